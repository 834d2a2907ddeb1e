/* surface_flip.c - flips an edge: two triangles exchange their common edge for the other
 * diagonal. */
#include "topology/fan.h"
#include "surface/surface.h"

#include <inttypes.h>

/* Does an edge join corner k of triangle t with vertex `other`? Looks at the fan round the
 * corner. */
static bool vertices_are_joined(const mw_surface *surface, uint32_t t, uint32_t k, uint32_t other)
{
    const mw_edge_end first[2] = {{mw__link(t, k), true}, {mw__link(t, mw__prev(k)), false}};
    for (int way = 0; way < 2; way++) /* a fan that is not closed is searched in both directions */
        for (mw_edge_end e = first[way];;) {
            uint32_t far = surface->tri[mw__link_triangle(e.half)].v[mw__far_corner(e)];
            if (mw__representative(surface->coincident, far) ==
                mw__representative(surface->coincident, other))
                return true;
            if (mw__link_of(surface->tri, e) == MW_NONE) break;
            e = mw__other_edge(mw__across(surface->tri, surface->coincident, e));
            if (mw__link_triangle(e.half) == t) return false;
        }
    return false;
}

static void half_edges_link(mw_triangle *tri, uint32_t half, uint32_t other)
{
    tri[mw__link_triangle(half)].link[mw__link_edge(half)] = other;
    if (other != MW_NONE) tri[mw__link_triangle(other)].link[mw__link_edge(other)] = half;
}

mw_status mw_surface_flip(mw_surface *surface, uint32_t triangle, unsigned local_edge,
                          mw_error *error)
{
    mw_triangle *abc = &surface->tri[triangle];
    uint32_t ab = local_edge, link = abc->link[ab];
    if (surface->edited)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the surface has an editor: call mw_surface_edit_flip()");
    if (link == MW_NONE)
        return mw__fail_at(error, triangle, -1, "triangle %" PRIu32 ": edge %u has no neighbour",
                           triangle, local_edge);
    if (!mw__surface_orientations_agree(surface, triangle, ab))
        return mw__fail_at(error, triangle, -1,
                           "triangle %" PRIu32 ": its neighbour at edge %u is oriented differently",
                           triangle, local_edge);
    uint32_t neighbour = mw__link_triangle(link), ba = mw__link_edge(link);
    mw_triangle *bad = &surface->tri[neighbour];
    uint32_t ca = mw__prev(ab), db = mw__prev(ba), c = abc->v[ca], d = bad->v[db];
    if (mw__representative(surface->coincident, c) == mw__representative(surface->coincident, d) ||
        vertices_are_joined(surface, triangle, ca, d))
        return mw__fail_at(error, triangle, c,
                           "triangle %" PRIu32 ": vertices %" PRIu32 " and %" PRIu32
                           " are the same, or joined already",
                           triangle, c, d);
    uint32_t beyond_ca = abc->link[ca], beyond_db = bad->link[db];
    abc->v[ab] = d;
    bad->v[ba] = c;
    abc->v[3] = abc->v[0];
    bad->v[3] = bad->v[0];
    half_edges_link(surface->tri, mw__link(triangle, ab), beyond_db);
    half_edges_link(surface->tri, mw__link(neighbour, ba), beyond_ca);
    half_edges_link(surface->tri, mw__link(triangle, ca), mw__link(neighbour, db));
    surface->shape++;
    return MW_OK;
}
