#include "cli/raster/greedy_tin.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/raster/raster_scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The pixel of a triangle with the largest error. */
typedef struct greedy_candidate {
    double error; /* at most the tolerance: it is not in the heap */
    size_t pixel;
    uint32_t position; /* in the heap */
} greedy_candidate;

typedef struct greedy_tin {
    const dem *dem;
    mw_editor *editor;
    double tolerance;
    uint8_t *used; /* pixels that are vertices */
    double *z;     /* of the vertices */
    size_t vertices, vertex_room;
    greedy_candidate *candidates; /* of the triangles */
    uint32_t *heap;               /* triangles, the worst first */
    size_t room, count;           /* of both; in the heap */
    size_t inserted;
} greedy_tin;

/* --- the heap --------------------------------------------------------------------------------- */

static bool greedy_before(const greedy_tin *g, uint32_t a, uint32_t b)
{
    const greedy_candidate *p = &g->candidates[a], *q = &g->candidates[b];
    return p->error > q->error || (p->error == q->error && p->pixel < q->pixel);
}

static void greedy_put(greedy_tin *g, size_t position, uint32_t triangle)
{
    g->heap[position] = triangle;
    g->candidates[triangle].position = (uint32_t)position;
}

/* Restore the order of the heap after the entry at a position has changed. */
static void greedy_settle(greedy_tin *g, size_t position)
{
    uint32_t t = g->heap[position];
    for (; position > 0 && greedy_before(g, t, g->heap[(position - 1) / 2]);
         position = (position - 1) / 2)
        greedy_put(g, position, g->heap[(position - 1) / 2]);
    for (size_t child; (child = 2 * position + 1) < g->count; position = child) {
        if (child + 1 < g->count && greedy_before(g, g->heap[child + 1], g->heap[child])) child++;
        if (!greedy_before(g, g->heap[child], t)) break;
        greedy_put(g, position, g->heap[child]);
    }
    greedy_put(g, position, t);
}

static void greedy_remove(greedy_tin *g, uint32_t triangle)
{
    size_t position = g->candidates[triangle].position;
    if (position == MW_NONE) return;
    g->candidates[triangle].position = MW_NONE;
    uint32_t last = g->heap[--g->count];
    if (last == triangle) return;
    greedy_put(g, position, last);
    greedy_settle(g, position);
}

static bool greedy_grow(greedy_tin *g, size_t triangles, size_t vertices)
{
    if (triangles > g->room) {
        size_t room = 2 * triangles + 1024;
        greedy_candidate *candidates = realloc(g->candidates, room * sizeof *candidates);
        if (candidates) g->candidates = candidates;
        uint32_t *heap = realloc(g->heap, room * sizeof *heap);
        if (heap) g->heap = heap;
        if (!candidates || !heap) return false;
        for (size_t t = g->room; t < room; t++) candidates[t] = (greedy_candidate){0, 0, MW_NONE};
        g->room = room;
    }
    if (vertices > g->vertex_room) {
        size_t room = 2 * vertices + 1024;
        double *z = realloc(g->z, room * sizeof *z);
        if (!z) return false;
        g->z = z;
        g->vertex_room = room;
    }
    return true;
}

/* --- triangles -------------------------------------------------------------------------------- */

typedef struct greedy_triangle {
    double p[3][2], origin[3], gradient[2];
} greedy_triangle;

static void greedy_load(const greedy_tin *g, uint32_t triangle, greedy_triangle *t)
{
    uint32_t v[3];
    mw_editor_triangle(g->editor, triangle, v);
    for (int k = 0; k < 3; k++) mw_editor_vertex(g->editor, v[k], t->p[k]);
    double bx = t->p[1][0] - t->p[0][0], by = t->p[1][1] - t->p[0][1];
    double cx = t->p[2][0] - t->p[0][0], cy = t->p[2][1] - t->p[0][1];
    double bz = g->z[v[1]] - g->z[v[0]], cz = g->z[v[2]] - g->z[v[0]], area = bx * cy - by * cx;
    t->gradient[0] = (bz * cy - cz * by) / area;
    t->gradient[1] = (cz * bx - bz * cx) / area;
    t->origin[0] = t->p[0][0];
    t->origin[1] = t->p[0][1];
    t->origin[2] = g->z[v[0]];
}

