/* surface_corners.h - the triangles at a vertex and at an edge of an edited surface. Private. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_CORNERS_H
#define MW_SRC_SURFACE_EDIT_SURFACE_CORNERS_H

#include "surface/edit/edited_surface.h"

/* Put a corner into the list of its vertex, or take it out. */
void mw__corner_add(mw_surface_editor *e, uint32_t vertex, uint32_t corner);
void mw__corner_drop(mw_surface_editor *e, uint32_t vertex, uint32_t corner);

/* Put the corners of all triangles into lists, which have no corner yet. O(n). */
void mw__corners_fill(mw_surface_editor *e);

/* The half-edges that join two vertices, the lower one first; MW_NONE for those that are missing.
 * Returns how many there are. The vertices exist. */
unsigned mw__surface_edge(const mw_surface_editor *e, uint32_t a, uint32_t b, uint32_t half[2]);

/* How many triangles are at a vertex. */
uint32_t mw__surface_degree(const mw_surface_editor *e, uint32_t vertex);

/* Begin a search that marks vertices. */
void mw__surface_search_begin(mw_surface_editor *e);
static MW_INLINE bool mw__surface_seen(const mw_surface_editor *e, uint32_t vertex)
{
    return e->at[vertex].seen == e->search;
}
static MW_INLINE void mw__surface_see(mw_surface_editor *e, uint32_t vertex)
{
    e->at[vertex].seen = e->search;
}

#endif
