/* point_sets.c - points in general position, on lattices, lines and circles, and at the ends of
 * the range of doubles. */
#include "support/point_sets.h"

#include <math.h>

#include "support/meshes.h"

static mw_point uniform(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){random_unit(random), random_unit(random)};
}

static mw_point gaussian(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double r = sqrt(-2 * log(1 - random_unit(random))),
           angle = 6.283185307179586 * random_unit(random);
    return (mw_point){r * cos(angle), r * sin(angle)};
}

static mw_point integer_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    uint32_t width = (uint32_t)sqrt(n);
    return (mw_point){i % width, i / width};
}

/* Nearly cocircular, nearly collinear: tenths are rounded. */
static mw_point decimal_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = integer_grid(random, i, n);
    return (mw_point){p.x * 0.1, p.y * 0.1};
}

static mw_point rotated_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = integer_grid(random, i, n);
    return (mw_point){p.x * 0.8 - p.y * 0.6, p.x * 0.6 + p.y * 0.8};
}

static mw_point circle(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double angle = 6.283185307179586 * i / n;
    return (mw_point){cos(angle), sin(angle)};
}

/* Exactly on a circle: the integer points at distance 65 from the origin. */
static mw_point exact_circle(uint64_t *random, uint32_t i, uint32_t n)
{
    static const int legs[][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {52, 39},
                                  {56, 33}, {60, 25}, {63, 16}, {65, 0}};
    (void)random, (void)n;
    int x = legs[i / 4 % 9][0], y = legs[i / 4 % 9][1];
    switch (i % 4) {
    case 0: return (mw_point){x, y};
    case 1: return (mw_point){-y, x};
    case 2: return (mw_point){-x, -y};
    default: return (mw_point){y, -x};
    }
}

static mw_point clusters(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = gaussian(random, i, n);
    uint64_t cluster = mw__random_below(random, 7);
    return (mw_point){random_unit(&cluster) + 1e-9 * p.x, random_unit(&cluster) + 1e-9 * p.y};
}

static mw_point rising_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = random_unit(random);
    return (mw_point){x, x * x};
}

static mw_point falling_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = rising_parabola(random, i, n);
    return (mw_point){-p.x, p.y};
}

static mw_point integer_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double x = i - n / 2.0;
    return (mw_point){x, x * x};
}

static mw_point spiral(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double angle = 60.0 * i / n;
    return (mw_point){angle * cos(angle), angle * sin(angle)};
}

static mw_point two_lines(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)n;
    return (mw_point){random_unit(random), i % 2};
}

static mw_point cross_lines(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)n;
    return i % 2 ? (mw_point){random_unit(random), 0.5} : (mw_point){0.5, random_unit(random)};
}

/* All on one line but one. */
static mw_point line_and_point(uint64_t *random, uint32_t i, uint32_t n)
{
    double x = 1 + floor(random_unit(random) * 1e6);
    return (mw_point){x, i == n / 2 ? 3 * x + 1 : 3 * x};
}

/* All on one line except for rounding. */
static mw_point rounded_line(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = random_unit(random);
    return (mw_point){x, x * 0.7 + 0.1};
}

/* Within a few units in the last place of the diagonal. */
static mw_point sliver_band(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = 1 + random_unit(random);
    return (mw_point){x, x + 0x1p-52 * mw__random_below(random, 3)};
}

static mw_point repeated(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){mw__random_below(random, 9), mw__random_below(random, 9)};
}

/* Differences of the last bits of large coordinates. */
static mw_point far_away(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){5e6 + random_unit(random) * 1e-6, 5e6 + random_unit(random) * 1e-6};
}

static mw_point surveyed(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){5e5 + 0.01 * mw__random_below(random, 5000),
                      5e6 + 0.01 * mw__random_below(random, 5000)};
}

static mw_point tiny(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1e-300 * random_unit(random), 1e-300 * random_unit(random)};
}

/* Products of four differences are subnormal, and off by more than a filter for normal numbers
 * expects. */
static mw_point underflowing(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = rotated_grid(random, i, n);
    return (mw_point){p.x * 1e-79, p.y * 1e-79};
}

static mw_point subnormal(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){0x1p-1074 * mw__random_below(random, 99),
                      -0x1p-1074 * mw__random_below(random, 99)};
}

static mw_point huge(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1e300 * random_unit(random), 1e300 * random_unit(random)};
}

/* Differences overflow. */
static mw_point widest(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1.7e308 * (2 * random_unit(random) - 1),
                      1.7e308 * (2 * random_unit(random) - 1)};
}

/* Coordinates of all magnitudes. */
static mw_point magnitudes(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = ldexp(1 + random_unit(random), (int)mw__random_below(random, 2000) - 1000);
    double y = ldexp(1 + random_unit(random), (int)mw__random_below(random, 2000) - 1000);
    return (mw_point){mw__random(random) & 1 ? x : -x, mw__random(random) & 1 ? y : -y};
}

static mw_point signed_zeros(uint64_t *random, uint32_t i, uint32_t n)
{
    static const double values[] = {0.0, -0.0, 1.0, -1.0};
    (void)i, (void)n;
    return (mw_point){values[mw__random_below(random, 4)], values[mw__random_below(random, 4)]};
}

static mw_point one_far_point(uint64_t *random, uint32_t i, uint32_t n)
{
    return i ? uniform(random, i, n) : (mw_point){1e30, 1e20};
}

const point_set point_sets[POINT_SETS] = {
    {"uniform", uniform, 30000, 10},
    {"gaussian", gaussian, 10000, 10},
    {"integer grid", integer_grid, 10000, 10},
    {"decimal grid", decimal_grid, 10000, 10},
    {"rotated grid", rotated_grid, 10000, 10},
    {"circle", circle, 10000, 10},
    {"exact circle", exact_circle, 36, 10},
    {"clusters", clusters, 10000, 10},
    {"rising parabola", rising_parabola, 20000, 10},
    {"falling parabola", falling_parabola, 20000, 10},
    {"integer parabola", integer_parabola, 20000, 10},
    {"spiral", spiral, 10000, 10},
    {"two lines", two_lines, 10000, 10},
    {"cross", cross_lines, 10000, 10},
    {"line and point", line_and_point, 10000, 10},
    {"rounded line", rounded_line, 10000, 10},
    {"sliver band", sliver_band, 10000, 10},
    {"repeated", repeated, 10000, 10},
    {"far away", far_away, 10000, 10},
    {"surveyed", surveyed, 10000, 10},
    {"tiny", tiny, 1000, 40},
    {"underflowing", underflowing, 3000, 10},
    {"subnormal", subnormal, 1000, 40},
    {"huge", huge, 1000, 10},
    {"widest", widest, 1000, 10},
    {"magnitudes", magnitudes, 1000, 40},
    {"signed zeros", signed_zeros, 100, 10},
    {"one far point", one_far_point, 10000, 10},
};

void point_set_fill(const point_set *s, uint64_t seed, mw_point *points, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) points[i] = s->point(&seed, i, n);
}
