/* weight_rows.h - an operator row by row, as files of weights have it. Private. */
#ifndef MW_SRC_IO_WEIGHTS_WEIGHT_ROWS_H
#define MW_SRC_IO_WEIGHTS_WEIGHT_ROWS_H

#include "base/job.h"

#include <meshwalk/weights.h>

typedef struct mw_weight_rows {
    mw_operator_info info;
    uint64_t *first; /* rows + 1 */
    uint32_t *column;
    double *weight;
} mw_weight_rows;

/* Writers; `rows` are the same as `weights`. */
mw_status mw__esmf_write(const char *path, const mw_weight_rows *rows,
                         const mw_weight_positions *positions, mw_job *job, mw_error *error);
mw_status mw__npz_write(const char *path, const mw_weight_rows *rows, mw_job *job, mw_error *error);

#endif
