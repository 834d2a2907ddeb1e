#include "io/text/counted_rows.h"

#include "io/text/number_text.h"

#include <inttypes.h>
#include <string.h>

bool mw__row_ends(mw_number_row *row)
{
    row->p = mw__skip_blanks(row->p);
    return *row->p == 0;
}

mw_status mw__row_integer(mw_number_row *row, const char *what, int64_t *value, mw_error *error)
{
    if (mw__row_ends(row))
        return mw__source_fail(row->source, error, "the line ends before the %s", what);
    const char *end = mw__read_integer(row->p, value);
    if (!end || !mw__at_gap(end))
        return mw__source_fail(row->source, error, "expected the %s, found '%s'", what,
                               mw__excerpt(row->p).text);
    if (!mw__integer_fits(*value)) return mw__source_fail_large(row->source, row->p, end, error);
    row->p = end;
    return MW_OK;
}

/* Fortran writes exponents of three digits without their letter: 1.5-105. Returns where the number
 * ends; NULL if none does. */
static const char *row_read_exponent(const char *text, const char *sign, double *value)
{
    char copy[64];
    size_t length = (size_t)(sign - text);
    if (strspn(sign + 1, "0123456789") != 3 || length > sizeof copy - 6) return NULL;
    memcpy(copy, text, length);
    copy[length] = 'e';
    memcpy(copy + length + 1, sign, 4);
    copy[length + 5] = 0;
    return mw__read_double(copy, value) == copy + length + 5 ? sign + 4 : NULL;
}

mw_status mw__row_double(mw_number_row *row, const char *what, double *value, mw_error *error)
{
    if (mw__row_ends(row))
        return mw__source_fail(row->source, error, "the line ends before the %s", what);
    const char *end = mw__read_double(row->p, value);
    if (end && (*end == '-' || *end == '+')) end = row_read_exponent(row->p, end, value);
    if (!end || !mw__at_gap(end))
        return mw__source_fail(row->source, error, "%s: '%s' is not a number", what,
                               mw__excerpt(row->p).text);
    row->p = end;
    return MW_OK;
}

mw_status mw__rows_header(mw_source *source, char *line, int64_t *values, size_t count,
                          mw_error *error)
{
    if (!line) return mw__source_fail(source, error, "the file is empty");
    mw_number_row row = {source, line};
    mw_status status = mw__row_integer(&row, "number of rows", &values[0], error);
    for (size_t i = 1; !status && i < count && !mw__row_ends(&row); i++)
        status = mw__row_integer(&row, "numbers of the header", &values[i], error);
    for (size_t i = 0; !status && i < count; i++)
        if (values[i] < 0)
            status = mw__source_fail(source, error, "a number in the header is negative");
    return status;
}

mw_status mw__rows_end_early(const mw_source *source, const char *what, int64_t have,
                             int64_t announced, mw_error *error)
{
    return mw__source_fail(source, error, "the file ends after %" PRId64 " of %" PRId64 " %s", have,
                           announced, what);
}

mw_status mw__rows_check_end(mw_source *source, const char *what, int64_t announced,
                             mw_error *error)
{
    char *line;
    mw_status status = mw__source_content_line(source, &line, error);
    if (status || !line) return status;
    return mw__source_fail(source, error, "there are more than the %" PRId64 " %s announced",
                           announced, what);
}
