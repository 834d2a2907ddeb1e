/* volume.c - volumes between surfaces: sums over the common parts of their triangles. */
#include "overlap/overlap_tile.h"
#include "overlap/overlap_walk.h"

#include "base/job.h"
#include "base/options.h"
#include "predicates/error_free.h"

#include <meshwalk/volume.h>
#include <stdlib.h>

enum { VOLUME_CHUNK = 512 }; /* tiles */

enum {
    VOLUME_CUT,
    VOLUME_FILL,
    VOLUME_CUT_AREA,
    VOLUME_FILL_AREA,
    VOLUME_LEVEL_AREA,
    VOLUME_SURFACE_AREA,
    VOLUME_OTHER_AREA,
    VOLUME_SUMS
};

/* Compensated sums: a million small terms lose no more than one. */
typedef struct volume_sums {
    double sum[VOLUME_SUMS], rest[VOLUME_SUMS];
    uint64_t parts;
} volume_sums;

typedef struct volume_work {
    const mw_locator *surface, *other; /* other NULL: the plane */
    const double *heights, *other_heights;
    double base;
    mw_overlap_walk *walk; /* [member] */
    volume_sums *chunk;    /* [chunk]: added in this order */
    atomic_bool no_memory;
} volume_work;

static MW_INLINE void volume_add(volume_sums *s, int which, double value)
{
    double tail;
    s->sum[which] = mw__two_sum(s->sum[which], value, &tail);
    s->rest[which] += tail;
}

/* --- one triangle --- */

/* A triangle in which the surface is d[k] above the other at corner k. d[0] has one sign; the
 * others have the opposite sign or are 0. The line where d is 0 cuts it into three triangles. */
static void volume_add_cut(volume_sums *s, double area, double u, double v, double w)
{
    double to_v = u / (u - v), to_w = u / (u - w); /* where d is 0, from corner 0 */
    double odd = area * to_v * to_w, far = area * (w / (w - u)), near = area * to_w * (v / (v - u));
    double odd_volume = odd * fabs(u) / 3, rest = (far * fabs(v + w) + near * fabs(v)) / 3;
    bool above = u > 0;
    volume_add(s, above ? VOLUME_CUT : VOLUME_FILL, odd_volume);
    volume_add(s, above ? VOLUME_CUT_AREA : VOLUME_FILL_AREA, odd);
    volume_add(s, above ? VOLUME_FILL : VOLUME_CUT, rest);
    volume_add(s, above ? VOLUME_FILL_AREA : VOLUME_CUT_AREA, far + near);
}

static void volume_add_triangle(volume_sums *s, double area, double u, double v, double w)
{
    int above = (u > 0) + (v > 0) + (w > 0), below = (u < 0) + (v < 0) + (w < 0);
    if (above + below == 0) {
        volume_add(s, VOLUME_LEVEL_AREA, area);
    } else if (above == 0 || below == 0) {
        volume_add(s, above ? VOLUME_CUT : VOLUME_FILL, area * fabs(u + v + w) / 3);
        volume_add(s, above ? VOLUME_CUT_AREA : VOLUME_FILL_AREA, area);
    } else {
        int side = above == 1 ? 1 : -1; /* the sign that only one corner has */
        if (u * side > 0) volume_add_cut(s, area, u, v, w);
        if (v * side > 0) volume_add_cut(s, area, v, w, u);
        if (w * side > 0) volume_add_cut(s, area, w, u, v);
    }
}

/* --- pairs of triangles --- */

static void volume_corner(const mw_overlap_tile *t, int k, double corner[3])
{
    corner[0] = t->p[k].x;
    corner[1] = t->p[k].y;
    corner[2] = t->value[k];
}

/* Do both triangles lie in one plane? Then the differences d, which are rounded, should be 0. Asked
 * exactly if all of them are small. */
