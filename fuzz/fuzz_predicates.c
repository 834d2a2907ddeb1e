/* The predicates against GMP on any bytes. The first byte says how to read the rest: as doubles,
 * or as small integers times a power of two, each moved by some units in the last place, which are
 * often degenerate. */
#include "oracle/line_oracle.h"
#include "predicates/line.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define COORDINATES LINE_ORACLE_COORDINATES

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool right)
{
    if (!right) abort();
}

static void read_doubles(double p[COORDINATES], const uint8_t *data, size_t size)
{
    if (size > COORDINATES * sizeof(double)) size = COORDINATES * sizeof(double);
    if (size > 0) memcpy(p, data, size);
}

/* Four bytes each: two for the integer, one for the exponent (relative to that of all), one for
 * the units. */
static void read_integers(double p[COORDINATES], const uint8_t *data, size_t size, int exponent)
{
    for (size_t i = 0; i < COORDINATES && 4 * i + 3 < size; i++) {
        const uint8_t *at = data + 4 * i;
        double v = ldexp((int16_t)(at[0] | at[1] << 8), exponent + (int8_t)at[2] / 16);
        for (int units = (int8_t)at[3] / 16; units != 0; units += units > 0 ? -1 : 1)
            v = nextafter(v, units > 0 ? DBL_MAX : -DBL_MAX);
        p[i] = fmax(-DBL_MAX, fmin(DBL_MAX, v));
    }
}

static mw_point at(const double *p, int i)
{
    return (mw_point){p[2 * i], p[2 * i + 1]};
}

/* The value as users get it has the sign of the truth, the exact stage its value as well. */
static void compare(predicate_oracle *truth, long exponent, double filtered, double exact)
{
    require((filtered > 0) - (filtered < 0) == mpz_sgn(truth->result));
    require(predicate_oracle_agrees(truth, exponent, exact));
}

static mw_line line_at(const double *p)
{
    return (mw_line){{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {0}};
}

static void check_hits(line_oracle *truth, const double p[COORDINATES])
{
    mw_line line = line_at(p);
    mw_corners s = {p + 6, p + 9, p + 12}, t = {p + 15, p + 18, p + 21};
    line_oracle_load(truth, p);
    if (!line_oracle_ready(truth)) return;
    require(mw__compare_hits(&line, s, t) == line_oracle_compare_hits(truth));
    require(mw__compare_hit_to(&line, s, fabs(p[24])) == line_oracle_compare_hit_to(truth));
    double distance = mw__hit_distance(&line, s);
    require((distance > 0) - (distance < 0) == mpz_sgn(truth->n[0]) * mpz_sgn(truth->m[0]));
}

static void check(predicate_oracle *truth, const double p[COORDINATES])
{
    mw_point a = at(p, 0), b = at(p, 1), c = at(p, 2), d = at(p, 3), e = at(p, 4);
    compare(truth, predicate_oracle_orient2d(truth, p), mw__orient2d(a, b, c),
            mw__orient2d_exact(a, b, c));
    compare(truth, predicate_oracle_dot2d(truth, p), mw__dot2d(a, b, c), mw__dot2d_exact(a, b, c));
    compare(truth, predicate_oracle_incircle(truth, p), mw__incircle(a, b, c, d),
            mw__incircle_exact(a, b, c, d));
    compare(truth, predicate_oracle_orient3d(truth, p), mw__orient3d(p, p + 3, p + 6, p + 9),
            mw__orient3d_exact(p, p + 3, p + 6, p + 9));
    mw_line line = line_at(p);
    compare(truth, line_oracle_side(truth, p), mw__side(&line, p + 6, p + 9),
            mw__side_exact(&line, p + 6, p + 9));
    require(mw__compare_distance(a, b, c, d, e) == predicate_oracle_compare_distance(truth, p));
    require(mw__compare_distance_to(a, b, c, p[6]) ==
            predicate_oracle_compare_distance_to(truth, p));
}

/* With a coordinate that is not finite: 0 from what uses it, and an end in any case. */
static void check_not_finite(const double p[COORDINATES])
{
    mw_point a = at(p, 0), b = at(p, 1), c = at(p, 2), d = at(p, 3), e = at(p, 4);
    bool plane = isfinite(a.x) && isfinite(a.y) && isfinite(b.x) && isfinite(b.y) &&
                 isfinite(c.x) && isfinite(c.y);
    double orientation = mw__orient2d(a, b, c), dot = mw__dot2d(a, b, c);
    require(plane || (orientation == 0 && dot == 0));
    mw_line line = line_at(p);
    bool space = true;
    for (int i = 0; i < 12; i++) space = space && isfinite(p[i]);
    require(space ||
            (mw__orient3d(p, p + 3, p + 6, p + 9) == 0 && mw__side(&line, p + 6, p + 9) == 0));
    require((plane && isfinite(d.x) && isfinite(d.y)) || mw__incircle(a, b, c, d) == 0);
    require(abs(mw__compare_distance(a, b, c, d, e)) <= 1);
    require(abs(mw__compare_distance_to(a, b, c, p[6])) <= 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static predicate_oracle truth;
    static line_oracle line_truth;
    static bool ready;
    double p[COORDINATES] = {0};
    if (!ready) {
        predicate_oracle_init(&truth);
        line_oracle_init(&line_truth);
    }
    ready = true;
    if (size < 2) return 0;
    if (data[0] % 2 == 0)
        read_doubles(p, data + 1, size - 1);
    else
        read_integers(p, data + 2, size - 2, 8 * (int8_t)data[1]);
    bool finite = true;
    for (int i = 0; i < COORDINATES; i++) finite = finite && isfinite(p[i]);
    if (finite) {
        check(&truth, p);
        check_hits(&line_truth, p);
    } else {
        check_not_finite(p);
    }
    return 0;
}
