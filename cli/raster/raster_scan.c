#include "cli/raster/raster_scan.h"
#include "cli/frame/message.h"
#include "cli/raster/scan_triangle.h"
#include "src/base/base.h"
#include "src/base/threads.h"

#include <math.h>
#include <stdlib.h>

/* A triangle that reaches into more strips than this is in the list of tall ones, which every strip
 * goes through. */
enum { MOST_STRIPS = 4 };

/* A strip has at most so many rows, and about as many pixels at most as stay in a cache. */
enum { MOST_ROWS = 64, STRIP_PIXELS = 1 << 20 };

/* Each thread that prepares a scan has a counter for every strip, and a share of the triangles. */
enum { MOST_SHARES = 8, SHARE_TRIANGLES = 1 << 15 };

/* Triangles and vertices are taken from the mesh so many at a time. */
enum { BLOCK = 256 };

/* Triangles and vertices have their places in the mesh's memory: so triangles that follow each
 * other find their vertices near each other. */
struct raster_scan {
    const mw_locator *locator;
    const mw_mesh *mesh;
    const raster_grid *grid;
    const double *values; /* those that the vertices have; NULL: none */
    scan_vertex *vertices;
    uint32_t height, strips, shares;
    size_t *counts;      /* of each share: of each strip, then of the tall triangles */
    const size_t *end;   /* of each strip's triangles in `triangles`, then of the tall ones */
    uint32_t *triangles; /* those that reach into a strip, and few others */
};

/* --- shares ----------------------------------------------------------------------------------- */

/* Things first .. end - 1. */
typedef struct scan_part {
    uint32_t first, end;
} scan_part;

/* The part of `count` things that is this share's. */
static scan_part scan_part_of(const raster_scan *s, uint32_t share, uint32_t count)
{
    return (scan_part){(uint32_t)((uint64_t)count * share / s->shares),
                       (uint32_t)((uint64_t)count * (share + 1) / s->shares)};
}

static uint32_t scan_block(uint32_t first, uint32_t end)
{
    return end - first < BLOCK ? end - first : BLOCK;
}

static size_t *scan_counts(const raster_scan *s, uint32_t share)
{
    return s->counts + (size_t)share * (s->strips + 1);
}

/* --- strips ----------------------------------------------------------------------------------- */

/* The strip of the first row on or south of a vertex; -1: it is north of all rows, s->strips: south
 * of all. */
static int32_t strip_of_vertex(const raster_scan *s, const scan_vertex *v)
{
    const raster_grid *g = s->grid;
    if (v->row == 0 && v->y > g->y[0]) return -1;
    return v->row == (int32_t)g->rows ? (int32_t)s->strips : v->row / (int32_t)s->height;
}

static void scan_copy_vertices(void *self, uint32_t share)
{
    raster_scan *s = self;
    double points[2 * BLOCK];
    const scan_part part = scan_part_of(s, share, mw_mesh_vertex_count(s->mesh));
    for (uint32_t first = part.first; first < part.end; first += BLOCK) {
        const uint32_t count = scan_block(first, part.end);
        mw_mesh_stored_vertices(s->mesh, first, count, points, NULL);
        for (uint32_t i = 0; i < count; i++) {
            scan_vertex *v = &s->vertices[first + i];
            *v = (scan_vertex){.x = points[2 * i], .y = points[2 * i + 1]};
            v->row = scan_row_south_of(s->grid, v->y);
            v->strip = strip_of_vertex(s, v);
        }
    }
}

/* The strips that a triangle with these corners reaches into: first .. last. The list of the tall
 * ones is behind the last strip. */
static row_range strips_of_triangle(const raster_scan *s, const uint32_t v[3])
{
    const int32_t a = s->vertices[v[0]].strip, b = s->vertices[v[1]].strip,
                  c = s->vertices[v[2]].strip, low = a < b ? a : b, high = a < b ? b : a;
    row_range r = {low < c ? low : c, high < c ? c : high};
    if (r.first < 0) r.first = 0;
    if (r.last == s->strips) r.last--;
    if (r.last - r.first >= MOST_STRIPS) r.first = r.last = s->strips;
    return r;
}

/* Go through the triangles of a share, count those of each strip or put them there. */
static void scan_go_through(raster_scan *s, uint32_t share, bool put)
{
    size_t *at = scan_counts(s, share);
    uint32_t corners[3 * BLOCK];
    const scan_part part = scan_part_of(s, share, mw_mesh_triangle_count(s->mesh));
    for (uint32_t first = part.first; first < part.end; first += BLOCK) {
        const uint32_t count = scan_block(first, part.end);
        mw_mesh_stored_triangles(s->mesh, first, count, corners, NULL);
        for (uint32_t i = 0; i < count; i++) {
            const row_range r = strips_of_triangle(s, corners + 3 * (size_t)i);
            for (int64_t strip = r.first; strip <= r.last; strip++) {
                if (put) s->triangles[at[strip]] = first + i;
                at[strip]++;
            }
        }
    }
}

