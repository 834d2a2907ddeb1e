/* library_versions.h - what a program is built with, and what it finds where it runs. */
#ifndef MW_CLI_GDAL_LIBRARY_VERSIONS_H
#define MW_CLI_GDAL_LIBRARY_VERSIONS_H

#include "cli/frame/text.h"

/* Write a line for each library that reading and writing of files can do without. */
void library_versions_write(text *t);

/* Write such a line; version: NULL if the library is not built in. */
void library_version_line(text *t, const char *name, const char *version, const char *without);

#endif
