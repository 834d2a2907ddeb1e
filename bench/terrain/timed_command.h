/* timed_command.h - a program that is run, and how long it takes. */
#ifndef MW_BENCH_TERRAIN_TIMED_COMMAND_H
#define MW_BENCH_TERRAIN_TIMED_COMMAND_H

#include <stdbool.h>

typedef struct command_time {
    double seconds;   /* by the clock */
    double processor; /* of the processor: the program's own, and the system's for it */
} command_time;

/* Is a program in the path? */
bool command_is_there(const char *program);

/* Run words[0], which is searched in the path, in a folder, and wait for its end. Its outputs go to
 * "log" in the folder. Returns 0, or an exit code after a complaint. */
int command_run(const char *folder, const char *const *words, command_time *time);

#endif
