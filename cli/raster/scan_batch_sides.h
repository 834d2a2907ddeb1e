/* scan_batch_sides.h - sides and planes of four triangles of a batch, each in a lane.
 *
 * A test that a NaN or an infinity fails leaves the triangle to scan_triangle.h. */
#ifndef MW_CLI_RASTER_SCAN_BATCH_SIDES_H
#define MW_CLI_RASTER_SCAN_BATCH_SIDES_H

#include "cli/raster/scan_batch_data.h"
#include "cli/raster/scan_vector.h"

/* The bounding box of a small triangle is at most so many times as large as twice its area. */
#define BATCH_THINNEST 1024

#define LANES(array) (*(scan_doubles *)(array))
#define LANES_MAGNITUDE(a) ((scan_doubles)((scan_mask)(a)&INT64_MAX))

/* What is the same for all triangles of a strip. */
typedef struct batch_terms {
    double west, height, per_width, columns;
    double reach; /* the greatest easting of a centre */
    double far;   /* twice the greatest northing, or more */
} batch_terms;

/* Corners from north to south, and what follows from them. */
typedef struct batch_lanes {
    scan_doubles x[3], y[3], value[3], row[3];
    scan_doubles low, high; /* eastings */
    scan_doubles area,
        box;             /* twice the area, positive if the middle corner is west; bounding box */
    scan_doubles column; /* first */
    scan_mask small;
} batch_lanes;

/* Sides that cross the first row at column start - 1 from the triangle's, and move by slope columns
 * for each unit north. */
typedef struct batch_side {
    scan_doubles start, slope;
} batch_side;

static SCAN_INLINE void lanes_lower(scan_doubles *a, const scan_doubles *b)
{
    const scan_mask less = *a < *b;
    scan_choose(&less, a, b);
}

static SCAN_INLINE void lanes_raise(scan_doubles *a, const scan_doubles *b)
{
    const scan_mask greater = *a > *b;
    scan_choose(&greater, a, b);
}

static SCAN_INLINE void lanes_exchange(const scan_mask *keep, scan_doubles *a, scan_doubles *b)
{
    const scan_doubles old = *a;
    scan_choose(keep, a, b);
    scan_choose(keep, b, &old);
}

/* Exchange corners i and i + 1 if i is south. */
static SCAN_INLINE void batch_order(batch_lanes *t, int i)
{
    const scan_mask keep = t->y[i] >= t->y[i + 1];
    lanes_exchange(&keep, &t->x[i], &t->x[i + 1]);
    lanes_exchange(&keep, &t->y[i], &t->y[i + 1]);
    lanes_exchange(&keep, &t->value[i], &t->value[i + 1]);
    lanes_exchange(&keep, &t->row[i], &t->row[i + 1]);
}

static SCAN_INLINE void batch_load(batch_lanes *t, scan_batch *b, int lane)
{
    for (int k = 0; k < 3; k++) {
        t->x[k] = LANES(b->x[k] + lane);
        t->y[k] = LANES(b->y[k] + lane);
        t->value[k] = LANES(b->value[k] + lane);
        t->row[k] = LANES(b->row[k] + lane);
    }
    batch_order(t, 0);
    batch_order(t, 1);
    batch_order(t, 0);
    t->low = t->high = t->x[0];
    for (int k = 1; k < 3; k++) lanes_lower(&t->low, &t->x[k]);
    for (int k = 1; k < 3; k++) lanes_raise(&t->high, &t->x[k]);
    t->area = (t->x[1] - t->x[0]) * (t->y[2] - t->y[0]) - (t->x[2] - t->x[0]) * (t->y[1] - t->y[0]);
    t->box = (t->high - t->low) * (t->y[0] - t->y[2]);
    const scan_doubles size = LANES_MAGNITUDE(t->area);
    t->small = (t->box < BATCH_THINNEST * size) & (size > 0x1p-800) & (size < 0x1p800);
}

/* Columns, as doubles, within those of the raster. */
static SCAN_INLINE void batch_clamp(const batch_terms *s, scan_doubles *column)
{
    const scan_doubles zero = {0}, most = zero + s->columns;
    lanes_raise(column, &zero);
    lanes_lower(column, &most);
    const scan_ints whole = __builtin_convertvector(*column, scan_ints);
    *column = __builtin_convertvector(whole, scan_doubles);
}

/* The first column is that of a centre at or west of the triangle; the last may be one too far
 * east. */
static SCAN_INLINE void batch_find_columns(batch_lanes *t, scan_batch *b, const batch_terms *s,
                                           int lane)
{
    scan_doubles end = (t->high - s->west) * s->per_width + 1;
    t->column = (t->low - s->west) * s->per_width - 0.5;
    batch_clamp(s, &t->column);
    batch_clamp(s, &end);
    LANES(b->column + lane) = t->column;
    LANES(b->columns + lane) = end - t->column;
    t->small &= end - t->column <= SCAN_BATCH_COLUMNS;
}

/* The planes: see triangle_find_plane, whose bound covers this too. The area is off by at most
 * 7 u B of itself in place of 6.3; B is at most BATCH_THINNEST; and the bound is taken from the
 * corner's value and added to it, then north and east follow, which are as many roundings. The
 * library's areas are within 6.3 u of the box, too, where it does not take doubles for all of them.
 */