/* A position in columns or rows, rounded to an integer within limits. Pixels just outside a
 * triangle may count as inside: the final verification uses exact tests. */
#define SLACK 1e-9
static int64_t clamp(double value, int64_t most)
{
    return value >= (double)most ? most : value > 0 ? (int64_t)value : 0;
}

/* Where a triangle crosses a row: from west to east. */
static void triangle_span(const greedy_triangle *t, double y, double span[2])
{
    span[0] = INFINITY;
    span[1] = -INFINITY;
    for (int k = 0; k < 3; k++) {
        const double *a = t->p[k], *b = t->p[(k + 1) % 3];
        if (fmin(a[1], b[1]) > y || fmax(a[1], b[1]) < y) continue;
        double x = a[1] == b[1] ? a[0] : a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        span[0] = fmin(span[0], fmin(x, a[1] == b[1] ? b[0] : x));
        span[1] = fmax(span[1], fmax(x, a[1] == b[1] ? b[0] : x));
    }
}

static void greedy_scan_row(const greedy_tin *g, const greedy_triangle *t, int64_t row,
                            greedy_candidate *worst)
{
    const raster_grid *grid = &g->dem->grid;
    double span[2], y = grid->y[row];
    triangle_span(t, y, span);
    if (!(span[0] <= span[1])) return;
    int64_t first = clamp(ceil((span[0] - grid->west) / grid->width - 0.5 - SLACK), grid->columns);
    int64_t end = clamp(floor((span[1] - grid->west) / grid->width + 0.5 + SLACK), grid->columns);
    size_t begin = (size_t)row * grid->columns;
    for (int64_t i = first; i < end; i++) {
        size_t pixel = begin + (size_t)i;
        double z = t->origin[2] + t->gradient[0] * (grid->x[i] - t->origin[0]) +
                   t->gradient[1] * (y - t->origin[1]);
        double error = fabs(z - g->dem->z[pixel]);
        if (!(error > worst->error) || g->used[pixel]) continue;
        worst->error = error;
        worst->pixel = pixel;
    }
}

/* Find the worst pixel of a triangle, and put it into the heap if it is beyond the tolerance. */
static void greedy_scan(greedy_tin *g, uint32_t triangle)
{
    const raster_grid *grid = &g->dem->grid;
    greedy_triangle t;
    greedy_candidate worst = {0};
    greedy_load(g, triangle, &t);
    double north = fmax(t.p[0][1], fmax(t.p[1][1], t.p[2][1])),
           south = fmin(t.p[0][1], fmin(t.p[1][1], t.p[2][1]));
    int64_t first = clamp(ceil((grid->north - north) / grid->height - 0.5 - SLACK), grid->rows),
            end = clamp(floor((grid->north - south) / grid->height + 0.5 + SLACK), grid->rows);
    for (int64_t row = first; row < end; row++) greedy_scan_row(g, &t, row, &worst);
    greedy_remove(g, triangle);
    g->candidates[triangle].error = worst.error;
    g->candidates[triangle].pixel = worst.pixel;
    if (!(worst.error > g->tolerance)) return;
    greedy_put(g, g->count++, triangle);
    greedy_settle(g, g->count - 1);
}

/* --- insertion -------------------------------------------------------------------------------- */

