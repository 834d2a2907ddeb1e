/* progress.h - one line on standard error that tells how far long work is. There is one progress in the program. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

/* Shown only where standard error is a terminal, and only once the work has taken a second. */
void progress_begin(bool quiet);

/* What is being done now, and on what: "reading", "terrain.ply"; "-" is standard input, NULL nothing worth a name. Both
 * must live until the next call. */
void progress_phase(const char *doing, const char *what);

/* How many points, or lines, this phase has done. */
void progress_points(uint64_t done);
void progress_lines(uint64_t done);

/* Stop, and wipe the line. Called before anything else is written to standard error, and at the end. */
void progress_end(void);

#endif
