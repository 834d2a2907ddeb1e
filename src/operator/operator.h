/* operator.h - the rows of an operator. Private.
 *
 * Rows lie in places. Their order follows what they read: the places of neighbours are near each
 * other, so that values come from the cache. Most operators have at most three entries a row; then
 * each place has three, and weights of 0 fill up what is missing. */
#ifndef MW_SRC_OPERATOR_OPERATOR_H
#define MW_SRC_OPERATOR_OPERATOR_H

#include "base/base.h"

#include <meshwalk/operator.h>

enum { MW_NARROW_ROW = 3 };

struct mw_operator {
    uint32_t rows, columns, empty_rows, widest;
    size_t entries;
    uint32_t *row;    /* the row in each place; NULL: places are rows */
    uint64_t *first;  /* the entries of place i begin at first[i]; NULL: at 3 * i, and are three */
    uint32_t *column; /* of each entry; of a weight of 0: any column */
    double *weight;
};

static MW_INLINE uint32_t mw__operator_row(const mw_operator *o, size_t place)
{
    return o->row ? o->row[place] : (uint32_t)place;
}

static MW_INLINE uint64_t mw__operator_first(const mw_operator *o, size_t place)
{
    return o->first ? o->first[place] : MW_NARROW_ROW * (uint64_t)place;
}

#endif
