#include "cli/raster/raster_scan.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>

/* A triangle that reaches into more strips than this is in the list of tall ones, which every strip
 * goes through. */
enum { MOST_STRIPS = 4 };

/* A strip has at most so many rows, and about as many pixels at most as stay in a cache. */
enum { MOST_ROWS = 32, STRIP_PIXELS = 1 << 19 };

/* A vertex as the scan has it. */
typedef struct scan_vertex {
    double x, y, value;
    uint32_t number; /* of the mesh */
} scan_vertex;

/* Its vertices are those of the mesh in the order in which triangles have them first: so triangles
 * that follow each other find theirs near each other, whatever the order in the file. */
struct raster_scan {
    const mw_locator *locator;
    const mw_mesh *mesh;
    const raster_grid *grid;
    const double *values; /* those that the vertices have; NULL: none */
    scan_vertex *vertices;
    uint32_t *corners; /* three of each triangle, in `vertices` */
    uint32_t vertex_count;
    uint32_t height, strips, tall_count;
    size_t *begin;       /* of each strip's triangles in `triangles`, and the end of the last */
    uint32_t *triangles; /* those that reach into a strip, and few others */
    uint32_t *tall;
};

/* --- rows and strips -------------------------------------------------------------------------- */

/* Rows whose centres lie between two northings: first .. last. None if first > last. */
typedef struct row_range {
    int64_t first, last;
} row_range;

static int64_t limit(double value, int64_t least, int64_t most)
{
    return value >= (double)most ? most : value > (double)least ? (int64_t)value : least;
}

static row_range rows_between(const raster_grid *g, double south, double north)
{
    int64_t rows = g->rows;
    row_range r = {limit((g->north - north) / g->height - 0.5, 0, rows),
                   limit((g->north - south) / g->height - 0.5, -1, rows - 1)};
    while (r.first > 0 && g->y[r.first - 1] <= north) r.first--;
    while (r.first < rows && g->y[r.first] > north) r.first++;
    while (r.last + 1 < rows && g->y[r.last + 1] >= south) r.last++;
    while (r.last >= 0 && g->y[r.last] < south) r.last--;
    return r;
}

static double scan_least(double a, double b, double c)
{
    double low = a < b ? a : b;
    return low < c ? low : c;
}

static double scan_greatest(double a, double b, double c)
{
    double high = a > b ? a : b;
    return high > c ? high : c;
}

static row_range rows_of_triangle(const raster_scan *s, uint32_t t)
{
    const uint32_t *v = s->corners + 3 * (size_t)t;
    double a = s->vertices[v[0]].y, b = s->vertices[v[1]].y, c = s->vertices[v[2]].y;
    return rows_between(s->grid, scan_least(a, b, c), scan_greatest(a, b, c));
}

/* Copy the triangles and their vertices. */
static bool scan_copy(raster_scan *s)
{
    uint32_t count = mw_mesh_triangle_count(s->mesh), n = mw_mesh_vertex_count(s->mesh);
    uint32_t *index = malloc(((size_t)n + 1) * sizeof *index); /* in `vertices`, of each number */
    double p[2];
    s->corners = malloc((3 * (size_t)count + 1) * sizeof *s->corners);
    s->vertices = malloc(((size_t)n + 1) * sizeof *s->vertices);
    bool done = index && s->corners && s->vertices;
    for (uint32_t v = 0; done && v < n; v++) index[v] = MW_NONE;
    for (uint32_t t = 0; done && t < count; t++) {
        uint32_t *corner = s->corners + 3 * (size_t)t;
        mw_mesh_triangle(s->mesh, t, corner);
        for (int k = 0; k < 3; k++) {
            uint32_t v = corner[k];
            if (index[v] == MW_NONE) {
                index[v] = s->vertex_count++;
                mw_mesh_vertex(s->mesh, v, p);
                s->vertices[index[v]] = (scan_vertex){p[0], p[1], 0, v};
            }
            corner[k] = index[v];
        }
    }
    free(index);
    return done;
}

void raster_scan_take_values(raster_scan *s, const double *values)
{
    s->values = values;
    for (uint32_t v = 0; values && v < s->vertex_count; v++)
        s->vertices[v].value = values[s->vertices[v].number];
}

/* Sort the triangles into strips: count, then fill. */
static bool scan_sort(raster_scan *s)
{
    uint32_t count = mw_mesh_triangle_count(s->mesh);
    size_t *at = calloc((size_t)s->strips + 2, sizeof *at);
    s->begin = at;
    s->tall = malloc(((size_t)count + 1) * sizeof *s->tall);
    row_range *ranges = malloc(((size_t)count + 1) * sizeof *ranges);
    bool done = at && s->tall && ranges;
    for (uint32_t t = 0; done && t < count; t++) {
        row_range r = rows_of_triangle(s, t);
        ranges[t] = (row_range){r.first / s->height, r.last / s->height};
        if (r.first > r.last) ranges[t] = (row_range){0, -1};
        if (ranges[t].last - ranges[t].first >= MOST_STRIPS) {
            s->tall[s->tall_count++] = t;
            ranges[t] = (row_range){0, -1};
        }
        for (int64_t i = ranges[t].first; i <= ranges[t].last; i++) at[i + 2]++;
    }
    for (uint32_t i = 0; done && i < s->strips; i++) at[i + 2] += at[i + 1];
    s->triangles = done ? malloc((at[s->strips + 1] + 1) * sizeof *s->triangles) : NULL;
    done = done && s->triangles;
    for (uint32_t t = 0; done && t < count; t++)
        for (int64_t i = ranges[t].first; i <= ranges[t].last; i++) s->triangles[at[i + 1]++] = t;
    free(ranges);
    return done;
}

