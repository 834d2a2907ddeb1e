/* A line in space against edges and planes, by GMP; and what it touches of a surface, by brute
 * force in integers on lattices, where everything coincides often. MW_TEST_LONG=1 runs a hundred
 * times as many cases, MW_TEST_SEED=n other ones. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/line_oracle.h"
#include "support/environment.h"
#include "support/predicate_cases.h"
#include "probe/prober.h"

#include <float.h>
#include <math.h>
#include <meshwalk/locate.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static predicate_oracle truth;
static line_oracle line_truth;

static void fail_case(const char *what, const double *p, int n, double value)
{
    fprintf(stderr, "%s: %a is wrong for", what, value);
    for (int i = 0; i < n; i++) fprintf(stderr, " %a", p[i]);
    fprintf(stderr, "\n");
    fail();
}

static int sign(double v)
{
    return (v > 0) - (v < 0);
}

static mw_line line_of(const double *p)
{
    return (mw_line){{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {0}};
}

/* --- sides ------------------------------------------------------------------------------------ */

/* How much of its bound the error of a rounded side takes: |side - truth| / (bound + u |side|), at
 * most 1. */
static double error_share(double side, double bound, long exponent)
{
    mpq_t value, exact;
    mpq_inits(value, exact, NULL);
    mpq_set_d(value, side);
    mpq_set_z(exact, truth.result);
    if (exponent < 0)
        mpq_div_2exp(exact, exact, (mp_bitcnt_t)-exponent);
    else
        mpq_mul_2exp(exact, exact, (mp_bitcnt_t)exponent);
    mpq_sub(value, value, exact);
    double error = fabs(mpq_get_d(value));
    mpq_clears(value, exact, NULL);
    return error / (bound + 0x1p-53 * fabs(side));
}

static void check_side(const double p[12])
{
    mw_line line = line_of(p);
    long exponent = line_oracle_side(&truth, p);
    if (sign(mw__side(&line, p + 6, p + 9)) != mpz_sgn(truth.result)) fail_case("side", p, 12, 0);
    double exact = mw__side_exact(&line, p + 6, p + 9);
    if (!predicate_oracle_agrees(&truth, exponent, exact)) fail_case("side_exact", p, 12, exact);
    if (sign(mw__facing(p + 3, p, p + 6, p + 9)) != mpz_sgn(truth.result))
        fail_case("facing", p, 12, 0);
}

static void test_known_sides(void **unused)
{
    (void)unused;
    mw_line line = {{0, 0, 5}, {0, 0, -2}, {0}};
    const double a[3] = {1, 0, 0}, b[3] = {0, 1, 1}, c[3] = {-1, 0, 7};
    assert_true(mw__side(&line, a, b) == -2);
    assert_true(mw__side(&line, b, a) == 2);
    assert_true(mw__side(&line, c, a) == 0);
    /* counter-clockwise from above, where the line comes from */
    assert_true(mw__facing(line.m, a, b, c) < 0);
    const double bad[3] = {0, NAN, 1}, far[3] = {INFINITY, 0, 0};
    assert_true(mw__side(&line, a, bad) == 0 && mw__side(&line, bad, b) == 0 &&
                mw__side(&line, a, far) == 0);
    assert_true(mw__facing(line.m, bad, b, c) == 0 && mw__facing(line.m, a, far, c) == 0);
}

static void test_sides(void **unused)
{
    (void)unused;
    long zeros = 0;
    for (long i = cases_count(200000); i > 0; i--) {
        double p[12];
        cases_generate(p, 12, 3);
        if (cases_below(4) == 0) cases_rescale(p + 3, 3);
        check_side(p);
        zeros += mpz_sgn(truth.result) == 0;
    }
    fprintf(stderr, "%ld zeros\n", zeros);
    assert_true(zeros > cases_count(5000));
}

/* The bound of the filter holds for every side, and the worst case comes near enough to tell if it
 * were too small: differences just above a power of two, all of them rounded. */
