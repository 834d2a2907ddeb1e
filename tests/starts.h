/* starts.h - for tests that go through all starts: the indices of those that need one. */
#ifndef MW_TEST_STARTS_H
#define MW_TEST_STARTS_H

#include <meshwalk/locate.h>
#include <stdlib.h>

/* One index for each start; NULL where the start has none. */
static inline void starts_open(const mw_locator *locator, mw_index *index[MW_START_COUNT])
{
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        mw_status status = mw_index_create(locator, (mw_start_kind)start, NULL, &index[start], NULL);
        if (status != (mw_start_has_index((mw_start_kind)start) ? MW_OK : MW_ERROR_ARGUMENT)) abort();
    }
}

static inline void starts_close(mw_index *index[MW_START_COUNT])
{
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) mw_index_destroy(index[start]);
}

#endif
