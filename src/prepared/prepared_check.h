/* prepared_check.h - is what a prepared file holds a mesh with its locator? Private. */
#ifndef MW_SRC_PREPARED_PREPARED_CHECK_H
#define MW_SRC_PREPARED_PREPARED_CHECK_H

#include "prepared/prepared.h"

/* Check every part of a file whose header has been checked: checksums, then that no query reads
 * outside of the parts, and that each ends with the right triangle. Does not rely on the checksums.
 * MW_ERROR_INPUT, MW_ERROR_MEMORY. Stages of the present part. */
mw_status mw__prepared_check(const mw_prepared *p, mw_job *job, mw_error *error);

#endif
