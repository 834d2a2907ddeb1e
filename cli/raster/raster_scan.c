#include "cli/raster/raster_scan.h"
#include "cli/frame/message.h"
#include "cli/raster/scan_triangle.h"

#include <math.h>
#include <stdlib.h>

/* A triangle that reaches into more strips than this is in the list of tall ones, which every strip
 * goes through. */
enum { MOST_STRIPS = 4 };

/* A strip has at most so many rows, and about as many pixels at most as stay in a cache. */
enum { MOST_ROWS = 32, STRIP_PIXELS = 1 << 19 };

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

/* --- scanning --------------------------------------------------------------------------------- */

static void scan_fill(const raster_scan *s, const scan_strip *strip, uint32_t triangle)
{
    const uint32_t *v = s->corners + 3 * (size_t)triangle;
    const scan_vertex *const corner[3] = {&s->vertices[v[0]], &s->vertices[v[1]],
                                          &s->vertices[v[2]]};
    scan_triangle_fill(strip, triangle, corner);
}

void raster_scan_strip(const raster_scan *s, uint32_t strip, mw_cursor *cursor,
                       const raster_scan_pixels *pixels)
{
    const raster_grid *g = s->grid;
    scan_strip rows = {.locator = s->locator,
                       .mesh = s->mesh,
                       .values = s->values,
                       .grid = g,
                       .cursor = cursor,
                       .per_width = 1 / g->width,
                       .first = (int64_t)strip * s->height,
                       .result = pixels->values,
                       .rounded = pixels->rounded,
                       .triangles = pixels->triangles};
    rows.last = rows.first + s->height - 1;
    if (rows.last >= g->rows) rows.last = (int64_t)g->rows - 1;
    size_t count = (size_t)(rows.last - rows.first + 1) * g->columns;
    for (size_t i = 0; rows.result && i < count; i++) rows.result[i] = NAN;
    for (size_t i = 0; rows.rounded && i < count; i++) rows.rounded[i] = NAN;
    for (size_t i = 0; rows.triangles && i < count; i++) rows.triangles[i] = MW_NONE;
    for (uint32_t i = 0; i < s->tall_count; i++) scan_fill(s, &rows, s->tall[i]);
    for (size_t i = s->begin[strip]; i < s->begin[strip + 1]; i++)
        scan_fill(s, &rows, s->triangles[i]);
}
