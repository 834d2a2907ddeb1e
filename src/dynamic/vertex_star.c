/* vertex_star.c - going round a vertex. */
#include "dynamic/vertex_star.h"

#include "dynamic/dynamic_tiling_memory.h"

uint32_t mw__vertex_star_first(const mw_dynamic_tiling *dynamic, uint32_t v, bool *open)
{
    return mw__vertex_star_first_from(dynamic, v, mw__dynamic_lowest_tile(dynamic, v), open);
}

uint32_t mw__vertex_star_first_from(const mw_dynamic_tiling *dynamic, uint32_t v, uint32_t first,
                                    bool *open)
{
    const mw_tiling *tiling = dynamic->tiling;
    uint32_t at = mw__link(first, mw__corner_of(&tiling->tri[first], v));
    for (;;) {
        uint32_t link = tiling->tri[mw__link_triangle(at)].link[mw__link_edge(at)];
        *open = link == MW_NONE;
        if (*open) return at;
        at = mw__half_next(link); /* link enters the tile by the edge that ends at v */
        if (mw__link_triangle(at) == first) return at;
    }
}

/* Push the edges round v from `first` on, until they close or end at the hull. *lowest: which of
 * them is an edge of the lowest tile. */
static bool star_push_edges(mw_dynamic_tiling *dynamic, uint32_t first, mw_vertex_star *star,
                            size_t *lowest)
{
    const mw_triangle *tri = dynamic->tiling->tri;
    uint32_t at = first, best = MW_NONE;
    dynamic->stack_count = 0;
    do {
        const mw_triangle *tile = &tri[mw__link_triangle(at)];
        uint32_t number = tile->user & ~MW_REVERSED;
        *lowest = number < best ? dynamic->stack_count : *lowest;
        best = number < best ? number : best;
        if (!mw__stack_push(dynamic, at)) return false;
        at = tile->link[mw__prev(mw__link_edge(at))]; /* which begins at v */
    } while (at != MW_NONE && at != first);
    *star = (mw_vertex_star){.n = dynamic->stack_count, .open = at == MW_NONE};
    return mw__boundary_room(dynamic, star->n + 2);
}

static void note_spoke(mw_vertex_star *star, size_t at)
{
    if (star->spokes++ < 2) star->spoke[star->spokes - 1] = at;
}

/* Set the steps opposite of v, one for each edge on the stack; begin with edge `first`. Prefetches
 * what filling the star will touch. */
static void star_set_steps(mw_dynamic_tiling *dynamic, mw_vertex_star *star, size_t first)
{
    const mw_triangle *tri = dynamic->tiling->tri;
    size_t from = first;
    for (size_t i = 0; i < star->n; i++) {
        uint32_t at = dynamic->stack[from], t = mw__link_triangle(at), k = mw__link_edge(at),
                 next = mw__next(k);
        uint32_t marks = dynamic->mark[t];
        mw_boundary_step *step = &dynamic->boundary[i];
        step->vertex = tri[t].v[next];
        step->beyond = tri[t].link[next];
        step->half = mw__link(t, next);
        step->fixed = marks >> next & 1;
        step->slit = false;
        __builtin_prefetch(&dynamic->tiling->point[step->vertex]);
        __builtin_prefetch(&dynamic->tiling->tile_at[step->vertex], 1);
        if (step->beyond != MW_NONE) __builtin_prefetch(&tri[mw__link_triangle(step->beyond)], 1);
        dynamic->pool[i] = t;
        if (MW_UNLIKELY(marks >> k & 1)) note_spoke(star, i);
        if (++from == star->n) from = 0;
    }
    uint32_t end = mw__half_prev(dynamic->stack[from > 0 ? from - 1 : star->n - 1]);
    dynamic->boundary[star->n].vertex = mw__corner(dynamic, end);
    if (star->open && mw__is_fixed(dynamic, end)) note_spoke(star, star->n);
    dynamic->stack_count = 0;
}

bool mw__vertex_star_collect(mw_dynamic_tiling *dynamic, uint32_t v, mw_vertex_star *star)
{
    uint32_t tile = dynamic->tiling->tile_at[v];
    size_t first = 0;
    bool open;
    if (!star_push_edges(dynamic, mw__link(tile, mw__corner_of(&dynamic->tiling->tri[tile], v)),
                         star, &first))
        return false;
    if (star->open) {
        if (!star_push_edges(dynamic, mw__vertex_star_first_from(dynamic, v, tile, &open), star,
                             &first))
            return false;
        first = 0;
    }
    star_set_steps(dynamic, star, first);
    return true;
}

bool mw__vertex_star_push(mw_dynamic_tiling *dynamic, const mw_vertex_star *star)
{
    for (size_t i = 0; i < star->n; i++) {
        uint32_t across = dynamic->boundary[i].half;
        if (!mw__stack_push(dynamic, across) || !mw__stack_push(dynamic, mw__half_next(across)) ||
            !mw__stack_push(dynamic, mw__half_prev(across)))
            return false;
    }
    return true;
}

uint32_t mw__dynamic_edge(const mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to)
{
    bool open;
    uint32_t first = mw__vertex_star_first(dynamic, from, &open), at = first;
    do {
        if (mw__corner(dynamic, mw__half_next(at)) == to) return at;
        uint32_t last = mw__half_prev(at);
        at = mw__beyond(dynamic, last);
        if (at == MW_NONE) return mw__corner(dynamic, last) == to ? last : MW_NONE;
    } while (at != first);
    return MW_NONE;
}
