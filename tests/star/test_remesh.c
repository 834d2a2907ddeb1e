/* test_remesh.c - icospheres, star-shaped polyhedra sampled on them, and how far surfaces are
 * apart: against exact rays, shapes whose distances are known, and every triangle. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/star_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/make_prober.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/star_shapes.h"

/* --- icospheres ------------------------------------------------------------------------------- */

typedef struct sphere_arrays {
    double *points;
    uint32_t *triangles, vertices, count;
} sphere_arrays;

static sphere_arrays sphere_room(uint32_t level)
{
    sphere_arrays s;
    mw_error error;
    expect_ok(mw_icosphere_size(level, &s.vertices, &s.count, &error), "size", &error);
    s.points = malloc(3 * (size_t)s.vertices * sizeof *s.points);
    s.triangles = malloc(3 * (size_t)s.count * sizeof *s.triangles);
    return s;
}

static sphere_arrays sphere_make(uint32_t level, uint32_t threads)
{
    sphere_arrays s = sphere_room(level);
    mw_error error;
    mw_remesh_options options = {.threads = threads};
    expect_ok(mw_icosphere_create(level, &options, s.points, s.triangles, &error), "icosphere",
              &error);
    return s;
}

static void sphere_free(sphere_arrays *s)
{
    free(s->points);
    free(s->triangles);
}

static mw_surface *sphere_surface(const sphere_arrays *s)
{
    mw_surface *surface;
    mw_error error;
    mw_arrays view = {.points = s->points,
                      .point_count = s->vertices,
                      .triangles = s->triangles,
                      .triangle_count = s->count};
    expect_ok(mw_surface_create(&view, NULL, &surface, &error), "surface", &error);
    return surface;
}

/* Closed, of one piece, counter-clockwise from outside, no vertex unused or twice, all at 1. */
static void test_icospheres(void **state)
{
    (void)state;
    for (uint32_t level = 0; level < 6; level++) {
        sphere_arrays s = sphere_make(level, 1);
        mw_surface *surface = sphere_surface(&s);
        mw_surface_info info;
        mw_star *star;
        mw_error error;
        expect_ok(mw_surface_describe(surface, &info, &error), "description", &error);
        assert_true(info.closed && info.oriented && info.components == 1 && info.euler == 2);
        assert_true(info.unused_vertices == 0 && info.flat_triangles == 0 && info.volume > 0);
        assert_true(info.volume < 4.18879021 && (level < 5 || info.volume > 4.18));
        expect_ok(mw_star_create(surface, NULL, &star, &error), "star", &error);
        for (uint32_t v = 0; v < s.vertices; v++) {
            const double *p = s.points + 3 * (size_t)v;
            assert_true(fabs(hypot(hypot(p[0], p[1]), p[2]) - 1) < 0x1p-50);
        }
        mw_star_destroy(star);
        mw_surface_destroy(surface);
        sphere_free(&s);
    }
}

/* The vertices of a level are the first of the next; its triangles are cut as the header says; and
 * triangles hardly differ in size. */
static void test_levels_nest(void **state)
{
    sphere_arrays a = sphere_make(4, 1), b = sphere_make(5, 3);
    (void)state;
    assert_memory_equal(a.points, b.points, 3 * a.vertices * sizeof *a.points);
    for (uint32_t t = 0; t < a.count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t *v = a.triangles + 3 * (size_t)t, *corner = b.triangles + 12 * (size_t)t;
            assert_int_equal(corner[3 * k + k], v[k]);
            assert_int_equal(corner[3 * k + (k + 1) % 3], corner[9 + k]);
            const double *p = a.points + 3 * (size_t)v[k],
                         *q = a.points + 3 * (size_t)v[(k + 1) % 3],
                         *m = b.points + 3 * (size_t)corner[9 + k];
            for (int i = 0; i < 3; i++) /* the middle of the edge, moved outwards */
                assert_true(
                    fabs((p[i] + q[i]) / hypot(hypot(p[0] + q[0], p[1] + q[1]), p[2] + q[2]) -
                         m[i]) < 0x1p-50);
        }
    sphere_free(&a);
    sphere_free(&b);
}

