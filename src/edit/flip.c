/* flip.c - flips on request, and flips that make a mesh Delaunay again [Lawson 1977].
 *
 *            c                            c
 *           /|\                          / \      Tile t is a, b, c; tile n beyond ab is b, a, d.
 *          / | \                        /   \     They become a, d, c and d, b, c: t and n again,
 *         a--+--b   as seen with       a  +  b    so no tile is made or deleted.
 *          \ | /    ab drawn            \ | /
 *           \|/                          \|/
 *            d                            d
 *
 * The flips end: each lowers the surface lifted to the paraboloid. They end with a constrained
 * Delaunay triangulation of the edges that are not fixed. Parts of the plane that fixed edges hide
 * from each other are independent. */
#include "edit/flip.h"

#include "edit/operations.h"
#include "edit/tile_links.h"
#include "edit/vertex_star.h"

#include <inttypes.h>

bool mw__edge_flip(mw_dynamic_tiling *f, uint32_t half)
{
    mw_triangle *tri = f->tiling->tri;
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half), other = tri[t].link[k];
    uint32_t n = mw__link_triangle(other), e = mw__link_edge(other);
    if (!mw__journal_tile(f, t) || !mw__journal_tile(f, n)) return false;
    uint32_t a = tri[t].v[k], b = tri[n].v[e], c = tri[t].v[mw__prev(k)], d = tri[n].v[mw__prev(e)];
    uint32_t bc = tri[t].link[mw__next(k)], ca = tri[t].link[mw__prev(k)];
    uint32_t ad = tri[n].link[mw__next(e)], db = tri[n].link[mw__prev(e)];
    uint32_t of_t = f->mark[t] & MW_FIXED_EDGES, of_n = f->mark[n] & MW_FIXED_EDGES;
    mw__set_corners(f, t, a, d, c);
    mw__set_corners(f, n, d, b, c);
    mw__attach(f, mw__link(t, 0), ad);
    mw__attach(f, mw__link(t, 1), mw__link(n, 2));
    mw__attach(f, mw__link(t, 2), ca);
    mw__attach(f, mw__link(n, 0), db);
    mw__attach(f, mw__link(n, 1), bc);
    mw__set_fixed(f, t, (of_n >> mw__next(e) & 1) | (of_t >> mw__prev(k) & 1) << 2);
    mw__set_fixed(f, n, (of_n >> mw__prev(e) & 1) | (of_t >> mw__next(k) & 1) << 1);
    return true;
}

bool mw__edge_is_illegal(const mw_dynamic_tiling *f, uint32_t half)
{
    uint32_t other = mw__beyond(f, half);
    if (other == MW_NONE || mw__is_fixed(f, half)) return false;
    const mw_point *p = f->tiling->point;
    const uint32_t *v = f->tiling->tri[mw__link_triangle(half)].v;
    return mw__incircle(p[v[0]], p[v[1]], p[v[2]], p[mw__apex(f, other)]) > 0;
}

/* Is the edge between two tiles that the edit filled? */
static bool edge_is_within(const mw_dynamic_tiling *f, uint32_t half)
{
    uint32_t other = mw__beyond(f, half);
    return other != MW_NONE && f->mark[mw__link_triangle(half)] & MW_FILLED &&
           f->mark[mw__link_triangle(other)] & MW_FILLED;
}

static MW_INLINE bool edges_legalise(mw_dynamic_tiling *f, bool within)
{
    while (f->stack_count > 0) {
        uint32_t half = f->stack[--f->stack_count];
        if (within && !edge_is_within(f, half)) continue;
        if (!mw__edge_is_illegal(f, half)) continue;
        uint32_t t = mw__link_triangle(half), n = mw__link_triangle(mw__beyond(f, half));
        if (!mw__edge_flip(f, half)) return false;
        f->flips++;
        if (!mw__stack_push(f, mw__link(t, 0)) || !mw__stack_push(f, mw__link(t, 2)) ||
            !mw__stack_push(f, mw__link(n, 0)) || !mw__stack_push(f, mw__link(n, 1)))
            return false;
    }
    return true;
}

bool mw__legalise(mw_dynamic_tiling *f)
{
    return f->delaunay ? edges_legalise(f, false) : edges_legalise(f, true);
}

bool mw__legalise_within(mw_dynamic_tiling *f)
{
    return edges_legalise(f, true);
}

mw_status mw__dynamic_make_delaunay(mw_dynamic_tiling *f, mw_error *error)
{
    f->delaunay = true;
    for (uint32_t t = 0; t < f->tiling->tri_count; t++) {
        for (uint32_t k = 0; k < 3; k++)
            if (!mw__stack_push(f, mw__link(t, k))) return mw__fail_memory(error);
        if (!mw__legalise(f)) return mw__fail_memory(error);
    }
    return MW_OK;
}

mw_status mw__dynamic_flip(mw_dynamic_tiling *f, uint32_t from, uint32_t to, mw_error *error)
{
    uint32_t half = mw__dynamic_edge(f, from, to), number[2] = {f->vertex_number[from], f->vertex_number[to]};
    if (half == MW_NONE || (!mw__is_users_tile(f, mw__link_triangle(half)) && !mw__is_fixed(f, half)))
        return mw__fail_at(error, -1, number[0], "vertices %" PRIu32 " and %" PRIu32 " are not joined by an edge",
                           number[0], number[1]);
    uint32_t other = mw__beyond(f, half);
    if (other == MW_NONE || mw__is_fixed(f, half))
        return mw__fail_at(error, -1, number[0],
                           "the edge from vertex %" PRIu32 " to %" PRIu32 " is border or a constraint", number[0],
                           number[1]);
    const mw_point *p = f->tiling->point;
    uint32_t a = mw__corner(f, half), b = mw__corner(f, other), c = mw__apex(f, half), d = mw__apex(f, other);
    if (!(mw__orient2d(p[d], p[c], p[a]) > 0 && mw__orient2d(p[c], p[d], p[b]) > 0))
        return mw__fail_at(error, -1, number[0],
                           "the triangles beside the edge from vertex %" PRIu32 " to %" PRIu32
                           " make no convex quadrilateral",
                           number[0], number[1]);
    if (mw__incircle(p[a], p[b], p[c], p[d]) != 0) f->delaunay = false;
    f->last = mw__link_triangle(half);
    return mw__edge_flip(f, half) ? MW_OK : mw__fail_memory(error);
}
