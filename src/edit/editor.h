/* editor.h - what an editor holds. Private. */
#ifndef MW_SRC_EDIT_EDITOR_H
#define MW_SRC_EDIT_EDITOR_H

#include "dynamic/dynamic_tiling.h"
#include "edit/upkeep.h"

struct mw_editor {
    mw_dynamic_tiling dynamic; /* changes the locator's tiling */
    mw_locator locator;        /* of the mesh as it is now     */
    /* The tiling as a mesh, with ghosts, for callers that look up triangles by number; and the
     * fields, by number of vertex. It owns only the fields. */
    mw_mesh view;
    size_t field_room; /* values in each field there is room for */
    mw_upkeep upkeep;
    mw_cursor cursor;   /* interpolates values of new vertices    */
    bool guide_led_far; /* the last walk from the guide was long: see insertion_first_tile */
    bool keeps_log;
    uint32_t threads; /* as in the options                      */
    const mw_progress *progress;
    size_t undo, undoable;
    mw_edit *log;
    size_t log_count, log_room;
    mw_changed_triangle *changed;
    size_t changed_room;
    uint64_t edits;
};

/* Update the view: the arrays of the dynamic tiling may have moved. */
void mw__editor_update_view(mw_editor *editor);

/* Does an undo, a report (`change`, as the caller gave it), an index or a hub need to know what so
 * many insertions at once changed? */
static MW_INLINE bool mw__editor_needs_report(const mw_editor *editor, const mw_change *change,
                                              size_t insertions)
{
    return change || editor->undo > 0 || mw__upkeep_needs_report(&editor->upkeep, insertions);
}

/* Insert one vertex, within the step under way if there is one. Sets *vertex to the number of the
 * vertex there. `t`: the tile where the search begins; MW_NONE: choose one. Errors as
 * mw_edit_apply; the caller then rolls the step back. */
mw_status mw__editor_insert(mw_editor *editor, const mw_edit *edit, uint32_t t, uint32_t *vertex,
                            mw_error *error);

/* End the step under way, whose operations had this outcome: commit it, or roll it back. `change`:
 * NULL, or filled with `own` and the triangles changed. Also for an insertion that failed before it
 * began a step: then there is nothing to roll back. */
mw_status mw__editor_conclude(mw_editor *editor, mw_status status, const mw_change *own,
                              mw_change *change, mw_error *error);

/* Room for so many more entries of the log, if the editor keeps one. */
bool mw__log_room(mw_editor *editor, size_t more);

/* Room for the values of so many more vertices in each field. */
bool mw__field_room(mw_editor *editor, size_t more);

/* Fix the edges that join pairs of vertices. MW_ERROR_INPUT: no such edge, or no such vertex. */
mw_status mw__fix_edges(mw_dynamic_tiling *dynamic, const uint32_t *ends, size_t count,
                        mw_error *error);

/* The slot of a vertex that has a tile, by its number; MW_NONE if there is none. */
static MW_INLINE uint32_t mw__used_vertex_slot(const mw_dynamic_tiling *dynamic, uint32_t number)
{
    uint32_t slot = number < dynamic->vertex_count ? dynamic->vertex_slot[number] : MW_NONE;
    return slot != MW_NONE && dynamic->tiling->tile_at[slot] != MW_NONE ? slot : MW_NONE;
}

#endif
