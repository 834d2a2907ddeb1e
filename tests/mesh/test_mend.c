/* Mending: embeddings that were damaged become embeddings that cover the same places, judged by
 * brute force in integers; of any soup nothing is lost. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/domain_oracle.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

typedef struct damage {
    arrays sound, a; /* the embedding, and what was made of it */
    uint64_t random;
} damage;

static uint32_t damage_below(damage *d, uint32_t n)
{
    return mw__random_below(&d->random, n);
}

/* A grid with holes; coordinates are multiples of 12, so that edges have thirds and quarters. */
static void damage_begin(damage *d, uint32_t n)
{
    arrays grid = arrays_grid(n, 0, &d->random);
    arrays_transform(&grid, 12, -12, 24);
    if (damage_below(d, 3) > 0) arrays_punch(&grid, random_unit(&d->random) * 0.6, &d->random);
    d->sound = grid;
    d->a = arrays_make(4096, 8192);
    for (uint32_t i = 0; i < grid.point_count; i++)
        arrays_point(&d->a, grid.points[2 * i], grid.points[2 * i + 1]);
    for (uint32_t i = 0; i < grid.triangle_count; i++) {
        const uint32_t *v = grid.triangles + 3 * (size_t)i;
        arrays_triangle(&d->a, v[0], v[1], v[2]);
    }
}

static void damage_end(damage *d)
{
    arrays_free(&d->sound);
    arrays_free(&d->a);
}

/* Put vertices into an edge of triangle t, which becomes a fan; with `flat`, fill the gap to its
 * neighbour with triangles without area. */
static void damage_break_edge(damage *d, uint32_t t, bool flat)
{
    arrays *a = &d->a;
    uint32_t k = damage_below(d, 3), count = 1 + damage_below(d, 3);
    const uint32_t *v = a->triangles + 3 * (size_t)t;
    uint32_t from = v[k], to = v[(k + 1) % 3], apex = v[(k + 2) % 3], last = from;
    for (uint32_t i = 1; i <= count + 1; i++) {
        double s = i / (count + 1.0);
        uint32_t next =
            i > count
                ? to
                : arrays_point(a, rint((1 - s) * a->points[2 * from] + s * a->points[2 * to]),
                               rint((1 - s) * a->points[2 * from + 1] + s * a->points[2 * to + 1]));
        if (i == 1) {
            const uint32_t first[3] = {from, next, apex};
            memcpy(a->triangles + 3 * (size_t)t, first, sizeof first);
        } else {
            arrays_triangle(a, last, next, apex);
            if (flat) arrays_triangle(a, from, next, last);
        }
        last = next;
    }
}

/* Give some corners a vertex of their own at the same place. */
static void damage_tear(damage *d, double share)
{
    arrays *a = &d->a;
    for (uint32_t i = 0; i < 3 * a->triangle_count; i++) {
        if (random_unit(&d->random) >= share) continue;
        uint32_t v = a->triangles[i];
        a->triangles[i] = arrays_point(a, a->points[2 * v], a->points[2 * v + 1]);
    }
}

static void damage_repeat(damage *d)
{
    uint32_t n = d->a.triangle_count, v[3];
    for (uint32_t i = damage_below(d, 5); i > 0; i--) {
        memcpy(v, d->a.triangles + 3 * (size_t)damage_below(d, n), sizeof v);
        if (damage_below(d, 2)) mw__swap(&v[0], &v[1]);
        arrays_triangle(&d->a, v[2], v[0], v[1]);
        if (damage_below(d, 2)) arrays_triangle(&d->a, v[0], v[1], v[0]);
    }
}

static void damage_make(damage *d)
{
    damage_begin(d, 1 + damage_below(d, 5));
    uint32_t n = d->sound.triangle_count;
    double broken = random_unit(&d->random);
    for (uint32_t t = 0; t < n; t++)
        if (random_unit(&d->random) < broken) damage_break_edge(d, t, damage_below(d, 2));
    damage_repeat(d);
    if (damage_below(d, 2)) damage_tear(d, random_unit(&d->random));
    arrays_scramble(&d->a, 1, &d->random);
}

/* --- what is mended --- */

