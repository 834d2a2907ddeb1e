#include "bench/ocean/ocean_weights.h"
#include "bench/data/dataset.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps that are in memory at a time: far more than caches hold, and less than memory. */
enum { BLOCK = 24 };

enum { COPY, SIDE_1, SIDE, STEPS_1, STEPS, SCATTERED_SIDE_1, SCATTERED_1, SCATTERED, FLOATS };

const char *const ocean_weights_ways[OCEAN_WEIGHTS_WAYS] = {"copy",
                                                            "side by side, 1 thr.",
                                                            "side by side",
                                                            "steps, 1 thread",
                                                            "in steps",
                                                            "scattered, side, 1",
                                                            "scattered, 1 thr.",
                                                            "scattered, in steps",
                                                            "floats, in steps"};

static int weights_of_points(const mw_locator *locator, const mw_mesh *mesh, const double *xy,
                             size_t n, mw_operator **out)
{
    mw_error error;
    mw_location *at = malloc(n * sizeof *at);
    if (!at) return fail_memory();
    mw_status status = mw_locate_batch(locator, xy, n, 2, NULL, at, NULL, &error);
    if (!status) status = mw_operator_create(mesh, at, n, NULL, out, &error);
    free(at);
    return status ? fail_query(&error) : 0;
}

/* Points as those of a grid, row by row, or anywhere. */
static void weights_set_points(double *xy, size_t n, bool ordered, uint64_t seed)
{
    uint64_t random = seed + 2;
    size_t width = 1;
    while (width * width < n) width++;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 2; k++)
            xy[2 * i + (size_t)k] = ordered ? (double)(k ? i / width : i % width) / (double)width
                                            : dataset_unit(&random);
}

static int weights_make_operator(const mw_mesh *mesh, size_t n, bool ordered, uint64_t seed,
                                 mw_operator **out)
{
    mw_error error;
    mw_locator *locator;
    double *xy = malloc(2 * n * sizeof *xy);
    if (!xy) return fail_memory();
    weights_set_points(xy, n, ordered, seed);
    mw_status status = mw_locator_create(mesh, NULL, &locator, &error);
    int end = status ? fail_query(&error) : weights_of_points(locator, mesh, xy, n, out);
    mw_locator_destroy(status ? NULL : locator);
    free(xy);
    return end;
}

/* A vertex, and the strip of the square that it lies in. */
typedef struct strip_vertex {
    double at[2], strip;
} strip_vertex;

static int strip_compare(const void *a, const void *b)
{
    const strip_vertex *p = a, *q = b;
    if (p->strip != q->strip) return p->strip < q->strip ? -1 : 1;
    return (p->at[0] > q->at[0]) - (p->at[0] < q->at[0]);
}

/* The same vertices numbered strip by strip: as in the meshes of models, neighbours have near
 * numbers. */
static int weights_number_vertices(const mw_mesh *mesh, mw_mesh **out)
{
    enum { SPACINGS = 2 }; /* height of a strip */
    const uint32_t n = mw_mesh_vertex_count(mesh);
    const double strips = sqrt(n) / SPACINGS;
    mw_error error;
    strip_vertex *vertices = malloc((size_t)n * sizeof *vertices);
    if (!vertices) return fail_memory();
    for (uint32_t v = 0; v < n; v++) {
        mw_mesh_vertex(mesh, v, vertices[v].at);
        vertices[v].strip = floor(vertices[v].at[1] * strips);
    }
    qsort(vertices, n, sizeof *vertices, strip_compare);
    mw_status status = mw_delaunay(vertices->at, n, 3, NULL, NULL, NULL, out, &error);
    free(vertices);
    return status ? fail_query(&error) : 0;
}

static int weights_make_operators(ocean_weights *w, const mw_mesh *mesh, uint64_t seed)
{
    mw_mesh *numbered = NULL;
    int end = weights_make_operator(mesh, w->points, false, seed, &w->scattered);
    if (end == 0) end = weights_number_vertices(mesh, &numbered);
    if (end == 0) end = weights_make_operator(numbered, w->points, true, seed, &w->ordered);
    mw_mesh_destroy(numbered);
    return end;
}

int ocean_weights_make(ocean_weights *w, const mw_mesh *mesh, uint64_t seed)
{
    *w = (ocean_weights){.points = mw_mesh_vertex_count(mesh)};
    w->values = malloc(w->points * BLOCK * sizeof *w->values);
    w->results = malloc(w->points * BLOCK * sizeof *w->results);
    if (!w->values || !w->results) return fail_memory();
    for (size_t i = 0; i < w->points * BLOCK; i++) w->values[i] = (double)(i % 1000);
    return weights_make_operators(w, mesh, seed);
}

void ocean_weights_release(ocean_weights *w)
{
    mw_operator_destroy(w->scattered);
    mw_operator_destroy(w->ordered);
    free(w->values);
    free(w->results);
}

static const mw_operator *weights_of_way(const ocean_weights *w, size_t way)
{
    return way >= SCATTERED_SIDE_1 && way <= SCATTERED ? w->scattered : w->ordered;
}

static mw_status weights_apply(const ocean_weights *w, size_t way, mw_error *error)
{
    const bool side = way == SIDE_1 || way == SIDE || way == SCATTERED_SIDE_1,
               one =
                   way == SIDE_1 || way == STEPS_1 || way == SCATTERED_SIDE_1 || way == SCATTERED_1;
    const mw_operator *weights = weights_of_way(w, way);
    const mw_value_table table = {.values = w->values,
                                  .type = way == FLOATS ? MW_FLOAT32 : MW_FLOAT64,
                                  .count = BLOCK,
                                  .step = side ? 0 : w->points};
    const mw_operator_apply_options options = {.threads = one};
    return mw_operator_apply(weights, &table, &options, w->results, error);
}

double ocean_weights_bytes(const ocean_weights *w, size_t way)
{
    const double size = way == FLOATS ? sizeof(float) : sizeof(double),
                 fields = 2 * size * (double)w->points * OCEAN_STEPS,
                 entry = sizeof(uint32_t) + sizeof(double); /* a column and a weight */
    mw_operator_info info;
    if (way == COPY) return fields;
    mw_operator_describe(weights_of_way(w, way), &info);
    return fields + entry * (double)info.entries * (OCEAN_STEPS / BLOCK);
}

int ocean_weights_time(void *self, size_t way, size_t round, double *figures)
{
    const ocean_weights *w = self;
    mw_error error;
    mw_status status = MW_OK;
    (void)round;
    const double begin = monotonic_seconds();
    for (size_t step = 0; step < OCEAN_STEPS && !status; step += BLOCK)
        if (way == COPY)
            memcpy(w->results, w->values, w->points * BLOCK * sizeof *w->values);
        else
            status = weights_apply(w, way, &error);
    figures[0] = monotonic_seconds() - begin;
    return status ? fail_query(&error) : 0;
}
