/* start_list.h - for tests that go through all starts: the indices of those that need one. */
#ifndef MW_TESTS_SUPPORT_START_LIST_H
#define MW_TESTS_SUPPORT_START_LIST_H

#include <meshwalk/locate.h>

/* Makes an index for each start that has one, NULL for the others; ends the program where that
 * fails. */
void starts_open(const mw_locator *locator, mw_index *index[MW_START_COUNT]);
void starts_close(mw_index *index[MW_START_COUNT]);

#endif