static mw_mended mend(const arrays *a, mw_mend_options options)
{
    mw_error error;
    mw_mended m;
    mw_arrays view = arrays_view(a);
    expect_ok(mw_mend_arrays(&view, &options, &m, &error), "mending", &error);
    return m;
}

static arrays mended_arrays(const arrays *a, const mw_mended *m)
{
    arrays out = arrays_make((uint32_t)m->vertex_count + 1, (uint32_t)m->triangle_count + 1);
    for (size_t i = 0; i < m->vertex_count; i++)
        arrays_point(&out, a->points[2 * m->vertex_from[i]], a->points[2 * m->vertex_from[i] + 1]);
    for (size_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *v = m->triangles + 3 * t;
        assert_true(v[0] < out.point_count && v[1] < out.point_count && v[2] < out.point_count);
        arrays_triangle(&out, v[0], v[1], v[2]);
    }
    return out;
}

static double turn(const arrays *a, const uint32_t *v, uint32_t t)
{
    v += 3 * (size_t)t;
    return mw_orient2d(a->points + 2 * v[0], a->points + 2 * v[1], a->points + 2 * v[2]);
}

static bool holds_point(const arrays *a, uint32_t t, const double q[2])
{
    const uint32_t *v = a->triangles + 3 * (size_t)t;
    double s[3], area = turn(a, a->triangles, t);
    if (area == 0) return false;
    for (int k = 0; k < 3; k++)
        s[k] = mw_orient2d(a->points + 2 * v[k], a->points + 2 * v[(k + 1) % 3], q);
    return area > 0 ? s[0] >= 0 && s[1] >= 0 && s[2] >= 0 : s[0] <= 0 && s[1] <= 0 && s[2] <= 0;
}

static uint32_t count_holders(const arrays *a, const double q[2])
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < a->triangle_count; t++) count += holds_point(a, t, q);
    return count;
}

static double area_of(const arrays *a)
{
    double sum = 0;
    for (uint32_t t = 0; t < a->triangle_count; t++) sum += fabs(turn(a, a->triangles, t));
    return sum;
}

/* The maps fit each other, and each part lies in its triangle. */
static void expect_maps(const arrays *a, const arrays *out, const mw_mended *m)
{
    for (size_t i = 0; i < m->vertex_count; i++)
        assert_int_equal(m->vertex_to[m->vertex_from[i]], i);
    for (size_t i = 1; i < m->vertex_count; i++)
        assert_true(m->vertex_from[i - 1] < m->vertex_from[i]);
    for (uint32_t v = 0; v < a->point_count; v++) assert_true(m->vertex_to[v] < m->vertex_count);
    for (size_t t = 0; t < m->triangle_count; t++) {
        assert_true(t == 0 || m->triangle_from[t - 1] <= m->triangle_from[t]);
        for (int k = 0; k < 3; k++)
            assert_true(holds_point(a, m->triangle_from[t],
                                    out->points + 2 * m->triangles[3 * t + (size_t)k]));
    }
}

static void expect_unchanged(const arrays *out, mw_mend_options options)
{
    mw_mended again = mend(out, options);
    assert_int_equal(again.change_count, 0);
    assert_int_equal(again.triangle_count, out->triangle_count);
    assert_memory_equal(again.triangles, out->triangles,
                        3 * out->triangle_count * sizeof *out->triangles);
    mw_mended_release(&again);
}

static void test_damaged_embeddings(void **state)
{
    (void)state;
    size_t welded = 0, split = 0, flat = 0;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        damage d = {.random = mw__random_seed(seed, 0)};
        damage_make(&d);
        mw_mended m = mend(&d.a, (mw_mend_options){0});
        arrays out = mended_arrays(&d.a, &m);
        for (size_t i = 0; i < m.change_count; i++) {
            welded += m.changes[i].kind == MW_MEND_WELDED;
            split += m.changes[i].kind == MW_MEND_SPLIT;
            flat += m.changes[i].kind == MW_MEND_DROPPED_FLAT;
        }
        expect_maps(&d.a, &out, &m);
        if (!domain_oracle_is_embedding(&out)) fail_msg("seed %u: no embedding", (unsigned)seed);
        assert_true(area_of(&out) == area_of(&d.sound));
        for (uint32_t t = 0; t < out.triangle_count; t++)
            assert_true(turn(&out, out.triangles, t) > 0);
        for (int i = 0; i < 30; i++) {
            const double q[2] = {-14 + 65 * random_unit(&d.random),
                                 22 + 65 * random_unit(&d.random)};
            assert_int_equal(count_holders(&out, q) > 0, count_holders(&d.sound, q) > 0);
        }
        expect_unchanged(&out, (mw_mend_options){0});
        arrays_free(&out);
        mw_mended_release(&m);
        damage_end(&d);
    }
    assert_true(welded > 500 && split > 500 && flat > 500);
}

