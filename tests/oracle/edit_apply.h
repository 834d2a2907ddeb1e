/* edit_apply.h - edits of an editor and of its twin: what each did is taken over from its
 * report; where it is refused nothing may have changed. */
#ifndef MW_TESTS_ORACLE_EDIT_APPLY_H
#define MW_TESTS_ORACLE_EDIT_APPLY_H

#include "oracle/edit_check.h"
#include "oracle/edit_locate.h"
#include "oracle/edit_predict.h"

/* Applies the edit to the editor, by the function of its kind (direct) or by mw_edit_apply, and
 * requires what twin_predict says. Returns the editor's status. */
mw_status twin_apply(twin *t, const mw_edit *edit, bool direct);

/* Undoes the latest edit of the editor. `then`: a copy of the twin from before it. */
void twin_undo(twin *t, const twin *then);

/* The editor has undone an edit, as `change` tells: requires that all is as in `then`. */
void twin_undone(twin *t, const twin *then, const mw_change *change);

/* Compacts the editor; the twin gets the new numbers. */
void twin_compact(twin *t);

/* --- parts of these, for tests that call the editor themselves -------------------------------- */

/* The editor has done the edit, as `change` tells: brings the twin up to date, and requires what
 * the edit has to do. */
void twin_take_over(twin *t, const mw_edit *e, const mw_change *change);

/* Brings triangles and states of vertices up to date, not coordinates and constraints. undone:
 * what was freed comes back by its number, else new triangles have new ones. */
void twin_absorb(twin *t, const mw_change *change, bool undone);

/* Makes room for numbers below these; the new ones are gone. */
void twin_grow(twin *t, uint32_t vertex_range, uint32_t triangle_range);

/* Reads coordinates and values of a vertex from the editor. */
void twin_read_vertex(twin *t, uint32_t v);

/* Makes two of each constraint that has v inside it. */
void twin_split_fixed(twin *t, uint32_t v);

/* Did nothing change? */
bool change_is_empty(const mw_change *change);

#endif
