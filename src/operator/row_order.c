/* row_order.c - orders rows so that rows that read the same values follow each other. */
#include "operator/row_order.h"

#include "base/hilbert.h"

#include <stdlib.h>

enum { NEAR = 1024 }; /* rows whose keys differ by less than this read nearby memory */

/* Do at least seven of eight rows read near the previous row? */
static bool order_is_there(const uint32_t *key, uint32_t rows)
{
    uint32_t far = 0, last = MW_NONE;
    for (uint32_t i = 0; i < rows; i++) {
        if (key[i] == MW_NONE) continue;
        const uint32_t apart = key[i] > last ? key[i] - last : last - key[i];
        if (last != MW_NONE && apart >= NEAR) far++;
        last = key[i];
    }
    return far <= rows / 8;
}

bool mw__row_order(const uint32_t *key, uint32_t rows, uint32_t **row)
{
    *row = NULL;
    if (order_is_there(key, rows)) return true;
    mw_key *keys = mw__alloc(rows, sizeof *keys), *scratch = mw__alloc(rows, sizeof *scratch);
    uint32_t *order = mw__alloc(rows, sizeof *order);
    const bool made = keys && scratch && order;
    for (uint32_t i = 0; i < rows && made; i++) keys[i] = (mw_key){key[i], i};
    if (made) mw__sort_keys(keys, scratch, rows);
    for (uint32_t i = 0; i < rows && made; i++) order[i] = keys[i].item;
    free(keys);
    free(scratch);
    if (made)
        *row = order;
    else
        free(order);
    return made;
}
