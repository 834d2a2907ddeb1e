/* Numbers to text: the shortest of 15, 16 and 17 significant digits that reads back as the same
 * double, laid out as printf's %g does. Doubles from 1e-10 to 1e41 are decided exactly in
 * 128-bit integers, the rest by snprintf. */
#include "base/wide.h"
#include "io/text/number_text.h"

#include <math.h>
#include <meshwalk/io.h>
#include <stdio.h>
#include <string.h>

/* digits has `count` digits; the first stands for 10^exponent. `precision` is the P of the %.Pg
 * that this is. */
typedef struct decimal_digits {
    uint64_t digits;
    int count, exponent, precision;
} decimal_digits;

static const uint64_t ten_to[] = {
    UINT64_C(1),
    UINT64_C(10),
    UINT64_C(100),
    UINT64_C(1000),
    UINT64_C(10000),
    UINT64_C(100000),
    UINT64_C(1000000),
    UINT64_C(10000000),
    UINT64_C(100000000),
    UINT64_C(1000000000),
    UINT64_C(10000000000),
    UINT64_C(100000000000),
    UINT64_C(1000000000000),
    UINT64_C(10000000000000),
    UINT64_C(100000000000000),
    UINT64_C(1000000000000000),
    UINT64_C(10000000000000000),
    UINT64_C(100000000000000000),
};

/* Decimal exponents for which every power of 5 below is at most the 27th, even when they are one
 * off. */
enum { LOWEST = -10, HIGHEST = 40 };

/* The decimal with `precision` digits, the last of which may be zeros; rounding may have made it
 * one digit longer. */
static decimal_digits decimal_tidy(uint64_t digits, int exponent, int precision)
{
    decimal_digits d = {digits, precision, exponent, precision};
    if (digits == ten_to[precision]) d = (decimal_digits){1, 1, exponent + 1, precision};
    while (d.count > 8 && d.digits % 10000 == 0) d.digits /= 10000, d.count -= 4;
    while (d.count > 1 && d.digits % 10 == 0) d.digits /= 10, d.count--;
    return d;
}

/* Most numbers in files have at most 15 digits: find them with one multiplication or division and
 * prove them with another. If n < 10^15 and n / 10^k rounds to v, then n has the digits of the one
 * 15-digit decimal of v. If the guess n is wrong, the proof fails and the slower way is taken. */
static bool decimal_of_15_digits(double v, int exponent, decimal_digits *d)
{
    int k = 14 - exponent;
    if (k < -22 || k > 22) return false;
    double scaled = k >= 0 ? v * mw__power_of_10[k] : v / mw__power_of_10[-k];
    if (!(scaled < 1e15 - 1)) return false;
    uint64_t n = (uint64_t)(scaled + 0.5);
    double back = k >= 0 ? (double)n / mw__power_of_10[k] : (double)n * mw__power_of_10[-k];
    if (back != v || n < ten_to[14]) return false;
    *d = decimal_tidy(n, exponent, 15);
    return true;
}

/* floor(v * 10^k) for v = m * 2^e, whether at least a half was cut off, and whether more was cut
 * off than nothing or a half. v * 10^k lies between 10^15 and 10^18. */
typedef struct scaled_number {
    uint64_t whole;
    bool half, rest;
} scaled_number;

static scaled_number decimal_scale(uint64_t m, int e, int k)
{
    if (k >= 0) {
        mw_wide product = mw__wide_product(m, mw__power_of_5[k]);
        int shift = -(e + k);
        if (shift <= 0) return (scaled_number){product.low << -shift, false, false};
        return (scaled_number){mw__wide_right(product, shift),
                               mw__wide_right(product, shift - 1) & 1,
                               mw__wide_any(product, shift - 1)};
    }
    /* v >= 10^17, and then e + k > 0 */
    uint64_t divisor = mw__power_of_5[-k], left;
    uint64_t whole = mw__wide_divide(mw__wide_shifted(m, e + k), divisor, &left);
    return (scaled_number){whole, left > divisor / 2, left != 0}; /* 5^k is odd: no ties */
}

/* Round s to the nearest multiple of `unit` (10 or 100), ties to even, and divide by it. */
static uint64_t scaled_round_to(scaled_number s, uint64_t unit)
{
    uint64_t whole = s.whole / unit, left = s.whole % unit;
    bool more = s.half || s.rest;
    return whole + (left > unit / 2 || (left == unit / 2 && (more || (whole & 1))));
}