int raster_scan_create(raster_scan **scan, const mw_locator *locator, const mw_mesh *mesh,
                       const raster_grid *grid)
{
    raster_scan *s = *scan = calloc(1, sizeof *s);
    if (!s) return fail_memory();
    *s = (raster_scan){.locator = locator, .mesh = mesh, .grid = grid};
    s->height = grid->columns <= STRIP_PIXELS / MOST_ROWS ? MOST_ROWS
                : grid->columns <= STRIP_PIXELS           ? STRIP_PIXELS / grid->columns
                                                          : 1;
    s->strips = (uint32_t)(((uint64_t)grid->rows + s->height - 1) / s->height);
    return scan_copy(s) && scan_sort(s) ? 0 : fail_memory();
}

void raster_scan_release(raster_scan *s)
{
    if (!s) return;
    free(s->vertices);
    free(s->corners);
    free(s->begin);
    free(s->triangles);
    free(s->tall);
    free(s);
}

uint32_t raster_scan_strips(const raster_scan *s)
{
    return s->strips;
}

uint32_t raster_scan_height(const raster_scan *s)
{
    return s->height;
}

/* --- one triangle ----------------------------------------------------------------------------- */

/* A side from corner p on, which is not horizontal. */
typedef struct scan_side {
    double from[2], to[2];
    double south, north;
    double start;  /* the column, between centres, of its corner */
    double slope;  /* how many columns it goes east for each unit north */
    double unsure; /* bound for the error of a column where it crosses a row */
    bool is_left;  /* of the triangle's pixels */
} scan_side;

typedef struct scan_triangle {
    uint32_t number;
    bool reversed;     /* the user gave it clockwise */
    bool plain;        /* weights in doubles are those of the library where areas exceed `least` */
    double x[3], y[3]; /* counter-clockwise, from the user's first corner */
    double value[3];   /* of the same corners */
    double least;
    double south, north;
    scan_side sides[3];
    int side_count;
} scan_triangle;

/* How a strip is scanned. */
typedef struct strip_scan {
    const raster_scan *scan;
    mw_cursor *cursor;
    double *result;
    uint32_t *triangles;
    int64_t first, last; /* rows */
} strip_scan;

/* Set `least`. The library uses areas in doubles if each exceeds its error bound, at most 7e-16 *
 * width * height, and the sum of the bounds is below 2^-42 of the sum of the areas. The limit here
 * is more than twice as large, which covers the rounding of these tests. */
static void triangle_find_limits(scan_triangle *t, double area)
{
    double west = scan_least(t->x[0], t->x[1], t->x[2]),
           east = scan_greatest(t->x[0], t->x[1], t->x[2]);
    double box = (east - west) * (t->north - t->south);
    t->least = 4e-15 * box;
    t->plain = area > 0x1p-800 && area < 0x1p800 && 6e-15 * box < 0x1p-43 * area;
}

static void triangle_find_sides(scan_triangle *t, const raster_grid *g)
{
    const double u = 0x1p-53, reach = fmax(fabs(g->x[0]), fabs(g->x[g->columns - 1]));
    for (int k = 0; k < 3; k++) {
        int n = (k + 1) % 3;
        double dy = t->y[n] - t->y[k];
        if (t->y[n] == t->y[k]) continue;
        scan_side *side = &t->sides[t->side_count++];
        *side = (scan_side){.from = {t->x[k], t->y[k]},
                            .to = {t->x[n], t->y[n]},
                            .south = dy > 0 ? t->y[k] : t->y[n],
                            .north = dy > 0 ? t->y[n] : t->y[k],
                            .start = (t->x[k] - g->west) / g->width - 0.5,
                            .slope = (t->x[n] - t->x[k]) / dy / g->width,
                            .is_left = t->y[n] < t->y[k]};
        /* Fewer than twelve roundings, each of at most u of one of these. */
        side->unsure = 32 * u *
                       (fabs(side->slope) * (t->north - t->south) +
                        (fabs(t->x[k]) + reach + g->width) / g->width + g->columns);
    }
}

