/* operator.c - an operator is destroyed, described and copied. */
#include "operator/operator.h"

#include "operator/past_caches.h"

#include <stdlib.h>

void mw_operator_destroy(mw_operator *o)
{
    if (!o) return;
    free(o->row);
    free(o->first);
    free(o->column);
    free(o->weight);
    free(o->places);
    free(o->lines);
    free(o);
}

void mw_operator_describe(const mw_operator *o, mw_operator_info *info)
{
    const size_t room = mw__operator_first(o, o->rows);
    *info = (mw_operator_info){.rows = o->rows,
                               .columns = o->columns,
                               .entries = o->entries,
                               .empty_rows = o->empty_rows,
                               .widest = o->widest};
    info->bytes = sizeof *o + room * (sizeof *o->column + sizeof *o->weight) +
                  (o->row ? o->rows * sizeof *o->row : 0) +
                  (o->first ? (o->rows + (size_t)1) * sizeof *o->first : 0) +
                  (o->places ? (o->columns + room) * sizeof(uint32_t) : 0) +
                  (o->lines ? (o->columns + (size_t)o->rows) * MW_CACHE_LINE : 0);
}

/* Set first[i + 1] to the number of entries of row i. */
static void operator_count(const mw_operator *o, uint64_t *first)
{
    first[0] = 0;
    for (size_t rank = 0; rank < o->rows; rank++) {
        uint64_t count = 0;
        for (uint64_t e = mw__operator_first(o, rank); e < mw__operator_first(o, rank + 1); e++)
            count += o->weight[e] != 0;
        first[(size_t)mw__operator_row(o, rank) + 1] = count;
    }
}

void mw_operator_copy(const mw_operator *o, uint64_t *first, uint32_t *column, double *weight)
{
    operator_count(o, first);
    for (size_t i = 0; i < o->rows; i++) first[i + 1] += first[i];
    for (size_t rank = 0; rank < o->rows && (column || weight); rank++) {
        uint64_t to = first[mw__operator_row(o, rank)];
        for (uint64_t e = mw__operator_first(o, rank); e < mw__operator_first(o, rank + 1); e++) {
            if (o->weight[e] == 0) continue;
            if (column) column[to] = o->column[e];
            if (weight) weight[to] = o->weight[e];
            to++;
        }
    }
}
