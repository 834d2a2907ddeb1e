/* line_sums.h - an operator times values of which those of a column fill a cache line. Private; for
 * this room only. */
#ifndef MW_SRC_OPERATOR_LINE_SUMS_H
#define MW_SRC_OPERATOR_LINE_SUMS_H

#include "operator/apply_call.h"

/* The results of the ranks from .. to - 1, a line for each, written past the caches. Values and
 * results begin with a cache line, and count and stride are as many values as one has. */
void mw__line_sums(const mw_apply_call *c, size_t from, size_t to);

#endif
