/* test_volume.c - volumes between surfaces, held against brute force over all pairs of triangles in
 * rationals: meshes with holes, pockets and several components, turned triangles, vertices at one
 * place with different heights, cut triangles, edges along edges. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/clip/clip_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh with heights, as a user has it and as the library does. */
typedef struct ground {
    arrays of;
    double *heights;
    mw_mesh *mesh;
    mw_locator *locator;
} ground;

static ground ground_make(arrays of, double range, uint64_t *random)
{
    ground g = {.of = of, .heights = malloc((of.point_count + 1) * sizeof(double))};
    for (uint32_t v = 0; v < of.point_count; v++)
        g.heights[v] = range < 0 ? (double)(mw__random(random) % 3) : range * random_unit(random);
    g.mesh = arrays_mesh(&g.of, (mw_mesh_options){.layout = (mw_mesh_layout)(of.point_count % 3)});
    g.locator = mesh_locator(g.mesh, (mw_locator_options){.threads = 1});
    return g;
}

static void ground_release(ground *g)
{
    mw_locator_destroy(g->locator);
    mw_mesh_destroy(g->mesh);
    free(g->heights);
    arrays_free(&g->of);
}

/* A triangle, counter-clockwise, with its heights. False if it is flat or has no heights. */
static int triangle_of(const ground *g, uint32_t t, double p[6], double z[3])
{
    const uint32_t *v = g->of.triangles + 3 * (size_t)t;
    for (uint32_t k = 0; k < 3; k++) {
        memcpy(p + 2 * (size_t)k, g->of.points + 2 * (size_t)v[k], 2 * sizeof *p);
        z[k] = g->heights[v[k]];
        if (!isfinite(z[k])) return 0;
    }
    double side = mw_orient2d(p, p + 2, p + 4);
    for (int i = 0; i < 2 && side < 0; i++) {
        double swap = p[2 + i];
        p[2 + i] = p[4 + i];
        p[4 + i] = swap;
    }
    if (side < 0) {
        double swap = z[1];
        z[1] = z[2];
        z[2] = swap;
    }
    return side != 0;
}

static double area_of(const ground *g)
{
    double p[6], z[3], sum = 0;
    for (uint32_t t = 0; t < g->of.triangle_count; t++)
        if (triangle_of(g, t, p, z)) sum += mw_orient2d(p, p + 2, p + 4) / 2;
    return sum;
}

static clip_sums sums_of(const ground *a, const ground *b)
{
    clip_sums all = {0};
    double p[6], q[6], f[3], g[3];
    for (uint32_t s = 0; s < a->of.triangle_count; s++)
        for (uint32_t t = 0; t < b->of.triangle_count; t++) {
            if (!triangle_of(a, s, p, f) || !triangle_of(b, t, q, g)) continue;
            clip_sums one = clip_oracle_sums(p, f, q, 3, g);
            all.area += one.area;
            all.above += one.above;
            all.below += one.below;
        }
    return all;
}

static mw_volume_info volume_of(const ground *a, const ground *b, uint32_t threads)
{
    mw_volume_info info;
    mw_error error;
    mw_volume_options options = {.threads = threads};
    expect_ok(
        mw_volume_between(a->locator, a->heights, b->locator, b->heights, &options, &info, &error),
        "a volume", &error);
    return info;
}

static void expect_near(double is, double should, double size)
{
    if (fabs(is - should) > 0x1p-38 * size) fail_msg("%.17g, not %.17g", is, should);
}

static void expect_volume(const ground *a, const ground *b, double range)
{
    mw_volume_info is = volume_of(a, b, 1), back = volume_of(b, a, 1), again = volume_of(a, b, 3);
    clip_sums should = sums_of(a, b);
    double of_a = area_of(a), of_b = area_of(b), size = fmin(of_a, of_b);
    expect_near(is.area, should.area, size);
    expect_near(is.cut, should.above, size * range);
    expect_near(is.fill, should.below, size * range);
    expect_near(is.cut_area + is.fill_area + is.level_area, should.area, size);
    expect_near(is.surface_only, of_a - should.area, of_a);
    expect_near(is.other_only, of_b - should.area, of_b);
    expect_near(back.cut, should.below, size * range);
    expect_near(back.fill_area, is.cut_area, size);
    expect_near(back.level_area, is.level_area, size);
    assert_true((is.parts == 0) == (should.area == 0));
    assert_int_equal(back.parts, is.parts);
    assert_true(is.parts <= (uint64_t)a->of.triangle_count * b->of.triangle_count * 4);
    assert_memory_equal(&is, &again, sizeof is);
}