static bool volume_is_level(const mw_overlap_tile *p, const mw_overlap_tile *q, const double *d,
                            uint32_t count)
{
    double most = 0, a[3], b[3], c[3], corner[3];
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(fabs(p->value[k]), fabs(q->value[k])));
    for (uint32_t i = 0; i < count; i++)
        if (fabs(d[i]) > 0x1p-32 * most) return false;
    volume_corner(q, 0, a);
    volume_corner(q, 1, b);
    volume_corner(q, 2, c);
    for (int k = 0; k < 3; k++) {
        volume_corner(p, k, corner);
        if (mw__orient3d(a, b, c, corner) != 0) return false;
    }
    return true;
}

static void volume_add_part(volume_sums *s, const mw_clip *clip, const mw_overlap_tile *p,
                            const mw_overlap_tile *q)
{
    double d[MW_CLIP_SIDES + 3], zero = p->value[0];
    for (uint32_t i = 0; i < clip->count; i++) {
        const mw_clip_corner *c = &clip->corner[i];
        d[i] = 0;
        for (int k = 0; k < 3; k++)
            d[i] += c->p[k] * (p->value[k] - zero) - c->q[k] * (q->value[k] - zero);
    }
    const bool level = volume_is_level(p, q, d, clip->count);
    for (uint32_t k = 1; k + 1 < clip->count; k++) {
        const double part = mw__clip_part(clip, k);
        if (level)
            volume_add(s, VOLUME_LEVEL_AREA, part);
        else
            volume_add_triangle(s, part, d[0], d[k], d[k + 1]);
    }
    s->parts++;
}

static void volume_add_tile(volume_work *w, volume_sums *s, mw_overlap_walk *walk, uint32_t t)
{
    mw_overlap_tile p = mw__overlap_tile(w->surface, t, w->heights);
    if (!p.there) return;
    volume_add(s, VOLUME_SURFACE_AREA, p.area);
    if (!w->other) {
        volume_add_triangle(s, p.area, p.value[0] - w->base, p.value[1] - w->base,
                            p.value[2] - w->base);
        s->parts++;
        return;
    }
    uint32_t tile;
    mw_clip clip;
    mw__overlap_walk_begin(walk, p.p);
    while (mw__overlap_walk_next(walk, &tile, &clip)) {
        if (w->other->tiling.tri[tile].user & MW_GHOST) continue;
        mw_overlap_tile q = mw__overlap_tile(w->other, tile, w->other_heights);
        if (q.there) volume_add_part(s, &clip, &p, &q);
    }
}

/* --- chunks --- */

static void volume_add_chunk(void *work, uint64_t chunk, uint32_t member)
{
    volume_work *w = work;
    mw_overlap_walk *walk = w->other ? &w->walk[member] : NULL;
    const uint64_t n = w->surface->tiling.tri_count, first = chunk * VOLUME_CHUNK;
    if (walk) mw__overlap_walk_forget(walk);
    for (uint64_t t = first; t < first + VOLUME_CHUNK && t < n; t++)
        volume_add_tile(w, &w->chunk[chunk], walk, (uint32_t)t);
    if (walk && walk->no_memory) atomic_store_explicit(&w->no_memory, true, memory_order_relaxed);
}

static void volume_add_other_chunk(void *work, uint64_t chunk, uint32_t member)
{
    (void)member;
    volume_work *w = work;
    const uint64_t n = w->other->tiling.tri_count, first = chunk * VOLUME_CHUNK;
    for (uint64_t t = first; t < first + VOLUME_CHUNK && t < n; t++)
        volume_add(&w->chunk[chunk], VOLUME_OTHER_AREA,
                   mw__overlap_tile(w->other, (uint32_t)t, w->other_heights).area);
}

/* The area of the whole minus the common part; a remainder within rounding is 0. */
static double volume_only(double whole, double common)
{
    return whole - common > whole * 0x1p-44 ? whole - common : 0;
}

