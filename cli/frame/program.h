/* program.h - a program of sub-commands. */
#ifndef MW_CLI_FRAME_PROGRAM_H
#define MW_CLI_FRAME_PROGRAM_H

#include "cli/frame/options.h"

/* The command of a name; NULL: there is none. */
const command *program_find(const command *const *commands, size_t count, const char *name);

/* Run a command with the arguments after its name, which end with NULL; or print its help, if they
 * ask for it. Returns the exit code. */
int program_run(const command *c, char **arguments);

#endif
