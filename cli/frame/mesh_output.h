/* mesh_output.h - the mesh that a command writes: its name, its format. */
#ifndef CLI_MESH_OUTPUT_H
#define CLI_MESH_OUTPUT_H

#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

/* The choices of --format: 0 goes by the ending of the name. */
extern const choices mesh_formats;

/* Refuse a mesh without a name, or whose format neither name nor --format tells. Returns 0 or an exit code after a complaint. */
int mesh_output_check(const char *asking, const char *output, int format);

/* Is it written as two files, .node and .ele? */
bool mesh_output_is_node(const char *output, int format);

/* Write it. `named`: under a temporary name (files_try_output). Returns 0 or an exit code. */
int mesh_output_write(const char *output, int format, const mw_mesh_file *file, bool named);

#endif
