/* help.h - the text that --help prints, made from the tables of options. */
#ifndef MW_CLI_FRAME_HELP_H
#define MW_CLI_FRAME_HELP_H

#include "cli/frame/options.h"
#include "cli/frame/text.h"

/* Add the help of one command to a text: with all options, or with the essential ones. */
void help_of_command(text *t, const command *c, bool all);

/* Add words to a text, wrapped to the width of a page and indented. */
void help_wrap(text *t, const char *words, size_t indent);

#endif
