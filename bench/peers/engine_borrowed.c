#include "bench/peers/engine_borrowed.h"
#include "bench/peers/found_locations.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <stdlib.h>
#include <string.h>

typedef struct borrowed_engine {
    uint32_t *neighbours;
    mw_borrowed *mesh;
    found_locations found;
} borrowed_engine;

void engine_borrowed_destroy(void *self)
{
    borrowed_engine *o = self;
    if (!o) return;
    mw_borrowed_release(o->mesh);
    free(o->neighbours);
    free(o->found.at);
    free(o);
}

/* What a caller has: the neighbours opposite to the vertices. NULL where it fails. */
static uint32_t *borrowed_engine_neighbours(const mw_arrays *arrays)
{
    mw_mesh *mesh;
    uint32_t *neighbours = malloc((3 * arrays->triangle_count + 1) * sizeof *neighbours);
    if (!neighbours || mw_mesh_create(arrays, NULL, &mesh, NULL) != MW_OK) {
        free(neighbours);
        return NULL;
    }
    for (uint32_t t = 0; t < arrays->triangle_count; t++)
        for (unsigned k = 0; k < 3; k++)
            neighbours[3 * (size_t)t + (k + 2) % 3] = mw_mesh_neighbour(mesh, t, k, NULL);
    mw_mesh_destroy(mesh);
    return neighbours;
}

double engine_borrowed_build(const engine_mesh *m, unsigned threads, void **self)
{
    mw_borrowed_arrays arrays = {.mesh = {.points = m->points,
                                          .point_count = m->point_count,
                                          .triangles = m->triangles,
                                          .triangle_count = m->triangle_count}};
    mw_borrow_options options = {.threads = threads};
    borrowed_engine *o = calloc(1, sizeof *o);
    *self = o;
    if (o && (o->neighbours = borrowed_engine_neighbours(&arrays.mesh))) {
        arrays.neighbours = o->neighbours;
        double clock = monotonic_seconds();
        if (mw_mesh_borrow(&arrays, &options, &o->mesh, NULL) == MW_OK)
            return monotonic_seconds() - clock;
    }
    engine_borrowed_destroy(o);
    *self = NULL;
    return ENGINE_FAILED;
}

size_t engine_borrowed_bytes(const void *self)
{
    mw_borrowed_info info;
    mw_borrowed_describe(((const borrowed_engine *)self)->mesh, &info);
    return info.bytes;
}

double engine_borrowed_locate(void *self, const double *queries, size_t n, unsigned threads,
                              uint64_t *answers)
{
    borrowed_engine *o = self;
    mw_borrowed_query_options options = {.threads = threads};
    if (!found_locations_reserve(&o->found, n)) return ENGINE_FAILED;
    double clock = monotonic_seconds();
    if (mw_borrowed_locate_batch(o->mesh, queries, n, 2, &options, o->found.at, NULL, NULL) !=
        MW_OK)
        return ENGINE_FAILED;
    double seconds = monotonic_seconds() - clock;
    found_locations_take(&o->found, n, answers);
    return seconds;
}

double engine_borrowed_locate_single(void *self, const double *queries, size_t n, unsigned threads,
                                     uint64_t *answers)
{
    borrowed_engine *o = self;
    mw_borrowed_cursor cursor = {0};
    (void)threads;
    if (!found_locations_reserve(&o->found, n)) return ENGINE_FAILED;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++)
        o->found.at[i] = mw_borrowed_locate(o->mesh, &cursor, queries[2 * i], queries[2 * i + 1]);
    double seconds = monotonic_seconds() - clock;
    found_locations_take(&o->found, n, answers);
    return seconds;
}
