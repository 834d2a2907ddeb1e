/* gdal_constraints.h - constraints from any vector file that GDAL reads. */
#ifndef MW_CLI_CONSTRAINTS_GDAL_CONSTRAINTS_H
#define MW_CLI_CONSTRAINTS_GDAL_CONSTRAINTS_H

#include "cli/constraints/feature_values.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* What is read. All zero: all layers, no attributes. */
typedef struct gdal_constraints_options {
    /* the only one that is read; NULL: see `polygons` */
    const char *layer;
    /* without `layer`: the only layer that has polygons, or lines; several are an error */
    bool polygons, lines;
    /* NULL, or filled with the attributes that its list names */
    feature_values *values;
} gdal_constraints_options;

/* Read points, lines and polygons, also those inside collections; curves become chains of segments.
 * Features are numbered from 0 over all layers that are read. Returns 0, or an exit code after a
 * complaint; release the file with mw_constraint_file_release. */
int gdal_constraints_read(const char *path, const gdal_constraints_options *options,
                          mw_constraint_file *file);

#endif
