/* journal.h - an edit as a whole: what it changed, and how it is taken back. Private. */
#ifndef MW_SRC_JOURNAL_H
#define MW_SRC_JOURNAL_H

#include "edit/fabric.h"

/* False when out of memory. `recorded`: in the journal, unless nobody will ask and nothing can fail
 * (insert_points.c). */
bool mw__fabric_begin(mw_fabric *f, const mw_edit *edit, bool recorded);

/* After the operations. Between this and mw__fabric_forget the journal of the last step can be read. */
void mw__fabric_commit(mw_fabric *f);
void mw__fabric_rollback(mw_fabric *f);
/* Take back the last step, which was recorded. Its journal then holds the tiles as they were after the edit, and is the last thing in the
 * journal until the step is dropped (mw__fabric_drop). False when out of memory; then nothing has changed. */
bool mw__fabric_revert(mw_fabric *f);
void mw__fabric_drop(mw_fabric *f);
/* Keep the journal of the last `steps` edits only. */
void mw__fabric_forget(mw_fabric *f, size_t steps);

/* The part of the journal that belongs to the last step. */
static MW_INLINE size_t mw__fabric_journal(const mw_fabric *f, const mw_before **first)
{
    size_t begin = f->step[f->step_count - 1].journal;
    *first = f->before + begin;
    return f->before_count - begin;
}

/* How many places the last step changed at most. */
static MW_INLINE size_t mw__fabric_extent(const mw_fabric *f)
{
    const mw_step *step = &f->step[f->step_count - 1];
    uint32_t tiles = f->tiling->tri_count;
    return f->before_count - step->journal + (tiles > step->tiles ? tiles - step->tiles : 0);
}

/* The triangles that the last step, which was recorded, changed: `list` has room for three times its extent. */
void mw__fabric_report(const mw_fabric *f, mw_changed_triangle *list, mw_change *change);

#endif