static arrays random_arrays(uint64_t *random, int round)
{
    arrays m = arrays_grid(2 + (uint32_t)(mw__random(random) % 4), round & 1 ? 0.6 : 0, random);
    arrays_punch(&m, (double)(mw__random(random) % 3) * 0.3, random);
    arrays_scramble(&m, 1, random);
    return m;
}

/* On each other's vertices and edges, a little off, far off, inside each other. */
static void test_pairs(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume pairs", 1);
    for (int round = 0; round < (environment_is_long() ? 2000 : 50); round++) {
        static const double scales[] = {1, 0.5, 3, 0.1, 1.5};
        double range = round % 3 ? 1 : -1, scale = scales[round % 5],
               shift = (double)(mw__random(&random) % 9) / 2 - 2;
        ground a = ground_make(random_arrays(&random, round), range, &random);
        arrays m = random_arrays(&random, round / 2);
        arrays_transform(&m, scale, shift, round % 4 ? shift : 0.25);
        ground b = ground_make(m, range, &random);
        if (round % 6 == 5) a.heights[0] = NAN;
        expect_volume(&a, &b, range < 0 ? 2 : 1);
        ground_release(&b);
        ground_release(&a);
    }
}

/* Far from the origin, as in a national grid, with heights far from 0. */
static void test_far(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume far", 2);
    for (int round = 0; round < 4; round++) {
        arrays m = random_arrays(&random, 1), n = random_arrays(&random, 1);
        arrays_transform(&m, 10, 2600000, 1200000);
        arrays_transform(&n, 8, 2600003, 1200007);
        ground a = ground_make(m, 5, &random), b = ground_make(n, 5, &random);
        for (uint32_t v = 0; v < a.of.point_count; v++) a.heights[v] += 4000;
        for (uint32_t v = 0; v < b.of.point_count; v++) b.heights[v] += 4000;
        expect_volume(&a, &b, 5);
        ground_release(&b);
        ground_release(&a);
    }
}

/* Vertices at one place with heights of their own: a wall. And a triangle that is cut into tiles
 * because vertices lie inside its edge. */
static void test_walls(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume walls", 3);
    for (int round = 0; round < 10; round++) {
        arrays m = arrays_make(16, 16), grid = random_arrays(&random, round);
        uint32_t left = arrays_point(&m, 0, 0), right = arrays_point(&m, 6, 0),
                 low = arrays_point(&m, 3, -6), p = arrays_point(&m, 2, 0),
                 q = arrays_point(&m, 4, 0), top = arrays_point(&m, 3, 6),
                 twin = arrays_point(&m, 3, 6), far = arrays_point(&m, 8, 6);
        arrays_triangle(&m, left, low, right);
        arrays_triangle(&m, left, p, top);
        arrays_triangle(&m, p, q, top);
        arrays_triangle(&m, q, right, top);
        arrays_triangle(&m, left, right, p);
        arrays_triangle(&m, p, right, q);
        arrays_triangle(&m, right, far, twin);
        arrays_scramble(&m, 1, &random);
        arrays_transform(&m, 0.5, round % 2 ? 0.3 : 0, 2);
        ground a = ground_make(m, 1, &random), b = ground_make(grid, 1, &random);
        expect_volume(&a, &b, 1);
        ground_release(&b);
        ground_release(&a);
    }
}

/* A surface has no volume against itself, and against itself raised, its area times that. */
static void test_itself(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume itself", 4);
    arrays m = arrays_grid(12, 0.7, &random);
    arrays_punch(&m, 0.2, &random);
    ground a = ground_make(m, 1, &random);
    double *raised = malloc(m.point_count * sizeof *raised), whole = area_of(&a);
    for (uint32_t v = 0; v < m.point_count; v++) raised[v] = a.heights[v] + 2;
    mw_volume_info is = volume_of(&a, &a, 0), up;
    mw_error error;
    expect_near(is.area, whole, whole);
    assert_true(is.cut < 1e-12 && is.fill < 1e-12);
    assert_true(is.surface_only == 0 && is.other_only == 0);
    expect_ok(mw_volume_between(a.locator, raised, a.locator, a.heights, NULL, &up, &error),
              "a volume", &error);
    expect_near(up.cut, 2 * whole, whole);
    assert_true(up.fill == 0 && up.fill_area == 0 && up.level_area == 0);
    free(raised);
    ground_release(&a);
}

