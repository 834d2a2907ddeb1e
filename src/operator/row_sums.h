/* row_sums.h - an operator applied to values whose columns are stored one after another: the values
 * of a column lie side by side. Private; for this room only. */
#ifndef MW_SRC_OPERATOR_ROW_SUMS_H
#define MW_SRC_OPERATOR_ROW_SUMS_H

#include "operator/apply_call.h"

/* The results of the ranks from .. to - 1; step and field of the call are 1. */
void mw__row_sums(const mw_apply_call *c, size_t from, size_t to);

#endif
