/* edit_comparison.h - scripts of edits, carried out by all engines that follow edits, in rounds. */
#ifndef MW_BENCH_EDITS_EDIT_COMPARISON_H
#define MW_BENCH_EDITS_EDIT_COMPARISON_H

#include "bench/edits/edit_table.h"

/* Adds a row for each engine. Returns 0 or an exit code after a complaint. */
int edit_comparison_measure(const edit_plan *p, edit_task task, edit_table *table);

#endif
