/* prepared_guide_check.h - the parts of a prepared file that a query can do without. Private. */
#ifndef MW_SRC_PREPARED_PREPARED_GUIDE_CHECK_H
#define MW_SRC_PREPARED_PREPARED_GUIDE_CHECK_H

#include "prepared/prepared.h"

/* Check the guide, the index of the border, and the values: no search in them reads outside of the
 * parts, and each ends. MW_ERROR_INPUT, MW_ERROR_MEMORY. O(their size). */
mw_status mw__prepared_check_guide(const mw_prepared *p, mw_error *error);

#endif
