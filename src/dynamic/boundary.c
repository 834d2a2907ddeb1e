/* boundary.c - fills the polygon inside a boundary with tiles. */
#include "dynamic/boundary.h"

#include "dynamic/dynamic_tiling_memory.h"
#include "dynamic/tile_links.h"

#include <string.h>

/* --- tiles from the pool ---------------------------------------------------------------------- */

/* Sort by number. Usually there are six tiles, and insertion sort is best; the gaps are for
 * vertices with many thousands [Shell 1959]. */
static void pool_sort(const mw_triangle *tri, uint32_t *tile, size_t n)
{
    size_t gap = 1;
    while (gap < n / 9) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t i = gap; i < n; i++) {
            uint32_t t = tile[i], number = tri[t].user & MW_USER_MASK;
            size_t j = i;
            for (; j >= gap && (tri[tile[j - gap]].user & MW_USER_MASK) > number; j -= gap)
                tile[j] = tile[j - gap];
            tile[j] = t;
        }
}

/* Move the tile of the highest number to the end; the others stay in order. */
static void pool_put_highest_last(const mw_triangle *tri, uint32_t *tile, size_t n)
{
    uint32_t highest = tile[0];
    for (size_t i = 1; i < n; i++) {
        bool higher = (tri[tile[i]].user & MW_USER_MASK) > (tri[highest].user & MW_USER_MASK);
        tile[i - 1] = higher ? highest : tile[i];
        highest = higher ? tile[i] : highest;
    }
    tile[n - 1] = highest;
}

static bool pool_journal(mw_dynamic_tiling *dynamic, const mw_pool *pool)
{
    for (size_t i = 0; i < pool->count; i++)
        if (!mw__journal_tile(dynamic, pool->tile[i])) return false;
    return true;
}

bool mw__pool_begin(mw_dynamic_tiling *dynamic, mw_pool *pool)
{
    if (!pool_journal(dynamic, pool)) return false;
    pool_sort(dynamic->tiling->tri, pool->tile, pool->count);
    return true;
}

bool mw__pool_begin_ring(mw_dynamic_tiling *dynamic, mw_pool *pool)
{
    pool_put_highest_last(dynamic->tiling->tri, pool->tile, pool->count);
    pool_put_highest_last(dynamic->tiling->tri, pool->tile, pool->count - 1);
    return pool_journal(dynamic, pool);
}

void mw__pool_end(mw_dynamic_tiling *dynamic, mw_pool *pool, uint32_t heir)
{
    if (pool->used > 0) heir = dynamic->tiling->tri[pool->tile[0]].user & MW_USER_MASK;
    for (size_t i = pool->used; i < pool->count; i++) mw__free_number(dynamic, pool->tile[i], heir);
}

/* Link the half-edge of a new tile that replaces a step with what lies beyond the step. */
static void boundary_step_attach(mw_dynamic_tiling *dynamic, uint32_t half,
                                 const mw_boundary_step *step, mw_pool *pool)
{
    uint32_t beyond = step->beyond;
    if (step->slit) {
        size_t i = 0;
        while (i < pool->slit_count && pool->slit[i].half != beyond) i++;
        beyond = i < pool->slit_count ? pool->slit[i].beyond : MW_NONE; /* MW_NONE: not there yet */
        if (beyond == MW_NONE)
            pool->slit[pool->slit_count++] = (mw_boundary_step){.half = step->half, .beyond = half};
    }
    mw__attach(dynamic, half, beyond);
}

/* Cut off the corner where step b follows step a: a new tile. Returns the half-edge that closes it,
 * whose neighbour is still missing. */
static uint32_t corner_cut_off(mw_dynamic_tiling *dynamic, const mw_boundary_step *a,
                               const mw_boundary_step *b, uint32_t end, mw_pool *pool)
{
    uint32_t t = pool->tile[pool->used++];
    mw__set_corners(dynamic, t, a->vertex, b->vertex, end);
    mw__set_fixed(dynamic, t, (uint32_t)a->fixed | (uint32_t)b->fixed << 1);
    dynamic->mark[t] |= MW_FILLED;
    boundary_step_attach(dynamic, mw__link(t, 0), a, pool);
    boundary_step_attach(dynamic, mw__link(t, 1), b, pool);
    mw__attach(dynamic, mw__link(t, 2), MW_NONE);
    dynamic->last = t;
    return mw__link(t, 2);
}

bool mw__chain_cut_corners(mw_dynamic_tiling *dynamic, mw_boundary_step *step, size_t *n,
                           mw_pool *pool)
{
    const mw_point *p = dynamic->tiling->point;
    size_t top = 0; /* steps kept so far */
    for (size_t i = 0; i < *n; i++) {
        mw_boundary_step next = step[i];
        uint32_t end = step[i + 1].vertex;
        while (top > 0 && mw__orient2d(p[step[top - 1].vertex], p[next.vertex], p[end]) > 0) {
            const mw_boundary_step *before = &step[top - 1];
            uint32_t half = corner_cut_off(dynamic, before, &next, end, pool);
            if (!mw__stack_push(dynamic, half)) return false;
            next = (mw_boundary_step){.vertex = before->vertex, .beyond = half};
            top--;
        }
        step[top++] = next;
    }
    step[top].vertex = step[*n].vertex;
    *n = top;
    return true;
}

/* Of the vertices between the ends of n steps, the one whose circle through both ends contains none
 * of the others. */
