#define _GNU_SOURCE /* strerror_r that returns the text */
#include "io/text/system_error.h"

#include <errno.h>
#include <string.h>

mw_status mw__fail_system(const char *name, int number, mw_error *error)
{
    if (number == ENOMEM) return mw__fail_memory(error);
    char text[128];
    return mw__fail(error, MW_ERROR_SYSTEM, "%.240s: %s", name,
                    strerror_r(number, text, sizeof text));
}
