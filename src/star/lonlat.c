/* lonlat.c - longitude and latitude in degrees, and directions. */
#include "star/star.h"

/* pi / 180, as the sum of two doubles. */
#define RADIAN 0x1.1df46a2529d39p-6
#define RADIAN_REST 0x1.5c1d8becdd291p-62

/* A sine or cosine: the sum of two doubles. */
typedef struct precise {
    double value, rest;
} precise;

/* Cosine x and sine y of degrees. Whole turns and quarters of a turn are taken away without rounding, so that multiples
 * of 90 give 0 and 1, and degrees that differ by 360 the same. The rest, at most 45 degrees, becomes an angle a + b,
 * where b is what rounding took from it; sin(a + b) is sin a + b cos a up to b^2 < 2^-107. */
static void cosine_sine(double degrees, precise *x, precise *y)
{
    int quarters;
    double rest = remquo(degrees, 90, &quarters);
    double a = rest * RADIAN, b = fma(rest, RADIAN, -a) + rest * RADIAN_REST;
    double c = cos(a), s = sin(a), sign = quarters & 2 ? -1 : 1;
    precise cosine = {sign * c, -sign * b * s}, sine = {sign * s, sign * b * c};
    if (quarters & 1) {
        *x = (precise){-sine.value, -sine.rest};
        *y = cosine;
    } else {
        *x = cosine;
        *y = sine;
    }
}

/* Rounded once. A zero is +0. */
static double product(precise a, precise b)
{
    return fma(a.value, b.value, a.value * b.rest + a.rest * b.value) + 0.0;
}

/* Let u = 2^-53, half a unit in the last place of numbers from 1/2 to 1 being u / 2. Where sin and cos of the C library
 * are off by less than 0.7 such units, as glibc's are, a factor is off by less than 0.7 u and what its rests leave out,
 * which is below u / 1000; so a product of two that are at most 1 is off by less than 1.41 u, and rounding adds u / 2
 * at most: less than 2 u = 2^-52. */
void mw_lonlat_to_direction(double longitude, double latitude, double direction[3])
{
    if (!isfinite(longitude) || !(fabs(latitude) <= 90)) {
        direction[0] = direction[1] = direction[2] = NAN;
        return;
    }
    precise out, up, x, y;
    cosine_sine(latitude, &out, &up);
    cosine_sine(longitude, &x, &y);
    direction[0] = product(out, x);
    direction[1] = product(out, y);
    direction[2] = up.value + up.rest + 0.0;
}

/* Scaled by a power of two to coordinates of about 1 at most, so that the length over- and underflows nowhere; zeros
 * are +0, so that there is one longitude on the seam, 180. */
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
