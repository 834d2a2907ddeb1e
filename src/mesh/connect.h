/* connect.h - edges as their lower vertices see them. Private. */
#ifndef MW_SRC_CONNECT_H
#define MW_SRC_CONNECT_H

#include "mesh/mesh.h"

typedef struct mw_half_edge {
    uint32_t to, half; /* upper vertex; 4 * triangle + edge */
} mw_half_edge;

/* Add what another thread has found. */
void mw__links_add(const mw_triangle *tri, const mw_links *more, mw_links *links);

/* Link the halves of one lower vertex, however many they are, or an edge has: the first two in the user's order are joined, and
 * the others noted. What is found is added to *links. Returns false when out of memory. */
bool mw__match(mw_triangle *tri, const mw_half_edge *half, uint32_t count, mw_links *links);

/* Is the half-edge, a further one of its edge, the first such in the user's order? Then it becomes *extra. */
void mw__note_extra(const mw_triangle *tri, uint32_t half, uint32_t *extra);

#endif