static void test_bound(void **unused)
{
    (void)unused;
    double worst = 0;
    for (long i = cases_count(200000); i > 0; i--) {
        double p[12], bound, noise = ldexp(1, -(int)cases_below(12));
        for (int k = 0; k < 3; k++) p[k] = 0x1p-10 * cases_uniform();
        for (int k = 3; k < 12; k++)
            p[k] = ((double)cases_below(3) - 1) * (1 + noise * fabs(cases_uniform()));
        mw_line line = line_of(p);
        double side = mw__side_rounded(&line, p + 6, p + 9, &bound);
        worst = fmax(worst, error_share(side, bound, line_oracle_side(&truth, p)));
    }
    fprintf(stderr, "worst error: %.3f of the bound\n", worst);
    assert_true(worst <= 1 && worst > (environment_is_short() ? 0.4 : 0.6));
}

/* --- hits ------------------------------------------------------------------------------------- */

static void corners_at(const double *p, mw_corners c)
{
    for (int k = 0; k < 3; k++) c[k] = p + 3 * k;
}

/* Two triangles and a line that meets a vertex or an edge that they share. */
static void generate_tie(double p[LINE_ORACLE_COORDINATES])
{
    uint32_t size = cases_below(2) ? 8 : 1 << 20;
    for (int i = 3; i < LINE_ORACLE_COORDINATES; i++)
        p[i] = 2 * ((double)cases_below(size) - size / 2);
    uint32_t a = cases_below(3), b = cases_below(3), along = cases_below(5);
    bool edge = cases_below(2);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t from = 6 + 3 * a + k, next = 6 + 3 * ((a + 1) % 3) + k;
        p[15 + 3 * b + k] = p[from];
        if (edge) p[15 + 3 * ((b + 2) % 3) + k] = p[next];
        double at = edge ? (p[from] + p[next]) / 2 : p[from];
        p[k] = at - ((double)along - 2) * p[3 + k];
    }
    double length = sqrt(p[3] * p[3] + p[4] * p[4] + p[5] * p[5]);
    p[24] = fabs((double)along - 2) * length;
    if (cases_below(8) == 0) cases_perturb(p, LINE_ORACLE_COORDINATES - 1);
    if (cases_below(4) == 0) cases_rescale(p, LINE_ORACLE_COORDINATES);
    if (cases_below(4) == 0) cases_rescale(p + 3, 3);
}

/* All of one size, or not; the length such that it matters, now and then. */
static void generate_hits(double p[LINE_ORACLE_COORDINATES])
{
    if (cases_below(3) == 0) {
        generate_tie(p);
        return;
    }
    cases_generate(p, 24, 3);
    if (cases_below(4) == 0) cases_rescale(p + 3, 3);
    mw_line line = line_of(p);
    mw_corners c;
    corners_at(p + 6, c);
    double distance = fabs(mw__hit_distance(&line, c));
    p[24] = cases_below(2) && isfinite(distance) ? distance : fabs(p[cases_below(24)]);
    if (cases_below(2)) p[24] = nextafter(p[24], DBL_MAX);
}

static void test_comparisons(void **unused)
{
    (void)unused;
    double p[LINE_ORACLE_COORDINATES];
    long ties = 0, reached = 0;
    for (long i = cases_count(80000); i > 0; i--) {
        generate_hits(p);
        line_oracle_load(&line_truth, p);
        if (!line_oracle_ready(&line_truth)) continue;
        mw_line line = line_of(p);
        mw_corners s, t;
        corners_at(p + 6, s);
        corners_at(p + 15, t);
        int order = mw__compare_hits(&line, s, t), to = mw__compare_hit_to(&line, s, p[24]);
        if (order != line_oracle_compare_hits(&line_truth))
            fail_case("compare_hits", p, LINE_ORACLE_COORDINATES, order);
        if (mw__compare_hits(&line, t, s) != -order)
            fail_case("compare_hits", p, LINE_ORACLE_COORDINATES, -order);
        if (to != line_oracle_compare_hit_to(&line_truth))
            fail_case("compare_hit_to", p, LINE_ORACLE_COORDINATES, to);
        assert_int_equal(mw__compare_hit_to(&line, s, INFINITY), -1);
        ties += order == 0;
        reached += to == 0;
    }
    fprintf(stderr, "%ld ties, %ld in reach to the bit\n", ties, reached);
    assert_true(ties > cases_count(10000) && reached > cases_count(3000));
}

