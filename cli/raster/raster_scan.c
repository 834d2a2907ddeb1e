#include "cli/raster/raster_scan.h"
#include "cli/frame/message.h"
#include "cli/raster/scan_batch.h"
#include "src/base/base.h"
#include "src/base/threads.h"

#include <math.h>
#include <stdlib.h>

/* A unit of triangles that reaches into more strips than this is in the list of tall ones, which
 * every strip goes through. */
enum { MOST_STRIPS = 4 };

/* A unit has so many triangles, which follow each other in the mesh's memory, if they are so near
 * to each other that strips go through at most so many triangles for each in the mesh; else one. */
enum { UNIT = 16, MOST_PASSES = 2 };

/* A strip has at most so many rows, and about as many pixels at most as stay in a cache. */
enum { MOST_ROWS = 64, STRIP_PIXELS = 1 << 20 };

/* Each thread that prepares a scan has a counter for every strip, and a share of the triangles. */
enum { MOST_SHARES = 8, SHARE_TRIANGLES = 1 << 15 };

/* Triangles and vertices are taken from the mesh so many at a time. */
enum { BLOCK = 256 };

/* The strips that a unit reaches into. */
typedef struct unit_strips {
    int32_t first, last;
} unit_strips;

/* Triangles and vertices have their places in the mesh's memory: so triangles that follow each
 * other find their vertices near each other. */
struct raster_scan {
    const mw_locator *locator;
    const mw_mesh *mesh;
    const raster_grid *grid;
    const double *values; /* those that the vertices have; NULL: none */
    scan_vertex *vertices;
    uint32_t height, strips, shares;
    uint32_t unit;       /* triangles in a unit; the last unit may have fewer */
    unit_strips *ranges; /* of each unit */
    size_t *counts;      /* of each share: of each strip, then of the tall units */
    const size_t *end;   /* of each strip's units in `units`, then of the tall ones */
    uint32_t *units;     /* those that reach into a strip, and few others */
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

static uint32_t scan_unit_count(const raster_scan *s)
{
    const uint64_t triangles = mw_mesh_triangle_count(s->mesh);
    return (uint32_t)((triangles + s->unit - 1) / s->unit);
}

/* How many triangles a unit has; *first: where they begin. */
static uint32_t scan_unit_at(const raster_scan *s, uint32_t unit, uint32_t *first)
{
    const uint32_t count = mw_mesh_triangle_count(s->mesh);
    *first = unit * s->unit;
    return count - *first < s->unit ? count - *first : s->unit;
}

/* The strips that triangles with these corners reach into. The list of the tall ones is behind the
 * last strip. */
static unit_strips strips_of_unit(const raster_scan *s, const uint32_t *corners, uint32_t count)
{
    int32_t low = s->vertices[corners[0]].strip, high = low;
    for (uint32_t i = 1; i < 3 * count; i++) {
        const int32_t strip = s->vertices[corners[i]].strip;
        low = strip < low ? strip : low;
        high = strip > high ? strip : high;
    }
    const int32_t strips = (int32_t)s->strips;
    unit_strips r = {low < 0 ? 0 : low, high == strips ? high - 1 : high};
    if (r.last - r.first >= MOST_STRIPS) r.first = r.last = strips;
    return r;
}

/* Count the units of each strip. */
static void scan_count_units(void *self, uint32_t share)
{
    raster_scan *s = self;
    size_t *at = scan_counts(s, share);
    uint32_t corners[3 * UNIT], first;
    const scan_part part = scan_part_of(s, share, scan_unit_count(s));
    for (uint32_t unit = part.first; unit < part.end; unit++) {
        const uint32_t count = scan_unit_at(s, unit, &first);
        mw_mesh_stored_triangles(s->mesh, first, count, corners, NULL);
        s->ranges[unit] = strips_of_unit(s, corners, count);
        for (int64_t k = s->ranges[unit].first; k <= s->ranges[unit].last; k++) at[k]++;
    }
}

static void scan_put_units(void *self, uint32_t share)
{
    raster_scan *s = self;
    size_t *at = scan_counts(s, share);
    const scan_part part = scan_part_of(s, share, scan_unit_count(s));
    for (uint32_t unit = part.first; unit < part.end; unit++)
        for (int64_t k = s->ranges[unit].first; k <= s->ranges[unit].last; k++)
            s->units[at[k]++] = unit;
}

/* Do strips go through few triangles that they do not have? */
static bool scan_units_fit(const raster_scan *s)
{
    const uint64_t triangles = mw_mesh_triangle_count(s->mesh);
    uint64_t passes = 0;
    for (uint32_t share = 0; share < s->shares; share++)
        for (uint32_t strip = 0; strip <= s->strips; strip++)
            passes += scan_counts(s, share)[strip] * (strip < s->strips ? 1 : s->strips);
    return passes <= MOST_PASSES * triangles / s->unit;
}

/* Choose units, and count those of each strip. */
static bool scan_make_units(raster_scan *s)
{
    const size_t counts = (size_t)s->shares * (s->strips + 1);
    for (s->unit = UNIT;; s->unit = 1) {
        s->ranges = mw__alloc_lines(scan_unit_count(s), sizeof *s->ranges);
        s->counts = mw__calloc(counts, sizeof *s->counts);
        if (!s->ranges || !s->counts) return false;
        mw__team_run(s->shares, scan_count_units, s);
        if (s->unit == 1 || scan_units_fit(s)) return true;
        free(s->ranges);
        free(s->counts);
    }
}

/* Counts become where each share puts its units of each strip. Returns the sum. */
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
    if (!s->vertices) return false;
    mw__team_run(s->shares, scan_copy_vertices, s);
    if (!scan_make_units(s)) return false;
    s->units = mw__alloc_lines(scan_add_counts(s), sizeof *s->units);
    if (!s->units) return false;
    mw__team_run(s->shares, scan_put_units, s);
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
    if (s->strips > count / UNIT) s->shares = 1;
    return scan_make(s) ? 0 : fail_memory();
}