static void test_icosphere_threads(void **state)
{
    sphere_arrays one = sphere_make(7, 1), four = sphere_make(7, 4);
    (void)state;
    assert_memory_equal(one.points, four.points, 3 * one.vertices * sizeof *one.points);
    assert_memory_equal(one.triangles, four.triangles, 3 * one.count * sizeof *one.triangles);
    sphere_free(&one);
    sphere_free(&four);
}

/* --- remeshing -------------------------------------------------------------------------------- */

typedef struct remesh_world {
    star_shape shape;
    double centre[3];
    mw_surface *surface;
    mw_star *star;
} remesh_world;

/* Opens the world on its shape. */
static void remesh_open(remesh_world *w)
{
    mw_error error;
    mw_arrays view = star_shape_arrays(&w->shape);
    mw_surface_options how = {.weld = 1};
    mw_star_options options = {.centre = {w->centre[0], w->centre[1], w->centre[2]}};
    expect_ok(mw_surface_create(&view, &how, &w->surface, &error), "surface", &error);
    expect_ok(mw_star_create(w->surface, &options, &w->star, &error), "star", &error);
}

static void remesh_release(remesh_world *w)
{
    mw_star_destroy(w->star);
    mw_surface_destroy(w->surface);
    star_shape_free(&w->shape);
}

/* Every vertex is on the ray that the header describes, in the facet of lowest number, rounded
 * once. */
static void remesh_expect(const remesh_world *w, uint32_t level, double radius)
{
    sphere_arrays sphere = sphere_make(level, 1), found = sphere_room(level);
    mw_location *at = malloc(found.vertices * sizeof *at);
    mw_error error;
    expect_ok(mw_star_remesh(w->star, level, NULL, found.points, found.triangles, at, &error),
              "remesh", &error);
    assert_memory_equal(found.triangles, sphere.triangles, 3 * found.count * sizeof(uint32_t));
    for (uint32_t v = 0; v < found.vertices; v++) {
        double q[3];
        for (size_t k = 0; k < 3; k++)
            q[k] = w->centre[k] + radius * sphere.points[3 * (size_t)v + k];
        const mw_location expected =
            star_oracle_locate(w->shape.point, w->shape.corner, w->shape.triangles, w->centre, q);
        assert_int_equal(at[v].triangle, expected.triangle);
        assert_true(star_oracle_is_meeting(w->shape.point,
                                           w->shape.corner + 3 * (size_t)at[v].triangle, w->centre,
                                           q, found.points + 3 * (size_t)v));
    }
    free(at);
    sphere_free(&sphere);
    sphere_free(&found);
}

static void test_remesh_exact_rays(void **state)
{
    static const double centres[][3] = {{0, 0, 0}, {0.25, -0.5, 0.125}, {300, -1e3, 7}};
    static const double radii[] = {1, 1, 512}; /* a power of two, at least half of 1000 */
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        uint64_t random = environment_print_seed("exact rays", 50 + i);
        remesh_world w = {.shape = star_shape_octahedron(2)};
        star_shape_stretch(&w.shape, 4, &random);
        star_shape_shuffle(&w.shape, &random);
        for (uint32_t v = 0; v < w.shape.points; v++)
            for (uint32_t k = 0; k < 3; k++) w.shape.point[3 * v + k] += centres[i][k];
        memcpy(w.centre, centres[i], sizeof w.centre);
        remesh_open(&w);
        remesh_expect(&w, 3, radii[i]);
        remesh_release(&w);
    }
}

/* A globe whose seam and poles have several vertices at one place: corners torn apart, welded. */
static void test_remesh_welded(void **state)
{
    uint64_t random = environment_print_seed("welded", 54);
    remesh_world w = {.shape = star_shape_octahedron(2)};
    (void)state;
    star_shape_stretch(&w.shape, 3, &random);
    star_shape_tear(&w.shape);
    remesh_open(&w);
    remesh_expect(&w, 3, 1);
    remesh_release(&w);
}