/* r = z * 2^exponent */
static void set_scaled(mpf_t r, mpz_t z, long exponent)
{
    mpf_set_z(r, z);
    if (exponent < 0)
        mpf_div_2exp(r, r, (mp_bitcnt_t)-exponent);
    else
        mpf_mul_2exp(r, r, (mp_bitcnt_t)exponent);
}

/* Is the distance that was told right: sign, 0, what overflows, and the error elsewhere? */
static bool distance_agrees(double distance)
{
    mpf_t exact, factor;
    mpf_init2(exact, 256);
    mpf_init2(factor, 256);
    set_scaled(exact, line_truth.square, 2 * line_truth.base);
    mpf_sqrt(exact, exact);
    mpf_set_z(factor, line_truth.n[0]);
    mpf_mul(exact, exact, factor);
    mpf_set_z(factor, line_truth.m[0]);
    mpf_div(exact, exact, factor); /* both are of the third degree: their scales cancel */
    bool right = mpf_sgn(exact) == sign(distance);
    mpf_set_d(factor, DBL_MAX * (1 - 0x1p-40));
    if (isinf(distance)) {
        mpf_abs(exact, exact);
        right = right && mpf_cmp(exact, factor) > 0;
    } else if (fabs(distance) < DBL_MIN) {
        right = right && fabs(mpf_get_d(exact)) < 2 * DBL_MIN;
    } else {
        mpf_set_d(factor, distance);
        mpf_div(exact, exact, factor);
        right = right && fabs(mpf_get_d(exact) - 1) < 0x1p-40;
    }
    mpf_clears(exact, factor, NULL);
    return right;
}

static void test_distances(void **unused)
{
    (void)unused;
    double p[LINE_ORACLE_COORDINATES];
    long infinite = 0, small = 0, zeros = 0;
    for (long i = cases_count(40000); i > 0; i--) {
        generate_hits(p);
        line_oracle_load(&line_truth, p);
        if (!line_oracle_ready(&line_truth)) continue;
        mw_line line = line_of(p);
        mw_corners s;
        corners_at(p + 6, s);
        double distance = mw__hit_distance(&line, s);
        if (!distance_agrees(distance)) fail_case("hit_distance", p, 15, distance);
        infinite += isinf(distance) != 0;
        small += fabs(distance) < DBL_MIN;
        zeros += distance == 0 && !signbit(distance);
    }
    fprintf(stderr, "%ld infinite, %ld small, %ld zero\n", infinite, small, zeros);
    assert_true(infinite > cases_count(10) && small > zeros && zeros > cases_count(1000));
}

/* The sides of the first triangle as p has it: their signs, and whether the line meets it. */
static bool exact_sides(const double *p, mpz_t side[3], long *exponent)
{
    bool front = false, back = false;
    for (int k = 0; k < 3; k++) {
        double v[12];
        memcpy(v, p, 6 * sizeof v[0]);
        memcpy(v + 6, p + 6 + 3 * ((k + 1) % 3), 3 * sizeof v[0]);
        memcpy(v + 9, p + 6 + 3 * ((k + 2) % 3), 3 * sizeof v[0]);
        exponent[k] = line_oracle_side(&truth, v);
        mpz_set(side[k], truth.result);
        front = front || mpz_sgn(side[k]) < 0;
        back = back || mpz_sgn(side[k]) > 0;
    }
    return front != back;
}

