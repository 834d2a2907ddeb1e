/* sparse_rows.h - a sparse matrix by rows, from which operators of any width are made. Private. */
#ifndef MW_SRC_OPERATOR_SPARSE_ROWS_H
#define MW_SRC_OPERATOR_SPARSE_ROWS_H

#include "base/job.h"
#include "operator/operator.h"

typedef struct mw_sparse_rows {
    uint32_t rows, columns;
    uint64_t *first; /* rows + 1 */
    uint32_t *column;
    double *weight;
} mw_sparse_rows;

/* Room for so many entries; `first` is all 0. Returns false if there is no memory. */
bool mw__sparse_rows_init(mw_sparse_rows *s, uint32_t rows, uint32_t columns, uint64_t entries);
void mw__sparse_rows_release(mw_sparse_rows *s);

/* Call this when first[i] is the number of entries of row i: it makes first[i] the index of the
 * row's first entry. While entries are put in, first[i] moves on to the next free index;
 * mw__sparse_rows_full then moves it back. */
void mw__sparse_rows_open(mw_sparse_rows *s);
static inline void mw__sparse_rows_put(mw_sparse_rows *s, uint32_t row, uint32_t column,
                                       double weight)
{
    const uint64_t at = s->first[row]++;
    s->column[at] = column;
    s->weight[at] = weight;
}
void mw__sparse_rows_full(mw_sparse_rows *s);

/* The operator of these rows, in a stage of the job; NULL if there is no memory or the job is to
 * stop. */
mw_operator *mw__sparse_rows_pack(const mw_sparse_rows *s, mw_job *job);

#endif
