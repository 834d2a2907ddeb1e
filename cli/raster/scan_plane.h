/* scan_plane.h - the plane of a triangle's values, and the floats of pixels that it is sure of. */
#ifndef MW_CLI_RASTER_SCAN_PLANE_H
#define MW_CLI_RASTER_SCAN_PLANE_H

#include "cli/raster/scan_vector.h"

#include <stdbool.h>

/* A value is base + north * (y - plane.y) + east * (x - plane.x). */
typedef struct scan_plane {
    double x, y; /* the triangle's first corner */
    double base, east, north;
    double error; /* bound for the difference of what the plane has from what mw_interpolate has;
                   * infinite: the plane cannot be used */
} scan_plane;

/* Four pixels, of which the first `count` are filled. *unsure: those whose float may be another. */
static SCAN_INLINE void scan_plane_four(const scan_plane *f, double base, const double *px,
                                        float *result, int64_t count, scan_ints *unsure)
{
    const scan_ints lane = {0, 1, 2, 3}, mine = lane < (int32_t)count;
    const scan_doubles value = base + f->east * (*(const scan_doubles *)px - f->x);
    const scan_floats low = __builtin_convertvector(value - f->error, scan_floats),
                      high = __builtin_convertvector(value + f->error, scan_floats);
    scan_floats *to = (scan_floats *)result;
    *unsure |= mine & (low != high);
    *to = (scan_floats)(((scan_ints)low & mine) | ((scan_ints)*to & ~mine));
}

/* The same, one by one. */
static SCAN_INLINE void scan_plane_singly(const scan_plane *f, double base, const double *px,
                                          float *result, int64_t count, scan_ints *unsure)
{
    for (int64_t i = 0; i < count; i++) {
        const double value = base + f->east * (px[i] - f->x);
        result[i] = (float)(value - f->error);
        (*unsure)[0] |= result[i] != (float)(value + f->error);
    }
}

/* Fill `count` pixels of a row, whose centres are px; `room`: pixels from the first to the end of
 * the row, which pixels behind the last keep. If all doubles that are as near to the plane as the
 * library's value round to one float, it is the float of that value. *unsure is no longer 0 if some
 * pixel is not so. Most rows of a triangle are short: so the first eight pixels need no jump. */
static SCAN_INLINE void scan_plane_fill(const scan_plane *plane, double py, const double *px,
                                        float *result, int64_t count, int64_t room,
                                        scan_ints *unsure)
{
    const scan_plane f = *plane;
    const double base = f.base + f.north * (py - f.y);
    int64_t i = 2 * SCAN_FOUR;
    if (room < i) {
        scan_plane_singly(&f, base, px, result, count, unsure);
        return;
    }
    scan_plane_four(&f, base, px, result, count < i ? count : i, unsure);
    scan_plane_four(&f, base, px + SCAN_FOUR, result + SCAN_FOUR,
                    count < i ? count - SCAN_FOUR : SCAN_FOUR, unsure);
    for (; i < count && i + SCAN_FOUR <= room; i += SCAN_FOUR)
        scan_plane_four(&f, base, px + i, result + i, count - i < SCAN_FOUR ? count - i : SCAN_FOUR,
                        unsure);
    if (i < count) scan_plane_singly(&f, base, px + i, result + i, count - i, unsure);
}

/* Is there a pixel of which the plane was not sure? */
static SCAN_INLINE bool scan_is_unsure(const scan_ints *unsure)
{
    return ((*unsure)[0] | (*unsure)[1] | (*unsure)[2] | (*unsure)[3]) != 0;
}

#endif
