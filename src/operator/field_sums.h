/* field_sums.h - an operator applied to fields that are stored one after another. Private; for this
 * room only. */
#ifndef MW_SRC_OPERATOR_FIELD_SUMS_H
#define MW_SRC_OPERATOR_FIELD_SUMS_H

#include "operator/apply_call.h"

/* The results of the ranks from .. to - 1, of the fields field .. field_end - 1. */
void mw__field_sums(const mw_apply_call *c, size_t from, size_t to, size_t field, size_t field_end);

#endif