/* Any triangles over any points: the same places are covered, nothing else happens than what was
 * asked for, and a second time nothing. */
static void test_soups(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 1500; seed++) {
        damage d = {.a = arrays_make(64, 64),
                    .sound = arrays_make(1, 1),
                    .random = mw__random_seed(seed, 7)};
        uint32_t grid = 2 + damage_below(&d, 5), points = 3 + damage_below(&d, 9),
                 n = 1 + damage_below(&d, 12);
        for (uint32_t i = 0; i < points; i++)
            arrays_point(&d.a, damage_below(&d, grid), damage_below(&d, grid));
        for (uint32_t i = 0; i < n; i++)
            arrays_triangle(&d.a, damage_below(&d, points), damage_below(&d, points),
                            damage_below(&d, points));
        mw_mend_options options = {.repairs = damage_below(&d, 16)};
        mw_mended m = mend(&d.a, options);
        arrays out = mended_arrays(&d.a, &m);
        uint32_t asked = options.repairs ? options.repairs : (uint32_t)MW_REPAIR_ALL;
        static const uint32_t needs[MW_MEND_CHANGE_COUNT] = {
            MW_REPAIR_WELD, MW_REPAIR_DROP, MW_REPAIR_DROP,  MW_REPAIR_DROP,
            MW_REPAIR_DROP, MW_REPAIR_DROP, MW_REPAIR_SPLIT, MW_REPAIR_ORIENT};
        for (size_t i = 0; i < m.change_count; i++) assert_true(asked & needs[m.changes[i].kind]);
        for (int i = 0; i < 30; i++) {
            const double q[2] = {grid * random_unit(&d.random), grid * random_unit(&d.random)};
            if ((count_holders(&out, q) > 0) != (count_holders(&d.a, q) > 0))
                fail_msg("seed %u", (unsigned)seed);
        }
        expect_unchanged(&out, options);
        arrays_free(&out);
        mw_mended_release(&m);
        damage_end(&d);
    }
}

/* --- one kind of damage after the other --- */

static void expect_changes(const mw_mended *m, const char *texts)
{
    char all[512] = "", one[128];
    for (size_t i = 0; i < m->change_count; i++) {
        mw_mend_change_describe(&m->changes[i], one, sizeof one);
        strncat(all, one, sizeof all - strlen(all) - 1);
        strncat(all, "\n", sizeof all - strlen(all) - 1);
    }
    assert_string_equal(all, texts);
}

static void test_changes_are_told(void **state)
{
    (void)state;
    double points[] = {0, 0, 4, 0, 0, 4, 4, 0, 4, 4, 0, 4, 2, 2, NAN, 0};
    uint32_t triangles[] = {0, 1, 2, 3, 6, 4, 6, 4, 5, 4, 6, 1, 0, 7, 1, 0, 3, 1, 9, 0, 1, 1, 6, 2};
    arrays a = {points, triangles, 8, 8};
    mw_mended m = mend(&a, (mw_mend_options){0});
    expect_changes(&m, "vertex 3: welded to vertex 1\n"
                       "vertex 5: welded to vertex 2\n"
                       "triangle 4: dropped: vertex 7 is not finite\n"
                       "triangle 5: dropped: it has vertex 1 twice\n"
                       "triangle 6: dropped: it has a vertex that does not exist\n"
                       "triangle 7: dropped: it has no area\n"
                       "triangle 3: dropped: it has the vertices of triangle 1\n"
                       "triangle 0: split at vertex 6\n"
                       "triangle 1: turned\n");
    mw_mended_release(&m);
}

