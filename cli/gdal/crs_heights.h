/* crs_heights.h - what coordinate systems say about heights, which are never transformed. */
#ifndef MW_CLI_GDAL_CRS_HEIGHTS_H
#define MW_CLI_GDAL_CRS_HEIGHTS_H

#include <stdbool.h>

/* Points of `path` are transformed from one system to another, but their heights are not: warn if
 * the systems name different vertical systems or units. A system is a text, as in gdal_crs.h. */
void crs_warn_of_heights(const char *path, const char *from, const char *to);

/* Heights of two files in the same plane system are to be compared: refuse if the systems name
 * different vertical systems or units. Warn, unless quiet, if only one of them names its heights.
 * Returns 0, or an exit code after a complaint. */
int crs_check_heights(const char *a_path, const char *a, const char *b_path, const char *b,
                      bool quiet);

/* The unit of the plane of a projected system, as "metre". False: not known. */
#define CRS_UNIT 40
bool crs_unit(const char *crs, char unit[CRS_UNIT]);

#endif
