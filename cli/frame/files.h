/* files.h - the files a command reads and writes. */
#ifndef CLI_FILES_H
#define CLI_FILES_H

#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

/* "-" and NULL: a standard stream. */
bool files_is_stream(const char *path);

/* Refuse an output that is one of the inputs, also through a link or as the other half of .node and .ele: complains and
 * returns END_USAGE. Also refuses to read standard input twice. Returns 0 if all is well. */
int files_check(const char *output, const char *const *inputs, int count);

/* Would two outputs be one file, also by another name of its directory, or through a link? They need not exist yet. */
bool files_same_output(const char *one, const char *other);

/* Read a mesh, complaining about what is wrong with it. Returns 0 or an exit code. */
int files_read_mesh(const char *path, mw_mesh_file *file);

/* Is there a triangle with an area? Without one no point can be located. */
bool files_has_area(const mw_mesh_file *file);

/* Can the output be written at all? Better asked before long work than after it. `named`, if not NULL, is set if the
 * system writes it under a temporary name. Returns 0 or an exit code. */
int files_try_output(const char *output, bool *named);

/* Write a text as a whole; output NULL is standard output. The text is released. Returns 0 or an exit code. */
int files_write_text(const char *output, text *t);

#endif
