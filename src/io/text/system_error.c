#undef _GNU_SOURCE /* with it, the GNU library has another strerror_r than POSIX */
#include "io/text/system_error.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

mw_status mw__fail_system(const char *name, int number, mw_error *error)
{
    if (number == ENOMEM) return mw__fail_memory(error);
    char text[128];
    if (strerror_r(number, text, sizeof text) != 0)
        snprintf(text, sizeof text, "error %d of the system", number);
    return mw__fail(error, MW_ERROR_SYSTEM, "%.240s: %s", name, text);
}
