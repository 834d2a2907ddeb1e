/* operator.h - the rows of an operator. Private.
 *
 * The rank of a row is its position in memory. Rows that read nearby values have nearby ranks, so
 * that values are in the cache. Most operators have at most three entries a row; then each rank has
 * three, and weights of 0 fill up what is missing. */
#ifndef MW_SRC_OPERATOR_OPERATOR_H
#define MW_SRC_OPERATOR_OPERATOR_H

#include "base/base.h"

#include <meshwalk/operator.h>
#include <stdatomic.h>

enum { MW_NARROW_ROW = 3 };

struct mw_operator {
    uint32_t rows, columns, empty_rows, widest;
    size_t entries;
    uint32_t *row;    /* the row of each rank; NULL: ranks are rows */
    uint64_t *first;  /* the entries of rank i begin at first[i]; NULL: at 3 * i, and are three */
    uint32_t *column; /* of each entry; of a weight of 0: any column */
    double *weight;
    /* Made by calls for the calls after them; NULL: none. See column_places.h and field_groups.c.
     */
    _Atomic(uint32_t *) places;
    _Atomic(char *) lines;
};

static MW_INLINE uint32_t mw__operator_row(const mw_operator *o, size_t rank)
{
    return o->row ? o->row[rank] : (uint32_t)rank;
}

static MW_INLINE uint64_t mw__operator_first(const mw_operator *o, size_t rank)
{
    return o->first ? o->first[rank] : MW_NARROW_ROW * (uint64_t)rank;
}

#endif
