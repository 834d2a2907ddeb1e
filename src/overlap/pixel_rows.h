/* pixel_rows.h - the pixels of a raster that a triangle may overlap. Private. */
#ifndef MW_SRC_OVERLAP_PIXEL_ROWS_H
#define MW_SRC_OVERLAP_PIXEL_ROWS_H

#include "predicates/predicates.h"

#include <meshwalk/remap.h>

/* Rows first .. end - 1, or columns. */
typedef struct mw_pixel_range {
    uint32_t first, end;
} mw_pixel_range;

/* One more than needed at each end, because they come from rounded quotients; clipping decides. */
mw_pixel_range mw__pixel_rows(const mw_remap_pixels *pixels, const mw_point p[3]);
mw_pixel_range mw__pixel_columns(const mw_remap_pixels *pixels, const mw_point p[3], uint32_t row);

/* The corners of a pixel, counter-clockwise from the lower left; pixels that share an edge share
 * its coordinates. */
void mw__pixel_corners(const mw_remap_pixels *pixels, uint32_t row, uint32_t column,
                       mw_point corner[4]);

#endif
