/* match.h - the halves of an edge find each other, at its lower vertex. Private. */
#ifndef MW_SRC_MATCH_H
#define MW_SRC_MATCH_H

#include "mesh/mesh.h"

/* What linking has found. */
typedef struct mw_links {
    uint64_t linked; /* half-edges that got a link                                                          */
    uint32_t
        extra;     /* a link to the third or a further triangle of an edge, the one of the lowest user's number; MW_NONE
                        if there is none                                                                    */
    bool opposite; /* both triangles of each edge run through it in opposite directions                   */
} mw_links;

static MW_INLINE mw_links mw__no_links(void)
{
    return (mw_links){.extra = MW_NONE, .opposite = true};
}

/* Add what another thread has found. */
void mw__links_add(const mw_triangle *tri, const mw_links *more, mw_links *links);

/* The error of an edge that has two triangles already; the link `extra` names it, from and to are its vertices by the
 * user's numbers. */
mw_status mw__fail_shared(const mw_triangle *tri, uint32_t extra, uint32_t from, uint32_t to, mw_error *error);

typedef struct mw_half_edge {
    uint32_t to, half; /* upper vertex; 4 * triangle + edge */
} mw_half_edge;

/* Link the halves of one lower vertex, however many they are, or an edge has: the first two in the user's order are joined, and
 * the others noted. What is found is added to *links. Returns false when out of memory. */
bool mw__match(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links);

/* Is the half-edge, a further one of its edge, the first such in the user's order? Then it becomes *extra. */
void mw__note_extra(const mw_triangle *tri, uint32_t half, uint32_t *extra);

#endif
