/* space_engine_meshwalk.c - our own: certain probes, which a tree of boxes answers, walks over the
 * surface alone, and stars. */
#include "bench/space/space_engine.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <stdlib.h>
#include <string.h>

static const char *our_version(void)
{
    return "meshwalk " MW_VERSION_STRING;
}

/* A surface, and what answers about it. */
typedef struct our_scene {
    mw_surface *surface;
    mw_prober *prober[2]; /* by the way to follow */
    unsigned current;     /* of these */
    mw_star *star;
    uint32_t *vertices; /* 0, 1, 2 ...: the star is told which of them moved */
} our_scene;

static void our_destroy(void *self)
{
    our_scene *o = self;
    if (!o) return;
    for (int i = 0; i < 2; i++) mw_prober_destroy(o->prober[i]);
    mw_star_destroy(o->star);
    mw_surface_destroy(o->surface);
    free(o->vertices);
    free(o);
}

static our_scene *our_begin(const space_model *m)
{
    mw_arrays arrays = space_model_arrays(m);
    mw_surface_options options = {.tolerant = 1};
    mw_error error;
    our_scene *o = calloc(1, sizeof *o);
    if (!o) {
        fail_memory();
        return NULL;
    }
    if (mw_surface_create(&arrays, &options, &o->surface, &error) == MW_OK) return o;
    fail_query(&error);
    our_destroy(o);
    return NULL;
}

/* Put the points of the model into the surface, without the clock. */
static void our_show(our_scene *o, const space_model *m)
{
    mw_surface_begin_update(o->surface);
    memcpy(mw_surface_points(o->surface), m->points, 3 * m->point_count * sizeof *m->points);
}

/* --- probes ----------------------------------------------------------------------------------- */

static void *probes_build(const space_model *m, mw_prober_options options, double *seconds,
                          size_t *bytes)
{
    mw_error error;
    mw_prober_info info;
    our_scene *o = our_begin(m);
    if (!o) return NULL;
    mw_status status = MW_OK;
    for (int i = options.boxes ? 1 : 0; i >= 0 && status == MW_OK; i--) {
        double begin = monotonic_seconds();
        status = mw_prober_create(o->surface, &options, &o->prober[i], &error);
        *seconds = monotonic_seconds() - begin;
    }
    if (status != MW_OK) {
        fail_query(&error);
        our_destroy(o);
        return NULL;
    }
    mw_prober_describe(o->prober[0], &info);
    *bytes = info.bytes;
    return o;
}

static void *certain_build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    return probes_build(m, (mw_prober_options){.boxes = 1, .threads = threads}, seconds, bytes);
}

static void *walk_build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    return probes_build(m, (mw_prober_options){.threads = threads}, seconds, bytes);
}

static void *guided_build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    return probes_build(m, (mw_prober_options){.guide = 1, .threads = threads}, seconds, bytes);
}

static double probes_cast_single(const our_scene *o, const mw_probe_options *options,
                                 const space_rays *rays, uint32_t *found)
{
    mw_probe_cursor cursor;
    mw_error error;
    const mw_prober *prober = o->prober[o->current];
    if (mw_probe_cursor_init(prober, options, &cursor, &error) != MW_OK) {
        fail_query(&error);
        return -1;
    }
    double begin = monotonic_seconds();
    for (size_t i = 0; i < rays->count; i++) {
        const double *ray = rays->ray + 6 * i;
        found[i] = mw_probe(prober, &cursor, ray, ray + 3).triangle;
    }
    return monotonic_seconds() - begin;
}

static double certain_cast(void *scene, unsigned way, const space_rays *rays, space_rays_kind kind,
                           uint32_t threads, uint32_t *found)
{
    const our_scene *o = scene;
    mw_error error;
    mw_probe_options options = {
        .certain = 1, .extent = MW_PROBE_RAY, .faces = MW_PROBE_BOTH, .threads = threads};
    (void)kind;
    if (way == 0) return probes_cast_single(o, &options, rays, found);
    mw_touch *touches = malloc((rays->count + 1) * sizeof *touches);
    if (!touches) {
        fail_memory();
        return -1;
    }
    memset(touches, 0, rays->count * sizeof *touches);
    double begin = monotonic_seconds();
    mw_status status = mw_probe_batch(o->prober[o->current], rays->ray, rays->count, 6, &options,
                                      touches, NULL, &error);
    double seconds = monotonic_seconds() - begin;
    for (size_t i = 0; i < rays->count; i++) found[i] = touches[i].triangle;
    free(touches);
    if (status == MW_OK) return seconds;
    fail_query(&error);
    return -1;
}

static double walk_cast(void *scene, unsigned way, const space_rays *rays, space_rays_kind kind,
                        uint32_t threads, uint32_t *found)
{
    static const mw_probe_options defaults;
    (void)way;
    (void)kind;
    (void)threads;
    return probes_cast_single(scene, &defaults, rays, found);
}

/* "told" says how far vertices moved, "fit" does not. Each has a prober of its own; the other one
 * is brought up to date without the clock. */
