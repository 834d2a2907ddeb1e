/* gdal_layers.h - what a vector file that GDAL reads holds: its layers. */
#ifndef MW_CLI_GDAL_GDAL_LAYERS_H
#define MW_CLI_GDAL_GDAL_LAYERS_H

#include "cli/frame/report.h"

/* Report the names of the layers, and of the layer `wanted`, or the only one, what its features
 * are: their geometry and number, fields and coordinate system. Returns 0, or an exit code after a
 * complaint. */
int gdal_layers_report(const char *path, const char *wanted, report *r);

#endif
