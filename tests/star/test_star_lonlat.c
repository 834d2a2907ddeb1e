/* test_star_lonlat.c - longitude and latitude to directions and back: exact where that is
 * promised, accurate elsewhere. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/meshes.h"

#include <float.h>
#include <math.h>
#include <string.h>

static void expect_direction(double longitude, double latitude, double x, double y, double z)
{
    double want[3] = {x, y, z}, got[3];
    mw_lonlat_to_direction(longitude, latitude, got);
    if (memcmp(want, got, sizeof got) != 0)
        fail_msg("longitude %.17g, latitude %.17g: %a %a %a", longitude, latitude, got[0], got[1],
                 got[2]);
}

static void test_multiples_of_a_right_angle(void **state)
{
    static const double x[4] = {1, 0, -1, 0}, y[4] = {0, 1, 0, -1};
    (void)state;
    for (int i = -1000; i <= 1000; i++) {
        double longitude = 90.0 * i;
        expect_direction(longitude, 0, x[i & 3], y[i & 3], 0);
        expect_direction(longitude, -0.0, x[i & 3], y[i & 3], 0);
        expect_direction(longitude, 90, 0, 0, 1);
        expect_direction(longitude, -90, 0, 0, -1);
    }
    expect_direction(-0.0, 0, 1, 0, 0);
    expect_direction(450, 0, 0, 1, 0);
    expect_direction(360 * 0x1p900, 0, 1, 0, 0);
    expect_direction(12.5, 90, 0, 0, 1);
    expect_direction(-101.25, -90, 0, 0, -1);
}

/* Longitudes such that whole turns are added without rounding. */
static void test_whole_turns(void **state)
{
    uint64_t random = 1;
    (void)state;
    for (int i = 0; i < 200000; i++) {
        double longitude = ldexp((double)mw__random_below(&random, 360u << 20), -20) - 180;
        double latitude = 180 * (random_unit(&random) - 0.5), d[3];
        mw_lonlat_to_direction(longitude, latitude, d);
        for (int turns = -3; turns <= 3; turns++)
            expect_direction(longitude + 360 * turns, latitude, d[0], d[1], d[2]);
    }
}

/* The other way round the sphere: east and west, north and south are mirror images, bit by bit. */
static void test_mirrored(void **state)
{
    uint64_t random = 2;
    (void)state;
    for (int i = 0; i < 100000; i++) {
        double longitude = 360 * (random_unit(&random) - 0.5),
               latitude = 180 * (random_unit(&random) - 0.5), d[3];
        mw_lonlat_to_direction(longitude, latitude, d);
        expect_direction(-longitude, latitude, d[0], -d[1] + 0.0, d[2]);
        expect_direction(longitude, -latitude, d[0], d[1], -d[2] + 0.0);
    }
}

#if LDBL_MANT_DIG >= 64
static long double sine(double degrees)
{
    return sinl(remainderl(degrees, 360) * 0x1.1df46a2529d39p-6L +
                remainderl(degrees, 360) * 0x1.5c1d8becdd291p-62L); /* pi / 180 in two parts */
}

static long double cosine(double degrees)
{
    return cosl(remainderl(degrees, 360) * 0x1.1df46a2529d39p-6L +
                remainderl(degrees, 360) * 0x1.5c1d8becdd291p-62L);
}

static double draw_degrees(uint64_t *random, double most)
{
    double degrees = most * (2 * random_unit(random) - 1);
    switch (mw__random_below(random, 4)) {
    case 0: return trunc(degrees);
    case 1: return ldexp(degrees, -(int)mw__random_below(random, 60));
    case 2: return 45 * trunc(degrees / 45) + ldexp(degrees, -(int)mw__random_below(random, 60));
    default: return degrees;
    }
}