static bool sides_agree(const double told[3], mpz_t side[3], const long exponent[3])
{
    mpf_t exact[3], sum;
    double told_sum = told[0] + told[1] + told[2];
    bool right = told_sum >= 0x1p-900 && told_sum <= 0x1p900;
    mpf_init2(sum, 256);
    for (int k = 0; k < 3; k++) {
        mpf_init2(exact[k], 256);
        set_scaled(exact[k], side[k], exponent[k]);
        mpf_abs(exact[k], exact[k]);
        mpf_add(sum, sum, exact[k]);
    }
    for (int k = 0; k < 3; k++) {
        right = right && (mpf_sgn(exact[k]) == 0) == (told[k] == 0) && told[k] >= 0;
        mpf_div(exact[k], exact[k], sum);
        right = right && fabs(mpf_get_d(exact[k]) - told[k] / told_sum) < 0x1p-41;
        mpf_clear(exact[k]);
    }
    mpf_clear(sum);
    return right;
}

/* Let the line go through a vertex, a point of an edge or one inside, as far as rounding lets it.
 */
static void aim(double p[15])
{
    static const double weights[][3] = {
        {1, 0, 0}, {0.5, 0.5, 0}, {0.75, 0.25, 0}, {0.5, 0.25, 0.25}};
    const double *weight = weights[cases_below(4)];
    double along = (double)cases_below(3) - 1;
    uint32_t first = cases_below(3);
    for (uint32_t k = 0; k < 3; k++) {
        double at = 0;
        for (uint32_t i = 0; i < 3; i++) at += weight[i] * p[6 + 3 * ((first + i) % 3) + k];
        p[k] = cases_clamped(at - along * p[3 + k]);
    }
}

/* What doubles tell is so, and the same to the last bit. */
static long check_inside(const mw_line *line, const mw_corners s, const double side[3])
{
    double told[3];
    if (!mw__hit_inside(line, s, told)) return 0;
    for (int k = 0; k < 3; k++) {
        assert_true(told[k] == side[k] && told[k] > 0);
        assert_true(mw__side(line, s[(k + 1) % 3], s[(k + 2) % 3]) < 0);
    }
    return 1;
}

/* A triangle much smaller than its distance from q. */
static void shrink(double p[15])
{
    for (int k = 0; k < 3; k++)
        for (int i = 9; i < 15; i += 3)
            p[i + k] = cases_clamped(p[6 + k] + ldexp(p[i + k] - p[6 + k], -12));
}

static void test_weights(void **unused)
{
    (void)unused;
    mpz_t side[3];
    mpz_inits(side[0], side[1], side[2], NULL);
    long exponent[3], met = 0, zeros = 0, plain = 0;
    for (long i = cases_count(80000); i > 0; i--) {
        double p[15], told[3];
        cases_generate(p, 15, 3);
        if (cases_below(4) == 0) cases_rescale(p + 3, 3);
        if (cases_below(3) == 0) shrink(p);
        if (cases_below(8)) aim(p);
        if (!exact_sides(p, side, exponent)) continue;
        mw_line line = line_of(p);
        mw_corners s;
        corners_at(p + 6, s);
        mw__hit_sides(&line, s, told);
        if (!sides_agree(told, side, exponent)) fail_case("hit_sides", p, 15, told[0]);
        met++;
        zeros += told[0] == 0 || told[1] == 0 || told[2] == 0;
        plain += check_inside(&line, s, told);
    }
    mpz_clears(side[0], side[1], side[2], NULL);
    fprintf(stderr, "%ld met, %ld of them at an edge, %ld inside by doubles\n", met, zeros, plain);
    assert_true(met > cases_count(20000) && zeros > cases_count(3000) && plain > cases_count(2000));
}

/* --- touches on small lattices ---------------------------------------------------------------- */

enum { MOST_VERTICES = 14, MOST_TRIANGLES = 40 };

