#include "cli/raster/scan_triangle.h"
#include "cli/raster/scan_crossing.h"
#include "cli/raster/scan_plane.h"

#include <math.h>

/* --- rows ------------------------------------------------------------------------------------- */

static int64_t limit(double value, int64_t least, int64_t most)
{
    return value >= (double)most ? most : value > (double)least ? (int64_t)value : least;
}

int32_t scan_row_south_of(const raster_grid *g, double northing)
{
    int64_t rows = g->rows, row = limit((g->north - northing) / g->height - 0.5, 0, rows);
    while (row > 0 && g->y[row - 1] <= northing) row--;
    while (row < rows && g->y[row] > northing) row++;
    return (int32_t)row;
}

/* Rows of the strip whose centres lie between the corners of a triangle. */
static row_range rows_of_triangle(const scan_strip *s, const scan_vertex *const corner[3])
{
    const scan_vertex *a = corner[0], *b = corner[1], *c = corner[2],
                      *north = a->row < b->row ? a : b, *south = a->y < b->y ? a : b;
    if (c->row < north->row) north = c;
    if (c->y < south->y) south = c;
    /* That row is south of the corner, unless the corner is on it. */
    const bool reached = south->row < (int64_t)s->grid->rows && s->grid->y[south->row] == south->y;
    row_range r = {north->row, (int64_t)south->row - !reached};
    if (r.first < s->first) r.first = s->first;
    if (r.last > s->last) r.last = s->last;
    return r;
}

/* --- a triangle ------------------------------------------------------------------------------- */

/* A side from one corner to the next counter-clockwise. A horizontal one is not used. */
typedef struct scan_side {
    double from[2], to[2];
    double south, north;
    double start;  /* the column, between centres, of its first corner */
    double slope;  /* how many columns it goes east for each unit north */
    double unsure; /* bound for the error of a column where it crosses a row */
    double margin; /* a centre so many columns from the crossing is far enough for doubles */
    bool is_left;  /* of the triangle's pixels */
} scan_side;

typedef struct scan_triangle {
    uint32_t number;
    bool reversed;     /* the user gave it clockwise */
    bool plain;        /* weights in doubles are those of the library where areas exceed `least` */
    double x[3], y[3]; /* counter-clockwise, from the user's first corner */
    double value[3];   /* of the same corners */
    double least;
    double width;
    double south, north;
    double middle[2]; /* rows between these northings, near the middle corner, need exact tests */
    scan_side sides[3];
    const scan_side *across; /* the long side */
    const scan_side *lower, *upper;
    scan_plane plane;
} scan_triangle;

/* Set `least`. The library uses areas in doubles if each exceeds its error bound, at most 7e-16 *
 * width * height, and the sum of the bounds is below 2^-42 of the sum of the areas. The limit here
 * is more than twice as large, which covers the rounding of these tests. */
static void triangle_find_limits(scan_triangle *t, double area)
{
    double height = t->north - t->south, box = t->width * height;
    t->least = 4e-15 * box;
    t->plain = area > 0x1p-800 && area < 0x1p800 && 6e-15 * box < 0x1p-43 * area;
}

static void triangle_find_sides(scan_triangle *t, const scan_strip *s)
{
    const raster_grid *g = s->grid;
    const double u = 0x1p-53, reach = fmax(fabs(g->x[0]), fabs(g->x[g->columns - 1]));
    const double height = t->north - t->south, per_width = s->per_width;
    for (int k = 0; k < 3; k++) {
        int n = k == 2 ? 0 : k + 1;
        const double dy = t->y[n] - t->y[k], each = 1 / dy;
        scan_side *side = &t->sides[k];
        side->from[0] = t->x[k];
        side->from[1] = t->y[k];
        side->to[0] = t->x[n];
        side->to[1] = t->y[n];
        side->south = dy > 0 ? t->y[k] : t->y[n];
        side->north = dy > 0 ? t->y[n] : t->y[k];
        side->start = (t->x[k] - g->west) * per_width - 0.5;
        side->slope = (t->x[n] - t->x[k]) * each * per_width;
        side->is_left = dy < 0;
        /* Fewer than sixteen roundings, each of at most u of one of these. */
        side->unsure =
            32 * u *
            (fabs(side->slope) * height + (fabs(t->x[k]) + reach) * per_width + 1 + g->columns);
        /* The area between a side and a point is the height of the side times the distance along
         * the row. It must be above `least` as computed, so twice that is enough. */
        side->margin = side->unsure + 2 * t->least * fabs(each) * per_width;
    }
}

/* Name the sides. The area between the third side and a row falls with the distance of the row from
 * the middle corner, from all of `area` to nothing. */
