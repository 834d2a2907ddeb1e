/* signals.h - what an interrupt leaves behind: nothing.
 *
 * Where the system can write files without a name there is nothing to do. Elsewhere an output stands under a temporary
 * name until it is complete (mw_output_temporary), and these see to it. All threads but one hold back the signals that
 * ask the program to end; that one waits for them, so it may lock and clean up as any code may. */
#ifndef CLI_SIGNALS_H
#define CLI_SIGNALS_H

#include <stdbool.h>

/* Start to wait for signals; called once, before there are other threads. Where no thread can be had, signals end the
 * program as they would any other. */
void signals_begin(void);

/* When a signal asks the program to end: remove this file first, and no other. NULL: nothing to remove. */
void signals_remove(const char *temporary);
/* Remove this one, too, of up to MOST_TEMPORARIES. NULL: nothing more. */
#define MOST_TEMPORARIES 4
void signals_remove_too(const char *temporary);

/* Remove it now: the program ends without closing its output. */
void signals_clean(void);

/* Let such signals wait until released, for outputs that the library writes on its own. */
void signals_hold(bool hold);

#endif