static SCAN_INLINE void batch_find_planes(batch_lanes *t, scan_batch *b, int lane)
{
    const scan_doubles each = 1 / t->area, f = t->value[1] - t->value[0],
                       g = t->value[2] - t->value[0], x1 = t->x[1] - t->x[0],
                       y1 = t->y[1] - t->y[0], x2 = t->x[2] - t->x[0], y2 = t->y[2] - t->y[0];
    const scan_doubles sum = t->value[0] + t->value[1] + t->value[2];
    scan_doubles largest = LANES_MAGNITUDE(t->value[0]);
    for (int k = 1; k < 3; k++) {
        const scan_doubles other = LANES_MAGNITUDE(t->value[k]);
        lanes_raise(&largest, &other);
    }
    const scan_doubles error = 256 * 0x1p-53 * largest * t->box * LANES_MAGNITUDE(each);
    LANES(b->low + lane) = 0 + t->value[0] - error;
    LANES(b->high + lane) = 0 + t->value[0] + error;
    LANES(b->east + lane) = (f * y2 - g * y1) * each;
    LANES(b->north + lane) = (g * x1 - f * x2) * each;
    LANES(b->from[0] + lane) = t->x[0];
    LANES(b->from[1] + lane) = t->y[0];
    t->small &= (sum == sum) & ((largest == 0) | ((error > 0x1p-100) & (error < 0x1p100)));
}

/* The side from corner p to q. One that is not used is a 0. */
static SCAN_INLINE void batch_find_side(const batch_lanes *t, const batch_terms *s, int p, int q,
                                        const scan_doubles *at, const scan_mask *used,
                                        batch_side *side)
{
    const scan_doubles zero = {0};
    side->slope = (t->x[q] - t->x[p]) / (t->y[q] - t->y[p]) * s->per_width;
    scan_choose(used, &side->slope, &zero);
    side->start =
        (t->x[p] - s->west) * s->per_width + 0.5 - t->column + (*at - t->y[p]) * side->slope;
}

static SCAN_INLINE void batch_store_side(const batch_terms *s, const batch_side *side, float *start,
                                         float *step)
{
    const scan_doubles each = side->slope * -s->height;
    *(scan_floats *)start = __builtin_convertvector(side->start, scan_floats);
    *(scan_floats *)step = __builtin_convertvector(each, scan_floats);
}

/* Store which side is in the west. */
static SCAN_INLINE void batch_store_sides(const batch_lanes *t, scan_batch *b, const batch_terms *s,
                                          int lane, const batch_side *across,
                                          const batch_side side[2])
{
    const scan_mask is_west = t->area > 0;
    for (int k = 0; k < 2; k++) {
        batch_side west = side[k], east = *across;
        lanes_exchange(&is_west, &west.start, &east.start);
        lanes_exchange(&is_west, &west.slope, &east.slope);
        batch_store_side(s, &west, b->start[0][k] + lane, b->step[0][k] + lane);
        batch_store_side(s, &east, b->start[1][k] + lane, b->step[1][k] + lane);
    }
}

/* Sides are computed in doubles with fewer than sixteen roundings, each of at most u = 2^-53 of a
 * term of `doubles`: s->far is there for the northings of rows, which are not evenly spaced to the
 * last bit. As floats, crossings are off by at most 2^-24 of twice the start and three times the
 * way from there. */
static SCAN_INLINE void batch_find_sides(batch_lanes *t, scan_batch *b, const batch_terms *s,
                                         int lane)
{
    const scan_doubles at = LANES(b->at + lane), rows = LANES(b->rows + lane),
                       middle = t->row[1] - LANES(b->first + lane);
    const scan_mask all = {-1, -1, -1, -1}, above = middle > 0, below = middle < rows;
    batch_side across, side[2];
    batch_find_side(t, s, 0, 2, &at, &all, &across);
    batch_find_side(t, s, 0, 1, &at, &above, &side[0]);
    batch_find_side(t, s, 1, 2, &at, &below, &side[1]);
    LANES(b->middle + lane) = middle;
    batch_store_sides(t, b, s, lane, &across, side);
    scan_doubles slope = LANES_MAGNITUDE(across.slope), start = LANES_MAGNITUDE(across.start);
    for (int k = 0; k < 2; k++) {
        const scan_doubles one = LANES_MAGNITUDE(side[k].slope),
                           two = LANES_MAGNITUDE(side[k].start);
        lanes_raise(&slope, &one);
        lanes_raise(&start, &two);
    }
    const scan_doubles eastings = LANES_MAGNITUDE(t->low) + LANES_MAGNITUDE(t->high) + s->reach,
                       doubles = slope * (s->far + t->y[0] - t->y[2]) + eastings * s->per_width +
                                 1 + s->columns,
                       margin =
                           32 * 0x1p-53 * doubles + 0x1p-22 * (start + slope * s->height * rows),
                       clear = 0.5 - margin;
    *(scan_floats *)(b->clear + lane) = __builtin_convertvector(clear, scan_floats);
    t->small &= margin < 0x1p-4;
}

/* Compute what the lanes of a batch need. */
static SCAN_INLINE void batch_prepare(scan_batch *b, const batch_terms *terms)
{
    for (int lane = 0; lane < SCAN_BATCH; lane += SCAN_FOUR) {
        batch_lanes t;
        batch_load(&t, b, lane);
        batch_find_columns(&t, b, terms, lane);
        batch_find_planes(&t, b, lane);
        batch_find_sides(&t, b, terms, lane);
        *(scan_mask *)(b->small + lane) = t.small;
    }
}

#endif
