/* prepared_fail.c - the message of a prepared file that is damaged. */
#include "prepared/prepared.h"

#include <stdarg.h>
#include <stdio.h>

mw_status mw__prepared_fail(const mw_prepared *p, mw_error *error, const char *format, ...)
{
    char text[200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return mw__fail(error, MW_ERROR_INPUT, "%.240s: a damaged prepared mesh: %s", p->name, text);
}
