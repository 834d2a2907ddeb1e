/* row_order.h - in which order an operator holds its rows. Private. */
#ifndef MW_SRC_OPERATOR_ROW_ORDER_H
#define MW_SRC_OPERATOR_ROW_ORDER_H

#include "base/base.h"

/* Sets *row to the row of each rank: rows by ascending keys; rows with equal keys keep their order.
 * If the keys are nearly in order already, sets *row to NULL: each row is its own rank. A key says
 * where a row reads values; MW_NONE: nowhere. Returns false when out of memory. The caller frees
 * *row. */
bool mw__row_order(const uint32_t *key, uint32_t rows, uint32_t **row);

#endif
