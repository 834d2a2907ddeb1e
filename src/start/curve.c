/* curve.c - tiles that lie in memory along a Hilbert curve are their own index: the place of q on
 * the curve says roughly where its tile is in memory.
 *
 * One in every few tiles is sampled, with the key of its lowest vertex. The slot where a walk
 * begins is interpolated linearly between the two samples round the key of q. Samples are as dense
 * as the tiles, so any distribution of vertices will do. Points near each other on the curve are
 * near each other in the plane. A walk is a few tiles longer than from a fine grid, but the table
 * is small enough for a cache. If tiles are in any other order, the walk begins at the sample
 * before q.
 *
 * A key is looked up by its upper bits first, in a table of buckets: as many as samples, or up to
 * twice as many. */
#include "start/curve.h"

#include <stdlib.h>

/* The key of the lowest vertex: by that tiles of a mesh that is laid out are in order
 * (mesh/layout.h). */
static uint32_t tile_key(const mw_curve *curve, const mw_tiling *tiling, uint32_t t)
{
    const uint32_t *v = tiling->tri[t].v;
    uint32_t low = v[0] < v[1] ? v[0] : v[1];
    mw_point p = tiling->point[v[2] < low ? v[2] : low];
    return mw__hilbert_key(&curve->hilbert, p.x, p.y);
}

static bool curve_follows(const mw_curve *curve, uint32_t tile, uint32_t before)
{
    return (tile > before ? tile - before : before - tile) <= curve->near;
}

static uint32_t curve_buckets(const mw_curve *curve)
{
    return UINT32_C(1) << (32 - curve->shift);
}

/* Put all tiles of the sample, every `stride`-th, between the two ends of the curve. */
static bool curve_sample(mw_curve *curve, const mw_tiling *tiling, uint32_t stride, mw_key *scratch,
                         mw_job *job)
{
    enum { SOME = 1 << 12 };
    uint32_t n = curve->count - 2, follow = 0;
    mw_key *sample = curve->sample + 1;
    for (uint32_t i = 0; i < n && (i % SOME != 0 || mw__job_step(job, i, n)); i++)
        sample[i] = (mw_key){tile_key(curve, tiling, i * stride), i * stride};
    if (mw__job_stopped(job)) return false;
    mw__sort_keys(sample, scratch, n);
    sample[-1] = (mw_key){0, sample[0].item};
    sample[n] = (mw_key){UINT32_MAX, sample[n - 1].item};
    for (uint32_t i = 1; i < n; i++)
        follow += curve_follows(curve, sample[i].item, sample[i - 1].item);
    curve->regular = follow >= n - n / 8 - 1;
    return true;
}

static void curve_fill_buckets(mw_curve *curve)
{
    for (uint32_t b = 0, i = 0; b <= curve_buckets(curve); b++) {
        while (i < curve->count - 1 && curve->sample[i].key < (uint64_t)b << curve->shift) i++;
        curve->from[b] = i > 0 ? i : 1;
    }
}

bool mw__curve_create(mw_curve *curve, const mw_tiling *tiling, const double low[2],
                      const double high[2], uint32_t samples, mw_job *job)
{
    mw__job_stage(job, "sampling along a curve", 1);
    uint32_t stride = samples ? (tiling->tri_count - 1) / samples + 1 : MW_CURVE_STRIDE;
    uint32_t n = (tiling->tri_count - 1) / stride + 1, bits = 1;
    while (UINT32_C(1) << bits < n) bits++;
    *curve = (mw_curve){
        .hilbert = mw__hilbert(low, high), .count = n + 2, .shift = 32 - bits, .near = 4 * stride};
    curve->sample = mw__alloc_lines(curve->count, sizeof *curve->sample);
    curve->from = mw__alloc_lines((size_t)curve_buckets(curve) + 1, sizeof *curve->from);
    mw_key *scratch = mw__alloc_lines(n, sizeof *scratch);
    bool done = curve->sample && curve->from && scratch &&
                curve_sample(curve, tiling, stride, scratch, job);
    if (done) curve_fill_buckets(curve);
    free(scratch);
    return done;
}

void mw__curve_release(mw_curve *curve)
{
    free(curve->sample);
    free(curve->from);
    mw__grid_release(&curve->sparse);
}

size_t mw__curve_bytes(const mw_curve *curve)
{
    size_t grid = curve->sparse.tile ? mw__grid_bytes(&curve->sparse) : 0;
    return grid + curve->count * sizeof *curve->sample +
           ((size_t)curve_buckets(curve) + 1) * sizeof *curve->from;
}
