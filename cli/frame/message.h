/* message.h - the messages of the program on standard error, and its exit codes. */
#ifndef MW_CLI_FRAME_MESSAGE_H
#define MW_CLI_FRAME_MESSAGE_H

#include <meshwalk/meshwalk.h>

/* Exit codes. Scripts rely on them (meshwalk.1). */
enum {
    END_DONE = 0,
    /* done, but points have no answer and --strict was given, or defects remain */
    END_UNANSWERED = 1,
    END_USAGE = 2,
    END_INPUT = 3,    /* the input cannot be read, or is not valid */
    END_RESOURCE = 4, /* out of memory, beyond a limit, or the output cannot be written */
};

/* Print one line "meshwalk: ..." on standard error. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Complain of an error of the library and return its exit code.
 *   fail_reading  an error of a reader: its message names the file
 *   fail_mesh     an error about the mesh that was read from `path`; where the file has the
 *                 triangle follows, if message_note_place has told it
 *   fail_query    the library refuses an option, or a limit is reached
 *   fail_writing  an error of an output; a closed pipe gives no message
 *   fail_memory   out of memory */
/* Where the file `path` has a triangle, as a sentence; kept until the next call. */
void message_note_place(const char *path, size_t triangle, const char *sentence);

int fail_reading(const mw_error *error);
int fail_mesh(const char *path, const mw_error *error);
int fail_query(const mw_error *error);
int fail_writing(const mw_error *error);
int fail_memory(void);

#endif
