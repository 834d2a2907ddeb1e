/* rim.c - filling the hole that tiles leave, by cutting off corners of its boundary. */
#include "edit/rim.h"

#include <stdlib.h>
#include <string.h>

bool mw__rim_room(mw_fabric *f, size_t steps)
{
    if (steps <= f->rim_room) return true;
    size_t room = steps + steps / 2 + 16;
    mw_rim_step *rim = mw__realloc(f->rim, room, sizeof *rim);
    if (!rim) return false;
    f->rim = rim;
    uint32_t *pool = mw__realloc(f->pool, room, sizeof *pool);
    if (!pool) return false;
    f->pool = pool;
    f->rim_room = room;
    return true;
}

/* --- the star of a vertex --------------------------------------------------------------------------------------------- */

uint32_t mw__star_first(const mw_fabric *f, uint32_t v, bool *open)
{
    return mw__star_from(f, v, mw__fabric_tile(f, v), open);
}

uint32_t mw__star_from(const mw_fabric *f, uint32_t v, uint32_t first, bool *open)
{
    const mw_tiling *tiling = f->tiling;
    uint32_t at = mw__link(first, mw__corner_of(&tiling->tri[first], v));
    for (;;) {
        uint32_t link = tiling->tri[mw__link_triangle(at)].link[mw__link_edge(at)];
        *open = link == MW_NONE;
        if (*open) return at;
        at = mw__half_next(link); /* link enters the tile by the edge that ends at v */
        if (mw__link_triangle(at) == first) return at;
    }
}

/* Steps round v from its edge `first` on, until they close or end at the hull. */
static bool collect_from(mw_fabric *f, uint32_t first, mw_star *star)
{
    uint32_t at = first, link;
    *star = (mw_star){0};
    do {
        if (!mw__rim_room(f, star->n + 2)) return false;
        uint32_t across = mw__half_next(at), last = mw__half_prev(at);
        if (mw__is_fixed(f, at) && star->spokes++ < 2) star->spoke[star->spokes - 1] = star->n;
        f->rim[star->n] = (mw_rim_step){.vertex = mw__corner(f, across),
                                        .beyond = mw__beyond(f, across),
                                        .half = across,
                                        .fixed = mw__is_fixed(f, across)};
        f->pool[star->n++] = mw__link_triangle(at);
        f->rim[star->n].vertex = mw__corner(f, last);
        link = mw__beyond(f, last);
        star->open = link == MW_NONE;
        if (star->open && mw__is_fixed(f, last) && star->spokes++ < 2) star->spoke[star->spokes - 1] = star->n;
        at = link; /* which begins at v */
    } while (link != MW_NONE && link != first);
    return true;
}

bool mw__collect_star(mw_fabric *f, uint32_t v, mw_star *star)
{
    uint32_t tile = mw__fabric_tile(f, v);
    bool open;
    if (!collect_from(f, mw__link(tile, mw__corner_of(&f->tiling->tri[tile], v)), star)) return false;
    return !star->open || collect_from(f, mw__star_first(f, v, &open), star);
}

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

bool mw__pool_begin(mw_fabric *f, mw_pool *pool)
{
    for (size_t i = 0; i < pool->count; i++)
        if (!mw__journal(f, pool->tile[i])) return false;
    sort_tiles(f->tiling->tri, pool->tile, pool->count);
    return true;
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
