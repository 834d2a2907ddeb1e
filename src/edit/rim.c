/* rim.c - filling the hole that tiles leave, by cutting off corners of its boundary. */
#include "edit/rim.h"

#include "edit/fabric_memory.h"
#include "edit/stitch.h"

#include <string.h>

/* --- tiles from the pool ---------------------------------------------------------------------------------------------- */

/* By number. As a rule they are six, and insertion is best; the gaps are for vertices of many thousands [Shell 1959]. */
static void sort_tiles(const mw_triangle *tri, uint32_t *tile, size_t n)
{
    size_t gap = 1;
    while (gap < n / 9) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t i = gap; i < n; i++) {
            uint32_t t = tile[i], number = tri[t].user & MW_USER_MASK;
            size_t j = i;
            for (; j >= gap && (tri[tile[j - gap]].user & MW_USER_MASK) > number; j -= gap) tile[j] = tile[j - gap];
            tile[j] = t;
        }
}

/* The tile of the highest number goes to the end; the others stay in order. */
static void put_highest_last(const mw_triangle *tri, uint32_t *tile, size_t n)
{
    uint32_t highest = tile[0];
    for (size_t i = 1; i < n; i++) {
        bool higher = (tri[tile[i]].user & MW_USER_MASK) > (tri[highest].user & MW_USER_MASK);
        tile[i - 1] = higher ? highest : tile[i];
        highest = higher ? tile[i] : highest;
    }
    tile[n - 1] = highest;
}

static bool journal_all(mw_fabric *f, const mw_pool *pool)
{
    for (size_t i = 0; i < pool->count; i++)
        if (!mw__journal(f, pool->tile[i])) return false;
    return true;
}

bool mw__pool_begin(mw_fabric *f, mw_pool *pool)
{
    if (!journal_all(f, pool)) return false;
    sort_tiles(f->tiling->tri, pool->tile, pool->count);
    return true;
}

bool mw__pool_begin_ring(mw_fabric *f, mw_pool *pool)
{
    put_highest_last(f->tiling->tri, pool->tile, pool->count);
    put_highest_last(f->tiling->tri, pool->tile, pool->count - 1);
    return journal_all(f, pool);
}

void mw__pool_end(mw_fabric *f, mw_pool *pool, uint32_t heir)
{
    if (pool->used > 0) heir = f->tiling->tri[pool->tile[0]].user & MW_USER_MASK;
    for (size_t i = pool->used; i < pool->count; i++) mw__free_number(f, pool->tile[i], heir);
}

/* The new half-edge of a step, and what is beyond it. */
static void settle(mw_fabric *f, uint32_t half, const mw_rim_step *step, mw_pool *pool)
{
    uint32_t beyond = step->beyond;
    if (step->slit) {
        size_t i = 0;
        while (i < pool->slit_count && pool->slit[i].half != beyond) i++;
        beyond = i < pool->slit_count ? pool->slit[i].beyond : MW_NONE; /* MW_NONE: the other side is yet to come */
        if (beyond == MW_NONE) pool->slit[pool->slit_count++] = (mw_rim_step){.half = step->half, .beyond = half};
    }
    mw__attach(f, half, beyond);
}

/* A tile at the corner where step b follows step a; returns the half-edge that closes it, to be looked at from outside. */
static uint32_t cut_off(mw_fabric *f, const mw_rim_step *a, const mw_rim_step *b, uint32_t end, mw_pool *pool)
{
    uint32_t t = pool->tile[pool->used++];
    mw__set_corners(f, t, a->vertex, b->vertex, end);
    mw__set_fixed(f, t, (uint32_t)a->fixed | (uint32_t)b->fixed << 1);
    f->mark[t] |= MW_FILLED;
    settle(f, mw__link(t, 0), a, pool);
    settle(f, mw__link(t, 1), b, pool);
    mw__attach(f, mw__link(t, 2), MW_NONE);
    f->last = t;
    return mw__link(t, 2);
}

bool mw__cut_chain(mw_fabric *f, mw_rim_step *step, size_t *n, mw_pool *pool)
{
    const mw_point *p = f->tiling->point;
    size_t top = 0; /* steps that are kept so far */
    for (size_t i = 0; i < *n; i++) {
        mw_rim_step next = step[i];
        uint32_t end = step[i + 1].vertex;
        while (top > 0 && mw__orient2d(p[step[top - 1].vertex], p[next.vertex], p[end]) > 0) {
            const mw_rim_step *before = &step[top - 1];
            uint32_t half = cut_off(f, before, &next, end, pool);
            if (!mw__push(f, half)) return false;
            next = (mw_rim_step){.vertex = before->vertex, .beyond = half};
            top--;
        }
        step[top++] = next;
    }
    step[top].vertex = step[*n].vertex;
    *n = top;
    return true;
}

