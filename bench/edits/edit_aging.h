/* edit_aging.h - how a triangulation ages under many edits: task session of 'bench edit'.
 *
 * What location takes while a mesh is edited for long, without a structure (from the triangle found
 * last, from the nearest of a sample, by what a locator has of itself), and with indices that
 * follow the edits; beside them a grid that does not. The thesis prefers walking for meshes that
 * change, for there is nothing to keep up. */
#ifndef MW_BENCH_EDITS_EDIT_AGING_H
#define MW_BENCH_EDITS_EDIT_AGING_H

#include "bench/edits/edit_table.h"

/* Adds rows. Returns 0 or an exit code after a complaint. */
int edit_aging_measure(const edit_plan *p, edit_table *table);

#endif
