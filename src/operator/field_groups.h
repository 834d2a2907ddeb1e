/* field_groups.h - an operator times fields one after another whose columns or rows are scattered.
 * Private; for this room only. */
#ifndef MW_SRC_OPERATOR_FIELD_GROUPS_H
#define MW_SRC_OPERATOR_FIELD_GROUPS_H

#include "base/job.h"
#include "operator/apply_call.h"

/* Is it faster to bring groups of fields side by side, which takes two more passes over their
 * memory? */
bool mw__field_groups_repay(const mw_apply_call *c);

/* All results, unless the job is to stop. Returns false, and changes nothing, if there is no
 * memory. */
bool mw__field_groups_apply(const mw_apply_call *c, mw_job *job);

#endif
