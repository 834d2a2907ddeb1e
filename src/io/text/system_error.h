/* system_error.h - what the system says of a file. Private. */
#ifndef MW_SRC_IO_TEXT_SYSTEM_ERROR_H
#define MW_SRC_IO_TEXT_SYSTEM_ERROR_H

#include "base/base.h"

/* Fill in an error with MW_ERROR_SYSTEM, "NAME: " and the text of an errno; ENOMEM is
 * MW_ERROR_MEMORY. */
mw_status mw__fail_system(const char *name, int number, mw_error *error);

#endif