void raster_scan_release(raster_scan *s)
{
    if (!s) return;
    free(s->vertices);
    free(s->counts);
    free(s->ranges);
    free(s->units);
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

/* The triangles of a unit that will be filled soon: corners and numbers. */
typedef struct scan_soon {
    uint32_t corner[3 * UNIT], number[UNIT], count;
} scan_soon;

static void scan_soon_take(const raster_scan *s, uint32_t unit, scan_soon *soon)
{
    uint32_t first;
    soon->count = scan_unit_at(s, unit, &first);
    mw_mesh_stored_triangles(s->mesh, first, soon->count, soon->corner, soon->number);
    for (uint32_t k = 0; k < 3 * soon->count; k++)
        __builtin_prefetch(&s->vertices[soon->corner[k]]);
}

/* Fill the triangles of some units. `batch`: NULL if the strip can have none. */
static void scan_fill_unit(const raster_scan *s, const scan_strip *strip, const scan_soon *unit,
                           scan_batch *batch)
{
    for (uint32_t i = 0; i < unit->count; i++) {
        const uint32_t *v = unit->corner + 3 * (size_t)i;
        const scan_vertex *const corner[3] = {&s->vertices[v[0]], &s->vertices[v[1]],
                                              &s->vertices[v[2]]};
        if (batch)
            scan_batch_add(batch, strip, unit->number[i], corner);
        else
            scan_triangle_fill(strip, unit->number[i], corner);
    }
}

/* Fill the triangles of the units of a list. The memory of a unit's vertices is asked for while
 * others are filled. */
static void scan_fill(const raster_scan *s, const scan_strip *strip, size_t from, size_t to)
{
    enum { AHEAD = 2 };
    scan_soon soon[AHEAD];
    scan_batch batch;
    const bool batches = scan_batch_begin(&batch, strip);
    for (size_t i = from; i < to && i < from + AHEAD - 1; i++)
        scan_soon_take(s, s->units[i], &soon[i % AHEAD]);
    for (size_t i = from; i < to; i++) {
        const size_t next = i + AHEAD - 1;
        if (next < to) scan_soon_take(s, s->units[next], &soon[next % AHEAD]);
        scan_fill_unit(s, strip, &soon[i % AHEAD], batches ? &batch : NULL);
    }
    if (batches) scan_batch_finish(&batch, strip);
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
