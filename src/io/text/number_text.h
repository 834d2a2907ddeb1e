/* number_text.h - numbers as text, read and written the same whatever the locale says. Private.
 *
 * Both directions are correctly rounded. The usual cases are computed in doubles or in 128-bit
 * integers; the C library computes the rest (very long, very large or very small numbers). */
#ifndef MW_SRC_IO_TEXT_NUMBER_TEXT_H
#define MW_SRC_IO_TEXT_NUMBER_TEXT_H

#include "base/base.h"

/* mw__decimal takes exponents from -MW_DECIMAL_RANGE to MW_DECIMAL_RANGE: 5^27 is the largest
 * power of 5 below 2^63. */
#define MW_DECIMAL_RANGE 27

/* The double nearest to digits * 10^exponent, ties to even. */
double mw__decimal(uint64_t digits, int exponent);

/* Read a number at `p`, which a NUL ends: [+-] digits [. digits] [e|E|d|D [+-] digits], "nan",
 * "inf", "infinity" (any case). Returns what follows the number, or NULL if there is no number; the
 * caller checks that a separator follows. Numbers beyond the range of doubles become infinite or
 * zero; numbers of more than 1000 characters are refused. */
const char *mw__read_double(const char *p, double *value);

/* Read [+-] digits at `p`; values that do not fit become INT64_MAX or INT64_MIN. NULL if there
 * is no integer. */
const char *mw__read_integer(const char *p, int64_t *value);

/* False for those, and for the two numbers that look like them; no file that is sound has any. */
static MW_INLINE bool mw__integer_fits(int64_t value)
{
    return value != INT64_MAX && value != INT64_MIN;
}

/* 10^0 ... 10^22, the powers of ten that are doubles, and 5^0 ... 5^27. */
extern const double mw__power_of_10[23];
extern const uint64_t mw__power_of_5[MW_DECIMAL_RANGE + 1];

#endif
