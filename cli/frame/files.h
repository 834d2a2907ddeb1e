/* files.h - the files that a command reads and writes. */
#ifndef MW_CLI_FRAME_FILES_H
#define MW_CLI_FRAME_FILES_H

#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

/* Does a path mean standard input or standard output? "-" and NULL do. */
bool files_is_standard(const char *path);

/* Refuse an output that is also an input. Two paths may be one file by a link, or as the two halves
 * .node and .ele of one mesh. Refuse also to read standard input twice. Returns 0, or END_USAGE
 * after a complaint. */
int files_check_output(const char *output, const char *const *inputs, int count);

/* Refuse a text output whose name has the ending of another format, such as .gpkg or .gz. Returns
 * 0, or END_USAGE after a complaint. */
int files_check_text_output(const char *output);

/* Are two outputs the same file, by links or by other names of its directory too? Neither needs to
 * exist. */
bool files_same_output(const char *one, const char *other);

/* If the name is that of a raster, say how a mesh is made of it: it was not what is needed. */
bool files_remark_raster(const char *path);

/* The layout of meshes in netCDF that are read from now on; NULL: recognised. */
void files_use_layout(const char *layout);

/* Read a mesh. Returns 0, or an exit code after a complaint. */
int files_read_mesh(const char *path, mw_mesh_file *file);

/* Does a triangle have an area? In a mesh without one no point can be located. */
bool files_has_area(const mw_mesh_file *file);

/* Check before long work that an output can be written. If `temporary` is not NULL, *temporary says
 * whether the file is written under a temporary name. Returns 0, or an exit code after a complaint.
 */
int files_try_output(const char *output, bool *temporary);

/* Write a text as one file, or to standard output if the path is NULL; or write it to standard
 * error. Both release the text, and return 0, or an exit code after a complaint. */
int files_write_text(const char *output, text *t);
int files_write_error_text(text *t);

#endif
