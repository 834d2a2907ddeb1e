/* pixel_rows.c - the pixels near a triangle. */
#include "overlap/pixel_rows.h"

static double pixel_x(const mw_remap_pixels *pixels, double column)
{
    return pixels->west + column * pixels->width;
}
static double pixel_y(const mw_remap_pixels *pixels, double row)
{
    return pixels->north - row * pixels->height;
}

/* The numbers of the cells from `low` to `high`, which are in widths of a cell; and one more at
 * each end. */
static mw_pixel_range pixel_range(double low, double high, uint32_t count)
{
    double first = floor(low) - 1, end = floor(high) + 2;
    if (!(first > 0)) first = 0;
    if (!(end < count)) end = count;
    if (!(first < end)) return (mw_pixel_range){0, 0};
    return (mw_pixel_range){(uint32_t)first, (uint32_t)end};
}

mw_pixel_range mw__pixel_rows(const mw_remap_pixels *pixels, const mw_point p[3])
{
    double low = fmin(fmin(p[0].y, p[1].y), p[2].y), high = fmax(fmax(p[0].y, p[1].y), p[2].y);
    return pixel_range((pixels->north - high) / pixels->height,
                       (pixels->north - low) / pixels->height, pixels->rows);
}

/* The x of the edge ab at a height between its ends. */
static double pixel_edge_x(mw_point a, mw_point b, double y)
{
    double t = (y - a.y) / (b.y - a.y);
    return a.x + fmin(fmax(t, 0), 1) * (b.x - a.x);
}

mw_pixel_range mw__pixel_columns(const mw_remap_pixels *pixels, const mw_point p[3], uint32_t row)
{
    /* A margin of a hundredth of a row makes up for rounding. */
    double top = pixel_y(pixels, row - 0.01), bottom = pixel_y(pixels, row + 1.01);
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < 3; k++) {
        mw_point a = p[k], b = p[k == 2 ? 0 : k + 1];
        if (fmax(a.y, b.y) < bottom || fmin(a.y, b.y) > top) continue;
        double x[2] = {a.x, b.x};
        if (a.y != b.y) {
            x[0] = pixel_edge_x(a, b, fmax(fmin(a.y, b.y), bottom));
            x[1] = pixel_edge_x(a, b, fmin(fmax(a.y, b.y), top));
        }
        low = fmin(low, fmin(x[0], x[1]));
        high = fmax(high, fmax(x[0], x[1]));
    }
    if (low > high) return (mw_pixel_range){0, 0};
    return pixel_range((low - pixels->west) / pixels->width, (high - pixels->west) / pixels->width,
                       pixels->columns);
}

void mw__pixel_corners(const mw_remap_pixels *pixels, uint32_t row, uint32_t column,
                       mw_point corner[4])
{
    double west = pixel_x(pixels, column), east = pixel_x(pixels, column + 1.0),
           north = pixel_y(pixels, row), south = pixel_y(pixels, row + 1.0);
    corner[0] = (mw_point){west, south};
    corner[1] = (mw_point){east, south};
    corner[2] = (mw_point){east, north};
    corner[3] = (mw_point){west, north};
}
