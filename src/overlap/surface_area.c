/* surface_area.c - areas of a surface over a region, slopes included. */
#include "overlap/overlap_tile.h"
#include "overlap/overlap_walk.h"

#include "base/job.h"
#include "base/options.h"

#include <meshwalk/volume.h>
#include <stdlib.h>

enum { SURFACE_CHUNK = 512 }; /* tiles of the region */

typedef struct surface_work {
    const mw_locator *surface, *region;
    const double *heights;
    mw_overlap_walk *walk;       /* [member] */
    mw_surface_area_info *chunk; /* [chunk]: added in this order */
    atomic_bool no_memory;
} surface_work;

/* The area of the tile in space divided by its area in the plane. */
static double surface_slope(const mw_overlap_tile *t)
{
    double ax = t->p[1].x - t->p[0].x, ay = t->p[1].y - t->p[0].y, az = t->value[1] - t->value[0],
           bx = t->p[2].x - t->p[0].x, by = t->p[2].y - t->p[0].y, bz = t->value[2] - t->value[0];
    double double_area = 2 * t->area, dx = (az * by - bz * ay) / double_area,
           dy = (bz * ax - az * bx) / double_area;
    return hypot(1, hypot(dx, dy));
}

static void surface_add_tile(const surface_work *w, mw_surface_area_info *sum,
                             mw_overlap_walk *walk, uint32_t t)
{
    mw_overlap_tile p = mw__overlap_tile(w->region, t, NULL);
    uint32_t tile;
    mw_clip clip;
    if (!p.there) return;
    sum->region_area += p.area;
    mw__overlap_walk_begin(walk, p.p);
    while (mw__overlap_walk_next(walk, &tile, &clip)) {
        mw_overlap_tile q = mw__overlap_tile(w->surface, tile, w->heights);
        if (!q.there) continue;
        double area = mw__clip_integral(&clip).area;
        sum->area += area;
        sum->surface_area += area * surface_slope(&q);
        sum->parts++;
    }
}

static void surface_add_chunk(void *work, uint64_t chunk, uint32_t member)
{
    surface_work *w = work;
    mw_overlap_walk *walk = &w->walk[member];
    const uint64_t n = w->region->tiling.tri_count, first = chunk * SURFACE_CHUNK;
    mw__overlap_walk_forget(walk);
    for (uint64_t t = first; t < first + SURFACE_CHUNK && t < n; t++)
        surface_add_tile(w, &w->chunk[chunk], walk, (uint32_t)t);
    if (walk->no_memory) atomic_store_explicit(&w->no_memory, true, memory_order_relaxed);
}

static mw_status surface_sum_up(surface_work *w, uint32_t threads, const mw_progress *progress,
                                mw_surface_area_info *info, mw_error *error)
{
    mw_job job = mw__job(threads, progress);
    const uint64_t tiles = w->region->tiling.tri_count,
                   chunks = (tiles + SURFACE_CHUNK - 1) / SURFACE_CHUNK;
    uint32_t team = mw__job_team(&job, chunks);
    w->chunk = mw__calloc(chunks, sizeof *w->chunk);
    w->walk = mw__calloc(team, sizeof *w->walk);
    bool made = w->chunk && w->walk;
    for (uint32_t i = 0; i < team && made; i++)
        made = mw__overlap_walk_create(&w->walk[i], w->surface);
    mw__job_stage(&job, "adding areas", 1);
    made = made && mw__job_chunks(&job, team, chunks, surface_add_chunk, w) && !w->no_memory;
    mw_status status = mw__job_end(&job, made ? MW_OK : mw__fail_memory(error), error);
    *info = (mw_surface_area_info){0};
    for (uint64_t c = 0; c < chunks && !status; c++) {
        info->area += w->chunk[c].area;
        info->surface_area += w->chunk[c].surface_area;
        info->region_area += w->chunk[c].region_area;
        info->parts += w->chunk[c].parts;
    }
    for (uint32_t i = 0; i < team && w->walk; i++) mw__overlap_walk_release(&w->walk[i]);
    free(w->walk);
    free(w->chunk);
    return status;
}

mw_status mw_surface_area(const mw_locator *surface, const double *heights,
                          const mw_locator *region, const mw_volume_options *options,
                          mw_surface_area_info *info, mw_error *error)
{
    static const mw_volume_options defaults;
    if (!options) options = &defaults;
    if (!surface || !heights || !region || !info)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a locator, the heights or the result is NULL");
    mw_status status = MW_RESERVED_CHECK(mw_volume_options, options, error);
    if (!status) status = mw__overlap_check_locator(surface, error);
    if (!status) status = mw__overlap_check_locator(region, error);
    if (status) return status;
    surface_work work = {.surface = surface, .region = region, .heights = heights};
    return surface_sum_up(&work, options->threads, options->progress, info, error);
}