static void test_remesh_threads(void **state)
{
    uint64_t random = environment_print_seed("threads", 55);
    remesh_world w = {.shape = star_shape_octahedron(5), .centre = {0.1, 0.2, -0.3}};
    sphere_arrays first = sphere_room(6), again = sphere_room(6);
    mw_error error;
    (void)state;
    star_shape_stretch(&w.shape, 3, &random);
    remesh_open(&w);
    expect_ok(mw_star_remesh(w.star, 6, NULL, first.points, NULL, NULL, &error), "remesh", &error);
    for (uint32_t threads = 1; threads < 5; threads++) {
        mw_remesh_options options = {.threads = threads};
        expect_ok(mw_star_remesh(w.star, 6, &options, again.points, again.triangles, NULL, &error),
                  "remesh", &error);
        assert_memory_equal(first.points, again.points, 3 * first.vertices * sizeof(double));
    }
    sphere_free(&first);
    sphere_free(&again);
    remesh_release(&w);
}

static void test_remesh_arguments(void **state)
{
    uint32_t vertices, triangles;
    remesh_world w = {.shape = star_shape_octahedron(0)};
    double points[36], *p;
    uint32_t corners[60];
    mw_remesh_options wrong = {.reserved = {1}};
    mw_error error;
    (void)state;
    remesh_open(&w);
    assert_int_equal(mw_icosphere_size(13, &vertices, &triangles, &error), MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "level 13"));
    expect_ok(mw_icosphere_size(12, &vertices, &triangles, &error), "size", &error);
    assert_int_equal(triangles, 335544320);
    assert_int_equal(mw_icosphere_size(0, NULL, &triangles, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_icosphere_create(0, NULL, NULL, corners, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_icosphere_create(0, &wrong, points, corners, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_remesh(NULL, 0, NULL, points, corners, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_remesh(w.star, 0, NULL, NULL, corners, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_remesh(w.star, 13, NULL, points, corners, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    expect_ok(mw_star_remesh(w.star, 0, NULL, points, corners, NULL, &error), "remesh", &error);
    mw_surface_begin_update(w.surface);
    p = mw_surface_points(w.surface);
    p[0] *= 2;
    mw_surface_end_update(w.surface);
    assert_int_equal(mw_star_remesh(w.star, 0, NULL, points, corners, NULL, &error),
                     MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "up to date"));
    remesh_release(&w);
}

/* --- deviations ------------------------------------------------------------------------------- */

static mw_deviation deviation_of(const mw_surface *a, const mw_surface *b, uint32_t threads)
{
    mw_prober *prober = prober_with_boxes(b);
    mw_remesh_options options = {.threads = threads};
    mw_deviation d;
    mw_error error;
    expect_ok(mw_surface_deviation(a, prober, &options, &d, &error), "deviation", &error);
    mw_prober_destroy(prober);
    return d;
}

/* A cube in the middle of one three times as large: the inner one is 1 away everywhere; of the
 * outer one the corners are sqrt(3) away, and of a side, squares of 1 x 1 in the middle, 1. */
static void test_known_distances(void **state)
{
    solid inner = solid_box(0, 0, 0, 1, 0), outer = solid_box(-1, -1, -1, 3, 0);
    mw_surface *a = solid_surface(&inner, (mw_surface_options){0}),
               *b = solid_surface(&outer, (mw_surface_options){0});
    (void)state;
    mw_deviation d = deviation_of(a, b, 1);
    assert_true(d.largest == 1 && d.samples == 20);
    assert_true(fabs(d.mean - 1) < 0x1p-50 && fabs(d.area - 6) < 0x1p-45);
    assert_true(d.at_most >= 1 && d.at_most < 1 + 0.6 * sqrt(2));
    d = deviation_of(b, a, 1);
    assert_true(fabs(d.largest - sqrt(3)) < 0x1p-50 && fabs(d.area - 54) < 0x1p-40);
    for (int k = 0; k < 3; k++) {
        assert_true(d.point[k] == -1 || d.point[k] == 2);
        assert_true(d.nearest[k] == (d.point[k] < 0 ? 0 : 1));
    }
    assert_true(d.at_most >= sqrt(3) && d.triangle < 12 && d.nearest_triangle < 12);
    d = deviation_of(a, a, 1);
    assert_true(d.largest == 0 && d.mean == 0 && d.at_most == 0 && d.samples == 20);
    mw_surface_destroy(a);
    mw_surface_destroy(b);
    solid_free(&inner);
    solid_free(&outer);
}

/* The samples again, each against every triangle; and points between them against the bound. */
static void test_against_every_sample(void **state)
{
    uint64_t random = environment_print_seed("every sample", 60);
    solid one = solid_sphere(4, &random), other = solid_sphere(2, &random); /* nothing is cut */
    mw_surface *a = solid_surface(&one, (mw_surface_options){0}),
               *b = solid_surface(&other, (mw_surface_options){0});
    const mw_deviation d = deviation_of(a, b, 1);
    mw_prober *prober = prober_with_boxes(b);
    double largest = 0, sum = 0, area = 0;
    (void)state;
    for (uint32_t t = 0; t < one.triangle_count; t++) {
        const uint32_t *v = one.triangles + 3 * (size_t)t;
        double at[5][3], far[5], n[3], size = 0;
        for (uint32_t i = 0; i < 5; i++) {
            double w[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
            mw_nearest_surface_point hit;
            for (uint32_t k = 0; k < 3 && i != 3; k++) w[k] = i < 3 ? k == i : random_unit(&random);
            const double whole = w[0] + w[1] + w[2];
            for (uint32_t k = 0; k < 3; k++)
                at[i][k] = (w[0] * one.points[3 * v[0] + k] + w[1] * one.points[3 * v[1] + k] +
                            w[2] * one.points[3 * v[2] + k]) /
                           whole;
            expect_ok(mw_nearest_on_surface(prober, at[i], INFINITY, &hit, NULL), "nearest", NULL);
            far[i] = hit.distance;
        }
        assert_true(far[4] <= d.at_most);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
            n[k] = (at[1][i] - at[0][i]) * (at[2][j] - at[0][j]) -
                   (at[1][j] - at[0][j]) * (at[2][i] - at[0][i]);
            size += n[k] * n[k] / 4;
        }
        size = sqrt(size);
        area += size;
        sum += size * (far[3] * 0.75 + (far[0] + far[1] + far[2]) / 12);
        largest = fmax(largest, fmax(fmax(far[0], far[1]), fmax(far[2], far[3])));
    }
    assert_true(fabs(d.largest - largest) < 1e-14 && fabs(d.mean - sum / area) < 1e-14);
    assert_true(fabs(d.area - area) < 1e-12 * area);
    assert_true(d.samples == one.triangle_count + (uint64_t)(one.triangle_count / 2 + 2));
    for (uint32_t threads = 2; threads < 5; threads++) {
        const mw_deviation again = deviation_of(a, b, threads);
        assert_memory_equal(&again, &d, sizeof d);
    }
    mw_prober_destroy(prober);
    mw_surface_destroy(a);
    mw_surface_destroy(b);
    solid_free(&one);
    solid_free(&other);
}

/* Large triangles are cut: the samples come near the farthest point, and none is beyond the
 * bound. */
static void test_large_triangles(void **state)
{
    uint64_t random = environment_print_seed("large triangles", 61);
    solid box = solid_box(-1, -1, -1, 2, 0), ball = solid_sphere(4, &random);
    mw_surface *a = solid_surface(&box, (mw_surface_options){0}),
               *b = solid_surface(&ball, (mw_surface_options){0});
    const mw_deviation d = deviation_of(a, b, 1);
    mw_prober *prober = prober_with_boxes(b);
    double largest = 0;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const uint32_t *v = box.triangles + 3 * (size_t)mw__random_below(&random, 12);
        double u = random_unit(&random), w = random_unit(&random), p[3];
        mw_nearest_surface_point hit;
        for (uint32_t k = 0; k < 3; k++)
            p[k] = (1 - u) * box.points[3 * v[0] + k] +
                   u * ((1 - w) * box.points[3 * v[1] + k] + w * box.points[3 * v[2] + k]);
        expect_ok(mw_nearest_on_surface(prober, p, INFINITY, &hit, NULL), "nearest", NULL);
        largest = fmax(largest, hit.distance);
    }
    assert_true(d.samples > 12 * 64);
    assert_true(largest <= d.at_most && d.largest > 0.95 * largest && d.at_most < 1.2 * d.largest);
    mw_prober_destroy(prober);
    mw_surface_destroy(a);
    mw_surface_destroy(b);
    solid_free(&box);
    solid_free(&ball);
}

static void test_deviation_arguments(void **state)
{
    solid box = solid_box(0, 0, 0, 1, 0), flat = solid_make(3, 1), bad = solid_box(0, 0, 0, 1, 0);
    solid_point(&flat, 0, 0, 0);
    solid_point(&flat, 1, 1, 1);
    solid_point(&flat, 2, 2, 2);
    solid_triangle(&flat, 0, 1, 2);
    bad.points[23] = NAN;
    mw_surface *a = solid_surface(&box, (mw_surface_options){0}),
               *line = solid_surface(&flat, (mw_surface_options){0}),
               *nan = solid_surface(&bad, (mw_surface_options){.tolerant = 1});
    mw_prober *without, *with = prober_with_boxes(a), *on_line = prober_with_boxes(line);
    mw_deviation d;
    mw_error error;
    (void)state;
    expect_ok(mw_prober_create(a, NULL, &without, &error), "prober", &error);
    assert_int_equal(mw_surface_deviation(NULL, with, NULL, &d, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_deviation(a, NULL, NULL, &d, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_deviation(a, with, NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_deviation(a, without, NULL, &d, &error), MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "boxes"));
    assert_int_equal(mw_surface_deviation(a, on_line, NULL, &d, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no triangle with an area"));
    assert_int_equal(mw_surface_deviation(nan, with, NULL, &d, &error), MW_ERROR_INPUT);
    assert_int_equal(error.vertex, 7);
    expect_ok(mw_surface_deviation(line, with, NULL, &d, &error), "a line", &error);
    assert_true(isnan(d.mean) && fabs(d.largest - sqrt(3)) < 0x1p-50 && d.area == 0);
    mw_prober_destroy(without);
    mw_prober_destroy(with);
    mw_prober_destroy(on_line);
    mw_surface_destroy(a);
    mw_surface_destroy(line);
    mw_surface_destroy(nan);
    solid_free(&box);
    solid_free(&flat);
    solid_free(&bad);
}

/* --- failing allocations ---------------------------------------------------------------------- */

typedef struct memory_inputs {
    const mw_star *star;
    const mw_surface *surface;
    const mw_prober *prober;
    sphere_arrays room;
} memory_inputs;

static const mw_remesh_options alone = {.threads = 1};

static mw_status memory_icosphere(const memory_inputs *in, mw_error *error)
{
    return mw_icosphere_create(3, &alone, in->room.points, in->room.triangles, error);
}

static mw_status memory_remesh(const memory_inputs *in, mw_error *error)
{
    return mw_star_remesh(in->star, 3, &alone, in->room.points, in->room.triangles, NULL, error);
}

static mw_status memory_project(const memory_inputs *in, mw_error *error)
{
    const mw_star_query_options options = {.threads = 1};
    return mw_star_project_batch(in->star, in->room.points, 100, 0, &options, in->room.points + 300,
                                 NULL, error);
}

static mw_status memory_deviation(const memory_inputs *in, mw_error *error)
{
    mw_deviation d;
    return mw_surface_deviation(in->surface, in->prober, &alone, &d, error);
}

static void test_every_allocation(void **state)
{
    static mw_status (*const calls[])(const memory_inputs *, mw_error *) = {
        memory_icosphere, memory_remesh, memory_project, memory_deviation};
    static const long least[] = {9, 12, 2, 3};
    remesh_world w = {.shape = star_shape_octahedron(1)};
    (void)state;
    remesh_open(&w);
    memory_inputs in = {w.star, w.surface, prober_with_boxes(w.surface), sphere_make(3, 1)};
    for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
        long k = 0;
        for (mw_status status = MW_ERROR_MEMORY; status; k++) {
            mw_error error;
            allocations_left = k;
            status = calls[c](&in, &error);
            allocations_left = -1;
            assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
        }
        assert_true(k > least[c]);
    }
    mw_prober_destroy((mw_prober *)in.prober);
    sphere_free(&in.room);
    remesh_release(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_icospheres),           cmocka_unit_test(test_levels_nest),
        cmocka_unit_test(test_icosphere_threads),    cmocka_unit_test(test_remesh_exact_rays),
        cmocka_unit_test(test_remesh_welded),        cmocka_unit_test(test_remesh_threads),
        cmocka_unit_test(test_remesh_arguments),     cmocka_unit_test(test_known_distances),
        cmocka_unit_test(test_against_every_sample), cmocka_unit_test(test_deviation_arguments),
        cmocka_unit_test(test_every_allocation),     cmocka_unit_test(test_large_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
