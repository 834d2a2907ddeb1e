/* signals.h - what an interrupt leaves behind: nothing.
 *
 * Where the system can write files without a name there is nothing to do. Elsewhere an output stands under a temporary
 * name until it is complete (mw_output_temporary), and these two see to it. */
#ifndef CLI_SIGNALS_H
#define CLI_SIGNALS_H

#include <stdbool.h>

/* When a signal asks the program to end: remove this file first. NULL: nothing to remove. */
void signals_remove(const char *temporary);

/* Hold such signals back until released, for outputs that the library writes on its own. */
void signals_hold(bool hold);

#endif
