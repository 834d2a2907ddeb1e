/* signals.h - an interrupted program leaves no temporary file behind.
 *
 * An output has a temporary name until it is complete (mw_output_temporary) on systems that cannot
 * write files without a name; on others there is nothing to remove. All threads but one block the
 * signals that ask the program to end. That one waits for them, so it may lock a mutex and remove
 * files, which a signal handler may not. */
#ifndef MW_CLI_FRAME_SIGNALS_H
#define MW_CLI_FRAME_SIGNALS_H

#include <stdbool.h>

/* Start the waiting thread. Call it once, before other threads start. If the thread cannot be made,
 * signals end the program as usual. */
void signals_begin(void);

#define MAX_TEMPORARIES 4 /* files to remove at a time */

/* Set the only file to remove when a signal ends the program; NULL: remove none. */
void signals_set_temporary(const char *temporary);
/* Add one more such file; NULL adds none. */
void signals_add_temporary(const char *temporary);

/* Remove the files now: the program ends without closing its outputs. */
void signals_remove_temporaries(void);

/* Hold signals back until released, while the library writes an output of its own;
 * signals_have_come() then cancels that call. */
void signals_hold(bool hold);

/* Has a signal asked the program to end? It ends when signals are released. */
bool signals_have_come(void);

/* Wait for that end, after a call of the library was cancelled for it. */
_Noreturn void signals_await_end(void);

#endif