static double certain_follow(void *scene, unsigned way, const space_model *m, size_t moved,
                             double farthest, uint32_t threads)
{
    our_scene *o = scene;
    (void)moved;
    our_show(o, m);
    double begin = monotonic_seconds();
    mw_prober_update(o->prober[way], way == 0 ? farthest : -1, threads);
    double seconds = monotonic_seconds() - begin;
    mw_prober_update(o->prober[!way], way == 0 ? -1 : farthest, threads);
    mw_surface_end_update(o->surface);
    o->current = way;
    return seconds;
}

static double walk_follow(void *scene, unsigned way, const space_model *m, size_t moved,
                          double farthest, uint32_t threads)
{
    our_scene *o = scene;
    (void)way;
    (void)moved;
    our_show(o, m);
    double begin = monotonic_seconds();
    mw_prober_update(o->prober[0], farthest, threads);
    mw_surface_end_update(o->surface);
    return monotonic_seconds() - begin;
}

const space_engine space_engine_certain = {
    .name = "meshwalk",
    .casts = {"single", "batch"},
    .follows = {"told", "fit"},
    .version = our_version,
    .build = certain_build,
    .cast = certain_cast,
    .follow = certain_follow,
    .destroy = our_destroy,
};

const space_engine space_engine_walk = {
    .name = "meshwalk-walk",
    .casts = {"single"},
    .follows = {"told"},
    .is_first = true,
    .most_rays = 1000,
    .version = our_version,
    .build = walk_build,
    .cast = walk_cast,
    .follow = walk_follow,
    .destroy = our_destroy,
};

const space_engine space_engine_guided = {
    .name = "meshwalk-guide",
    .casts = {"single"},
    .follows = {"told"},
    .is_first = true,
    .most_rays = 1000,
    .version = our_version,
    .build = guided_build,
    .cast = walk_cast,
    .follow = walk_follow,
    .destroy = our_destroy,
};

/* --- stars ------------------------------------------------------------------------------------ */

static void *star_build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    mw_error error;
    mw_star_info info;
    mw_star_options options = {.threads = threads};
    our_scene *o = our_begin(m);
    if (!o) return NULL;
    o->vertices = malloc((m->point_count + 1) * sizeof *o->vertices);
    if (!o->vertices) {
        fail_memory();
        our_destroy(o);
        return NULL;
    }
    for (uint32_t i = 0; i < m->point_count; i++) o->vertices[i] = i;
    double begin = monotonic_seconds();
    mw_status status = mw_star_create(o->surface, &options, &o->star, &error);
    *seconds = monotonic_seconds() - begin;
    if (status != MW_OK) {
        fail_query(&error);
        our_destroy(o);
        return NULL;
    }
    mw_star_describe(o->star, &info);
    *bytes = info.bytes;
    return o;
}

static double star_cast_batch(const our_scene *o, const space_rays *rays,
                              const mw_star_query_options *options, uint32_t *found)
{
    mw_error error;
    mw_location *locations = malloc((rays->count + 1) * sizeof *locations);
    if (!locations) {
        fail_memory();
        return -1;
    }
    memset(locations, 0, rays->count * sizeof *locations);
    double begin = monotonic_seconds();
    mw_status status = mw_star_locate_batch(o->star, rays->ray + 3, rays->count, 6, options,
                                            locations, NULL, &error);
    double seconds = monotonic_seconds() - begin;
    for (size_t i = 0; i < rays->count; i++) found[i] = locations[i].triangle;
    free(locations);
    if (status == MW_OK) return seconds;
    fail_query(&error);
    return -1;
}

static double star_cast(void *scene, unsigned way, const space_rays *rays, space_rays_kind kind,
                        uint32_t threads, uint32_t *found)
{
    const our_scene *o = scene;
    mw_star_query_options options = {.threads = threads};
    mw_star_cursor cursor;
    mw_error error;
    (void)kind;
    if (way == 1) return star_cast_batch(o, rays, &options, found);
    if (mw_star_cursor_init(o->star, &options, &cursor, &error) != MW_OK) {
        fail_query(&error);
        return -1;
    }
    double begin = monotonic_seconds();
    for (size_t i = 0; i < rays->count; i++)
        found[i] = mw_star_locate(o->star, &cursor, rays->ray + 6 * i + 3).triangle;
    return monotonic_seconds() - begin;
}

static double star_follow(void *scene, unsigned way, const space_model *m, size_t moved,
                          double farthest, uint32_t threads)
{
    our_scene *o = scene;
    mw_error error;
    (void)way;
    (void)farthest;
    mw_star_update_options options = {.threads = threads};
    if (moved < m->point_count) {
        options.moved = o->vertices;
        options.moved_count = moved;
    }
    our_show(o, m);
    double begin = monotonic_seconds();
    mw_status status = mw_star_update(o->star, &options, &error);
    mw_surface_end_update(o->surface);
    double seconds = monotonic_seconds() - begin;
    if (status == MW_OK) return seconds;
    fail_query(&error);
    return -1;
}

const space_engine space_engine_star = {
    .name = "meshwalk-star",
    .casts = {"single", "batch"},
    .follows = {"update"},
    .needs_star = true,
    .version = our_version,
    .build = star_build,
    .cast = star_cast,
    .follow = star_follow,
    .destroy = our_destroy,
};
