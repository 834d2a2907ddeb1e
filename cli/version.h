/* version.h - what the program is built with, and what it finds where it runs. */
#ifndef MW_CLI_VERSION_H
#define MW_CLI_VERSION_H

#include "cli/frame/text.h"

/* Write the version of the program, then a line for each library that it can do without. */
void version_write(text *t);

#endif
