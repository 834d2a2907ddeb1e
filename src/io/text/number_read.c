/* Text to numbers. A decimal w * 10^e is decided
 *   - by one multiplication or division where w < 2^53 and |e| <= 22, both then being exact
 *     doubles [Clinger 1990],
 *   - by one multiplication or division of integers where w < 2^64 and |e| <= 27,
 *   - otherwise by strtod_l in the "C" locale. */
#define _GNU_SOURCE /* strtod_l */
#include "base/wide.h"
#include "io/text/number_text.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const double mw__power_of_10[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

const uint64_t mw__power_of_5[MW_DECIMAL_RANGE + 1] = {
    UINT64_C(1),
    UINT64_C(5),
    UINT64_C(25),
    UINT64_C(125),
    UINT64_C(625),
    UINT64_C(3125),
    UINT64_C(15625),
    UINT64_C(78125),
    UINT64_C(390625),
    UINT64_C(1953125),
    UINT64_C(9765625),
    UINT64_C(48828125),
    UINT64_C(244140625),
    UINT64_C(1220703125),
    UINT64_C(6103515625),
    UINT64_C(30517578125),
    UINT64_C(152587890625),
    UINT64_C(762939453125),
    UINT64_C(3814697265625),
    UINT64_C(19073486328125),
    UINT64_C(95367431640625),
    UINT64_C(476837158203125),
    UINT64_C(2384185791015625),
    UINT64_C(11920928955078125),
    UINT64_C(59604644775390625),
    UINT64_C(298023223876953125),
    UINT64_C(1490116119384765625),
    UINT64_C(7450580596923828125),
};

/* 2^exponent for the exponents of normal doubles. */
static double power_of_2(int exponent)
{
    uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

double mw__decimal(uint64_t digits, int exponent)
{
    if (digits < UINT64_C(1) << 53) {
        if (exponent >= 0 && exponent <= 22) return (double)digits * mw__power_of_10[exponent];
        if (exponent < 0 && exponent >= -22) return (double)digits / mw__power_of_10[-exponent];
        if (digits == 0) return 0;
    }
    if (exponent >= 0) {
        mw_wide product = mw__wide_product(digits, mw__power_of_5[exponent]);
        return mw__wide_double(product) * power_of_2(exponent);
    }
    /* Divide w by 5^k, both shifted up to their 64th bit: the quotient has 63 or 64 bits, and
     * its last bit may stand for all that follow when it is rounded to 53. */
    uint64_t divisor = mw__power_of_5[-exponent];
    int up = __builtin_clzll(digits), down = __builtin_clzll(divisor);
    uint64_t rest,
        quotient = mw__wide_divide(mw__wide_shifted(digits << up, 63), divisor << down, &rest);
    return (double)(quotient | (rest != 0)) * power_of_2(down - up - 63 + exponent);
}

static MW_INLINE bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* The word at p, letters in any case, or NULL. */
static const char *word_match(const char *p, const char *word)
{
    for (; *word; p++, word++)
        if ((*p | 0x20) != *word) return NULL;
    return p;
}

static const char *number_read_word(const char *p, bool minus, double *value)
{
    const char *end;
    if ((end = word_match(p, "infinity")) || (end = word_match(p, "inf"))) {
        *value = minus ? -INFINITY : INFINITY;
        return end;
    }
    if ((end = word_match(p, "nan"))) *value = NAN;
    return end;
}

/* The text start..end has the form of a number. */
static const char *number_read_slowly(const char *start, const char *end, double *value)
{
    char copy[1001];
    size_t length = (size_t)(end - start);
    if (length >= sizeof copy) return NULL;
    memcpy(copy, start, length);
    copy[length] = 0;
    for (char *c = copy; *c; c++)
        if ((*c | 0x20) == 'd') *c = 'e';
    /* the "C" locale is a constant in the common C libraries: nothing is allocated here */
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!c_locale) return NULL;
    *value = strtod_l(copy, NULL, c_locale);
    freelocale(c_locale);
    return end;
}

/* Digits without leading zeros, of a number whose digits and point lie in first..end. */
static ptrdiff_t significant_digits(const char *first, const char *end)
{
    ptrdiff_t count = 0;
    for (; first < end; first++) count += is_digit(*first) && (count > 0 || *first != '0');
    return count;
}

/* The exponent after 'e' at p, kept small enough to be added to. NULL if no digits follow. */
static const char *number_read_exponent(const char *p, int *exponent)
{
    bool minus = *p == '-';
    if (*p == '-' || *p == '+') p++;
    if (!is_digit(*p)) return NULL;
    int sum = 0;
    for (; is_digit(*p); p++)
        if (sum < 100000) sum = sum * 10 + (*p - '0');
    *exponent = minus ? -sum : sum;
    return p;
}

const char *mw__read_double(const char *p, double *value)
{
    const char *start = p;
    bool minus = *p == '-';
    if (*p == '-' || *p == '+') p++;
    const char *first = p;
    uint64_t digits = 0; /* modulo 2^64: of use where there are at most 19 */
    for (; is_digit(*p); p++) digits = digits * 10 + (uint64_t)(*p - '0');
    ptrdiff_t count = p - first, decimals = 0;
    if (*p == '.') {
        const char *point = p++;
        for (; is_digit(*p); p++) digits = digits * 10 + (uint64_t)(*p - '0');
        decimals = p - point - 1;
        count += decimals;
    }
    if (count == 0) return number_read_word(first, minus, value);
    const char *mantissa_end = p;
    int exponent = 0;
    if ((*p | 0x20) == 'e' || (*p | 0x20) == 'd') {
        const char *end = number_read_exponent(p + 1, &exponent);
        if (end) p = end;
    }
    if (count > 19) count = significant_digits(first, mantissa_end);
    if (count > 19 || decimals > 1000) return number_read_slowly(start, p, value);
    exponent -= (int)decimals;
    if (exponent < -MW_DECIMAL_RANGE || exponent > MW_DECIMAL_RANGE)
        return number_read_slowly(start, p, value);
    double magnitude = mw__decimal(digits, exponent);
    *value = minus ? -magnitude : magnitude;
    return p;
}

const char *mw__read_integer(const char *p, int64_t *value)
{
    bool minus = *p == '-';
    if (*p == '-' || *p == '+') p++;
    if (!is_digit(*p)) return NULL;
    int64_t sum = 0; /* negative, since INT64_MIN has no positive counterpart */
    bool full = false;
    for (; is_digit(*p); p++)
        full |=
            __builtin_mul_overflow(sum, 10, &sum) || __builtin_sub_overflow(sum, *p - '0', &sum);
    if (full || (!minus && sum == INT64_MIN))
        *value = minus ? INT64_MIN : INT64_MAX;
    else
        *value = minus ? sum : -sum;
    return p;
}
