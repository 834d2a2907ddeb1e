#include "predicates/big.h"

#include "base/wide.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* |v| = mantissa * 2^exponent. v is finite. */
static uint64_t mantissa_of(double v, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    uint64_t fraction = bits & (UINT64_MAX >> 12);
    int field = (int)(bits >> 52 & 2047);
    *exponent = field == 0 ? -1074 : field - 1075;
    return field == 0 ? fraction : fraction | UINT64_C(1) << 52;
}

int mw__big_base(const double *v, int n)
{
    bool found = false;
    int base = 0;
    for (int i = 0; i < n; i++) {
        int exponent;
        uint64_t m = mantissa_of(v[i], &exponent);
        if (m == 0) continue;
        exponent += __builtin_ctzll(m);
        if (!found || exponent < base) base = exponent;
        found = true;
    }
    return base;
}

static void big_trim(mw_big *r)
{
    while (r->n > 0 && r->limb[r->n - 1] == 0) r->n--;
    if (r->n == 0) r->sign = 0;
}

static void big_set(mw_big *r, double v, int base)
{
    int exponent;
    uint64_t m = mantissa_of(v, &exponent);
    int shift = exponent - base;
    if (m == 0) {
        r->sign = r->n = 0;
        return;
    }
    if (shift < 0) { /* those bits of the mantissa are 0 */
        m >>= -shift;
        shift = 0;
    }
    int first = shift / 64;
    mw_wide shifted = mw__wide_shifted(m, shift % 64);
    for (int i = 0; i < first; i++) r->limb[i] = 0;
    r->limb[first] = shifted.low;
    r->limb[first + 1] = shifted.high;
    r->n = first + 2;
    r->sign = signbit(v) ? -1 : 1;
    big_trim(r);
}

void mw__big_difference(mw_big *r, double a, double b, int base)
{
    mw_big subtrahend;
    big_set(r, a, base);
    big_set(&subtrahend, b, base);
    mw__big_subtract(r, r, &subtrahend);
}

void mw__big_unit(mw_big *r)
{
    r->sign = r->n = 1;
    r->limb[0] = 1;
}

static int compare_magnitude(const mw_big *a, const mw_big *b)
{
    if (a->n != b->n) return a->n < b->n ? -1 : 1;
    for (int i = a->n - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i] ? -1 : 1;
    }
    return 0;
}

/* |a| + |b|, a the longer one. */
static void add_magnitude(mw_big *r, const mw_big *a, const mw_big *b)
{
    int n = a->n, shorter = b->n;
    uint64_t carry = 0;
    for (int i = 0; i < n; i++) {
        uint64_t sum;
        bool over = __builtin_add_overflow(a->limb[i], i < shorter ? b->limb[i] : 0, &sum);
        carry = __builtin_add_overflow(sum, carry, &r->limb[i]) || over;
    }
    r->n = n;
    if (carry) r->limb[r->n++] = carry;
}

/* |a| - |b|, a the larger one. */
static void subtract_magnitude(mw_big *r, const mw_big *a, const mw_big *b)
{
    int n = a->n, shorter = b->n;
    uint64_t borrow = 0;
    for (int i = 0; i < n; i++) {
        uint64_t difference;
        bool under = __builtin_sub_overflow(a->limb[i], i < shorter ? b->limb[i] : 0, &difference);
        borrow = __builtin_sub_overflow(difference, borrow, &r->limb[i]) || under;
    }
    r->n = n;
}

/* r = a + b, where b is taken with the given sign. */
static void add_signed(mw_big *r, const mw_big *a, const mw_big *b, int b_sign)
{
    int order = compare_magnitude(a, b), sign = order < 0 ? b_sign : a->sign;
    const mw_big *larger = order < 0 ? b : a, *smaller = order < 0 ? a : b;
    if (a->sign * b_sign < 0)
        subtract_magnitude(r, larger, smaller);
    else
        add_magnitude(r, larger, smaller);
    r->sign = sign;
    big_trim(r);
}

void mw__big_add(mw_big *r, const mw_big *a, const mw_big *b)
{
    add_signed(r, a, b, b->sign);
}

void mw__big_subtract(mw_big *r, const mw_big *a, const mw_big *b)
{
    add_signed(r, a, b, -b->sign);
}

void mw__big_multiply(mw_big *r, const mw_big *a, const mw_big *b)
{
    r->n = a->n + b->n;
    r->sign = a->sign * b->sign;
    memset(r->limb, 0, (size_t)r->n * sizeof r->limb[0]);
    for (int i = 0; i < a->n; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->n; j++) {
            mw_wide sum = mw__wide_product(a->limb[i], b->limb[j]);
            sum.high += __builtin_add_overflow(sum.low, r->limb[i + j], &sum.low);
            sum.high += __builtin_add_overflow(sum.low, carry, &r->limb[i + j]);
            carry = sum.high;
        }
        r->limb[i + b->n] = carry;
    }
    big_trim(r);
}

void mw__big_cross(mw_big *r, const mw_big *a, const mw_big *b, const mw_big *c, const mw_big *d)
{
    mw_big left, right;
    mw__big_multiply(&left, a, d);
    mw__big_multiply(&right, b, c);
    mw__big_subtract(r, &left, &right);
}

double mw__big_fraction(const mw_big *a, int *exponent)
{
    *exponent = 0;
    if (a->sign == 0) return 0;
    uint64_t top = a->limb[a->n - 1];
    int zeros = __builtin_clzll(top);
    if (zeros > 0) {
        top <<= zeros;
        if (a->n > 1) top |= a->limb[a->n - 2] >> (64 - zeros);
    }
    double fraction = frexp((double)top, exponent);
    *exponent += 64 * (a->n - 1) - zeros;
    return a->sign * fraction;
}

double mw__big_double(const mw_big *a, int exponent)
{
    int own;
    double fraction = mw__big_fraction(a, &own), magnitude = ldexp(fabs(fraction), own + exponent);
    return a->sign * (a->sign ? fmin(fmax(magnitude, DBL_MIN), DBL_MAX) : 0);
}