static size_t find_delaunay_apex(const mw_dynamic_tiling *dynamic, const mw_boundary_step *step,
                                 size_t n)
{
    const mw_point *p = dynamic->tiling->point, from = p[step[n].vertex];
    mw_lifted_vertex to = mw__lift_vertex(dynamic->tiling, step[0].vertex, from), apex = to;
    size_t best = 0;
    for (size_t i = 1; i < n; i++) {
        mw_lifted_vertex next = mw__lift_vertex(dynamic->tiling, step[i].vertex, from);
        if (!(mw__lifted_side(dynamic->tiling, &to, &next, from) > 0)) continue;
        if (best > 0) {
            /* det < 0: next is in the circle */
            double bound, det = mw__lifted_incircle(&to, &apex, &next, &bound);
            if (MW_UNLIKELY(!(fabs(det) > bound)))
                det = -mw__incircle_sign(from, p[to.vertex], p[apex.vertex], p[next.vertex]);
            if (det >= 0) continue;
        }
        apex = next;
        best = i;
    }
    return best;
}

static uint32_t polygon_fill(mw_dynamic_tiling *dynamic, const mw_boundary_step *step, size_t n,
                             mw_pool *pool);

/* The half-edge beyond n steps, for a tile that has their ends: that of a new tile, or, for one
 * step, what is beyond it. */
static MW_INLINE uint32_t fill_beyond(mw_dynamic_tiling *dynamic, const mw_boundary_step *step,
                                      size_t n, mw_pool *pool, bool *fixed)
{
    *fixed = n == 1 && step->fixed;
    return n == 1 ? step->beyond : polygon_fill(dynamic, step, n, pool);
}

/* Fill the polygon of n steps and the edge from the end of the last step back to the beginning of
 * the first: make the tile at that edge, then fill what is beyond its other two edges. The vertex
 * removed lies in or on the circle of the tile; so vertices on the circle are met in their order
 * round it, and no step crosses the tile. Returns the half-edge of that edge. */
static uint32_t polygon_fill(mw_dynamic_tiling *dynamic, const mw_boundary_step *step, size_t n,
                             mw_pool *pool)
{
    size_t apex = n == 2 ? 1 : find_delaunay_apex(dynamic, step, n);
    uint32_t t = pool->tile[pool->used++];
    bool fixed[2];
    mw__set_corners(dynamic, t, step[n].vertex, step[0].vertex, step[apex].vertex);
    mw__attach(dynamic, mw__link(t, 1), fill_beyond(dynamic, step, apex, pool, &fixed[0]));
    mw__attach(dynamic, mw__link(t, 2),
               fill_beyond(dynamic, step + apex, n - apex, pool, &fixed[1]));
    mw__set_fixed(dynamic, t, (uint32_t)fixed[0] << 1 | (uint32_t)fixed[1] << 2);
    return mw__link(t, 0);
}

void mw__ring_fill_delaunay(mw_dynamic_tiling *dynamic, const mw_boundary_step *step, size_t n,
                            mw_pool *pool)
{
    uint32_t last = polygon_fill(dynamic, step, n - 1, pool), t = mw__link_triangle(last);
    mw__attach(dynamic, last, step[n - 1].beyond);
    if (step[n - 1].fixed) dynamic->mark[t] |= 1;
    dynamic->last = t;
}

/* Does the corner between steps a and b turn left, and is q not in the tile that would cut it
 * off? */
static bool is_ear(const mw_dynamic_tiling *dynamic, const mw_boundary_step *a,
                   const mw_boundary_step *b, uint32_t end, mw_point q)
{
    const mw_point *p = dynamic->tiling->point;
    return mw__orient2d(p[a->vertex], p[b->vertex], p[end]) > 0 &&
           mw__orient2d(p[a->vertex], p[end], q) >= 0;
}

/* The ring is star-shaped, seen from q. If such a ring has more than three steps, one of its
 * corners can be cut off so that q still sees, or lies on, the rest: the edges from q to the ring
 * can be flipped in some order [Lawson 1977]. After a corner was cut off, the one before it is
 * tried again. */
bool mw__ring_cut_corners(mw_dynamic_tiling *dynamic, mw_boundary_step *step, size_t n, mw_point q,
                          mw_pool *pool)
{
    size_t top = 0, i = 0; /* steps 0 .. top - 1 have been tried, i .. n - 1 have not */
    while (top + (n - i) > 3) {
        if (i == n) { /* go round once more */
            n = top;
            top = i = 0;
            mw_boundary_step first = step[0]; /* the corner where the list begins was not tried */
            memmove(step, step + 1, (n - 1) * sizeof *step);
            step[n - 1] = first;
            continue;
        }
        step[top++] = step[i++];
        while (top > 1 && top + (n - i) > 3) {
            mw_boundary_step *a = &step[top - 2], *b = &step[top - 1];
            uint32_t end = i < n ? step[i].vertex : step[0].vertex;
            if (!is_ear(dynamic, a, b, end, q)) break;
            uint32_t half = corner_cut_off(dynamic, a, b, end, pool);
            if (!mw__stack_push(dynamic, half)) return false;
            *a = (mw_boundary_step){.vertex = a->vertex, .beyond = half};
            top--;
        }
    }
    for (; i < n; i++) step[top++] = step[i];
    uint32_t last = corner_cut_off(dynamic, &step[0], &step[1], step[2].vertex, pool);
    mw__attach(dynamic, last, step[2].beyond);
    if (step[2].fixed) dynamic->mark[mw__link_triangle(last)] |= 4;
    return true;
}
