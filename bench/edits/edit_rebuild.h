/* edit_rebuild.h - the task rebuild of 'bench edit'.
 *
 * A triangulation is edited, and after every k edits a thousand points are located: by walks in
 * what has been edited, or by a tree that is rebuilt from its arrays. What the edits take is
 * counted only for those who follow them: somebody has to make the edits for the others, too. */
#ifndef MW_BENCH_EDITS_EDIT_REBUILD_H
#define MW_BENCH_EDITS_EDIT_REBUILD_H

#include "bench/edits/edit_table.h"

/* Adds rows. Returns 0 or an exit code after a complaint. */
int edit_rebuild_measure(const edit_plan *p, edit_table *table);

#endif
