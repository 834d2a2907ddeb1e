/* surface_followers.h - what follows the edits of a surface: probers, by their boxes, and stars.
 * Private. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_FOLLOWERS_H
#define MW_SRC_SURFACE_EDIT_SURFACE_FOLLOWERS_H

#include "surface/edit/edited_surface.h"

/* Let a prober of the surface follow; one without boxes, or that follows already, needs nothing.
 * Nothing has changed on failure. Also the star. */
mw_status mw__followers_add_prober(mw_surface_editor *e, mw_prober *prober, mw_error *error);
mw_status mw__followers_add_star(mw_surface_editor *e, mw_star *star, mw_error *error);
void mw__followers_remove_prober(mw_surface_editor *e, const mw_prober *prober);
void mw__followers_remove_star(mw_surface_editor *e, mw_star *star);
void mw__followers_release(mw_surface_editor *e);
size_t mw__followers_bytes(const mw_surface_editor *e);

/* Room for an edit that makes so many triangles and vertices. */
bool mw__followers_reserve(mw_surface_editor *e, size_t made, size_t vertices);

/* The last step has been carried out: all follow it. */
void mw__followers_follow(mw_surface_editor *e);

/* An update of the surface has only been the edit: what was up to date before it is again. */
void mw__followers_end_update(mw_surface_editor *e);

/* The surface has been renumbered, and has its new counts. First boxes are made anew, which may
 * fail; then stars get the new numbers, and all follow. */
bool mw__followers_rebuild(mw_surface_editor *e);
void mw__followers_renumber(mw_surface_editor *e, const uint32_t *triangle, const uint32_t *vertex);

#endif
