/* editor.h - what an editor holds. Private. */
#ifndef MW_SRC_EDITOR_H
#define MW_SRC_EDITOR_H

#include "edit/fabric.h"
#include "edit/upkeep.h"

struct mw_editor {
    mw_fabric fabric;   /* changes the locator's tiling                                  */
    mw_locator locator; /* of what is there now                                          */
    mw_mesh
        view; /* the tiling as a mesh, ghosts and all, for those who look up triangles by number; with the fields, whose
                           values are by number of vertex. It owns the fields only        */
    size_t field_room; /* values of each field there is room for                        */
    mw_upkeep upkeep;
    mw_cursor cursor; /* finds where to insert */
    bool astray;      /* the last walk there was long: see first_tile */
    bool keeps_log;
    uint32_t threads; /* as in the options */
    size_t undo, undoable;
    mw_edit *log;
    size_t log_count, log_room;
    mw_changed_triangle *changed;
    size_t changed_room;
    uint64_t edits;
};

/* The arrays of the fabric may have moved: have the view look at them. */
void mw__editor_look(mw_editor *editor);

/* Will somebody ask what an insertion changed? `change`: as the caller has it. */
static MW_INLINE bool mw__editor_asks(const mw_editor *editor, const mw_change *change)
{
    return change || editor->undo > 0 || mw__upkeep_asks(&editor->upkeep);
}

/* One insertion, within the step under way if there is one; *vertex is set to the number of the vertex there. `t`: a tile to begin at, MW_NONE: which
 * is to be chosen. Errors as mw_edit_apply; then the step is to be rolled back. */
mw_status mw__editor_insert(mw_editor *editor, const mw_edit *edit, uint32_t t, uint32_t *vertex, mw_error *error);

/* After the operations of the step under way, which had this outcome: all or nothing. `change` may be NULL, or is filled: with `own`, and the
 * triangles. Also for an insertion that failed before it was a step: then there is nothing to roll back. */
mw_status mw__editor_conclude(mw_editor *editor, mw_status status, const mw_change *own, mw_change *change,
                              mw_error *error);

/* Room for so many more entries of the log, if there is one. */
bool mw__log_room(mw_editor *editor, size_t more);

/* Room for the values of so many more vertices in each field. */
bool mw__field_room(mw_editor *editor, size_t more);

/* Fix the edges that join pairs of vertices. MW_ERROR_INPUT: there is no such edge, or no such vertex. */
mw_status mw__fix_edges(mw_fabric *fabric, const uint32_t *ends, size_t count, mw_error *error);

/* The place of a vertex that some triangle has, MW_NONE if there is none of that number. */
static MW_INLINE uint32_t mw__vertex_there(const mw_fabric *f, uint32_t number)
{
    uint32_t place = number < f->vertex_count ? f->vertex_slot[number] : MW_NONE;
    return place != MW_NONE && f->tiling->tile_at[place] != MW_NONE ? place : MW_NONE;
}

#endif
