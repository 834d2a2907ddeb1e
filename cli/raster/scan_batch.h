/* scan_batch.h - small triangles, scan-converted to floats many at a time.
 *
 * Most triangles of a fine mesh have a few dozen pixels. Their sides and planes are computed in
 * lanes, a triangle in each; then each triangle's crossings in lanes of rows, and its pixels in
 * lanes of columns, without a branch for a row. Columns and rows count from the triangle's own
 * first ones, so floats are enough for the crossings. Bounds say whether each pixel is sure; a
 * triangle with one that is not, or that is too large, is left to scan_triangle.h. */
#ifndef MW_CLI_RASTER_SCAN_BATCH_H
#define MW_CLI_RASTER_SCAN_BATCH_H

#include "cli/raster/scan_batch_data.h"

/* Before the first triangle of a strip. False: there are no batches, and its triangles must go to
 * scan_triangle_fill: this processor lacks AVX2, whose vectors make batches worth while, or other
 * pixels than floats are wanted. */
bool scan_batch_begin(scan_batch *batch, const scan_strip *strip);

/* Like scan_triangle_fill, now or later. */
void scan_batch_add(scan_batch *batch, const scan_strip *strip, uint32_t number,
                    const scan_vertex *const corner[3]);

/* After the last triangle of the strip. */
void scan_batch_finish(scan_batch *batch, const scan_strip *strip);

#endif