static void triangle_name_sides(scan_triangle *t, double area)
{
    int across = 0;
    for (int k = 1; k < 3; k++)
        if (t->sides[k].north - t->sides[k].south > t->sides[across].north - t->sides[across].south)
            across = k;
    const int next = across == 2 ? 0 : across + 1, last = across == 0 ? 2 : across - 1;
    /* A long left side goes down, so the side after it begins at the lowest corner. */
    bool down = t->sides[across].is_left;
    t->across = &t->sides[across];
    t->lower = &t->sides[down ? next : last];
    t->upper = &t->sides[down ? last : next];
    const double middle = t->y[last], clear = 3 * t->least * (t->north - t->south) / area;
    t->middle[0] = middle - clear;
    t->middle[1] = middle + clear;
    if (!t->plain) t->middle[0] = -(double)INFINITY;
    if (!t->plain) t->middle[1] = (double)INFINITY;
}

/* The plane, and how far its values are from those of the library. With M the largest value, B the
 * area of the bounding box over `area`, at least 1, and u = 2^-53: an area has an error below 6.3 u
 * of the box. So the errors of the library's weights sum to less than 45 u B, and its value is off
 * by less than 70 u M B. The roundings of both slopes make less than 50 u M B. `area` is off by
 * less than 6.3 u B of itself, and so the plane by twice that times M. The roundings of a row and a
 * value make less than 30 u M B. In all this is less than 256 u M B. */
static void triangle_find_plane(scan_triangle *t, double area)
{
    const double *f = t->value, each = 1 / area;
    double bf = f[1] - f[0], cf = f[2] - f[0], largest = 0;
    double bx = t->x[1] - t->x[0], cx = t->x[2] - t->x[0];
    double by = t->y[1] - t->y[0], cy = t->y[2] - t->y[0];
    for (int k = 0; k < 3; k++) largest = fabs(f[k]) > largest ? fabs(f[k]) : largest;
    t->plane.x = t->x[0];
    t->plane.y = t->y[0];
    t->plane.base = 0 + f[0];
    t->plane.east = (bf * cy - cf * by) * each;
    t->plane.north = (cf * bx - bf * cx) * each;
    t->plane.error = 256 * 0x1p-53 * largest * (t->width * (t->north - t->south)) * each;
    /* Between these limits nothing overflows, and a value and its neighbours within the error do
     * not all round to a zero. */
    bool sound = largest == 0 || (t->plane.error > 0x1p-100 && t->plane.error < 0x1p100);
    if (!sound || !t->plain || isnan(f[0] + f[1] + f[2])) t->plane.error = (double)INFINITY;
}

/* False: it has no area, so no point is its own. */
static bool triangle_load(scan_triangle *t, const scan_strip *s, uint32_t number,
                          const scan_vertex *const corner[3])
{
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        p[k][0] = corner[k]->x;
        p[k][1] = corner[k]->y;
    }
    double area = mw_orient2d(p[0], p[1], p[2]);
    if (area == 0) return false;
    t->number = number;
    t->reversed = area < 0;
    for (int k = 0; k < 3; k++) {
        int from = t->reversed && k > 0 ? 3 - k : k;
        t->x[k] = p[from][0];
        t->y[k] = p[from][1];
        t->value[k] = corner[from]->value;
    }
    t->width = scan_greatest(t->x[0], t->x[1], t->x[2]) - scan_least(t->x[0], t->x[1], t->x[2]);
    t->south = scan_least(t->y[0], t->y[1], t->y[2]);
    t->north = scan_greatest(t->y[0], t->y[1], t->y[2]);
    triangle_find_limits(t, fabs(area));
    triangle_find_sides(t, s);
    triangle_name_sides(t, fabs(area));
    if (s->rounded) triangle_find_plane(t, fabs(area));
    return true;
}

/* --- where a row crosses a side --------------------------------------------------------------- */

/* Does the closed half-plane of a side contain the centre of a column? */
static bool side_holds(const scan_side *side, const raster_grid *g, int64_t column, double y)
{
    const double at[2] = {g->x[column], y};
    return mw_orient2d(side->from, side->to, at) >= 0;
}

/* Where a side crosses a row, in columns, is somewhere between *low and *high. */
static void side_cross(const scan_side *side, const raster_grid *g, double y, double *low,
                       double *high)
{
    double column = side->start + (y - side->from[1]) * side->slope;
    *low = column - side->unsure;
    *high = column + side->unsure;
    if (*low <= *high) return;
    *low = -1; /* overflow */
    *high = g->columns;
}

