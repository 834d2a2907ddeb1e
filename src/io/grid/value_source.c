#include "io/grid/value_source.h"

#include "io/text/byte_order.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>

mw_status mw__value_word(mw_value_source *values, char **word, mw_error *error)
{
    *word = NULL;
    char *p = values->rest ? mw__skip_blanks(values->rest) : NULL;
    while (!p || !*p) {
        mw_status status = mw__source_line(values->source, &p, error);
        if (status) return status;
        values->rest = p;
        if (!p) return MW_OK;
        p = mw__skip_blanks(p);
    }
    char *end = p;
    while (!mw__at_gap(end)) end++;
    values->rest = *end ? end + 1 : end;
    *end = 0;
    *word = p;
    return MW_OK;
}

mw_status mw__value_line(mw_value_source *values, char **line, mw_error *error)
{
    values->rest = NULL;
    return mw__source_line(values->source, line, error);
}

mw_status mw__value_bytes(mw_value_source *values, size_t count, const unsigned char **bytes,
                          mw_error *error)
{
    values->rest = NULL;
    return mw__source_bytes(values->source, count, bytes, error);
}

char *mw__value_rest(mw_value_source *values)
{
    char *rest = values->rest;
    values->rest = NULL;
    return rest;
}

static mw_status value_needed_word(mw_value_source *values, const char *what, char **word,
                                   mw_error *error)
{
    mw_status status = mw__value_word(values, word, error);
    if (!status && !*word)
        status = mw__source_fail(values->source, error, "the file ends before the %s", what);
    return status;
}

static int64_t value_sign_extend(uint64_t bits, size_t size)
{
    unsigned shift = (unsigned)(64 - 8 * size);
    return (int64_t)(bits << shift) >> shift;
}

/* A number of 16 bits, as IEEE 754 has them. */
static double value_of_half(unsigned bits)
{
    const int exponent = bits >> 10 & 31;
    const double fraction = bits & 1023;
    const double size = exponent == 0    ? ldexp(fraction, -24)
                        : exponent == 31 ? (fraction == 0 ? INFINITY : NAN)
                                         : ldexp(1024 + fraction, exponent - 25);
    return bits >> 15 ? -size : size;
}

double mw__value_of_bytes(const unsigned char *bytes, mw_number_type type, bool big)
{
    uint64_t bits = mw__get_bytes(bytes, type.size, big);
    if (type.kind == MW_NUMBER_UNSIGNED) return (double)bits;
    if (type.kind == MW_NUMBER_SIGNED) return (double)value_sign_extend(bits, type.size);
    if (type.size == 2) return value_of_half((unsigned)bits);
    return type.size == 4 ? (double)mw__float_of_bits((uint32_t)bits) : mw__double_of_bits(bits);
}

mw_status mw__value_double(mw_value_source *values, mw_number_type type, const char *what,
                           double *value, mw_error *error)
{
    if (values->binary) {
        const unsigned char *bytes;
        mw_status status = mw__value_bytes(values, type.size, &bytes, error);
        if (!status) *value = mw__value_of_bytes(bytes, type, values->big);
        return status;
    }
    char *word;
    mw_status status = value_needed_word(values, what, &word, error);
    if (status) return status;
    const char *end = mw__read_double(word, value);
    if (end && !*end) return MW_OK;
    return mw__source_fail(values->source, error, "%s: '%s' is not a number", what,
                           mw__excerpt(word).text);
}

mw_status mw__value_word_integer(mw_value_source *values, const char *what, int64_t *value,
                                 mw_error *error)
{
    char *word;
    mw_status status = value_needed_word(values, what, &word, error);
    if (status) return status;
    const char *end = mw__read_integer(word, value);
    if (!end || *end)
        return mw__source_fail(values->source, error, "expected the %s, found '%s'", what,
                               mw__excerpt(word).text);
    if (!mw__integer_fits(*value)) return mw__source_fail_large(values->source, word, end, error);
    return MW_OK;
}

mw_status mw__value_word_count(mw_value_source *values, const char *what, int64_t *value,
                               mw_error *error)
{
    mw_status status = mw__value_word_integer(values, what, value, error);
    if (!status && *value < 0)
        status = mw__source_fail(values->source, error, "the %s is %" PRId64, what, *value);
    return status;
}

mw_status mw__value_integer(mw_value_source *values, mw_number_type type, const char *what,
                            int64_t *value, mw_error *error)
{
    if (!values->binary) return mw__value_word_integer(values, what, value, error);
    const unsigned char *bytes;
    mw_status status = mw__value_bytes(values, type.size, &bytes, error);
    if (status) return status;
    uint64_t bits = mw__get_bytes(bytes, type.size, values->big);
    if (type.kind == MW_NUMBER_FLOAT || (type.kind == MW_NUMBER_UNSIGNED && bits > INT64_MAX))
        return mw__source_fail(values->source, error, "the %s is not an integer below 2^63", what);
    *value = type.kind == MW_NUMBER_UNSIGNED ? (int64_t)bits : value_sign_extend(bits, type.size);
    return MW_OK;
}
