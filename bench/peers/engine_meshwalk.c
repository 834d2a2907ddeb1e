#include "bench/peers/engine_meshwalk.h"
#include "bench/peers/found_locations.h"
#include "bench/peers/engine_borrowed.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <stdlib.h>
#include <string.h>

typedef struct meshwalk_engine {
    mw_mesh *mesh;
    mw_locator *locator;
    mw_index *index; /* or NULL */
    found_locations found;
} meshwalk_engine;

static const char *meshwalk_version(void)
{
    return "meshwalk " MW_VERSION_STRING;
}

static void meshwalk_engine_destroy(void *self)
{
    meshwalk_engine *o = self;
    if (!o) return;
    mw_index_destroy(o->index);
    mw_locator_destroy(o->locator);
    mw_mesh_destroy(o->mesh);
    free(o->found.at);
    free(o);
}

static bool meshwalk_engine_make(meshwalk_engine *o, const engine_mesh *m, unsigned threads,
                                 mw_start_kind start)
{
    mw_arrays arrays = {
        .points = m->points,
        .point_count = m->point_count,
        .triangles = m->triangles,
        .triangle_count = m->triangle_count,
    };
    mw_mesh_options options = {.threads = threads};
    mw_locator_options prepare = {.threads = threads};
    return mw_mesh_create(&arrays, &options, &o->mesh, NULL) == MW_OK &&
           mw_locator_create(o->mesh, &prepare, &o->locator, NULL) == MW_OK &&
           (!mw_start_has_index(start) ||
            mw_index_create(o->locator, start, NULL, &o->index, NULL) == MW_OK);
}

static double meshwalk_engine_build(const engine_mesh *m, unsigned threads, mw_start_kind start,
                                    void **self)
{
    meshwalk_engine *o = calloc(1, sizeof *o);
    *self = o;
    double clock = monotonic_seconds();
    if (o && meshwalk_engine_make(o, m, threads, start)) return monotonic_seconds() - clock;
    meshwalk_engine_destroy(o);
    *self = NULL;
    return ENGINE_FAILED;
}

static double meshwalk_build_auto(const engine_mesh *m, unsigned threads, void **self)
{
    return meshwalk_engine_build(m, threads, MW_START_AUTO, self);
}
static double meshwalk_build_grid(const engine_mesh *m, unsigned threads, void **self)
{
    return meshwalk_engine_build(m, threads, MW_START_GRID, self);
}
static double meshwalk_build_two_levels(const engine_mesh *m, unsigned threads, void **self)
{
    return meshwalk_engine_build(m, threads, MW_START_TWO_LEVEL_GRID, self);
}
static double meshwalk_build_curve(const engine_mesh *m, unsigned threads, void **self)
{
    return meshwalk_engine_build(m, threads, MW_START_CURVE, self);
}

static size_t meshwalk_engine_bytes(const void *self)
{
    const meshwalk_engine *o = self;
    mw_locator_info locator;
    mw_index_info index = {0};
    mw_locator_describe(o->locator, &locator);
    if (o->index) mw_index_describe(o->index, &index);
    return mw_mesh_bytes(o->mesh) + locator.bytes + index.bytes;
}

static double meshwalk_locate_batch(void *self, const double *queries, size_t n, unsigned threads,
                                    uint64_t *answers)
{
    meshwalk_engine *o = self;
    mw_query_options options = {.threads = threads, .index = o->index};
    if (!found_locations_reserve(&o->found, n)) return ENGINE_FAILED;
    double clock = monotonic_seconds();
    if (mw_locate_batch(o->locator, queries, n, 2, &options, o->found.at, NULL, NULL) != MW_OK)
        return ENGINE_FAILED;
    double seconds = monotonic_seconds() - clock;
    found_locations_take(&o->found, n, answers);
    return seconds;
}