typedef struct lattice {
    int64_t v[MOST_VERTICES][3], q[3], m[3];
    uint32_t triangles[3 * MOST_TRIANGLES], vertex_count, count;
    mw_surface *surface;
    mw_line line;
} lattice;

static void generate_surface(lattice *l)
{
    uint32_t size = 2 + cases_below(3), depth = cases_below(3);
    double points[3 * MOST_VERTICES];
    l->vertex_count = 4 + cases_below(MOST_VERTICES - 3);
    l->count = 2 + cases_below(MOST_TRIANGLES - 1);
    for (uint32_t i = 0; i < l->vertex_count; i++)
        for (uint32_t k = 0; k < 3; k++)
            points[3 * i + k] =
                (double)(l->v[i][k] = 4 * (int64_t)cases_below(k < 2 ? size : depth + 1));
    for (uint32_t i = 0; i < 3 * l->count; i++) {
        uint32_t *v = &l->triangles[i];
        *v = cases_below(l->vertex_count);
        if (cases_below(8) == 0) continue; /* a vertex may be repeated */
        while ((i % 3 > 0 && *v == v[-1]) || (i % 3 > 1 && *v == v[-2]))
            *v = cases_below(l->vertex_count);
    }
    mw_arrays arrays = {.points = points,
                        .point_count = l->vertex_count,
                        .triangles = l->triangles,
                        .triangle_count = l->count};
    mw_surface_options options = {.tolerant = 1, .weld = (int)cases_below(2)};
    assert_int_equal(mw_surface_create(&arrays, &options, &l->surface, NULL), MW_OK);
}

/* Through a vertex, the middle of an edge or anything else. */
static void generate_line(lattice *l)
{
    const uint32_t *t = &l->triangles[3 * cases_below(l->count)];
    uint32_t kind = cases_below(4);
    do {
        for (int k = 0; k < 3; k++) l->m[k] = (int64_t)cases_below(5) - 2;
        if (cases_below(2)) l->m[0] = l->m[1] = 0;
    } while (l->m[0] == 0 && l->m[1] == 0 && l->m[2] == 0);
    for (int k = 0; k < 3; k++) {
        int64_t a = l->v[t[0]][k], b = l->v[t[1]][k];
        l->q[k] = kind == 0   ? a
                  : kind == 1 ? (a + b) / 2
                  : kind == 2 ? (3 * a + b) / 4
                              : (int64_t)cases_below(12);
    }
    int64_t back = (int64_t)cases_below(5) - 2;
    for (int k = 0; k < 3; k++) {
        l->q[k] -= back * l->m[k];
        l->line.q[k] = (double)l->q[k];
        l->line.m[k] = (double)l->m[k];
        l->line.tail[k] = 0;
    }
}