/* Of the vertices between the ends of n steps, the one whose circle with these two ends holds none of the others. */
static size_t find_apex(const mw_fabric *f, const mw_rim_step *step, size_t n)
{
    const mw_point *p = f->tiling->point, from = p[step[n].vertex];
    mw_lifted_vertex to = mw__lift_vertex(f->tiling, step[0].vertex, from), apex = to;
    size_t best = 0;
    for (size_t i = 1; i < n; i++) {
        mw_lifted_vertex next = mw__lift_vertex(f->tiling, step[i].vertex, from);
        if (!(mw__lifted_side(f->tiling, &to, &next, from) > 0)) continue;
        if (best > 0) {
            double bound, det = mw__lifted_incircle(&to, &apex, &next, &bound); /* < 0: the next is in the circle */
            if (MW_UNLIKELY(!(fabs(det) > bound)))
                det = -mw__incircle_exact(from, p[to.vertex], p[apex.vertex], p[next.vertex]);
            if (det >= 0) continue;
        }
        apex = next;
        best = i;
    }
    return best;
}

static uint32_t fill_part(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool);

/* What lies beyond n steps, seen from a tile that has their ends: a tile among them, or what is beyond the one. */
static MW_INLINE uint32_t fill_beyond(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool, bool *fixed)
{
    *fixed = n == 1 && step->fixed;
    return n == 1 ? step->beyond : fill_part(f, step, n, pool);
}

/* The tile beside the way from the end of the last step back to the first one's beginning, and what is left beyond its other two edges. The
 * vertex removed lies in or on its circle, so that those on the circle come round it in the order in which they come here, and no step
 * crosses the tile. Returns its edge 0. */
static uint32_t fill_part(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool)
{
    size_t apex = n == 2 ? 1 : find_apex(f, step, n);
    uint32_t t = pool->tile[pool->used++];
    bool fixed[2];
    mw__set_corners(f, t, step[n].vertex, step[0].vertex, step[apex].vertex);
    mw__attach(f, mw__link(t, 1), fill_beyond(f, step, apex, pool, &fixed[0]));
    mw__attach(f, mw__link(t, 2), fill_beyond(f, step + apex, n - apex, pool, &fixed[1]));
    mw__set_fixed(f, t, (uint32_t)fixed[0] << 1 | (uint32_t)fixed[1] << 2);
    return mw__link(t, 0);
}

void mw__fill_ring(mw_fabric *f, const mw_rim_step *step, size_t n, mw_pool *pool)
{
    uint32_t last = fill_part(f, step, n - 1, pool), t = mw__link_triangle(last);
    mw__attach(f, last, step[n - 1].beyond);
    if (step[n - 1].fixed) f->mark[t] |= 1;
    f->last = t;
}

/* Does the corner between steps a and b turn left, with q not in the tile that cuts it off? */
static bool is_ear(const mw_fabric *f, const mw_rim_step *a, const mw_rim_step *b, uint32_t end, mw_point q)
{
    const mw_point *p = f->tiling->point;
    return mw__orient2d(p[a->vertex], p[b->vertex], p[end]) > 0 && mw__orient2d(p[a->vertex], p[end], q) >= 0;
}

/* The ring is a star seen from q. Such a ring of more than three steps has a corner that can be cut off so that q still sees, or lies on,
 * all of the rest: each edge from q to a ring vertex can be flipped in some order [Lawson 1977]. Going round, a corner is tried again when
 * the one after it has gone. */
bool mw__cut_ring(mw_fabric *f, mw_rim_step *step, size_t n, mw_point q, mw_pool *pool)
{
    size_t top = 0, i = 0; /* steps 0 .. top - 1 are tried, i .. n - 1 are not */
    while (top + (n - i) > 3) {
        if (i == n) { /* once more round */
            n = top;
            top = i = 0;
            mw_rim_step first = step[0]; /* the corner where the list begins is not tried */
            memmove(step, step + 1, (n - 1) * sizeof *step);
            step[n - 1] = first;
            continue;
        }
        step[top++] = step[i++];
        while (top > 1 && top + (n - i) > 3) {
            mw_rim_step *a = &step[top - 2], *b = &step[top - 1];
            uint32_t end = i < n ? step[i].vertex : step[0].vertex;
            if (!is_ear(f, a, b, end, q)) break;
            uint32_t half = cut_off(f, a, b, end, pool);
            if (!mw__push(f, half)) return false;
            *a = (mw_rim_step){.vertex = a->vertex, .beyond = half};
            top--;
        }
    }
    for (; i < n; i++) step[top++] = step[i];
    uint32_t last = cut_off(f, &step[0], &step[1], step[2].vertex, pool);
    mw__attach(f, last, step[2].beyond);
    if (step[2].fixed) f->mark[mw__link_triangle(last)] |= 4;
    return true;
}