/* Many vertices in one, two and all sides of a triangle. */
static void test_all_sides_are_split(void **state)
{
    (void)state;
    for (uint32_t sides = 1; sides < 8; sides++)
        for (uint32_t n = 1; n < 7; n++) {
            arrays a = arrays_make(64, 64);
            const double corner[3][2] = {{0, 0}, {60, 0}, {0, 60}},
                         apex[3][2] = {{30, -90}, {90, 90}, {-90, 30}};
            uint32_t first = 0;
            for (int k = 0; k < 3; k++) arrays_point(&a, corner[k][0], corner[k][1]);
            arrays_triangle(&a, 0, 1, 2);
            for (uint32_t k = 0; k < 3; k++) {
                const double *p = corner[k], *q = corner[(k + 1) % 3];
                uint32_t tip = arrays_point(&a, apex[k][0], apex[k][1]),
                         count = sides >> k & 1 ? n : 0, last = k;
                for (uint32_t i = 1; i <= count; i++, last = first) {
                    double s = i / (count + 1.0);
                    first = arrays_point(&a, rint(p[0] + s * (q[0] - p[0])),
                                         rint(p[1] + s * (q[1] - p[1])));
                    arrays_triangle(&a, last, tip, first);
                }
                arrays_triangle(&a, last, tip, (k + 1) % 3);
            }
            mw_mended m = mend(&a, (mw_mend_options){.repairs = MW_REPAIR_SPLIT});
            arrays out = mended_arrays(&a, &m);
            /* rounded to integers, the places are on the edges where n + 1 divides 60 */
            if (60 % (n + 1) == 0) {
                assert_int_equal(m.change_count, n * (uint32_t)__builtin_popcount(sides));
                assert_true(domain_oracle_is_embedding(&out));
                assert_true(area_of(&out) == area_of(&a));
            }
            arrays_free(&out);
            mw_mended_release(&m);
            arrays_free(&a);
        }
}

/* Within a tolerance: torn vertices that moved apart by less, and vertices that nearly lie in an
 * edge. */
static void test_tolerance(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 50; seed++) {
        damage d = {.random = mw__random_seed(seed, 3)};
        damage_begin(&d, 4);
        for (uint32_t t = 0; t < d.sound.triangle_count; t += 3) damage_break_edge(&d, t, false);
        damage_tear(&d, 0.5);
        for (uint32_t i = 0; i < 2 * d.a.point_count; i++)
            d.a.points[i] += 1e-7 * random_unit(&d.random);
        mw_mended m = mend(&d.a, (mw_mend_options){.tolerance = 1e-6});
        arrays out = mended_arrays(&d.a, &m);
        mw_arrays view = arrays_view(&out);
        mw_check check;
        assert_int_equal(mw_check_arrays(&view, NULL, &check, NULL), MW_OK);
        if (!check.valid) fail_msg("seed %u: %zu defects", (unsigned)seed, check.defect_count);
        mw_check_release(&check);
        assert_true(fabs(area_of(&out) - area_of(&d.sound)) < 1e-3);
        arrays_free(&out);
        mw_mended_release(&m);
        damage_end(&d);
    }
}

/* No chain of near vertices becomes one; each goes to the lowest within reach that is kept. */
static void test_chains_do_not_collapse(void **state)
{
    (void)state;
    arrays a = arrays_make(10, 1);
    for (int i = 0; i < 10; i++) arrays_point(&a, i, 0);
    mw_mended m = mend(&a, (mw_mend_options){.tolerance = 1});
    const uint32_t to[] = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4};
    assert_int_equal(m.vertex_count, 5);
    assert_memory_equal(m.vertex_to, to, sizeof to);
    mw_mended_release(&m);
    arrays_free(&a);
}

/* --- in space --- */

