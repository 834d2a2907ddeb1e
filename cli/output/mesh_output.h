/* mesh_output.h - the mesh that a command writes: its name and its format. */
#ifndef MW_CLI_OUTPUT_MESH_OUTPUT_H
#define MW_CLI_OUTPUT_MESH_OUTPUT_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

/* The choices of --format. Number 0 is "auto": the ending of the name decides. */
extern const choices mesh_formats;

/* Refuse a missing output, and one whose format neither its ending nor --format tells. Returns 0,
 * or END_USAGE after a complaint. */
int mesh_output_check(const char *command_name, const char *output, int format);

/* Is the mesh written as two files, .node and .ele? */
bool mesh_output_is_node(const char *output, int format);

/* Warn if the format has no place for the fields of the mesh, or for its heights. */
void mesh_output_warn(const char *output, int format, const mw_mesh_file *file);

/* Write the mesh, and beside a format that cannot hold its coordinate system a .prj file.
 * `temporary` is what files_try_output told; `quiet`: no remarks. Returns 0, or an exit code after
 * a complaint. */
int mesh_output_write(const char *output, int format, const mw_mesh_file *file, bool temporary,
                      bool quiet);

#endif