static int greedy_insert(greedy_tin *g, size_t pixel)
{
    const raster_grid *grid = &g->dem->grid;
    mw_change change;
    mw_error error;
    size_t most = 0;
    g->used[pixel] = 1;
    mw_status status = mw_edit_insert(g->editor, grid->x[pixel % grid->columns],
                                      grid->y[pixel / grid->columns], &change, &error);
    /* Beyond a border that is fixed. */
    if (status == MW_ERROR_INPUT) return 0;
    if (status != MW_OK) return fail_mesh(g->dem->path, &error);
    for (size_t i = 0; i < change.made + change.reused; i++)
        if (change.triangle[i].triangle >= most) most = (size_t)change.triangle[i].triangle + 1;
    if (!greedy_grow(g, most, (size_t)change.vertex + 1)) return fail_memory();
    if (change.vertices_made > 0) {
        g->z[change.vertex] = g->dem->z[pixel];
        g->vertices = (size_t)change.vertex + 1;
        g->inserted++;
    }
    for (size_t i = 0; i < change.freed; i++)
        greedy_remove(g, change.triangle[change.made + change.reused + i].triangle);
    for (size_t i = 0; i < change.made + change.reused; i++)
        greedy_scan(g, change.triangle[i].triangle);
    if (g->inserted % 4096 == 0) progress_points(g->inserted, -1);
    return 0;
}

static int greedy_run(greedy_tin *g)
{
    int end = 0;
    while (end == 0 && g->count > 0) {
        uint32_t t = g->heap[0];
        size_t pixel = g->candidates[t].pixel;
        end = greedy_insert(g, pixel);
        /* It lies in a neighbouring triangle, or just outside the mesh. */
        bool same = g->candidates[t].position != MW_NONE && g->candidates[t].pixel == pixel;
        if (end == 0 && same) greedy_scan(g, t);
    }
    return end;
}

/* --- verification ----------------------------------------------------------------------------- */

/* The mesh as it is now, with its heights and a locator. */
typedef struct greedy_result {
    mw_mesh *mesh;
    mw_locator *locator;
    raster_scan *scan;
} greedy_result;

static void greedy_result_release(greedy_result *r)
{
    raster_scan_release(r->scan);
    mw_locator_destroy(r->locator);
    mw_mesh_destroy(r->mesh);
    *r = (greedy_result){0};
}

static int greedy_result_of(greedy_result *r, const mw_mesh *given, const dem *d, const double *z,
                            uint32_t threads)
{
    mw_error error;
    const mw_locator_options options = {.threads = threads, .progress = progress_of_call()};
    mw_status status = z ? mw_mesh_set_field(r->mesh, "z", z, 1, &error) : MW_OK;
    const mw_mesh *mesh = given ? given : r->mesh;
    if (status == MW_OK) status = mw_locator_create(mesh, &options, &r->locator, &error);
    if (status != MW_OK) return fail_mesh(d->path, &error);
    return raster_scan_create(&r->scan, r->locator, mesh, &d->grid, threads);
}

/* State of a verification: the pixels whose error is too large. */
typedef enum greedy_remedy {
    REMEDY_NONE = 0,
    REMEDY_INSERT,         /* insert them */
    REMEDY_INSERT_OUTSIDE, /* also those that rounding has left outside of all triangles */
} greedy_remedy;

/* Compare the values of pixels from number `begin` on with the raster. */
static int greedy_compare(greedy_tin *g, size_t begin, size_t count, const double *values,
                          greedy_remedy remedy, greedy_tin_report *report)
{
    int end = 0;
    for (size_t i = 0; end == 0 && i < count; i++) {
        double z = g->dem->z[begin + i], error = fabs(values[i] - z);
        bool outside = isnan(values[i]);
        if (isnan(z)) continue;
        if (outside)
            report->left_out++;
        else
            report->pixels++;
        if (error > report->largest) report->largest = error;
        bool missed = outside ? remedy == REMEDY_INSERT_OUTSIDE : error > g->tolerance && remedy;
        if (missed && !g->used[begin + i]) end = greedy_insert(g, begin + i);
    }
    return end;
}

