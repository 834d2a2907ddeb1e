/* vector_gdal.h - constraints from any vector file that GDAL reads.
 *
 * GDAL takes tens of milliseconds and of megabytes to load, so the program is not linked with it: the library is loaded
 * when a file is met that nothing else reads. */
#ifndef CLI_VECTOR_GDAL_H
#define CLI_VECTOR_GDAL_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* Was the program built with GDAL? */
bool vector_gdal_built(void);

/* Read all layers: points, lines, polygons, whatever contains them, and curves as chains of segments. Features are
 * numbered from 0 over all layers. Returns 0 or an exit code; release the file with mw_constraint_file_release. */
int vector_gdal_read(const char *path, mw_constraint_file *file);

#endif
