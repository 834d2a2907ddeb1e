/* column_places.h - columns in the order in which the ranks use them. Private; for this room only.
 *
 * Values of columns that lie in this order are read nearly from the first to the last, wherever
 * the columns themselves lie. */
#ifndef MW_SRC_OPERATOR_COLUMN_PLACES_H
#define MW_SRC_OPERATOR_COLUMN_PLACES_H

#include "operator/operator.h"

/* The place of each column, then the place of the column of each entry. The first call makes them,
 * and they stay the operator's. NULL: there is no memory. Thread-safe. */
const uint32_t *mw__column_places(const mw_operator *o);

#endif
