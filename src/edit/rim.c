/* rim.c - filling the hole that tiles leave, by cutting off corners of its boundary. */
#include "edit/rim.h"

#include <stdlib.h>
#include <string.h>

bool mw__rim_enlarge(mw_fabric *f, size_t steps)
{
    size_t room = steps + steps / 2 + 16;
    mw_rim_step *rim = mw__realloc(f->rim, room, sizeof *rim);
    if (!rim) return false;
    f->rim = rim;
    uint32_t *pool = mw__realloc(f->pool, room, sizeof *pool);
    if (!pool) return false;
    f->pool = pool;
    mw_step_ahead *ahead = mw__realloc(f->ahead, room, sizeof *ahead);
    if (!ahead) return false;
    f->ahead = ahead;
    mw_sight *sight = mw__realloc(f->sight, 2 * room, sizeof *sight);
    if (!sight) return false;
    f->sight = sight;
    f->rim_room = room;
    return true;
}

void mw__rim_release(mw_fabric *f)
{
    free(f->rim);
    free(f->pool);
    free(f->ahead);
    free(f->sight);
    f->rim = NULL;
    f->pool = NULL;
    f->ahead = NULL;
    f->sight = NULL;
    f->rim_room = 0;
}

size_t mw__rim_bytes(const mw_fabric *f)
{
    return f->rim_room * (sizeof *f->rim + sizeof *f->pool + sizeof *f->ahead + 2 * sizeof *f->sight);
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

/* The edges round v from `first` on, until they close or end at the hull, onto the stack; *lowest: which of them is one of the lowest of its
 * triangles. */
static bool go_round(mw_fabric *f, uint32_t first, mw_star *star, size_t *lowest)
{
    const mw_triangle *tri = f->tiling->tri;
    uint32_t at = first, best = MW_NONE;
    f->stack_count = 0;
    do {
        const mw_triangle *tile = &tri[mw__link_triangle(at)];
        uint32_t number = tile->user & ~MW_FLIPPED;
        *lowest = number < best ? f->stack_count : *lowest;
        best = number < best ? number : best;
        if (!mw__push(f, at)) return false;
        at = tile->link[mw__prev(mw__link_edge(at))]; /* which begins at v */
    } while (at != MW_NONE && at != first);
    *star = (mw_star){.n = f->stack_count, .open = at == MW_NONE};
    return mw__rim_room(f, star->n + 2);
}

static void note_spoke(mw_star *star, size_t at)
{
    if (star->spokes++ < 2) star->spoke[star->spokes - 1] = at;
}

/* The steps across from v, one for each edge on the stack, of which `first` is the first. What filling them will touch is fetched meanwhile. */
static void set_steps(mw_fabric *f, mw_star *star, size_t first)
{
    const mw_triangle *tri = f->tiling->tri;
    size_t from = first;
    for (size_t i = 0; i < star->n; i++) {
        uint32_t at = f->stack[from], t = mw__link_triangle(at), k = mw__link_edge(at), next = mw__next(k);
        uint32_t marks = f->mark[t];
        mw_rim_step *step = &f->rim[i];
        step->vertex = tri[t].v[next];
        step->beyond = tri[t].link[next];
        step->half = mw__link(t, next);
        step->fixed = marks >> next & 1;
        step->slit = false;
        __builtin_prefetch(&f->tiling->point[step->vertex]);
        __builtin_prefetch(&f->tiling->tile_at[step->vertex], 1);
        if (step->beyond != MW_NONE) __builtin_prefetch(&tri[mw__link_triangle(step->beyond)], 1);
        f->pool[i] = t;
        if (MW_UNLIKELY(marks >> k & 1)) note_spoke(star, i);
        if (++from == star->n) from = 0;
    }
    uint32_t end = mw__half_prev(f->stack[from > 0 ? from - 1 : star->n - 1]);
    f->rim[star->n].vertex = mw__corner(f, end);
    if (star->open && mw__is_fixed(f, end)) note_spoke(star, star->n);
    f->stack_count = 0;
}

bool mw__collect_star(mw_fabric *f, uint32_t v, mw_star *star)
{
    uint32_t tile = f->tiling->tile_at[v];
    size_t first = 0;
    bool open;
    if (!go_round(f, mw__link(tile, mw__corner_of(&f->tiling->tri[tile], v)), star, &first)) return false;
    if (star->open) {
        if (!go_round(f, mw__star_from(f, v, tile, &open), star, &first)) return false;
        first = 0;
    }
    set_steps(f, star, first);
    return true;
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
    mw_sight to = mw__sight_of(f->tiling, step[0].vertex, from), apex = to;
    size_t best = 0;
    for (size_t i = 1; i < n; i++) {
        mw_sight next = mw__sight_of(f->tiling, step[i].vertex, from);
        if (!(mw__sights_side(f->tiling, &to, &next, from) > 0)) continue;
        if (best > 0) {
            double bound, det = mw__sights_rounded(&to, &apex, &next, &bound); /* < 0: the next is in the circle */
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
