/* surface_corners.c - lists of the corners at each vertex. */
#include "surface/edit/surface_corners.h"

void mw__corner_add(mw_surface_editor *e, uint32_t vertex, uint32_t corner)
{
    uint32_t next = e->at[vertex].first;
    e->corner[corner] = (mw_corner){next, MW_NONE};
    if (mw__is_corner(next)) e->corner[next].prev = corner;
    e->at[vertex].first = corner;
}

void mw__corner_drop(mw_surface_editor *e, uint32_t vertex, uint32_t corner)
{
    mw_corner c = e->corner[corner];
    if (c.prev == MW_NONE)
        e->at[vertex].first = c.next;
    else
        e->corner[c.prev].next = c.next;
    if (mw__is_corner(c.next)) e->corner[c.next].prev = c.prev;
}

void mw__corners_fill(mw_surface_editor *e)
{
    const mw_surface *surface = e->surface;
    for (uint32_t t = surface->tri_count; t-- > 0;) /* so the lowest triangle comes first */
        for (uint32_t k = 0; k < 3 && !mw__surface_is_freed(surface, t); k++)
            mw__corner_add(e, surface->tri[t].v[k], mw__corner_number(t, k));
}

/* The edge of a corner's triangle that joins the corner with a vertex; MW_NONE: neither does. */
static MW_INLINE uint32_t corner_edge_to(const mw_surface_editor *e, uint32_t corner,
                                         uint32_t vertex)
{
    uint32_t t = corner / 3, k = corner % 3;
    const uint32_t *v = e->surface->tri[t].v;
    if (v[k + 1] == vertex) return mw__link(t, k);
    return v[mw__prev(k)] == vertex ? mw__link(t, mw__prev(k)) : MW_NONE;
}

/* Both lists hold all triangles of the edge: the search ends with the shorter one. */
unsigned mw__surface_edge(const mw_surface_editor *e, uint32_t a, uint32_t b, uint32_t half[2])
{
    uint32_t c = e->at[a].first, d = e->at[b].first, found = MW_NONE;
    half[0] = half[1] = MW_NONE;
    while (found == MW_NONE) {
        if (!mw__is_corner(c) || !mw__is_corner(d)) return 0;
        found = corner_edge_to(e, c, b);
        if (found == MW_NONE) found = corner_edge_to(e, d, a);
        c = e->corner[c].next;
        d = e->corner[d].next;
    }
    uint32_t link = mw__half_link(e->surface->tri, found);
    half[0] = link == MW_NONE || found < link ? found : link;
    half[1] = link == MW_NONE || found > link ? link == MW_NONE ? MW_NONE : found : link;
    return link == MW_NONE ? 1 : 2;
}

uint32_t mw__surface_degree(const mw_surface_editor *e, uint32_t vertex)
{
    uint32_t n = 0;
    for (uint32_t c = e->at[vertex].first; mw__is_corner(c); c = e->corner[c].next) n++;
    return n;
}

void mw__surface_search_begin(mw_surface_editor *e)
{
    if (++e->search != 0) return;
    for (uint32_t v = 0; v < e->surface->point_count; v++) e->at[v].seen = 0;
    e->search = 1;
}