/* A double that is in the range -1 .. columns, rounded up. */
static int64_t column_above(double value, uint32_t columns)
{
    double most = columns;
    value = value > -1 ? value : -1;
    value = value < most ? value : most;
    int64_t whole = (int64_t)value;
    return whole + ((double)whole < value);
}

/* The first column inside a left side, or the first column beyond a right side. */
static int64_t side_first(const scan_side *side, const raster_grid *g, double y)
{
    double low, high;
    side_cross(side, g, y, &low, &high);
    int64_t first = column_above(low, g->columns), last = column_above(high, g->columns);
    if (first < 0) first = 0;
    while (first < last) {
        int64_t middle = first + (last - first) / 2;
        if (side_holds(side, g, middle, y) == side->is_left)
            last = middle;
        else
            first = middle + 1;
    }
    return first;
}

/* --- pixels of a row -------------------------------------------------------------------------- */

/* Values of pixels well within the triangle: the arithmetic of the library, in its order. */
static void triangle_values(const scan_triangle *t, double py, const double *restrict px,
                            double *restrict result, int64_t count)
{
    const double x0 = t->x[0], x1 = t->x[1], x2 = t->x[2];
    const double y0 = t->y[0] - py, y1 = t->y[1] - py, y2 = t->y[2] - py;
    const double f0 = t->value[0], f1 = t->value[1], f2 = t->value[2];
    if (t->reversed) {
        for (int64_t i = 0; i < count; i++) {
            double a = x0 - px[i], b = x1 - px[i], c = x2 - px[i];
            double area0 = b * y2 - y1 * c, area1 = c * y0 - y2 * a, area2 = a * y1 - y0 * b;
            double sum = area0 + area1 + area2;
            result[i] = 0 + area0 / sum * f0 + area2 / sum * f2 + area1 / sum * f1;
        }
        return;
    }
    for (int64_t i = 0; i < count; i++) {
        double a = x0 - px[i], b = x1 - px[i], c = x2 - px[i];
        double area0 = b * y2 - y1 * c, area1 = c * y0 - y2 * a, area2 = a * y1 - y0 * b;
        double sum = area0 + area1 + area2;
        result[i] = 0 + area0 / sum * f0 + area1 / sum * f1 + area2 / sum * f2;
    }
}

/* Pixels first .. last of a row belong to the triangle, and are far enough from its sides. */
static void triangle_fill_row(const scan_triangle *t, const scan_strip *s, int64_t row,
                              int64_t first, int64_t last)
{
    const raster_grid *g = s->grid;
    const size_t begin = (size_t)(row - s->first) * g->columns + (size_t)first;
    const int64_t count = last - first + 1;
    for (int64_t i = 0; s->rounded && i < count; i++) {
        double value;
        triangle_values(t, g->y[row], g->x + first + i, &value, 1);
        s->rounded[begin + (size_t)i] = (float)value;
    }
    if (s->result) triangle_values(t, g->y[row], g->x + first, s->result + begin, count);
    for (int64_t i = 0; s->triangles && i < count; i++) s->triangles[begin + (size_t)i] = t->number;
}

/* The answer of the library for one pixel. */
static void pixel_ask(const scan_strip *s, int64_t row, int64_t column)
{
    const raster_grid *g = s->grid;
    mw_location at = mw_locate(s->locator, s->cursor, g->x[column], g->y[row]);
    size_t i = (size_t)(row - s->first) * g->columns + (size_t)column;
    double value;
    if (s->triangles) s->triangles[i] = at.triangle;
    if (!s->result && !s->rounded) return;
    mw_interpolate(s->mesh, s->values, &at, 1, &value);
    if (s->result) s->result[i] = value;
    if (s->rounded) s->rounded[i] = (float)value;
}

/* Are the areas between the centre of a column and the sides large enough for doubles? */
static bool triangle_is_sure(const scan_triangle *t, double px, double py)
{
    double x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = t->x[k] - px;
        y[k] = t->y[k] - py;
    }
    return t->plain && x[1] * y[2] - y[1] * x[2] > t->least &&
           x[2] * y[0] - y[2] * x[0] > t->least && x[0] * y[1] - y[0] * x[1] > t->least;
}

/* Pixels first .. last of a row belong to the triangle. Only pixels near its sides need the test;
 * all pixels between two safe ones are safe. */
static void triangle_fill_tested(const scan_triangle *t, const scan_strip *s, int64_t row,
                                 int64_t first, int64_t last)
{
    const raster_grid *g = s->grid;
    double y = g->y[row];
    for (; first <= last && !triangle_is_sure(t, g->x[first], y); first++) pixel_ask(s, row, first);
    for (; first <= last && !triangle_is_sure(t, g->x[last], y); last--) pixel_ask(s, row, last);
    if (first <= last) triangle_fill_row(t, s, row, first, last);
}

