/* surface_changes.h - the single changes that edits of a surface are made of. Private. They record
 * what they change, keep the lists of corners and count the borders. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_CHANGES_H
#define MW_SRC_SURFACE_EDIT_SURFACE_CHANGES_H

#include "surface/edit/edited_surface.h"

/* Vertex k of triangle t becomes v. */
void mw__surface_set_corner(mw_surface_editor *e, uint32_t t, uint32_t k, uint32_t v);

/* Link two half-edges. `other` MW_NONE: the half-edge becomes a border; what it was linked to still
 * names it. */
void mw__surface_join(mw_surface_editor *e, uint32_t half, uint32_t other);

/* A new triangle without links. Returns its number. */
uint32_t mw__surface_make_triangle(mw_surface_editor *e, uint32_t a, uint32_t b, uint32_t c);

/* Free a triangle; its neighbours get borders. `heir`: a triangle that takes its place, or
 * MW_NONE. */
void mw__surface_free_triangle(mw_surface_editor *e, uint32_t t, uint32_t heir);

/* A new vertex; a copy of `copied`, or MW_NONE. Returns its number. */
uint32_t mw__surface_make_vertex(mw_surface_editor *e, const double point[3], uint32_t copied);
/* Free a vertex of no triangle; `other` took its place, or MW_NONE. */
void mw__surface_free_vertex(mw_surface_editor *e, uint32_t vertex, uint32_t other);
void mw__surface_move_vertex(mw_surface_editor *e, uint32_t vertex, const double point[3]);

#endif
