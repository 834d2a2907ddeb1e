/* window_sums.h - an operator times fields one after another, eight of them at a time, through a
 * window: a copy of the columns that some ranks need, with the values of a column side by side.
 * Private; for this room only. */
#ifndef MW_SRC_OPERATOR_WINDOW_SUMS_H
#define MW_SRC_OPERATOR_WINDOW_SUMS_H

#include "operator/apply_call.h"

enum { MW_WINDOW_RANKS = 1 << 14 }; /* at most, of one call */

typedef struct mw_window mw_window;

/* A window for each member of a team, 2.6 MB and a byte for 256 columns. NULL: there is no memory,
 * or windows are not for this call: a processor without AVX2, too few fields or rows, rows of more
 * than three entries, ranks that are not rows, missing values to be left out. Release with
 * free(). */
mw_window *mw__windows_create(const mw_apply_call *c, uint32_t team);

/* The results of the ranks from .. to - 1, of all fields. Where a window does not repay, it leaves
 * ranks to mw__field_sums. */
void mw__window_sums(const mw_apply_call *c, uint32_t member, size_t from, size_t to);

#endif