static void volume_collect(const volume_work *w, uint64_t chunks, mw_volume_info *info)
{
    double sum[VOLUME_SUMS];
    volume_sums all = {.parts = 0};
    for (uint64_t c = 0; c < chunks; c++) {
        for (int k = 0; k < VOLUME_SUMS; k++) {
            volume_add(&all, k, w->chunk[c].sum[k]);
            all.rest[k] += w->chunk[c].rest[k];
        }
        all.parts += w->chunk[c].parts;
    }
    for (int k = 0; k < VOLUME_SUMS; k++) /* what is lost of a sum that overflows is no number */
        sum[k] = isfinite(all.sum[k]) ? all.sum[k] + all.rest[k] : all.sum[k];
    double area = sum[VOLUME_CUT_AREA] + sum[VOLUME_FILL_AREA] + sum[VOLUME_LEVEL_AREA];
    *info =
        (mw_volume_info){.cut = sum[VOLUME_CUT],
                         .fill = sum[VOLUME_FILL],
                         .cut_area = sum[VOLUME_CUT_AREA],
                         .fill_area = sum[VOLUME_FILL_AREA],
                         .level_area = sum[VOLUME_LEVEL_AREA],
                         .area = area,
                         .surface_only = w->other ? volume_only(sum[VOLUME_SURFACE_AREA], area) : 0,
                         .other_only = w->other ? volume_only(sum[VOLUME_OTHER_AREA], area) : 0,
                         .parts = all.parts};
}

static uint64_t volume_chunks(const mw_locator *locator)
{
    return locator ? ((uint64_t)locator->tiling.tri_count + VOLUME_CHUNK - 1) / VOLUME_CHUNK : 0;
}

static mw_status volume_sum_up(volume_work *w, mw_job *job, uint32_t team, mw_error *error)
{
    for (uint32_t i = 0; i < team && w->other; i++)
        if (!mw__overlap_walk_create(&w->walk[i], w->other)) return mw__fail_memory(error);
    mw__job_stage(job, "adding volumes", w->other ? 0.9 : 1);
    if (!mw__job_chunks(job, team, volume_chunks(w->surface), volume_add_chunk, w) || w->no_memory)
        return mw__fail_memory(error);
    if (!w->other) return MW_OK;
    mw__job_stage(job, "adding areas", 0.1);
    uint64_t chunks = volume_chunks(w->other);
    return mw__job_chunks(job, mw__job_team(job, chunks), chunks, volume_add_other_chunk, w)
               ? MW_OK
               : mw__fail_memory(error);
}

static mw_status volume_make(volume_work *w, const mw_volume_options *options, mw_volume_info *info,
                             mw_error *error)
{
    static const mw_volume_options defaults;
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_volume_options, options, error);
    if (!status) status = mw__overlap_check_locator(w->surface, error);
    if (!status && w->other) status = mw__overlap_check_locator(w->other, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    uint64_t chunks = volume_chunks(w->surface), others = volume_chunks(w->other);
    if (chunks < others) chunks = others;
    uint32_t team = mw__job_team(&job, volume_chunks(w->surface));
    w->chunk = mw__calloc(chunks, sizeof *w->chunk);
    w->walk = mw__calloc(team, sizeof *w->walk);
    status = w->chunk && w->walk ? volume_sum_up(w, &job, team, error) : mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    if (!status) volume_collect(w, chunks, info);
    for (uint32_t i = 0; i < team && w->walk; i++) mw__overlap_walk_release(&w->walk[i]);
    free(w->walk);
    free(w->chunk);
    return status;
}

mw_status mw_volume_between(const mw_locator *surface, const double *heights,
                            const mw_locator *other, const double *other_heights,
                            const mw_volume_options *options, mw_volume_info *info, mw_error *error)
{
    if (!surface || !heights || !other || !other_heights || !info)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a locator, the heights of a mesh or the result is NULL");
    volume_work work = {
        .surface = surface, .heights = heights, .other = other, .other_heights = other_heights};
    return volume_make(&work, options, info, error);
}

mw_status mw_volume_above(const mw_locator *surface, const double *heights, double base,
                          const mw_volume_options *options, mw_volume_info *info, mw_error *error)
{
    if (!surface || !heights || !info)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the locator, the heights or the result is NULL");
    if (!isfinite(base))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the base of a volume is not finite");
    volume_work work = {.surface = surface, .heights = heights, .base = base};
    return volume_make(&work, options, info, error);
}