/* Compare a mesh with all pixels. */
static int greedy_verify(greedy_tin *g, greedy_result *r, const mw_mesh *mesh, greedy_remedy remedy,
                         greedy_tin_report *report)
{
    const raster_grid *grid = &g->dem->grid;
    size_t strip = (size_t)raster_scan_height(r->scan) * grid->columns,
           pixels = (size_t)grid->rows * grid->columns;
    double *values = malloc(strip * sizeof *values);
    mw_cursor cursor;
    if (!values || mw_cursor_init(r->locator, NULL, &cursor, NULL) != MW_OK) {
        free(values);
        return fail_memory();
    }
    int end = 0;
    report->pixels = report->left_out = 0;
    report->largest = 0;
    raster_scan_take_values(r->scan, mw_mesh_field(mesh, "z"));
    for (uint32_t s = 0; end == 0 && s < raster_scan_strips(r->scan); s++) {
        size_t begin = s * strip, count = pixels - begin < strip ? pixels - begin : strip;
        raster_scan_strip(r->scan, s, &cursor, &(raster_scan_pixels){.values = values});
        end = greedy_compare(g, begin, count, values, remedy, report);
    }
    free(values);
    return end;
}

/* --- pixels without a height ------------------------------------------------------------------ */

/* Mark the triangles that have the centre of a pixel without a height. */
static void greedy_mark_empty(const dem *d, const greedy_result *r, uint8_t *empty)
{
    const raster_grid *grid = &d->grid;
    mw_cursor cursor;
    mw_cursor_init(r->locator, NULL, &cursor, NULL);
    for (size_t i = 0; i < (size_t)grid->columns * grid->rows; i++) {
        if (!isnan(d->z[i])) continue;
        mw_location at =
            mw_locate(r->locator, &cursor, grid->x[i % grid->columns], grid->y[i / grid->columns]);
        if (at.triangle == MW_NONE) continue;
        empty[at.triangle] = 1;
        uint32_t across = at.where == MW_ON_EDGE
                              ? mw_mesh_neighbour(r->mesh, at.triangle, at.local, NULL)
                              : MW_NONE;
        if (across != MW_NONE) empty[across] = 1;
    }
}

/* The mesh without the marked triangles; its vertices keep their numbers. */
static int greedy_leave_out(const mw_mesh *mesh, const uint8_t *empty, const char *path,
                            mw_mesh **out)
{
    uint32_t count = mw_mesh_triangle_count(mesh), vertices = mw_mesh_vertex_count(mesh), n = 0;
    uint32_t *triangles = malloc((3 * (size_t)count + 1) * sizeof *triangles);
    double *points = malloc((2 * (size_t)vertices + 1) * sizeof *points);
    mw_error error;
    int end = triangles && points ? 0 : fail_memory();
    for (uint32_t v = 0; end == 0 && v < vertices; v++)
        mw_mesh_vertex(mesh, v, points + 2 * (size_t)v);
    for (uint32_t t = 0; end == 0 && t < count; t++)
        if (!empty[t]) mw_mesh_triangle(mesh, t, triangles + 3 * (size_t)n++);
    if (end == 0 && n == 0) {
        complain("%s: no triangle is left: its pixels with a height lie on one line, or are fewer "
                 "than three",
                 path);
        end = END_INPUT;
    }
    const mw_arrays arrays = {.points = points,
                              .point_count = vertices,
                              .point_stride = 2,
                              .triangles = triangles,
                              .triangle_count = n};
    if (end == 0 && (mw_mesh_create(&arrays, NULL, out, &error) != MW_OK ||
                     mw_mesh_set_field(*out, "z", mw_mesh_field(mesh, "z"), 1, &error) != MW_OK))
        end = fail_mesh(path, &error);
    free(triangles);
    free(points);
    return end;
}

/* --- the whole -------------------------------------------------------------------------------- */

