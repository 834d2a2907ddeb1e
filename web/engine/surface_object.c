/* surface_object.c - surfaces in space: probes, and rays from a centre. */
#include "engine/mesh_object.h"

#include <stdlib.h>
#include <string.h>

/* What is made of a surface; prober and star when they are asked for first. */
typedef struct web_surface {
    mw_surface *surface;
    mw_prober *prober;
    mw_star *star;
} web_surface;

/* Triangles visited, in order, and what was found: web_trace_part. */
typedef struct web_trace {
    uint32_t *triangles, *iterations;
    size_t count, room;
    double answer[8];
    double counters[WEB_COUNTERS];
} web_trace;

/* --- surfaces --------------------------------------------------------------------------------- */

void WEB_EXPORT(web_surface_free)(web_surface *s)
{
    if (!s) return;
    mw_star_destroy(s->star);
    mw_prober_destroy(s->prober);
    mw_surface_destroy(s->surface);
    free(s);
}

web_surface *WEB_EXPORT(web_surface_make)(const web_mesh *m, int weld)
{
    mw_arrays arrays = mw_mesh_file_arrays(&m->file);
    mw_surface_options options = {.weld = weld};
    web_surface *s = calloc(1, sizeof *s);
    if (s && mw_surface_create(&arrays, &options, &s->surface, &web_error) == MW_OK) return s;
    web_surface_free(s);
    return NULL;
}

/* Returns 0 on failure. */
int WEB_EXPORT(web_surface_prepare_probes)(web_surface *s)
{
    mw_prober_options boxes = {.boxes = 1};
    if (s->prober) return 1;
    return mw_prober_create(s->surface, &boxes, &s->prober, &web_error) == MW_OK;
}

/* A star about a centre, in place of the one before. Returns 0 if the surface is none. */
int WEB_EXPORT(web_surface_prepare_rays)(web_surface *s, double x, double y, double z)
{
    mw_star_options options = {.centre = {x, y, z}, .angles = 1};
    mw_star_destroy(s->star);
    s->star = NULL;
    return mw_star_create(s->surface, &options, &s->star, &web_error) == MW_OK;
}

/* --- traces ----------------------------------------------------------------------------------- */

void WEB_EXPORT(web_trace_free)(web_trace *t)
{
    if (!t) return;
    free(t->triangles);
    free(t->iterations);
    free(t);
}

static int trace_room(web_trace *t, size_t count)
{
    free(t->triangles);
    free(t->iterations);
    t->triangles = malloc((count ? count : 1) * sizeof *t->triangles);
    t->iterations = calloc(count ? count : 1, sizeof *t->iterations);
    t->room = count;
    return t->triangles && t->iterations;
}

size_t WEB_EXPORT(web_trace_count)(const web_trace *t)
{
    return t->count;
}

/* 0 triangles, 1 numbers of walks, 2 the answer: state (0 hit, 1 none, 2 limit, 3 bad), triangle,
 * where, local, weights, distance; 3 the counters of a walk from ray to ray. */
const void *WEB_EXPORT(web_trace_part)(const web_trace *t, int part)
{
    const void *const parts[] = {t->triangles, t->iterations, t->answer, t->counters};
    return parts[part];
}

static void trace_answer(web_trace *t, const mw_touch *touch)
{
    const double all[] = {touch->state,     touch->triangle,  touch->where,     touch->local,
                          touch->weight[0], touch->weight[1], touch->weight[2], touch->distance};
    memcpy(t->answer, all, sizeof all);
}

static int trace_probe(web_trace *t, const mw_prober *prober, const mw_probe_cursor *begin,
                       const double q[3], const double m[3])
{
    mw_touch touch;
    do {
        mw_probe_cursor cursor = *begin;
        if (!trace_room(t, t->count)) return 0;
        t->count =
            mw_probe_path(prober, &cursor, q, m, t->triangles, t->iterations, t->room, &touch);
    } while (t->count > t->room);
    trace_answer(t, &touch);
    return 1;
}

/* A probe at q that moves along m: both are three numbers. NULL on failure. */
web_trace *WEB_EXPORT(web_probe)(const web_surface *s, const double *q, const double *m,
                                 int certain, double seed)
{
    mw_probe_cursor cursor;
    mw_probe_options options = {
        .start = MW_PROBE_START_SAMPLE, .certain = certain, .seed = (uint64_t)seed};
    if (mw_probe_cursor_init(s->prober, &options, &cursor, &web_error) != MW_OK) return NULL;
    web_trace *t = calloc(1, sizeof *t);
    if (t && trace_probe(t, s->prober, &cursor, q, m)) return t;
    web_trace_free(t);
    return NULL;
}

static int trace_ray(web_trace *t, const mw_star *star, const mw_star_cursor *begin,
                     const double to[3])
{
    mw_location at;
    mw_star_cursor cursor;
    do {
        if (!trace_room(t, t->count)) return 0;
        cursor = *begin;
        memset(&cursor.counters, 0, sizeof cursor.counters);
        t->count = mw_star_path(star, &cursor, to, t->triangles, t->room, &at);
    } while (t->count > t->room);
    web_count(&cursor.counters, t->counters);
    mw_touch touch = {.state = at.triangle == MW_NONE ? MW_TOUCH_BAD : MW_TOUCH_HIT,
                      .triangle = at.triangle,
                      .where = at.where,
                      .local = at.local,
                      .weight = {at.weight[0], at.weight[1], at.weight[2]}};
    trace_answer(t, &touch);
    return 1;
}

/* A walk from the ray through one point to that through another: each is three numbers. */
web_trace *WEB_EXPORT(web_ray_walk)(const web_surface *s, int walk, double seed, const double *from,
                                    const double *to)
{
    mw_star_cursor cursor;
    mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                     .start = MW_STAR_START_LAST,
                                     .seed = (uint64_t)seed,
                                     .counters = 1};
    if (mw_star_cursor_init(s->star, &options, &cursor, &web_error) != MW_OK) return NULL;
    mw_star_locate(s->star, &cursor, from);
    web_trace *t = calloc(1, sizeof *t);
    if (t && trace_ray(t, s->star, &cursor, to)) return t;
    web_trace_free(t);
    return NULL;
}

/* A star walk's name (0), source (1), help (2); NULL beyond the last. */
const char *WEB_EXPORT(web_star_walk_text)(int walk, int what)
{
    mw_star_walk_kind kind = (mw_star_walk_kind)walk;
    if (what == 0) return mw_star_walk_name(kind);
    return what == 1 ? mw_star_walk_source(kind) : mw_star_walk_help(kind);
}
