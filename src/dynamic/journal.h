/* journal.h - an edit as a whole: begin, commit, roll back, undo, report. Private.
 *
 * What must an editor's journal keep? Enough to restore everything that an edit changes, and no
 * more:
 *
 *   tiles   Before an edit first changes or deletes the tile in a slot, it copies that slot
 *           (corners, links, user's number, fixed edges) into an mw_journal_entry, once for each
 *           slot and edit. Slots at the end of the array that were empty before the edit need no
 *           entry: the former tile count tells which they are.
 *   links   Only those of recorded tiles. A neighbour that is not recorded lies beside recorded
 *           tiles only, and their links tell its links. Exception: a tile that gets or loses a
 *           neighbour beyond a hull edge is recorded.
 *   counts  Of tiles, ghosts, numbers, vertices, points, free slots and constrained edges before
 *           the edit (mw_journal_edit). New vertices and numbers are the last ones given out, so
 *           the counts suffice to take them back.
 *   point   Where the vertex was that the edit moved or removed, and its number.
 *   value   The former one, if the edit changed a value.
 *   Delaunay  Whether the tiling was known to be Delaunay.
 *
 * To undo an edit (mw__journal_revert), the entries are exchanged with the tiles, and the counts
 * are set back. A failed edit is rolled back in the same way. To report what an edit changed, the
 * entries are compared with the tiles as they are now.
 *
 * The edits form a stack: each mw_journal_edit owns the entries from its first_entry up to those of
 * the next one. mw__journal_begin pushes an edit; mw__journal_commit ends it; mw__journal_forget
 * discards the oldest edits that can no longer be undone.
 *
 * The journal can be skipped when it has no reader: no undo, no report and no index needs it, and
 * the edit cannot fail after it has begun to change tiles (insert.c, insert_points.c). */
#ifndef MW_SRC_DYNAMIC_JOURNAL_H
#define MW_SRC_DYNAMIC_JOURNAL_H

#include "dynamic/dynamic_tiling.h"

/* Begin an edit. `recorded`: tiles are put into the journal. False when out of memory. */
bool mw__journal_begin(mw_dynamic_tiling *dynamic, const mw_edit *edit, bool recorded);

/* End the edit. Its entries can be read until mw__journal_forget. */
void mw__journal_commit(mw_dynamic_tiling *dynamic);
/* End an edit that failed: restore everything, and drop its step. */
void mw__journal_rollback(mw_dynamic_tiling *dynamic);
/* Undo the last step, which was recorded. Its entries then hold the tiles as they were after the
 * edit, until mw__journal_drop. False when out of memory; then nothing has changed. */
bool mw__journal_revert(mw_dynamic_tiling *dynamic);
/* Discard the last step and its entries. */
void mw__journal_drop(mw_dynamic_tiling *dynamic);
/* Discard all but the last `steps` steps. */
void mw__journal_forget(mw_dynamic_tiling *dynamic, size_t steps);

/* The entries of the last step; returns how many. */
static MW_INLINE size_t mw__journal_entries(const mw_dynamic_tiling *dynamic,
                                            const mw_journal_entry **first)
{
    size_t begin = dynamic->step[dynamic->step_count - 1].first_entry;
    *first = dynamic->journal + begin;
    return dynamic->journal_count - begin;
}

/* An upper bound of the number of slots that the last step changed. */
static MW_INLINE size_t mw__journal_extent(const mw_dynamic_tiling *dynamic)
{
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    uint32_t tiles = dynamic->tiling->tri_count;
    return dynamic->journal_count - step->first_entry +
           (tiles > step->tiles ? tiles - step->tiles : 0);
}

/* List the triangles that the last step changed, which was recorded. `list` has room for three
 * times the extent. */
void mw__journal_report(const mw_dynamic_tiling *dynamic, mw_changed_triangle *list,
                        mw_change *change);

#endif