static int64_t dot(const int64_t a[3], const int64_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(int64_t r[3], const int64_t a[3], const int64_t b[3])
{
    for (int k = 0; k < 3; k++)
        r[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void minus(int64_t r[3], const int64_t a[3], const int64_t b[3])
{
    for (int k = 0; k < 3; k++) r[k] = a[k] - b[k];
}

/* Where the line meets a triangle's plane: at n / m along it, which is the point p / m. m is 0
 * where they are parallel. */
typedef struct line_place {
    int64_t n, m, p[3];
} line_place;

static const int64_t *corner(const lattice *l, uint32_t t, uint32_t k)
{
    return l->v[l->triangles[3 * t + k % 3]];
}

static line_place place_of(const lattice *l, uint32_t t, int64_t normal[3])
{
    int64_t u[3], v[3], w[3];
    minus(u, corner(l, t, 1), corner(l, t, 0));
    minus(v, corner(l, t, 2), corner(l, t, 0));
    minus(w, corner(l, t, 0), l->q);
    cross(normal, u, v);
    line_place at = {dot(normal, w), dot(normal, l->m), {0}};
    for (int k = 0; k < 3; k++) at.p[k] = at.m * l->q[k] + at.n * l->m[k];
    return at;
}

/* -1: the line touches the triangle; 1: it meets its back; 0: neither. */
static int brute_touch(const lattice *l, uint32_t t)
{
    int64_t normal[3];
    line_place at = place_of(l, t, normal);
    for (uint32_t k = 0; k < 3 && at.m != 0; k++) {
        int64_t along[3], to[3], turn[3];
        const int64_t *a = corner(l, t, k);
        minus(along, corner(l, t, k + 1), a);
        for (int i = 0; i < 3; i++) to[i] = at.p[i] - at.m * a[i];
        cross(turn, along, to);
        if ((dot(normal, turn) < 0) != (at.m < 0) && dot(normal, turn) != 0) return 0;
    }
    return at.m < 0 ? -1 : at.m > 0;
}

/* Does the closed edge k of a triangle contain the place? */
static bool on_edge(const lattice *l, uint32_t t, uint32_t k, const line_place *at)
{
    const int64_t *a = corner(l, t, k), *b = corner(l, t, k + 1);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int64_t low = (a[i] < b[i] ? a[i] : b[i]) * at->m,
                high = (a[i] < b[i] ? b[i] : a[i]) * at->m;
        if (at->m < 0 ? at->p[i] > low || at->p[i] < high : at->p[i] < low || at->p[i] > high)
            return false;
        if ((b[i] - a[i]) * (at->p[j] - at->m * a[j]) != (b[j] - a[j]) * (at->p[i] - at->m * a[i]))
            return false;
    }
    return true;
}

static bool is_flat(const lattice *l, uint32_t t)
{
    int64_t normal[3];
    place_of(l, t, normal);
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

/* The lowest triangle touched of those linked to t through edges at its place; `through_flat`:
 * also through flat triangles. */
static uint32_t brute_lowest(const lattice *l, uint32_t t, bool through_flat)
{
    int64_t normal[3];
    line_place at = place_of(l, t, normal);
    uint32_t stack[MOST_TRIANGLES], n = 1, lowest = t;
    bool seen[MOST_TRIANGLES] = {false};
    stack[0] = t;
    seen[t] = true;
    while (n > 0) {
        uint32_t s = stack[--n];
        if (s < lowest && brute_touch(l, s) < 0) lowest = s;
        for (unsigned k = 0; k < 3; k++) {
            uint32_t next = mw_surface_neighbour(l->surface, s, k, NULL);
            if (next == MW_NONE || seen[next] || !on_edge(l, s, k, &at)) continue;
            if (!through_flat && is_flat(l, next)) continue;
            seen[next] = true;
            stack[n++] = next;
        }
    }
    return lowest;
}

static void check_answer(const lattice *l, uint32_t t)
{
    int64_t normal[3];
    line_place at = place_of(l, t, normal);
    mw_touch touch = mw__touch_of(l->surface, &l->line, t);
    double distance = (double)at.n / (double)at.m * sqrt((double)dot(l->m, l->m)), sum = 0;
    assert_true(fabs(touch.distance - distance) <= 1e-12 * fabs(distance));
    assert_true(touch.triangle == t && touch.state == MW_TOUCH_HIT && touch.back == 0);
    uint32_t on = 0, edges = 0;
    for (uint32_t k = 0; k < 3; k++) {
        sum += touch.weight[k];
        edges += on_edge(l, t, k, &at);
        on |= (uint32_t)on_edge(l, t, k, &at) << k;
        assert_true(touch.weight[k] >= 0);
        assert_true((touch.weight[k] == 0) == on_edge(l, t, mw__next(k), &at));
    }
    assert_true(fabs(sum - 1) < 1e-15);
    assert_int_equal(touch.where, edges == 0 ? MW_INSIDE : edges == 1 ? MW_ON_EDGE : MW_ON_VERTEX);
    static const uint8_t local[8] = {UINT8_MAX, 0, 1, 1, 2, 0, 2, UINT8_MAX};
    assert_int_equal(touch.local, local[on]);
    for (int i = 0; i < 3; i++) {
        double p = 0;
        for (uint32_t k = 0; k < 3; k++) p += touch.weight[k] * (double)corner(l, t, k)[i];
        assert_true(fabs(p - (double)at.p[i] / (double)at.m) < 1e-13);
    }
}

/* Told of a triangle that is not touched, or by other numbers than those of the answer? */
static long check_again(const lattice *l, uint32_t t, bool touched)
{
    double d = (double)cases_below(12);
    mw_touch again;
    if (!mw__touch_surely_inside(l->surface, &l->line, t, d, &again)) return 0;
    mw_touch touch = mw__touch_of_lowest(l->surface, &l->line, t);
    assert_true(touched && mw__touch_in_reach(l->surface, &l->line, t, d));
    assert_memory_equal(&again, &touch, sizeof touch);
    return 1;
}

static void check_reach(const lattice *l, uint32_t t)
{
    int64_t normal[3], d = (int64_t)cases_below(12);
    line_place at = place_of(l, t, normal);
    bool reached = at.n * at.n * dot(l->m, l->m) <= d * d * at.m * at.m;
    assert_int_equal(mw__touch_in_reach(l->surface, &l->line, t, (double)d), reached);
    assert_true(mw__touch_in_reach(l->surface, &l->line, t, INFINITY));
    for (uint32_t s = 0; s < l->count; s++) {
        if (brute_touch(l, s) >= 0) continue;
        line_place other = place_of(l, s, normal);
        int64_t nearer = llabs(at.n * other.m) - llabs(other.n * at.m);
        assert_int_equal(mw__touch_is_better(l->surface, &l->line, t, s),
                         nearer < 0 || (nearer == 0 && t < s));
    }
}

static void test_touches(void **unused)
{
    (void)unused;
    long touched = 0, lowered = 0, by_flat = 0, backs = 0, again = 0;
    for (long i = cases_count(5000); i > 0; i--) {
        lattice l;
        generate_surface(&l);
        for (int j = 0; j < 8; j++) {
            generate_line(&l);
            for (uint32_t t = 0; t < l.count; t++) {
                int side = brute_touch(&l, t);
                assert_int_equal(mw__line_touches(l.surface, &l.line, t), side < 0);
                assert_int_equal(mw__line_meets(l.surface, &l.line, t), side != 0);
                backs += side > 0;
                again += check_again(&l, t, side < 0);
                if (side >= 0) continue;
                uint32_t lowest = brute_lowest(&l, t, true);
                assert_int_equal(mw__lowest_touched(l.surface, &l.line, t), lowest);
                assert_int_equal(mw__touch_of_lowest(l.surface, &l.line, t).triangle, lowest);
                check_answer(&l, t);
                if (cases_below(4) == 0) check_reach(&l, t);
                touched++;
                lowered += lowest < t;
                by_flat += lowest < brute_lowest(&l, t, false);
            }
        }
        mw_surface_destroy(l.surface);
    }
    fprintf(stderr,
            "%ld touched, %ld with a lower one, %ld of them behind flat triangles; %ld from "
            "behind; %ld again\n",
            touched, lowered, by_flat, backs, again);
    assert_true(touched > cases_count(50000) && lowered > cases_count(7000) &&
                by_flat > cases_count(500) && backs > cases_count(50000) &&
                again > cases_count(5000));
}

/* A fan of more triangles than anything that is remembered: from each, the first is found. */
static void test_large_fan(void **unused)
{
    (void)unused;
    enum { N = 1000 };
    static double points[3 * (N + 1)];
    static uint32_t triangles[3 * N];
    for (uint32_t i = 0; i < N; i++) {
        points[3 * i] = cos(6.283 * i / N);
        points[3 * i + 1] = sin(6.283 * i / N);
        memcpy(&triangles[3 * i], (uint32_t[3]){N, i, (i + 1) % N}, sizeof(uint32_t[3]));
    }
    points[3 * N + 2] = 1;
    mw_surface *surface;
    mw_arrays arrays = {
        .points = points, .point_count = N + 1, .triangles = triangles, .triangle_count = N};
    assert_int_equal(mw_surface_create(&arrays, NULL, &surface, NULL), MW_OK);
    mw_line line = {{0, 0, 9}, {0, 0, -1}, {0}};
    for (uint32_t t = 0; t < N; t++) assert_int_equal(mw__lowest_touched(surface, &line, t), 0);
    /* triangles 499 and 500 are in the way, not in the answer */
    mw_surface_points(surface)[3 * 500] = NAN;
    for (uint32_t t = 0; t < N; t++) {
        bool whole = t != 499 && t != 500;
        assert_int_equal(mw__line_touches(surface, &line, t), whole);
        if (whole) assert_int_equal(mw__lowest_touched(surface, &line, t), 0);
    }
    mw_surface_destroy(surface);
}

/* Triangles that a weld joined are neighbours still when their vertices move apart, but no longer
 * at one place. */
static void test_parted_weld(void **unused)
{
    (void)unused;
    const double points[] = {2, 0, 0, 0, 0, 0, 1, -2, 0, 0, 0, 0, 2, 0, 0, 1, 2, 0};
    const uint32_t triangles[] = {0, 1, 2, 3, 4, 5};
    mw_arrays arrays = {
        .points = points, .point_count = 6, .triangles = triangles, .triangle_count = 2};
    mw_surface_options options = {.weld = 1};
    mw_surface *surface;
    assert_int_equal(mw_surface_create(&arrays, &options, &surface, NULL), MW_OK);
    mw_line edge = {{1, 0, 5}, {0, 0, -1}, {0}}, vertex = {{0, 0, 5}, {0, 0, -1}, {0}};
    assert_int_equal(mw__lowest_touched(surface, &edge, 1), 0);
    assert_int_equal(mw__lowest_touched(surface, &vertex, 1), 0);
    mw_surface_begin_update(surface);
    for (int i = 0; i < 3; i++) mw_surface_points(surface)[3 * i + 2] = 1;
    mw_surface_end_update(surface);
    assert_true(mw__line_touches(surface, &edge, 0) && mw__line_touches(surface, &edge, 1));
    assert_int_equal(mw__lowest_touched(surface, &edge, 1), 1);
    assert_int_equal(mw__lowest_touched(surface, &vertex, 1), 1);
    mw_surface_destroy(surface);
}

static void test_no_touch(void **unused)
{
    (void)unused;
    mw_touch touch = mw__touch_none(MW_TOUCH_LIMIT);
    assert_true(touch.state == MW_TOUCH_LIMIT && touch.triangle == MW_NONE &&
                touch.where == MW_BAD);
    assert_true(touch.local == 255 && isnan(touch.distance) && isnan(touch.weight[0]) &&
                isnan(touch.weight[2]));
}

static int set_up(void **unused)
{
    (void)unused;
    cases_seed();
    predicate_oracle_init(&truth);
    line_oracle_init(&line_truth);
    return 0;
}

static int tear_down(void **unused)
{
    (void)unused;
    predicate_oracle_clear(&truth);
    line_oracle_clear(&line_truth);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_sides), cmocka_unit_test(test_sides),
        cmocka_unit_test(test_bound),       cmocka_unit_test(test_comparisons),
        cmocka_unit_test(test_distances),   cmocka_unit_test(test_weights),
        cmocka_unit_test(test_touches),     cmocka_unit_test(test_large_fan),
        cmocka_unit_test(test_parted_weld), cmocka_unit_test(test_no_touch),
    };
    return cmocka_run_group_tests_name("line", tests, set_up, tear_down);
}
