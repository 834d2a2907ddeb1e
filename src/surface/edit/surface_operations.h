/* surface_operations.h - the edits of a surface. Private.
 *
 * Each checks an edit of its kind, begins it (mw__surface_edit_begin) and carries it out. On
 * failure the edit has not begun. Coordinates that the kind needs are finite. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_OPERATIONS_H
#define MW_SRC_SURFACE_EDIT_SURFACE_OPERATIONS_H

#include "surface/edit/edited_surface.h"

typedef mw_status mw_surface_operation(mw_surface_editor *e, const mw_surface_edit *edit,
                                       mw_error *error);

mw_surface_operation mw__surface_add_vertex, mw__surface_remove_vertex, mw__surface_shift_vertex,
    mw__surface_add_triangle, mw__surface_remove_triangle, mw__surface_split_edge,
    mw__surface_split_triangle, mw__surface_flip_edge, mw__surface_collapse, mw__surface_cut,
    mw__surface_sew;

/* --- surface_refuse.c: what several edits refuse, by name --- */

mw_status mw__surface_check_vertex(const mw_surface_editor *e, uint32_t vertex, mw_error *error);
mw_status mw__surface_check_triangle(const mw_surface_editor *e, uint32_t triangle,
                                     mw_error *error);
/* Both ends exist and an edge joins them; half and *count as mw__surface_edge. */
mw_status mw__surface_check_edge(const mw_surface_editor *e, uint32_t a, uint32_t b,
                                 uint32_t half[2], unsigned *count, mw_error *error);
/* Is a triangle left if so many go? */
mw_status mw__surface_check_left(const mw_surface_editor *e, uint32_t gone, mw_error *error);
mw_status mw__surface_refuse_third(uint32_t triangle, uint32_t a, uint32_t b, mw_error *error);
mw_status mw__surface_refuse_clash(uint32_t triangle, uint32_t a, uint32_t b, mw_error *error);

#endif
