/* gdal_constraints.h - constraints from any vector file that GDAL reads. */
#ifndef MW_CLI_INPUT_GDAL_CONSTRAINTS_H
#define MW_CLI_INPUT_GDAL_CONSTRAINTS_H

#include <meshwalk/meshwalk.h>

/* Read the points, lines and polygons of all layers, also those inside collections; curves become
 * chains of segments. Features are numbered from 0 over all layers. Returns 0, or an exit code
 * after a complaint; release the file with mw_constraint_file_release. */
int gdal_constraints_read(const char *path, mw_constraint_file *file);

#endif
