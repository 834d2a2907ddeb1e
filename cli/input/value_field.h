/* value_field.h - the values of a mesh that a command interpolates: z, or a field. */
#ifndef MW_CLI_INPUT_VALUE_FIELD_H
#define MW_CLI_INPUT_VALUE_FIELD_H

#include "cli/input/nodata.h"

#include <meshwalk/meshwalk.h>

/* The field that is asked for. */
typedef struct value_field {
    const char *name;
    nodata_rule nodata;
    bool quiet;
} value_field;

/* Copy the field from the file of a mesh, read from `path`, to the mesh; a vertex without a value
 * gets NaN. `self` is the value_field. Returns 0, or an exit code after a complaint that lists the
 * fields. */
int value_field_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self);

#endif
