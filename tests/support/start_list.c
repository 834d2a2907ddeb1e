/* start_list.c - an index for each start that has one. */
#include "support/start_list.h"

#include <stdlib.h>

void starts_open(const mw_locator *locator, mw_index *index[MW_START_COUNT])
{
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        mw_status status =
            mw_index_create(locator, (mw_start_kind)start, NULL, &index[start], NULL);
        if (status != (mw_start_has_index((mw_start_kind)start) ? MW_OK : MW_ERROR_ARGUMENT))
            abort();
    }
}

void starts_close(mw_index *index[MW_START_COUNT])
{
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) mw_index_destroy(index[start]);
}
