/* surface_journal.h - an edit of a surface as a whole: begin, commit, undo, report. Private.
 *
 * Before an edit first changes a triangle it copies the triangle's record, links included, once for
 * each edit. Triangles at the end of the array that the edit made need no entry: the former count
 * tells which they are. What becomes of vertices is recorded event by event. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_JOURNAL_H
#define MW_SRC_SURFACE_EDIT_SURFACE_JOURNAL_H

#include "surface/edit/edited_surface.h"

/* What an edit may need at most. */
typedef struct mw_surface_needs {
    size_t made;           /* triangles */
    size_t vertices;       /* vertices made */
    size_t triangles;      /* triangles that existed before and get other vertices or links */
    size_t vertex_entries; /* vertices made, freed and moved */
} mw_surface_needs;

/* Make room for half as many triangles and vertices more, so that the first edits need not. False
 * when out of memory. */
bool mw__surface_reserve_some(mw_surface_editor *e);

/* Reserve memory, and begin the edit. Nothing can fail after it. MW_ERROR_LIMIT,
 * MW_ERROR_MEMORY. */
mw_status mw__surface_edit_begin(mw_surface_editor *e, const mw_surface_needs *needs,
                                 mw_error *error);

/* Record a triangle, before the edit under way changes it. */
static MW_INLINE void mw__surface_record(mw_surface_editor *e, uint32_t t)
{
    mw_triangle *tri = &e->surface->tri[t];
    if (t >= e->journal_below || tri->user & MW_SURFACE_RECORDED) return;
    e->triangle[e->triangle_count++] = (mw_triangle_entry){t, *tri};
    tri->user |= MW_SURFACE_RECORDED;
}

/* Record what happens to a vertex, before it is moved. */
void mw__surface_record_vertex(mw_surface_editor *e, mw_vertex_event event, uint32_t vertex,
                               uint32_t other);

/* List what the last step changed; end the edit. */
void mw__surface_report(mw_surface_editor *e, mw_surface_change *change);
void mw__surface_commit(mw_surface_editor *e);

/* Take the last step back. Its entries then hold what was there after the edit, for a report, until
 * mw__surface_drop_step. MW_ERROR_MEMORY: nothing has changed. */
mw_status mw__surface_revert(mw_surface_editor *e, mw_error *error);
void mw__surface_drop_step(mw_surface_editor *e);

size_t mw__surface_journal_bytes(const mw_surface_editor *e);

#endif