/* How much larger a triangle is than its image in the plane. */
static double slope_of(const double p[6], const double z[3])
{
    double ax = p[2] - p[0], ay = p[3] - p[1], az = z[1] - z[0], bx = p[4] - p[0], by = p[5] - p[1],
           bz = z[2] - z[0];
    double x = ay * bz - az * by, y = az * bx - ax * bz, w = ax * by - ay * bx;
    return sqrt(x * x + y * y + w * w) / w;
}

/* Areas of a surface over another mesh, which is a region. */
/* Two triangulations of one plane: it is level throughout, however the differences are rounded. */
static void test_one_plane(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume one plane", 8);
    ground g[2];
    for (int i = 0; i < 2; i++) {
        g[i] = ground_make(arrays_grid(6 + (uint32_t)i, 0.7, &random), 1, &random);
        const double scale = i == 0 ? 7 : 6; /* both fill the square from 0 to 42 */
        for (uint32_t v = 0; v < 2 * g[i].of.point_count; v++)
            g[i].of.points[v] = ldexp(round(ldexp(g[i].of.points[v] * scale, 20)), -20);
        mw_locator_destroy(g[i].locator);
        mw_mesh_destroy(g[i].mesh);
        g[i].mesh = arrays_mesh(&g[i].of, (mw_mesh_options){0});
        g[i].locator = mesh_locator(g[i].mesh, (mw_locator_options){.threads = 1});
        for (uint32_t v = 0; v < g[i].of.point_count; v++)
            g[i].heights[v] = 3 * g[i].of.points[2 * v] - 0.375 * g[i].of.points[2 * v + 1] + 1;
    }
    const mw_volume_info is = volume_of(&g[0], &g[1], 1);
    assert_true(is.cut == 0 && is.fill == 0 && is.cut_area == 0 && is.fill_area == 0);
    expect_near(is.level_area, 42 * 42, 42 * 42);
    g[0].heights[20] += 0x1p-40;
    const mw_volume_info raised = volume_of(&g[0], &g[1], 1);
    assert_true(raised.cut > 0 && raised.level_area < is.level_area - 1);
    ground_release(&g[0]);
    ground_release(&g[1]);
}

static void test_surface_area(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume area", 9);
    for (int round = 0; round < 12; round++) {
        arrays m = random_arrays(&random, round);
        arrays_transform(&m, 0.5, round % 2, 0.25);
        ground a = ground_make(random_arrays(&random, round + 1), 1, &random),
               b = ground_make(m, 1, &random);
        if (round % 4 == 3) a.heights[0] = NAN;
        double area = 0, surface = 0, p[6], q[6], f[3], g[3];
        for (uint32_t s = 0; s < a.of.triangle_count; s++)
            for (uint32_t t = 0; t < b.of.triangle_count; t++) {
                if (!triangle_of(&a, s, p, f) || !triangle_of(&b, t, q, g)) continue;
                double one = clip_oracle_sums(p, NULL, q, 3, NULL).area;
                area += one;
                surface += one * slope_of(p, f);
            }
        mw_surface_area_info is;
        mw_error error;
        expect_ok(mw_surface_area(a.locator, a.heights, b.locator, NULL, &is, &error), "an area",
                  &error);
        expect_near(is.area, area, area_of(&b));
        expect_near(is.surface_area, surface, 2 * area_of(&b));
        expect_near(is.region_area, area_of(&b), area_of(&b));
        ground_release(&b);
        ground_release(&a);
    }
}

/* A plane is a surface of two large triangles. */
static void test_above(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_volume above", 5);
    for (int round = 0; round < 12; round++) {
        ground a = ground_make(random_arrays(&random, round), round % 3 ? 1 : -1, &random);
        arrays m = arrays_grid(1, 0, &random);
        arrays_transform(&m, 30, -10, -10);
        ground b = ground_make(m, 1, &random);
        double base = round % 3 ? random_unit(&random) : 1;
        for (uint32_t v = 0; v < m.point_count; v++) b.heights[v] = base;
        mw_volume_info is;
        mw_error error;
        expect_ok(mw_volume_above(a.locator, a.heights, base, NULL, &is, &error), "a volume",
                  &error);
        clip_sums should = sums_of(&a, &b);
        expect_near(is.cut, should.above, 2 * should.area);
        expect_near(is.fill, should.below, 2 * should.area);
        expect_near(is.area, should.area, should.area);
        assert_true(is.surface_only == 0 && is.other_only == 0);
        ground_release(&b);
        ground_release(&a);
    }
}

