/* bench_edit.h - the measurement 'meshwalk bench edit [SET]'. */
#ifndef MW_BENCH_EDITS_BENCH_EDIT_H
#define MW_BENCH_EDITS_BENCH_EDIT_H

#include "bench/core/settings.h"

/* `set`: names of sets of points, with commas between them, or NULL. Returns the exit code. */
int bench_edit(const bench_settings *s, const char *set);

#endif