static void test_accuracy(void **state)
{
    uint64_t random = 3;
    long double most = 0;
    (void)state;
    for (int i = 0; i < 400000; i++) {
        double longitude = draw_degrees(&random, 1000), latitude = draw_degrees(&random, 90), d[3];
        latitude = fmax(-90, fmin(90, latitude));
        mw_lonlat_to_direction(longitude, latitude, d);
        long double want[3] = {cosine(latitude) * cosine(longitude),
                               cosine(latitude) * sine(longitude), sine(latitude)};
        for (int k = 0; k < 3; k++) {
            most = fmaxl(most, fabsl(want[k] - d[k]));
            if (fabsl(want[k] - d[k]) >= 0x1p-52L)
                fail_msg("longitude %a, latitude %a: coordinate %d is %a", longitude, latitude, k,
                         d[k]);
        }
    }
    print_message("largest error: %.3Lf x 2^-52\n", most / 0x1p-52L);
}
#endif

static void expect_nan(double longitude, double latitude)
{
    double d[3] = {0, 0, 0};
    mw_lonlat_to_direction(longitude, latitude, d);
    assert_true(isnan(d[0]) && isnan(d[1]) && isnan(d[2]));
}

static void test_no_direction(void **state)
{
    (void)state;
    expect_nan(NAN, 0);
    expect_nan(0, NAN);
    expect_nan(INFINITY, 0);
    expect_nan(0, -INFINITY);
    expect_nan(0, nextafter(90, 91));
    expect_nan(0, -91);
}

static void expect_lonlat(double x, double y, double z, double longitude, double latitude)
{
    double got[2];
    mw_direction_to_lonlat((double[3]){x, y, z}, &got[0], &got[1]);
    if (got[0] != longitude || got[1] != latitude)
        fail_msg("direction %g %g %g: longitude %.17g, latitude %.17g", x, y, z, got[0], got[1]);
}

static void test_back(void **state)
{
    static const double size[] = {1, 3, 1e300, DBL_MAX, 1e-300, 0x1p-1074};
    uint64_t random = 4;
    (void)state;
    for (int i = 0; i < 6; i++) {
        double s = size[i];
        expect_lonlat(s, 0, 0, 0, 0);
        expect_lonlat(0, s, 0, 90, 0);
        expect_lonlat(-s, 0, 0, 180, 0);
        expect_lonlat(-s, -0.0, 0, 180, 0);
        expect_lonlat(0, -s, -0.0, -90, 0);
        expect_lonlat(0, 0, s, 0, 90);
        expect_lonlat(-0.0, -0.0, -s, 0, -90);
        expect_lonlat(s, s, 0, 45, 0);
        expect_lonlat(-s, -s, 0, -135, 0);
    }
    for (int i = 0; i < 100000; i++) {
        double longitude = 360 * (random_unit(&random) - 0.5),
               latitude = 180 * (random_unit(&random) - 0.5), got[2];
        double d[3], scale = ldexp(1, (int)mw__random_below(&random, 1900) - 950);
        mw_lonlat_to_direction(longitude, latitude, d);
        for (int k = 0; k < 3; k++) d[k] *= scale;
        mw_direction_to_lonlat(d, &got[0], &got[1]);
        if (fabs(got[0] - longitude) * cos(latitude / 57.3) > 1e-13 ||
            fabs(got[1] - latitude) > 1e-13)
            fail_msg("longitude %.17g, latitude %.17g: came back as %.17g, %.17g", longitude,
                     latitude, got[0], got[1]);
    }
}

static void test_no_lonlat(void **state)
{
    static const double bad[][3] = {{0, 0, 0},        {-0.0, 0, -0.0},  {NAN, 1, 1},
                                    {1, NAN, 0},      {1, 0, INFINITY}, {-INFINITY, 1, NAN},
                                    {INFINITY, 0, 0}, {0, 0, NAN}};
    (void)state;
    for (int i = 0; i < 8; i++) {
        double longitude = 0, latitude = 0;
        mw_direction_to_lonlat(bad[i], &longitude, &latitude);
        assert_true(isnan(longitude) && isnan(latitude));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_multiples_of_a_right_angle),
        cmocka_unit_test(test_whole_turns),
        cmocka_unit_test(test_mirrored),
#if LDBL_MANT_DIG >= 64
        cmocka_unit_test(test_accuracy),
#endif
        cmocka_unit_test(test_no_direction),
        cmocka_unit_test(test_back),
        cmocka_unit_test(test_no_lonlat),
    };
    return cmocka_run_group_tests_name("star_lonlat", tests, NULL, NULL);
}