static void scan_count_triangles(void *self, uint32_t share)
{
    scan_go_through(self, share, false);
}

static void scan_put_triangles(void *self, uint32_t share)
{
    scan_go_through(self, share, true);
}

/* Counts become where each share puts its triangles of each strip. Returns the sum. */
static size_t scan_add_counts(raster_scan *s)
{
    size_t sum = 0;
    for (uint32_t strip = 0; strip <= s->strips; strip++)
        for (uint32_t share = 0; share < s->shares; share++) {
            size_t *count = &scan_counts(s, share)[strip], own = *count;
            *count = sum;
            sum += own;
        }
    return sum;
}

static bool scan_make(raster_scan *s)
{
    s->vertices = mw__alloc_lines(mw_mesh_vertex_count(s->mesh), sizeof *s->vertices);
    s->counts = mw__calloc((uint64_t)s->shares * (s->strips + 1), sizeof *s->counts);
    if (!s->vertices || !s->counts) return false;
    mw__team_run(s->shares, scan_copy_vertices, s);
    mw__team_run(s->shares, scan_count_triangles, s);
    s->triangles = mw__alloc_lines(scan_add_counts(s), sizeof *s->triangles);
    if (!s->triangles) return false;
    mw__team_run(s->shares, scan_put_triangles, s);
    s->end = scan_counts(s, s->shares - 1);
    return true;
}

int raster_scan_create(raster_scan **scan, const mw_locator *locator, const mw_mesh *mesh,
                       const raster_grid *grid, uint32_t threads)
{
    const uint32_t count = mw_mesh_triangle_count(mesh);
    raster_scan *s = *scan = calloc(1, sizeof *s);
    if (!s) return fail_memory();
    *s = (raster_scan){.locator = locator, .mesh = mesh, .grid = grid};
    s->height = grid->columns <= STRIP_PIXELS / MOST_ROWS ? MOST_ROWS
                : grid->columns <= STRIP_PIXELS           ? STRIP_PIXELS / grid->columns
                                                          : 1;
    s->strips = (uint32_t)(((uint64_t)grid->rows + s->height - 1) / s->height);
    s->shares = mw__team(threads, count / SHARE_TRIANGLES);
    if (s->shares > MOST_SHARES) s->shares = MOST_SHARES;
    if (s->strips > count) s->shares = 1;
    return scan_make(s) ? 0 : fail_memory();
}

void raster_scan_release(raster_scan *s)
{
    if (!s) return;
    free(s->vertices);
    free(s->counts);
    free(s->triangles);
    free(s);
}

/* --- values ----------------------------------------------------------------------------------- */

static void scan_copy_values(void *self, uint32_t share)
{
    raster_scan *s = self;
    uint32_t numbers[BLOCK];
    double points[2 * BLOCK];
    const scan_part part = scan_part_of(s, share, mw_mesh_vertex_count(s->mesh));
    for (uint32_t first = part.first; first < part.end; first += BLOCK) {
        const uint32_t count = scan_block(first, part.end);
        mw_mesh_stored_vertices(s->mesh, first, count, points, numbers);
        for (uint32_t i = 0; i < count; i++) s->vertices[first + i].value = s->values[numbers[i]];
    }
}

void raster_scan_take_values(raster_scan *s, const double *values)
{
    s->values = values;
    if (values) mw__team_run(s->shares, scan_copy_values, s);
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

/* A triangle of a list that will be filled soon. */
typedef struct scan_soon {
    const scan_vertex *corner[3];
    uint32_t number;
} scan_soon;

static scan_soon scan_soon_of(const raster_scan *s, uint32_t triangle)
{
    scan_soon soon;
    uint32_t v[3];
    mw_mesh_stored_triangles(s->mesh, triangle, 1, v, &soon.number);
    for (int k = 0; k < 3; k++) {
        soon.corner[k] = &s->vertices[v[k]];
        __builtin_prefetch(soon.corner[k]);
    }
    return soon;
}

/* Fill the triangles of a list. The memory of a triangle's vertices is asked for while others are
 * filled. */
static void scan_fill(const raster_scan *s, const scan_strip *strip, size_t from, size_t to)
{
    enum { AHEAD = 8 };
    scan_soon soon[AHEAD];
    for (size_t i = from; i < to && i < from + AHEAD; i++)
        soon[i % AHEAD] = scan_soon_of(s, s->triangles[i]);
    for (size_t i = from; i < to; i++) {
        const scan_soon now = soon[i % AHEAD];
        if (to - i > AHEAD) soon[i % AHEAD] = scan_soon_of(s, s->triangles[i + AHEAD]);
        scan_triangle_fill(strip, now.number, now.corner);
    }
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
    scan_fill(s, &rows, s->end[s->strips - 1], s->end[s->strips]);
    scan_fill(s, &rows, strip > 0 ? s->end[strip - 1] : 0, s->end[strip]);
}
