/* lonlat.c - longitude and latitude in degrees, and directions. */
#include "star/star.h"

/* pi / 180, as the sum of two doubles. */
#define RADIAN 0x1.1df46a2529d39p-6
#define RADIAN_REST 0x1.5c1d8becdd291p-62

/* A sine or cosine: the sum of two doubles. */
typedef struct double_double {
    double value, rest;
} double_double;

/* Cosine x and sine y of an angle in degrees. Whole turns and quarter turns are subtracted without
 * rounding, so multiples of 90 give 0 and 1, and angles that differ by 360 give the same. The rest,
 * at most 45 degrees, becomes an angle a + b, where b is the rounding error of a. sin(a + b) is sin
 * a + b cos a, up to b^2 < 2^-107. */
static void cosine_sine(double degrees, double_double *x, double_double *y)
{
    int quarters;
    double rest = remquo(degrees, 90, &quarters);
    double a = rest * RADIAN, b = fma(rest, RADIAN, -a) + rest * RADIAN_REST;
    double c = cos(a), s = sin(a), sign = quarters & 2 ? -1 : 1;
    double_double cosine = {sign * c, -sign * b * s}, sine = {sign * s, sign * b * c};
    if (quarters & 1) {
        *x = (double_double){-sine.value, -sine.rest};
        *y = cosine;
    } else {
        *x = cosine;
        *y = sine;
    }
}

/* The product, rounded once. A zero is +0. */
static double double_double_product(double_double a, double_double b)
{
    return fma(a.value, b.value, a.value * b.rest + a.rest * b.value) + 0.0;
}

/* Error bound. Let u = 2^-53; half a unit in the last place of a number from 1/2 to 1 is u / 2.
 * Suppose sin and cos of the C library are off by less than 0.7 units, as those of glibc are. Then
 * a factor is off by less than 0.7 u, plus less than u / 1000 that its rest leaves out. A product
 * of two factors of at most 1 is off by less than 1.41 u, and rounding adds at most u / 2: less
 * than 2 u = 2^-52 together. */
void mw_lonlat_to_direction(double longitude, double latitude, double direction[3])
{
    if (!isfinite(longitude) || !(fabs(latitude) <= 90)) {
        direction[0] = direction[1] = direction[2] = NAN;
        return;
    }
    double_double out, up, x, y;
    cosine_sine(latitude, &out, &up);
    cosine_sine(longitude, &x, &y);
    direction[0] = double_double_product(out, x);
    direction[1] = double_double_product(out, y);
    direction[2] = up.value + up.rest + 0.0;
}

/* A power of two scales coordinates to about 1, so that the length neither overflows nor
 * underflows. Zeros are +0, so that the seam has one longitude, 180. */
void mw_direction_to_lonlat(const double direction[3], double *longitude, double *latitude)
{
    double largest = fmax(fmax(fabs(direction[0]), fabs(direction[1])), fabs(direction[2]));
    *longitude = *latitude = NAN;
    if (!mw__is_finite3(direction) || largest == 0) return;
    int exponent;
    frexp(largest, &exponent);
    double x = ldexp(direction[0], -exponent) + 0.0, y = ldexp(direction[1], -exponent) + 0.0;
    double z = ldexp(direction[2], -exponent);
    *longitude = atan2(y, x) / RADIAN;
    *latitude = atan2(z, hypot(x, y)) / RADIAN;
}