/* False: it has no area, so no point is its own. */
static bool triangle_load(scan_triangle *t, const strip_scan *s, uint32_t number)
{
    const uint32_t *corner = s->scan->corners + 3 * (size_t)number;
    const scan_vertex *v[3];
    double p[3][2];
    for (int k = 0; k < 3; k++) {
        v[k] = &s->scan->vertices[corner[k]];
        p[k][0] = v[k]->x;
        p[k][1] = v[k]->y;
    }
    double area = mw_orient2d(p[0], p[1], p[2]);
    if (area == 0) return false;
    *t = (scan_triangle){.number = number, .reversed = area < 0};
    for (int k = 0; k < 3; k++) {
        int from = t->reversed && k > 0 ? 3 - k : k;
        t->x[k] = p[from][0];
        t->y[k] = p[from][1];
        t->value[k] = v[from]->value;
    }
    t->south = scan_least(t->y[0], t->y[1], t->y[2]);
    t->north = scan_greatest(t->y[0], t->y[1], t->y[2]);
    triangle_find_limits(t, fabs(area));
    triangle_find_sides(t, s->scan->grid);
    return true;
}

/* --- one row of a triangle -------------------------------------------------------------------- */

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
    if (!(value > -1)) return -1;
    if (value >= columns) return columns;
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

/* The answer of the library for one pixel. */
static void pixel_ask(const strip_scan *s, int64_t column, double y, double *result,
                      uint32_t *triangle)
{
    mw_location at = mw_locate(s->scan->locator, s->cursor, s->scan->grid->x[column], y);
    if (triangle) *triangle = at.triangle;
    if (result) mw_interpolate(s->scan->mesh, s->scan->values, &at, 1, result);
}

/* Are the areas between the centre of a column and the sides large enough for doubles? */
static bool triangle_is_sure(const scan_triangle *t, double px, double py)
{
    double x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = t->x[k] - px;
        y[k] = t->y[k] - py;
    }
    return x[1] * y[2] - y[1] * x[2] > t->least && x[2] * y[0] - y[2] * x[0] > t->least &&
           x[0] * y[1] - y[0] * x[1] > t->least;
}

/* Values of pixels well within the triangle: the arithmetic of the library, in its order. */
static void triangle_fill_values(const scan_triangle *t, double py, const double *restrict px,
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

/* Pixels first .. last of a row belong to the triangle. Only pixels near its sides need the test;
 * all pixels between two safe ones are safe. */
static void triangle_fill(const scan_triangle *t, const strip_scan *s, int64_t row, int64_t first,
                          int64_t last)
{
    const raster_grid *g = s->scan->grid;
    double y = g->y[row];
    size_t begin = (size_t)(row - s->first) * g->columns;
    double *result = s->result ? s->result + begin : NULL;
    uint32_t *triangles = s->triangles ? s->triangles + begin : NULL;
    for (; first <= last && !(t->plain && triangle_is_sure(t, g->x[first], y)); first++)
        pixel_ask(s, first, y, result ? result + first : NULL,
                  triangles ? triangles + first : NULL);
    for (; first <= last && !triangle_is_sure(t, g->x[last], y); last--)
        pixel_ask(s, last, y, result ? result + last : NULL, triangles ? triangles + last : NULL);
    if (first > last) return;
    if (result) triangle_fill_values(t, y, g->x + first, result + first, last - first + 1);
    for (int64_t i = first; triangles && i <= last; i++) triangles[i] = t->number;
}

static void triangle_scan(const scan_triangle *t, const strip_scan *s)
{
    const raster_grid *g = s->scan->grid;
    row_range rows = rows_between(g, t->south, t->north);
    if (rows.first < s->first) rows.first = s->first;
    if (rows.last > s->last) rows.last = s->last;
    for (int64_t row = rows.first; row <= rows.last; row++) {
        int64_t first = 0, end = g->columns;
        for (int k = 0; k < t->side_count; k++) {
            /* A triangle is convex: in a row, the sides that cross it bound the triangle. */
            if (g->y[row] < t->sides[k].south || g->y[row] > t->sides[k].north) continue;
            int64_t column = side_first(&t->sides[k], g, g->y[row]);
            if (t->sides[k].is_left && column > first) first = column;
            if (!t->sides[k].is_left && column < end) end = column;
        }
        if (first < end) triangle_fill(t, s, row, first, end - 1);
    }
}

void raster_scan_strip(const raster_scan *scan, uint32_t strip, mw_cursor *cursor, double *result,
                       uint32_t *triangles)
{
    const raster_grid *g = scan->grid;
    strip_scan s = {scan, cursor, result, triangles, (int64_t)strip * scan->height, 0};
    scan_triangle t;
    s.last = s.first + scan->height - 1;
    if (s.last >= g->rows) s.last = (int64_t)g->rows - 1;
    size_t pixels = (size_t)(s.last - s.first + 1) * g->columns;
    for (size_t i = 0; result && i < pixels; i++) result[i] = NAN;
    for (size_t i = 0; triangles && i < pixels; i++) triangles[i] = MW_NONE;
    for (uint32_t i = 0; i < scan->tall_count; i++)
        if (triangle_load(&t, &s, scan->tall[i])) triangle_scan(&t, &s);
    for (size_t i = scan->begin[strip]; i < scan->begin[strip + 1]; i++)
        if (triangle_load(&t, &s, scan->triangles[i])) triangle_scan(&t, &s);
}