static void expect_surface(const mw_arrays *view, const mw_mended *m, uint32_t triangles,
                           bool closed)
{
    double *points = malloc((3 * m->vertex_count + 1) * sizeof *points);
    for (size_t i = 0; i < m->vertex_count; i++)
        memcpy(points + 3 * i, view->points + 3 * (size_t)m->vertex_from[i], 3 * sizeof *points);
    mw_arrays out = {.points = points,
                     .point_count = m->vertex_count,
                     .point_stride = 3,
                     .triangles = m->triangles,
                     .triangle_count = m->triangle_count};
    mw_check check;
    mw_star_options centre = {0};
    assert_int_equal(mw_surface_check_arrays(&out, 0, NULL, &check, NULL), MW_OK);
    assert_int_equal(check.defect_count, 0);
    mw_check_release(&check);
    assert_int_equal(m->triangle_count, triangles);
    assert_int_equal(mw_star_check_arrays(&out, 0, &centre, &check, NULL), MW_OK);
    if (closed) assert_int_equal(check.defect_count, 0);
    mw_check_release(&check);
    free(points);
}

static void test_space(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        uint64_t random = mw__random_seed(seed, 4);
        star_shape ball = star_shape_octahedron(3);
        uint32_t triangles = ball.triangles, flats = 0;
        for (int i = 0; i < 20; i++)
            flats += star_shape_add_flat(&ball, mw__random_below(&random, triangles),
                                         mw__random_below(&random, 3));
        /* the middle of an edge stays a vertex: each of the two triangles there becomes two */
        star_shape_shuffle(&ball, &random);
        star_shape_tear(&ball);
        mw_arrays view = star_shape_arrays(&ball);
        mw_mended m;
        mw_error error;
        expect_ok(mw_mend_arrays(&view, &(mw_mend_options){.space = 1}, &m, &error), "mending",
                  &error);
        expect_surface(&view, &m, triangles + 2 * flats, true);
        mw_mended_release(&m);
        star_shape_free(&ball);
    }
}

/* In space, a vertex splits the edge that it is near, but not one that ends before it. */
static void test_space_tolerance(void **state)
{
    (void)state;
    static const struct {
        double at[3], tolerance; /* of vertex 3, beside the edge from (0, 0, 0) to (2, 0, 0) */
        uint32_t triangles;
    } cases[] = {
        {{0.5, 3e-7, 4e-7}, 5.1e-7, 4},   {{0.5, 3e-7, 4e-7}, 4.9e-7, 3},
        {{0.5, -3e-7, -4e-7}, 5.1e-7, 4}, {{0.5, 0, 4e-7}, 4.1e-7, 4},
        {{0.5, 4e-7, 0}, 3.9e-7, 3},      {{2.5, 0, 0}, 1e-3, 3},
        {{-0.5, 0, 0}, 1e-3, 3},          {{1.5, 1e-3, 0}, 1.1e-3, 4},
    };
    static const uint32_t triangles[] = {0, 1, 2, 0, 4, 3, 3, 4, 1};
    for (int axes = 0; axes < 3; axes++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            const double *at = cases[i].at,
                         flat[15] = {0, 0, 0, 2, 0, 0, 1, 2, 1, at[0], at[1], at[2], 1, -2, 1};
            double points[15];
            for (int k = 0; k < 15; k++) points[k - k % 3 + (k + axes) % 3] = flat[k];
            mw_arrays view = {.points = points,
                              .point_count = 5,
                              .point_stride = 3,
                              .triangles = triangles,
                              .triangle_count = 3};
            mw_mend_options options = {.space = 1, .tolerance = cases[i].tolerance};
            mw_mended m;
            mw_error error;
            expect_ok(mw_mend_arrays(&view, &options, &m, &error), "mending", &error);
            if (m.triangle_count != cases[i].triangles)
                fail_msg("case %zu, axes %d: %zu triangles", i, axes, (size_t)m.triangle_count);
            mw_mended_release(&m);
        }
}