/* An editor's locator: the mesh as it is. */
static void test_editor(void **state)
{
    (void)state;
    enum { MOST = 200 };
    uint64_t random = environment_print_seed("test_volume editor", 6);
    arrays grid = arrays_grid(4, 0, &random);
    ground flat = ground_make(arrays_grid(1, 0, &random), 0, &random);
    mw_mesh *mesh = arrays_mesh(&grid, (mw_mesh_options){.threads = 1});
    mw_editor *editor;
    mw_error error;
    expect_ok(mw_editor_create(mesh, NULL, &editor, &error), "an editor", &error);
    double heights[MOST];
    for (int i = 0; i < MOST; i++) heights[i] = 3;
    for (int i = 0; i < 30; i++) {
        mw_edit_insert(editor, 4 * random_unit(&random), 4 * random_unit(&random), NULL, &error);
        mw_volume_info is;
        expect_ok(mw_volume_between(mw_editor_locator(editor), heights, flat.locator, flat.heights,
                                    NULL, &is, &error),
                  "a volume", &error);
        expect_near(is.cut, 3, 1);
        expect_near(is.surface_only, 15, 1);
    }
    mw_editor_destroy(editor);
    mw_mesh_destroy(mesh);
    ground_release(&flat);
    arrays_free(&grid);
}

static void test_memory(void **state)
{
    (void)state;
    uint64_t random = 7;
    arrays fine = arrays_grid(40, 0.5, &random);
    arrays_transform(&fine, 0.07, 0, 0);
    ground a = ground_make(arrays_grid(3, 0.5, &random), 1, &random),
           b = ground_make(fine, 1, &random);
    mw_volume_options options = {.threads = 1};
    for (long failures = 0;; failures++) {
        mw_volume_info info;
        mw_error error = {0};
        allocations_left = failures;
        mw_status status =
            mw_volume_between(a.locator, a.heights, b.locator, b.heights, &options, &info, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        if (failed) continue;
        assert_true(failures > 4); /* a triangle of the first has more tiles than the queue */
        break;
    }
    ground_release(&b);
    ground_release(&a);
}

static void test_refusals(void **state)
{
    (void)state;
    uint64_t random = 8;
    arrays m = arrays_grid(4, 0, &random);
    arrays_punch(&m, 0.4, &random);
    ground a = ground_make(m, 1, &random);
    mw_locator *open = mesh_locator(a.mesh, (mw_locator_options){.fill = MW_FILL_NO});
    mw_volume_info info;
    mw_error error;
    const double *z = a.heights;
    assert_int_equal(mw_volume_between(open, z, a.locator, z, NULL, &info, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_volume_between(a.locator, z, open, z, NULL, &info, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_volume_between(a.locator, z, a.locator, NULL, NULL, &info, &error),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_volume_above(a.locator, z, NAN, NULL, &info, &error), MW_ERROR_ARGUMENT);
    mw_surface_area_info sizes;
    assert_int_equal(mw_surface_area(open, z, a.locator, NULL, &sizes, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_area(a.locator, z, NULL, NULL, &sizes, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_volume_above(a.locator, NULL, 0, NULL, &info, &error), MW_ERROR_ARGUMENT);
    arrays far = arrays_grid(2, 0, &random);
    arrays_transform(&far, 0x1p310, 0, 0);
    ground b = ground_make(far, 1, &random);
    assert_int_equal(mw_volume_above(b.locator, b.heights, 0, NULL, &info, &error), MW_ERROR_LIMIT);
    ground_release(&b);
    mw_locator_destroy(open);
    ground_release(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs),        cmocka_unit_test(test_far),
        cmocka_unit_test(test_walls),        cmocka_unit_test(test_itself),
        cmocka_unit_test(test_above),        cmocka_unit_test(test_editor),
        cmocka_unit_test(test_surface_area), cmocka_unit_test(test_memory),
        cmocka_unit_test(test_refusals),     cmocka_unit_test(test_one_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