static double meshwalk_locate_one_by_one(meshwalk_engine *o, const double *queries, size_t n,
                                         mw_start_kind start, uint64_t *answers)
{
    mw_cursor cursor;
    mw_query_options options = {.start = start, .index = o->index};
    if (!found_locations_reserve(&o->found, n) ||
        mw_cursor_init(o->locator, &options, &cursor, NULL) != MW_OK)
        return ENGINE_FAILED;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++)
        o->found.at[i] = mw_locate(o->locator, &cursor, queries[2 * i], queries[2 * i + 1]);
    double seconds = monotonic_seconds() - clock;
    found_locations_take(&o->found, n, answers);
    return seconds;
}

static double meshwalk_locate_single(void *self, const double *queries, size_t n, unsigned threads,
                                     uint64_t *answers)
{
    (void)threads;
    return meshwalk_locate_one_by_one(self, queries, n, MW_START_AUTO, answers);
}
static double meshwalk_locate_last(void *self, const double *queries, size_t n, unsigned threads,
                                   uint64_t *answers)
{
    (void)threads;
    return meshwalk_locate_one_by_one(self, queries, n, MW_START_LAST, answers);
}

static double meshwalk_triangulate(const double *points, size_t n, unsigned threads, size_t *size)
{
    mw_mesh *mesh;
    mw_delaunay_options options = {.threads = threads};
    double clock = monotonic_seconds();
    if (mw_delaunay(points, n, 2, &options, NULL, NULL, &mesh, NULL) != MW_OK) return ENGINE_FAILED;
    double seconds = monotonic_seconds() - clock;
    *size = mw_mesh_bytes(mesh);
    mw_mesh_destroy(mesh);
    return seconds;
}

const engine_code *engine_meshwalk_code(engine_id id)
{
    static const engine_structure plain = {meshwalk_version, meshwalk_build_auto,
                                           meshwalk_engine_bytes, NULL, meshwalk_engine_destroy};
    static const engine_structure grid = {meshwalk_version, meshwalk_build_grid,
                                          meshwalk_engine_bytes, NULL, meshwalk_engine_destroy};
    static const engine_structure two_levels = {meshwalk_version, meshwalk_build_two_levels,
                                                meshwalk_engine_bytes, NULL,
                                                meshwalk_engine_destroy};
    static const engine_structure curve = {meshwalk_version, meshwalk_build_curve,
                                           meshwalk_engine_bytes, NULL, meshwalk_engine_destroy};
    static const engine_structure borrowed = {meshwalk_version, engine_borrowed_build,
                                              engine_borrowed_bytes, NULL, engine_borrowed_destroy};
    static const engine_code codes[] = {
        [ENGINE_MESHWALK] = {&plain, meshwalk_locate_batch, meshwalk_triangulate},
        [ENGINE_MESHWALK_SINGLE] = {&plain, meshwalk_locate_single, NULL},
        [ENGINE_MESHWALK_GRID] = {&grid, meshwalk_locate_batch, NULL},
        [ENGINE_MESHWALK_GRID_SINGLE] = {&grid, meshwalk_locate_single, NULL},
        [ENGINE_MESHWALK_TWO_LEVELS] = {&two_levels, meshwalk_locate_batch, NULL},
        [ENGINE_MESHWALK_TWO_LEVELS_SINGLE] = {&two_levels, meshwalk_locate_single, NULL},
        [ENGINE_MESHWALK_CURVE] = {&curve, meshwalk_locate_batch, NULL},
        [ENGINE_MESHWALK_CURVE_SINGLE] = {&curve, meshwalk_locate_single, NULL},
        [ENGINE_MESHWALK_LAST] = {&plain, meshwalk_locate_last, NULL},
        [ENGINE_MESHWALK_BORROWED] = {&borrowed, engine_borrowed_locate, NULL},
        [ENGINE_MESHWALK_BORROWED_SINGLE] = {&borrowed, engine_borrowed_locate_single, NULL},
    };
    return &codes[id];
}
