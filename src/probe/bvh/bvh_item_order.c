/* bvh_item_order.c - triangles whose boxes all have one centre: their order, where it is cut. */
#include "base/random.h"
#include "probe/bvh/bvh_item.h"

#include <stdlib.h>

/* A number for the corners of a triangle: equal triangles have one number, others seldom. As a
 * float it is neither 0 nor infinite. */
static float corners_number(const mw_surface *surface, uint32_t triangle)
{
    uint64_t mixed = 0, bits;
    for (uint32_t i = 0; i < 9; i++) {
        double x = mw__surface_corner(surface, triangle, i / 3)[i % 3] + 0.0; /* no -0 */
        memcpy(&bits, &x, sizeof bits);
        mixed = mw__mix(mixed + bits);
    }
    uint32_t number = NORMAL_FLOAT | (uint32_t)mixed % (NORMAL_FLOAT / 2);
    float as_float;
    memcpy(&as_float, &number, sizeof as_float);
    return as_float;
}

/* Smaller boxes first, then by corners, then by number. */
static int compare_items(const void *a, const void *b)
{
    build_item x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    float x_area = area_of(x.low, x.high), y_area = area_of(y.low, y.high);
    if (x_area != y_area) return x_area < y_area ? -1 : 1;
    if (x.high[3] != y.high[3]) return x.high[3] < y.high[3] ? -1 : 1;
    return item_triangle(&x) < item_triangle(&y) ? -1 : 1;
}

void mw__bvh_items_order(build_item *item, uint32_t n, const mw_surface *surface)
{
    if (item[0].high[3] != 0) return;
    for (uint32_t i = 0; i < n; i++)
        item[i].high[3] = corners_number(surface, item_triangle(&item[i]));
    qsort(item, n, sizeof *item, compare_items);
}

uint32_t mw__bvh_items_cut(const build_item *item, uint32_t n)
{
    const uint32_t middle = n / 2;
    for (uint32_t off = 0; off < middle; off++) {
        const uint32_t before = middle - off, behind = middle + off;
        if (item[before].high[3] != item[before - 1].high[3]) return before;
        if (behind < n && item[behind].high[3] != item[behind - 1].high[3]) return behind;
    }
    return middle;
}
