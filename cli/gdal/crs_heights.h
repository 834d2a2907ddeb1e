/* crs_heights.h - what coordinate systems say of heights, which nobody transforms. */
#ifndef MW_CLI_GDAL_CRS_HEIGHTS_H
#define MW_CLI_GDAL_CRS_HEIGHTS_H

#include <stdbool.h>

/* Points of `path` are brought from one system to another: warn if their heights, which stay as
 * they are, mean something else there, as far as the systems tell: another vertical system, another
 * unit. A system is a text, as in gdal_crs.h. */
void crs_warn_of_heights(const char *path, const char *from, const char *to);

/* Heights of two files are to be compared, whose plane is in one system: refuse if the systems tell
 * that heights are not the same in both, by their name or unit. Warn, unless quiet, if only one of
 * them tells of heights. Returns 0, or an exit
 * code after a complaint. */
int crs_check_heights(const char *a_path, const char *a, const char *b_path, const char *b,
                      bool quiet);

/* The unit of the plane of a projected system, as "metre". False: not known. */
#define CRS_UNIT 40
bool crs_unit(const char *crs, char unit[CRS_UNIT]);

#endif
