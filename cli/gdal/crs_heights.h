/* crs_heights.h - what coordinate systems say of heights, which nobody transforms. */
#ifndef MW_CLI_GDAL_CRS_HEIGHTS_H
#define MW_CLI_GDAL_CRS_HEIGHTS_H

/* Points of `path` are brought from one system to another: warn if their heights, which stay as
 * they are, mean something else there, as far as the systems tell: another vertical system, another
 * unit. A system is a text, as in gdal_crs.h. */
void crs_warn_of_heights(const char *path, const char *from, const char *to);

#endif
