/* progress.h - a line on standard error that shows how far long work has come. There is one for the
 * program. */
#ifndef MW_CLI_FRAME_PROGRESS_H
#define MW_CLI_FRAME_PROGRESS_H

#include <meshwalk/base.h>
#include <stdbool.h>
#include <stdint.h>

/* Begin to show progress, unless `quiet`. The line appears only on a terminal, and only after the
 * work has taken a second. */
void progress_begin(bool quiet);

/* Tell what the program does now, and to which file: "reading", "terrain.ply". The file "-" is
 * shown as standard input; NULL shows none. Both strings must stay valid until the next call. */
void progress_phase(const char *doing, const char *what);

/* Tell how many points or lines this phase has done so far, and what share of all that is (-1: not
 * known). */
void progress_points(uint64_t done, double fraction);
void progress_lines(uint64_t done, double fraction);

/* The next calls of the library do the part from..to of this phase, as fractions; -1: unknown. By
 * default each call counts as a whole phase, 0..1. */
void progress_part(double from, double to);

/* For calls of the library: shows their stage and their fraction, and cancels them when a signal
 * asks the program to end. Never NULL. */
const mw_progress *progress_of_call(void);

/* Stop and wipe the line. Whoever writes to standard error calls this first. */
void progress_end(void);

#endif
