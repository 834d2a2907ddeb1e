/* test_clip.c - what a triangle and a convex polygon have in common, held against rationals: on
 * integers, where corners lie on edges and edges on each other, anywhere, in needles; and sums over
 * cells that tile the plane. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "clip/clip.h"
#include "oracle/clip/clip_oracle.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct shape_pair {
    mw_point p[3], q[MW_CLIP_SIDES];
    uint32_t m;
} shape_pair;

static double anywhere(uint64_t *random, int finer)
{
    return finer ? 8 * random_unit(random) : (double)(mw__random(random) % 9);
}

static void turn_left(mw_point *p)
{
    if (mw__orient2d(p[0], p[1], p[2]) >= 0) return;
    mw_point swap = p[1];
    p[1] = p[2];
    p[2] = swap;
}

static void make_triangle(mw_point *p, uint64_t *random, int finer)
{
    do
        for (int i = 0; i < 3; i++)
            p[i] = (mw_point){anywhere(random, finer), anywhere(random, finer)};
    while (mw__orient2d(p[0], p[1], p[2]) == 0);
    turn_left(p);
}

/* A triangle, a pixel, or an octagon. */
static void make_polygon(shape_pair *s, uint64_t *random, int finer)
{
    static const mw_point octagon[8] = {{1, 0}, {2, 0}, {3, 1}, {3, 2},
                                        {2, 3}, {1, 3}, {0, 2}, {0, 1}};
    uint64_t kind = mw__random(random) % 3;
    s->m = kind == 0 ? 3 : kind == 1 ? 4 : 8;
    if (kind == 0) {
        make_triangle(s->q, random, finer);
        return;
    }
    double x = anywhere(random, finer), y = anywhere(random, finer),
           w = 1 + floor(anywhere(random, 0)), h = 1 + floor(anywhere(random, 0));
    mw_point pixel[4] = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    for (uint32_t j = 0; j < s->m; j++)
        s->q[j] = kind == 1 ? pixel[j] : (mw_point){x + octagon[j].x, y + octagon[j].y};
}

static double size_of(const shape_pair *s)
{
    double p = mw__orient2d(s->p[0], s->p[1], s->p[2]),
           q = mw__orient2d(s->q[0], s->q[1], s->q[s->m - 1]);
    return fmin(p, q) / 2;
}

/* Areas and integrals within 2^-40 of the smaller of the two, and no common part where there is no
 * area. */
static void expect_clip(const shape_pair *s, uint64_t *random)
{
    mw_clip clip;
    uint32_t n = mw__clip(s->p, s->q, s->m, &clip);
    mw_clip_integral is = mw__clip_integral(&clip);
    double f[3], g[3], size = size_of(s), sum = 0, value = 0, x = 0;
    for (int i = 0; i < 3; i++) {
        f[i] = (double)(mw__random(random) % 100) - 50;
        g[i] = (double)(mw__random(random) % 100) - 50;
    }
    clip_sums should = clip_oracle_sums(&s->p[0].x, f, &s->q[0].x, s->m, g);
    if (n == 0 || should.area == 0) {
        assert_int_equal(n, 0);
        assert_true(should.area == 0);
    }
    assert_true(n == 0 || (n >= 3 && n <= s->m + 3));
    assert_true(fabs(is.area - should.area) <= 0x1p-40 * size);
    const mw_point frame[3] = {s->q[0], s->q[1], s->q[s->m - 1]};
    for (int i = 0; i < 3; i++) {
        sum += is.p[i];
        value += is.p[i] * f[i] - is.q[i] * g[i];
        x += is.q[i] * frame[i].x;
    }
    double most = 0;
    for (int i = 0; i < 3; i++) most = fmax(most, fabs(is.q[i]));
    assert_true(fabs(sum - is.area) <= 0x1p-40 * size);
    assert_true(fabs(value - (should.above - should.below)) <= 0x1p-32 * (size + most) * 100);
    assert_true(fabs(x - should.x) <= 0x1p-32 * (size + most) * 100);
    for (uint32_t i = 0; i < n; i++) {
        const double *p = clip.corner[i].p, *q = clip.corner[i].q;
        for (int k = 0; k < 3; k++) {
            assert_true(p[k] >= 0);
            assert_true(s->m > 3 || q[k] >= 0);
        }
        assert_true(fabs(p[0] + p[1] + p[2] - 1) <= 0x1p-40);
        assert_true(fabs(q[0] + q[1] + q[2] - 1) <= 0x1p-32 * (1 + fabs(q[0]) + fabs(q[2])));
    }
}