/* A row by exact tests. */
static void triangle_test_row(const scan_triangle *t, const scan_strip *s, int64_t row)
{
    const raster_grid *g = s->grid;
    int64_t first = 0, end = g->columns;
    for (int k = 0; k < 3; k++) {
        /* A triangle is convex: in a row, the sides that cross it bound the triangle. */
        const scan_side *side = &t->sides[k];
        if (side->south == side->north || g->y[row] < side->south || g->y[row] > side->north)
            continue;
        int64_t column = side_first(side, g, g->y[row]);
        if (side->is_left && column > first) first = column;
        if (!side->is_left && column < end) end = column;
    }
    if (first < end) triangle_fill_tested(t, s, row, first, end - 1);
}

/* --- rows of a triangle ----------------------------------------------------------------------- */

static scan_crossing side_crossing(const scan_side *side)
{
    return scan_crossing_make(side->from[1], side->start, side->slope, side->margin);
}

/* The first pixel of each row, and the one behind the last. */
typedef struct row_ends {
    const int32_t *begin, *end;
} row_ends;

/* Rows first .. first + count - 1, of which the sides' crossings are known. */
static void triangle_fill_block(const scan_triangle *t, const scan_strip *s, int64_t first,
                                int64_t count, const scan_crossings *c, row_ends ends)
{
    for (int64_t i = 0; i < count; i++)
        if (c->sure[i] && ends.begin[i] < ends.end[i])
            triangle_fill_row(t, s, first + i, ends.begin[i], ends.end[i] - 1);
}

/* The same, as floats by the plane. False: it was not sure of them. */
static SCAN_INLINE bool triangle_plane_block(const scan_triangle *t, const scan_strip *s,
                                             int64_t first, int64_t count, const scan_crossings *c,
                                             row_ends ends)
{
    const raster_grid *g = s->grid;
    const int64_t columns = g->columns;
    float *row = s->rounded + (first - s->first) * columns;
    scan_ints unsure = {0};
    for (int64_t i = 0; i < count; i++, row += columns) {
        const int64_t begin = ends.begin[i], end = ends.end[i];
        if (c->sure[i] && begin < end)
            scan_plane_fill(&t->plane, g->y[first + i], g->x + begin, row + begin, end - begin,
                            columns - begin, &unsure);
    }
    return !scan_is_unsure(&unsure);
}

/* Rows first .. last of the strip. */
static SCAN_INLINE void triangle_fill_rows(const scan_triangle *t, const scan_strip *s,
                                           int64_t first, int64_t last)
{
    scan_crossings c; /* its arrays are filled row by row */
    c.across = side_crossing(t->across);
    c.upper = side_crossing(t->upper);
    c.lower = side_crossing(t->lower);
    c.middle[0] = t->middle[0];
    c.middle[1] = t->middle[1];
    c.columns = s->grid->columns;
    const bool is_left = t->across->is_left,
               by_plane = s->rounded && !s->result && !s->triangles && t->plane.error < 0x1p200;
    const row_ends ends = {is_left ? c.on_across : c.on_other, is_left ? c.on_other : c.on_across};
    for (; first <= last; first += SCAN_ROWS) {
        const int64_t left = last - first + 1, count = left < SCAN_ROWS ? left : SCAN_ROWS;
        scan_crossings_find(&c, s->grid->y + first, count);
        if (!by_plane || !triangle_plane_block(t, s, first, count, &c, ends))
            triangle_fill_block(t, s, first, count, &c, ends);
        for (int64_t i = 0; i < count; i++)
            if (!c.sure[i]) triangle_test_row(t, s, first + i);
    }
}

static void triangle_fill_rows_portable(const scan_triangle *t, const scan_strip *s, int64_t first,
                                        int64_t last)
{
    triangle_fill_rows(t, s, first, last);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void
triangle_fill_rows_avx2(const scan_triangle *t, const scan_strip *s, int64_t first, int64_t last)
{
    triangle_fill_rows(t, s, first, last);
}

#endif

void scan_triangle_fill(const scan_strip *s, uint32_t number, const scan_vertex *const corner[3])
{
    scan_triangle t;
    const row_range rows = rows_of_triangle(s, corner);
    if (rows.first > rows.last || !triangle_load(&t, s, number, corner)) return;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2")) {
        triangle_fill_rows_avx2(&t, s, rows.first, rows.last);
        return;
    }
#endif
    triangle_fill_rows_portable(&t, s, rows.first, rows.last);
}