static int greedy_begin(greedy_tin *g, const mw_mesh *mesh, const mw_constrained_edges *edges,
                        const common_settings *common)
{
    mw_error error;
    const raster_grid *grid = &g->dem->grid;
    const mw_editor_options options = {.delaunay = MW_DELAUNAY_MAKE,
                                       .constrained_edges = edges->edge,
                                       .constrained_edge_count = edges->count,
                                       .threads = common->threads,
                                       .progress = progress_of_call()};
    g->used = calloc((size_t)grid->columns * grid->rows, 1);
    g->vertices = mw_mesh_vertex_count(mesh);
    uint32_t count = mw_mesh_triangle_count(mesh);
    if (!g->used || !greedy_grow(g, count, g->vertices)) return fail_memory();
    if (g->vertices > 0) memcpy(g->z, mw_mesh_field(mesh, "z"), g->vertices * sizeof *g->z);
    if (mw_editor_create(mesh, &options, &g->editor, &error) != MW_OK)
        return fail_mesh(g->dem->path, &error);
    for (uint32_t t = 0; t < count; t++) greedy_scan(g, t);
    return greedy_run(g);
}

/* Verify, and insert pixels whose error rounding has hidden, until none exceeds the tolerance. */
static int greedy_complete(greedy_tin *g, greedy_result *r, uint32_t threads, greedy_remedy remedy,
                           greedy_tin_report *report)
{
    mw_error error;
    size_t before;
    int end;
    do {
        before = g->inserted;
        greedy_result_release(r);
        if (mw_editor_mesh(g->editor, NULL, NULL, &r->mesh, &error) != MW_OK)
            return fail_mesh(g->dem->path, &error);
        end = greedy_result_of(r, NULL, g->dem, g->z, threads);
        if (end == 0) end = greedy_verify(g, r, r->mesh, remedy, report);
        if (end == 0) end = greedy_run(g);
    } while (end == 0 && g->inserted > before);
    return end;
}

static int greedy_finish(greedy_tin *g, greedy_result *r, const common_settings *common,
                         mw_mesh **out, greedy_tin_report *report)
{
    greedy_result left = {0};
    uint8_t *empty = calloc((size_t)mw_mesh_triangle_count(r->mesh) + 1, 1);
    if (!empty) return fail_memory();
    greedy_mark_empty(g->dem, r, empty);
    int end = greedy_leave_out(r->mesh, empty, g->dem->path, out);
    free(empty);
    if (end == 0) end = greedy_result_of(&left, *out, g->dem, NULL, common->threads);
    if (end == 0) end = greedy_verify(g, &left, *out, REMEDY_NONE, report);
    greedy_result_release(&left);
    if (end || report->largest <= g->tolerance) return end;
    complain("%s: the mesh is off by %g at a pixel", g->dem->path, report->largest);
    return END_RESOURCE;
}

int greedy_tin_make(const dem *d, const mw_mesh *mesh, const mw_constrained_edges *edges,
                    const greedy_tin_options *options, mw_mesh **out, greedy_tin_report *report)
{
    const common_settings *common = options->common;
    greedy_remedy remedy = options->bounded ? REMEDY_INSERT : REMEDY_INSERT_OUTSIDE;
    greedy_tin g = {.dem = d, .tolerance = options->tolerance};
    greedy_result r = {0};
    *out = NULL;
    *report = (greedy_tin_report){0};
    progress_phase("inserting", d->path);
    int end = greedy_begin(&g, mesh, edges, common);
    if (end == 0) end = greedy_complete(&g, &r, common->threads, remedy, report);
    if (end == 0) end = greedy_finish(&g, &r, common, out, report);
    report->inserted = g.inserted;
    greedy_result_release(&r);
    mw_editor_destroy(g.editor);
    free(g.used);
    free(g.z);
    free(g.candidates);
    free(g.heap);
    return end;
}
