/* message.h - what the program says on standard error, and how it ends. */
#ifndef CLI_MESSAGE_H
#define CLI_MESSAGE_H

#include <meshwalk/meshwalk.h>

/* Exit codes: a contract with scripts (meshwalk.1). */
enum {
    END_DONE = 0,
    END_UNLOCATED = 1, /* done, but some points have no answer and --strict was given */
    END_USAGE = 2,
    END_INPUT = 3,    /* input unreadable or invalid */
    END_INTERNAL = 4, /* out of memory, a limit, or the output could not be written */
};

/* One line "meshwalk: ..." on standard error. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Report a failure of the library and return the exit code it means.
 *   fail_reading  a reader's error: its message begins with the file
 *   fail_mesh     an error about the mesh that was read from `path`
 *   fail_query    an option that the library refuses, or a limit
 *   fail_writing  an output's error; a closed pipe ends the program without a message */
int fail_reading(const mw_error *error);
int fail_mesh(const char *path, const mw_error *error);
int fail_query(const mw_error *error);
int fail_writing(const mw_error *error);
int fail_memory(void);

#endif