static decimal_digits decimal_exact(double v, int exponent)
{
    int e;
    uint64_t m = (uint64_t)(frexp(v, &e) * 0x1p53);
    e -= 53;
    scaled_number s = decimal_scale(m, e, 16 - exponent);
    if (s.whole < ten_to[16])
        s = decimal_scale(m, e, 16 - --exponent);
    else if (s.whole >= ten_to[17])
        s = decimal_scale(m, e, 16 - ++exponent);
    for (int precision = 15; precision < 17; precision++) {
        uint64_t digits = scaled_round_to(s, ten_to[17 - precision]);
        /* half a unit in the last place of v is at most 2^-53 v, or 12 units of the 17th digit */
        int64_t off = (int64_t)(digits * ten_to[17 - precision] - s.whole);
        if (off < -13 || off > 13) continue;
        if (mw__decimal(digits, exponent - precision + 1) == v)
            return decimal_tidy(digits, exponent, precision);
    }
    return decimal_tidy(s.whole + (s.half && (s.rest || (s.whole & 1))), exponent, 17);
}

/* For the far ends of the range. The decimal point of the locale is passed over: only digits are
 * picked up. */
static decimal_digits decimal_of_library(double v)
{
    decimal_digits d = {0};
    for (int precision = 15; precision <= 17; precision++) {
        char text[64];
        snprintf(text, sizeof text, "%.*e", precision - 1, v);
        uint64_t digits = 0;
        const char *p = text;
        for (; *p != 'e'; p++)
            if (*p >= '0' && *p <= '9') digits = digits * 10 + (uint64_t)(*p - '0');
        int64_t exponent = 0;
        mw__read_integer(p + 1, &exponent);
        d = decimal_tidy(digits, (int)exponent, precision);
        double back;
        char plain[64];
        snprintf(plain, sizeof plain, "%llue%d", (unsigned long long)digits,
                 (int)exponent - precision + 1);
        if (mw__read_double(plain, &back) && back == v) break;
    }
    return d;
}

/* v > 0 and finite. */
static decimal_digits decimal_shortest(double v)
{
    int binary;
    frexp(v, &binary);
    int exponent = ((binary - 1) * 78913) >> 18; /* times log10 of 2: right or one too low */
    if (exponent < LOWEST || exponent > HIGHEST) return decimal_of_library(v);
    if (exponent < 22) {
        double next =
            exponent >= -1 ? mw__power_of_10[exponent + 1] : 1 / mw__power_of_10[-exponent - 1];
        exponent += v >= next;
        decimal_digits d;
        if (decimal_of_15_digits(v, exponent, &d)) return d;
    }
    return decimal_exact(v, exponent); /* settles the exponent where a power of ten was rounded */
}

/* The last `count` digits of n, leading zeros included, ending at `end`. */
static void digits_put(char *end, uint64_t n, int count)
{
    for (; count >= 2; count -= 2, n /= 100) {
        unsigned pair = (unsigned)(n % 100);
        *--end = (char)('0' + pair % 10);
        *--end = (char)('0' + pair / 10);
    }
    if (count) *--end = (char)('0' + n % 10);
}

static char *decimal_put_fixed(char *p, decimal_digits d)
{
    if (d.exponent < 0) { /* 0.000ddd */
        memcpy(p, "0.000", 5);
        p += 1 - d.exponent;
        digits_put(p + d.count, d.digits, d.count);
        return p + d.count;
    }
    int whole = d.exponent + 1;
    if (d.count <= whole) { /* ddd000 */
        memset(p + d.count, '0', (size_t)(whole - d.count));
        digits_put(p + d.count, d.digits, d.count);
        return p + whole;
    }
    int decimals = d.count - whole;
    digits_put(p + whole, d.digits / ten_to[decimals], whole);
    p[whole] = '.';
    digits_put(p + d.count + 1, d.digits % ten_to[decimals], decimals);
    return p + d.count + 1;
}

static char *decimal_put_scientific(char *p, decimal_digits d)
{
    digits_put(p + d.count + 1, d.digits, d.count);
    p[0] = p[1];
    p[1] = '.';
    p += d.count > 1 ? d.count + 1 : 1;
    int exponent = d.exponent < 0 ? -d.exponent : d.exponent;
    int length = exponent >= 100 ? 3 : 2;
    *p++ = 'e';
    *p++ = d.exponent < 0 ? '-' : '+';
    digits_put(p + length, (uint64_t)exponent, length);
    return p + length;
}

static int digit_count(uint64_t n)
{
    int count = 1;
    while (count < 17 && n >= ten_to[count]) count++;
    return count;
}

size_t mw_format_double(double value, char text[32])
{
    char *p = text;
    if (isnan(value)) {
        memcpy(text, "nan", 4);
        return 3;
    }
    if (signbit(value)) *p++ = '-';
    double v = fabs(value);
    if (isinf(v)) {
        memcpy(p, "inf", 3);
        p += 3;
    } else if (v < 1e15 && v == (double)(uint64_t)v) {
        int count = digit_count((uint64_t)v);
        digits_put(p + count, (uint64_t)v, count);
        p += count;
    } else {
        decimal_digits d = decimal_shortest(v);
        p = d.exponent < -4 || d.exponent >= d.precision ? decimal_put_scientific(p, d)
                                                         : decimal_put_fixed(p, d);
    }
    *p = 0;
    return (size_t)(p - text);
}
