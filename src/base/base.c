#include "base/base.h"

#include <meshwalk/version.h>
#include <stdarg.h>
#include <stdio.h>

const char *mw_status_text(mw_status status)
{
    switch (status) {
    case MW_OK: return "no error";
    case MW_ERROR_ARGUMENT: return "wrong argument";
    case MW_ERROR_INPUT: return "invalid input";
    case MW_ERROR_MEMORY: return "out of memory";
    case MW_ERROR_LIMIT: return "too large";
    case MW_ERROR_SYSTEM: return "system error";
    case MW_CANCELLED: return "cancelled";
    case MW_STATUS_COUNT: break;
    }
    return "unknown status";
}

const char *mw_version(void)
{
    return MW_VERSION_STRING;
}

static mw_status error_fill(mw_error *error, mw_status status, int64_t triangle, int64_t vertex,
                            const char *format, va_list arguments)
{
    if (error) {
        *error = (mw_error){.status = status, .triangle = triangle, .vertex = vertex, .line = -1};
        vsnprintf(error->message, sizeof error->message, format, arguments);
    }
    return status;
}

mw_status mw__fail(mw_error *error, mw_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_fill(error, status, -1, -1, format, arguments);
    va_end(arguments);
    return status;
}

mw_status mw__fail_at(mw_error *error, int64_t triangle, int64_t vertex, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_fill(error, MW_ERROR_INPUT, triangle, vertex, format, arguments);
    va_end(arguments);
    return MW_ERROR_INPUT;
}

mw_status mw__fail_memory(mw_error *error)
{
    return mw__fail(error, MW_ERROR_MEMORY, "out of memory");
}