/* In space, vertices within the tolerance become one; a little farther apart they stay two. */
static void test_space_weld(void **state)
{
    (void)state;
    static const double apart[][3] = {{1, 2, 2}, {-2, 1, 2}, {2, -2, -1}, {3, 0, 0}, {0, 0, -3}};
    static const uint32_t triangles[] = {0, 1, 2, 3, 4, 1};
    for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
        for (int near = 0; near < 2; near++) {
            /* vertex 3 is as far from vertex 2 as the vector is long: 3 */
            const double *d = apart[i],
                         points[15] = {0, 0,         0,         90,       0,   7,  80, 70,
                                       9, 80 + d[0], 70 + d[1], 9 + d[2], 190, 95, 3};
            mw_arrays view = {.points = points,
                              .point_count = 5,
                              .point_stride = 3,
                              .triangles = triangles,
                              .triangle_count = 2};
            mw_mend_options options = {
                .repairs = MW_REPAIR_WELD, .space = 1, .tolerance = near ? 3.000001 : 2.999999};
            mw_mended m;
            mw_error error;
            expect_ok(mw_mend_arrays(&view, &options, &m, &error), "mending", &error);
            assert_int_equal(m.vertex_count, near ? 4 : 5);
            assert_int_equal(m.triangle_count, 2);
            assert_int_equal(m.triangles[3] == m.triangles[2], near);
            mw_mended_release(&m);
        }
}

/* A band of Moebius has no orientation: it is kept, and a check names the clash. */
static void test_moebius(void **state)
{
    (void)state;
    double points[3 * 16];
    uint32_t triangles[3 * 16];
    for (uint32_t i = 0; i < 8; i++) {
        double angle = i * 3.14159265358979 / 4, half = angle / 2;
        for (uint32_t k = 0; k < 2; k++) {
            double r = 2 + (k ? 0.5 : -0.5) * cos(half), *p = points + 3 * (2 * i + k);
            p[0] = r * cos(angle), p[1] = r * sin(angle), p[2] = (k ? 0.5 : -0.5) * sin(half);
        }
        uint32_t a = 2 * i, b = a + 1, c = i < 7 ? a + 2 : 1, d = i < 7 ? a + 3 : 0;
        memcpy(triangles + 6 * i, (uint32_t[]){a, b, c, b, d, c}, 6 * sizeof *triangles);
    }
    mw_arrays view = {.points = points,
                      .point_count = 16,
                      .point_stride = 3,
                      .triangles = triangles,
                      .triangle_count = 16};
    mw_mended m;
    mw_check check;
    assert_int_equal(mw_mend_arrays(&view, &(mw_mend_options){.space = 1}, &m, NULL), MW_OK);
    assert_int_equal(m.triangle_count, 16);
    view.triangles = m.triangles;
    assert_int_equal(mw_surface_check_arrays(&view, 0, NULL, &check, NULL), MW_OK);
    assert_true(check.defect_count > 0 && check.defects[0].kind == MW_DEFECT_CLASHING);
    mw_check_release(&check);
    mw_mended_release(&m);
}

/* --- wrong calls --- */

static void test_refusals(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 0, 0, 1};
    const uint32_t triangles[] = {0, 1, 2, 0, 1, 3};
    mw_arrays view = {
        .points = points, .point_count = 3, .triangles = triangles, .triangle_count = 2};
    mw_error error;
    mw_mended m;
    assert_int_equal(mw_mend_arrays(&view, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mend_arrays(NULL, NULL, &m, &error), MW_ERROR_ARGUMENT);
    const mw_mend_options wrong[] = {{.repairs = 16},         {.space = 2},
                                     {.tolerance = -1},       {.tolerance = NAN},
                                     {.tolerance = INFINITY}, {.reserved = {1}}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(mw_mend_arrays(&view, &wrong[i], &m, &error), MW_ERROR_ARGUMENT);
        assert_null(m.triangles);
    }
    mw_mend_options weld = {.repairs = MW_REPAIR_WELD};
    assert_int_equal(mw_mend_arrays(&view, &weld, &m, &error), MW_ERROR_INPUT);
    assert_int_equal(error.triangle, 1);
    assert_int_equal(mw_mend_arrays(&(mw_arrays){0}, NULL, &m, &error), MW_OK);
    assert_int_equal(m.triangle_count + m.vertex_count + m.change_count, 0);
    mw_mended_release(&m);
    mw_mended_release(&m);
    mw_mended_release(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_damaged_embeddings),
        cmocka_unit_test(test_soups),
        cmocka_unit_test(test_changes_are_told),
        cmocka_unit_test(test_all_sides_are_split),
        cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_chains_do_not_collapse),
        cmocka_unit_test(test_space),
        cmocka_unit_test(test_space_tolerance),
        cmocka_unit_test(test_space_weld),
        cmocka_unit_test(test_moebius),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
