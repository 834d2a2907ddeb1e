/* tiling.c - what a tiling is asked for, and its end. */
#include "tiling/tiling.h"

#include "base/posix.h"
#include "tiling/hub_table.h"

#include <stdlib.h>

uint32_t mw__lowest_around_vertex(const mw_tiling *tiling, uint32_t first, uint32_t v)
{
    uint32_t t = first, best = MW_NONE;
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        uint32_t link;
        do {
            const mw_triangle *tile = &tiling->tri[t];
            uint32_t k = tile->v[0] == v ? 0 : tile->v[1] == v ? 1 : 2;
            if (!(tile->user & MW_GHOST) && (tile->user & MW_USER_MASK) < best)
                best = tile->user & MW_USER_MASK;
            link = tile->link[clockwise ? k : mw__prev(k)];
            t = mw__link_triangle(link);
        } while (link != MW_NONE && t != first);
        if (link != MW_NONE) break;
        t = first;
    }
    return best;
}

uint32_t mw__lowest_at_edited_vertex(const mw_tiling *tiling, uint32_t t, uint32_t v)
{
    const mw_hub *hub = mw__hub_find(tiling->hubs, v);
    return hub && hub->count > 0 ? hub->number[0] : mw__lowest_around_vertex(tiling, t, v);
}

static void tiling_release_arrays(mw_tiling *tiling)
{
    if (!tiling->borrowed) {
        free(tiling->point);
        free(tiling->tri);
    }
    tiling->point = NULL;
    tiling->tri = NULL;
}

void mw__tiling_release(mw_tiling *tiling)
{
    tiling_release_arrays(tiling);
    free(tiling->owner);
    free(tiling->tile_at);
    free(tiling->area);
    free(tiling->loop_edges);
    free(tiling->tile_of);
    if (tiling->border_loops) mw__border_loops_release(tiling->border_loops);
    free(tiling->border_loops);
    *tiling = (mw_tiling){0};
}

size_t mw__tiling_copy_bytes(const mw_tiling *tiling)
{
    if (tiling->borrowed) return 0;
    return tiling->point_count * sizeof *tiling->point + tiling->tri_count * sizeof *tiling->tri;
}

typedef struct tiling_measuring {
    const mw_tiling *tiling;
    const double *middle;
    const double (*axis)[2];
    pthread_mutex_t lock; /* of the extent */
    double low[2], high[2];
} tiling_measuring;

static void tiling_measure(void *work, uint64_t from, uint64_t to)
{
    tiling_measuring *m = work;
    const mw_tiling *tiling = m->tiling;
    const double middle[2] = {m->middle[0], m->middle[1]}, ax = m->axis[0][0], ay = m->axis[0][1],
                 bx = m->axis[1][0], by = m->axis[1][1];
    double left = INFINITY, bottom = INFINITY, right = -INFINITY, top = -INFINITY;
    for (uint32_t v = (uint32_t)from; v < to; v++) {
        if (!mw__vertex_is_used(tiling, v)) continue;
        double x = tiling->point[v].x - middle[0], y = tiling->point[v].y - middle[1];
        double along = x * ax + y * ay, across = x * bx + y * by;
        left = along < left ? along : left;
        bottom = across < bottom ? across : bottom;
        right = along > right ? along : right;
        top = across > top ? across : top;
    }
    pthread_mutex_lock(&m->lock);
    m->low[0] = left < m->low[0] ? left : m->low[0];
    m->low[1] = bottom < m->low[1] ? bottom : m->low[1];
    m->high[0] = right > m->high[0] ? right : m->high[0];
    m->high[1] = top > m->high[1] ? top : m->high[1];
    pthread_mutex_unlock(&m->lock);
}

void mw__tiling_extent(const mw_tiling *tiling, const double middle[2], const double axis[2][2],
                       mw_job *job, double low[2], double high[2])
{
    tiling_measuring m = {.tiling = tiling,
                          .middle = middle,
                          .axis = axis,
                          .low = {INFINITY, INFINITY},
                          .high = {-INFINITY, -INFINITY}};
    pthread_mutex_init(&m.lock, NULL);
    mw__job_ranges(job, tiling->point_count, tiling_measure, &m);
    pthread_mutex_destroy(&m.lock);
    /* + 0.0 makes -0 a 0: which of the two equal numbers comes last depends on the threads */
    for (int k = 0; k < 2; k++) {
        low[k] = m.low[k] + 0.0;
        high[k] = m.high[k] + 0.0;
    }
}

size_t mw__tiling_bytes(const mw_tiling *tiling)
{
    size_t bytes = mw__tiling_copy_bytes(tiling);
    if (tiling->owner || tiling->tile_at) bytes += tiling->point_count * sizeof *tiling->owner;
    bytes += tiling->number_count * sizeof *tiling->tile_of;
    if (tiling->area) bytes += tiling->tri_count * sizeof *tiling->area;
    if (tiling->border_loops)
        bytes += sizeof *tiling->border_loops +
                 mw__border_loops_bytes(tiling->border_loops, tiling->point_count);
    return bytes;
}

static double tile_double_area(mw_point a, mw_point b, mw_point c)
{
    double bound, area = mw__orient2d_rounded(a, b, c, &bound);
    if (MW_UNLIKELY(!(MW_AREA_ERROR / 2 * area > bound))) area = mw__orient2d_exact(a, b, c);
    return area < DBL_MAX ? area : INFINITY;
}

mw_status mw__tiling_areas(mw_tiling *tiling, mw_error *error)
{
    const mw_point *p = tiling->point;
    tiling->area = mw__alloc(tiling->tri_count, sizeof *tiling->area);
    if (!tiling->area) return mw__fail_memory(error);
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const uint32_t *v = tiling->tri[t].v;
        tiling->area[t] = tile_double_area(p[v[0]], p[v[1]], p[v[2]]);
    }
    return MW_OK;
}