static void test_pairs(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("pairs", 26);
    long rounds = environment_is_long() ? 400000 : 8000;
    for (long r = 0; r < rounds; r++) {
        shape_pair s;
        make_triangle(s.p, &random, r & 1);
        make_polygon(&s, &random, r & 2);
        /* Far from the origin, with coordinates rounded as users' are. */
        if (r % 5 == 4) {
            for (int i = 0; i < 3; i++) s.p[i].x += 500000, s.p[i].y += 4e6;
            for (uint32_t j = 0; j < s.m; j++) s.q[j].x += 500000, s.q[j].y += 4e6;
            if (mw__orient2d(s.p[0], s.p[1], s.p[2]) <= 0) continue;
        }
        expect_clip(&s, &random);
    }
}

/* Needles across needles: both are 2^-30 wide. */
static void test_needles(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("needles", 27);
    for (int r = 0; r < 1000; r++) {
        shape_pair s = {.m = 3};
        double x = 1 + random_unit(&random), y = random_unit(&random), e = 0x1p-30;
        mw_point p[3] = {{0, 0}, {x, y}, {x * (1 - e), y + e * random_unit(&random)}};
        mw_point q[3] = {{0, e * random_unit(&random)}, {x, y - e}, {x, y + e}};
        memcpy(s.p, p, sizeof p);
        memcpy(s.q, q, sizeof q);
        turn_left(s.p);
        turn_left(s.q);
        if (size_of(&s) > 0) expect_clip(&s, &random);
    }
}

/* The parts of a triangle in the cells of a grid are the whole, however small the cells and however
 * many corners lie on their edges; so are those in the triangles that the cells are cut into. */
static void test_sums(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("sums", 28);
    for (int r = 0; r < 200; r++) {
        mw_point p[3];
        make_triangle(p, &random, r & 1);
        double shift = r & 2 ? 1e6 : 0, cell = 1.0 / (1 + r % 7), area = 0, halves = 0;
        for (int i = 0; i < 3; i++) p[i].x += shift;
        double whole = mw__orient2d(p[0], p[1], p[2]) / 2;
        for (int row = 0; row * cell < 9; row++)
            for (int column = 0; column * cell < 9; column++) {
                double x = shift + column * cell, x2 = shift + (column + 1) * cell, y = row * cell,
                       y2 = (row + 1) * cell;
                mw_point q[4] = {{x, y}, {x2, y}, {x2, y2}, {x, y2}};
                mw_point u[3] = {q[0], q[1], q[2]}, v[3] = {q[0], q[2], q[3]};
                mw_clip clip;
                mw__clip(p, q, 4, &clip);
                area += mw__clip_integral(&clip).area;
                mw__clip(p, u, 3, &clip);
                halves += mw__clip_integral(&clip).area;
                mw__clip(p, v, 3, &clip);
                halves += mw__clip_integral(&clip).area;
            }
        assert_true(fabs(area - whole) <= 1e-13 * whole);
        assert_true(fabs(halves - whole) <= 1e-13 * whole);
    }
}

/* Do they touch? A square and triangles that meet it in a corner, along an edge, or not. */
static void test_touching(void **state)
{
    (void)state;
    const mw_point q[4] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    const mw_point corner[3] = {{2, 2}, {3, 2}, {3, 3}}, edge[3] = {{2, 1}, {4, 0}, {4, 5}},
                   off[3] = {{2.5, 1}, {4, 0}, {4, 5}}, slanted[3] = {{3, 2}, {3, 3}, {2, 3}};
    mw_clip clip;
    assert_true(mw__clip_touches(corner, q, 4));
    assert_true(mw__clip_touches(edge, q, 4));
    assert_false(mw__clip_touches(off, q, 4));
    assert_false(mw__clip_touches(slanted, q, 4));
    assert_int_equal(mw__clip(corner, q, 4, &clip), 0);
    assert_int_equal(mw__clip(edge, q, 4, &clip), 0);
    assert_true(mw__clip_integral(&clip).area == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_needles),
        cmocka_unit_test(test_sums),
        cmocka_unit_test(test_touching),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
