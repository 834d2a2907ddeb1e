/* row_order.h - in which order an operator holds its rows. Private. */
#ifndef MW_SRC_OPERATOR_ROW_ORDER_H
#define MW_SRC_OPERATOR_ROW_ORDER_H

#include "base/base.h"

/* Sets *row to the row of each rank: rows by ascending keys; rows of equal keys keep their order.
 * To NULL if the keys are about in order already, and ranks are rows. A key tells where a row
 * reads; MW_NONE: nowhere. Returns false if there is no memory. The caller frees *row. */
bool mw__row_order(const uint32_t *key, uint32_t rows, uint32_t **row);

#endif
