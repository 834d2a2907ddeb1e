/* match.h - joins the half-edges of an edge, at its lower vertex. Private. */
#ifndef MW_SRC_MESH_MATCH_H
#define MW_SRC_MESH_MATCH_H

#include "mesh/mesh.h"

/* The results of linking. */
typedef struct mw_links {
    uint64_t linked; /* the number of half-edges with a link */
    /* A link to the third or a further triangle of an edge: that with the lowest number; else
     * MW_NONE. */
    uint32_t extra;
    bool opposite; /* the two triangles of each edge run along it in opposite directions */
} mw_links;

static MW_INLINE mw_links mw__no_links(void)
{
    return (mw_links){.extra = MW_NONE, .opposite = true};
}

typedef struct mw_half_edge {
    uint32_t to, half; /* upper vertex; 4 * triangle + edge */
} mw_half_edge;

/* The link of a half-edge. */
static MW_INLINE uint32_t *mw__half_edge_link(mw_triangle *tri, uint32_t half)
{
    return &tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

/* Add the results of another thread. */
void mw__links_add(const mw_triangle *tri, const mw_links *more, mw_links *links);

/* The error of an edge with more than two triangles. `extra` is a link to the third; `from` and
 * `to` are the user's numbers of the vertices. */
mw_status mw__fail_non_manifold_edge(const mw_triangle *tri, uint32_t extra, uint32_t from,
                                     uint32_t to, mw_error *error);

/* Link the half-edges of one lower vertex, any number of them. If an edge has more than two
 * half-edges, the first two in the user's order are joined, and the others are noted as defects.
 * Adds the results to *links. Returns false when out of memory. */
bool mw__half_edges_match(mw_triangle *tri, const mw_half_edge *half, uint32_t count,
                          mw_links *links);

/* Note a third or further half-edge of an edge: the first in the user's order becomes *extra. */
void mw__links_note_extra(const mw_triangle *tri, uint32_t half, uint32_t *extra);

#endif
