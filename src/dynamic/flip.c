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
#include "dynamic/flip.h"

#include "dynamic/operations.h"
#include "dynamic/tile_links.h"
#include "dynamic/vertex_star.h"

#include <inttypes.h>

bool mw__edge_flip(mw_dynamic_tiling *dynamic, uint32_t half)
{
    mw_triangle *tri = dynamic->tiling->tri;
    uint32_t t = mw__link_triangle(half), k = mw__link_edge(half), other = tri[t].link[k];
    uint32_t n = mw__link_triangle(other), e = mw__link_edge(other);
    if (!mw__journal_tile(dynamic, t) || !mw__journal_tile(dynamic, n)) return false;
    uint32_t a = tri[t].v[k], b = tri[n].v[e], c = tri[t].v[mw__prev(k)], d = tri[n].v[mw__prev(e)];
    uint32_t bc = tri[t].link[mw__next(k)], ca = tri[t].link[mw__prev(k)];
    uint32_t ad = tri[n].link[mw__next(e)], db = tri[n].link[mw__prev(e)];
    uint32_t of_t = dynamic->mark[t] & MW_FIXED_EDGES, of_n = dynamic->mark[n] & MW_FIXED_EDGES;
    mw__set_corners(dynamic, t, a, d, c);
    mw__set_corners(dynamic, n, d, b, c);
    mw__attach(dynamic, mw__link(t, 0), ad);
    mw__attach(dynamic, mw__link(t, 1), mw__link(n, 2));
    mw__attach(dynamic, mw__link(t, 2), ca);
    mw__attach(dynamic, mw__link(n, 0), db);
    mw__attach(dynamic, mw__link(n, 1), bc);
    mw__set_fixed(dynamic, t, (of_n >> mw__next(e) & 1) | (of_t >> mw__prev(k) & 1) << 2);
    mw__set_fixed(dynamic, n, (of_n >> mw__prev(e) & 1) | (of_t >> mw__next(k) & 1) << 1);
    return true;
}

bool mw__edge_is_illegal(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t other = mw__beyond(dynamic, half);
    if (other == MW_NONE || mw__is_fixed(dynamic, half)) return false;
    const mw_point *p = dynamic->tiling->point;
    const uint32_t *v = dynamic->tiling->tri[mw__link_triangle(half)].v;
    return mw__incircle(p[v[0]], p[v[1]], p[v[2]], p[mw__apex(dynamic, other)]) > 0;
}

/* Is the edge between two tiles that the edit filled? */
static bool edge_is_within(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t other = mw__beyond(dynamic, half);
    return other != MW_NONE && dynamic->mark[mw__link_triangle(half)] & MW_FILLED &&
           dynamic->mark[mw__link_triangle(other)] & MW_FILLED;
}

static MW_INLINE bool edges_legalise(mw_dynamic_tiling *dynamic, bool within)
{
    while (dynamic->stack_count > 0) {
        uint32_t half = dynamic->stack[--dynamic->stack_count];
        if (within && !edge_is_within(dynamic, half)) continue;
        if (!mw__edge_is_illegal(dynamic, half)) continue;
        uint32_t t = mw__link_triangle(half), n = mw__link_triangle(mw__beyond(dynamic, half));
        if (!mw__edge_flip(dynamic, half)) return false;
        dynamic->flips++;
        if (!mw__stack_push(dynamic, mw__link(t, 0)) || !mw__stack_push(dynamic, mw__link(t, 2)) ||
            !mw__stack_push(dynamic, mw__link(n, 0)) || !mw__stack_push(dynamic, mw__link(n, 1)))
            return false;
    }
    return true;
}

bool mw__legalise(mw_dynamic_tiling *dynamic)
{
    return dynamic->delaunay ? edges_legalise(dynamic, false) : edges_legalise(dynamic, true);
}

bool mw__legalise_within(mw_dynamic_tiling *dynamic)
{
    return edges_legalise(dynamic, true);
}

mw_status mw__dynamic_make_delaunay(mw_dynamic_tiling *dynamic, mw_error *error)
{
    dynamic->delaunay = true;
    for (uint32_t t = 0; t < dynamic->tiling->tri_count; t++) {
        for (uint32_t k = 0; k < 3; k++)
            if (!mw__stack_push(dynamic, mw__link(t, k))) return mw__fail_memory(error);
        if (!mw__legalise(dynamic)) return mw__fail_memory(error);
    }
    return MW_OK;
}

mw_status mw__dynamic_flip(mw_dynamic_tiling *dynamic, uint32_t from, uint32_t to, mw_error *error)
{
    uint32_t half = mw__dynamic_edge(dynamic, from, to),
             number[2] = {dynamic->vertex_number[from], dynamic->vertex_number[to]};
    if (half == MW_NONE ||
        (!mw__is_users_tile(dynamic, mw__link_triangle(half)) && !mw__is_fixed(dynamic, half)))
        return mw__fail_at(error, -1, number[0],
                           "vertices %" PRIu32 " and %" PRIu32 " are not joined by an edge",
                           number[0], number[1]);
    uint32_t other = mw__beyond(dynamic, half);
    if (other == MW_NONE || mw__is_fixed(dynamic, half))
        return mw__fail_at(error, -1, number[0],
                           "the edge from vertex %" PRIu32 " to %" PRIu32
                           " is border or a constraint",
                           number[0], number[1]);
    const mw_point *p = dynamic->tiling->point;
    uint32_t a = mw__corner(dynamic, half), b = mw__corner(dynamic, other),
             c = mw__apex(dynamic, half), d = mw__apex(dynamic, other);
    if (!(mw__orient2d(p[d], p[c], p[a]) > 0 && mw__orient2d(p[c], p[d], p[b]) > 0))
        return mw__fail_at(error, -1, number[0],
                           "the triangles beside the edge from vertex %" PRIu32 " to %" PRIu32
                           " do not form a convex quadrilateral",
                           number[0], number[1]);
    if (mw__incircle(p[a], p[b], p[c], p[d]) != 0) dynamic->delaunay = false;
    dynamic->last = mw__link_triangle(half);
    return mw__edge_flip(dynamic, half) ? MW_OK : mw__fail_memory(error);
}
