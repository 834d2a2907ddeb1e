/* The nearest point of a surface: what the boxes find is what each triangle says when it is alone,
 * and no point of the surface is nearer by more than rounding, by another method in longer
 * numbers. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/random.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/make_prober.h"
#include "support/shapes.h"
#include "probe/prober.h"

static uint64_t new_seed(const char *name)
{
    return environment_print_seed(name, 19990712);
}

/* By vector instructions and without: the same bits. */
static mw_nearest_surface_point nearest(const mw_prober *prober, const double q[3],
                                        double max_distance)
{
    mw_nearest_surface_point hit, portable_hit;
    mw_prober portable = *prober;
    mw_error error;
    portable.portable = true;
    expect_ok(mw_nearest_on_surface(prober, q, max_distance, &hit, &error), "nearest", &error);
    expect_ok(mw_nearest_on_surface(&portable, q, max_distance, &portable_hit, &error), "portable",
              &error);
    assert_int_equal(hit.triangle, portable_hit.triangle);
    assert_memory_equal(&hit.distance, &portable_hit.distance, sizeof hit.distance);
    assert_memory_equal(hit.point, portable_hit.point, sizeof hit.point);
    assert_memory_equal(hit.weight, portable_hit.weight, sizeof hit.weight);
    return hit;
}

/* --- another method --------------------------------------------------------------------------- */

/* At least as long as long double, mostly twice as long as double. */
#ifdef __SIZEOF_FLOAT128__
typedef __float128 wide_float;
#define WIDE_DIGITS 113
#else
typedef long double wide_float;
#define WIDE_DIGITS LDBL_MANT_DIG
#endif

static wide_float wide_dot(const wide_float a[3], const wide_float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void wide_cross(wide_float r[3], const wide_float a[3], const wide_float b[3])
{
    for (int k = 0; k < 3; k++)
        r[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* From the origin, squared. */
static wide_float square_to_segment(const wide_float a[3], const wide_float b[3])
{
    wide_float ab[3], p[3];
    for (int k = 0; k < 3; k++) ab[k] = b[k] - a[k];
    wide_float square = wide_dot(ab, ab), t = square > 0 ? -wide_dot(a, ab) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int k = 0; k < 3; k++) p[k] = a[k] + t * ab[k];
    return wide_dot(p, p);
}

/* From q to a triangle: to its plane where q lies over it, else to its edges. */
static long double distance_to_triangle(const double *const corner[3], const double q[3])
{
    wide_float p[3][3], u[3], v[3], n[3], c[3], least = INFINITY;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) p[i][k] = (wide_float)corner[i][k] - q[k];
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        v[k] = p[2][k] - p[0][k];
    }
    wide_cross(n, u, v);
    int over = 1;
    for (int i = 0; i < 3; i++) {
        /* its part along n is twice the area of the foot of q and the edge */
        wide_cross(c, p[i], p[(i + 1) % 3]);
        if (wide_dot(c, n) < 0) over = 0;
        wide_float square = square_to_segment(p[i], p[(i + 1) % 3]);
        least = square < least ? square : least;
    }
    wide_float away = wide_dot(n, p[0]), plane = away * away / wide_dot(n, n);
    return sqrtl((long double)(over && plane < least ? plane : least));
}

/* The least distance to a triangle that is not flat; INFINITY: there is none. */
static long double least_distance(const mw_surface *surface, const double q[3])
{
    long double least = INFINITY;
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        const double *const corner[3] = {mw__surface_corner(surface, t, 0),
                                         mw__surface_corner(surface, t, 1),
                                         mw__surface_corner(surface, t, 2)};
        if (!mw__is_finite3(corner[0]) || !mw__is_finite3(corner[1]) || !mw__is_finite3(corner[2]))
            continue;
        if (!mw__collinear3(corner[0], corner[1], corner[2]))
            least = fminl(least, distance_to_triangle(corner, q));
    }
    return least;
}

/* --- checks ----------------------------------------------------------------------------------- */

/* A prober for each triangle. */
typedef struct alone {
    mw_surface **surface;
    mw_prober **prober;
    uint32_t count;
} alone;

static alone take_apart(const shape *s)
{
    alone a = {malloc(s->triangle_count * sizeof *a.surface),
               malloc(s->triangle_count * sizeof *a.prober), s->triangle_count};
    for (uint32_t t = 0; t < a.count; t++) {
        shape one = shape_make(3, 1);
        for (uint32_t i = 0; i < 3; i++) {
            const double *p = s->points + 3 * (size_t)s->triangles[3 * (size_t)t + i];
            shape_point(&one, p[0], p[1], p[2]);
        }
        shape_triangle(&one, 0, 1, 2);
        a.surface[t] = shape_surface(&one, (mw_surface_options){.tolerant = 1});
        a.prober[t] = prober_with_boxes(a.surface[t]);
        shape_free(&one);
    }
    return a;
}

static void alone_free(alone *a)
{
    for (uint32_t t = 0; t < a->count; t++) {
        mw_prober_destroy(a->prober[t]);
        mw_surface_destroy(a->surface[t]);
    }
    free(a->prober);
    free(a->surface);
}

static uint32_t ask_each(const alone *a, const double q[3], double *distance)
{
    uint32_t best = MW_NONE;
    for (uint32_t t = 0; t < a->count; t++) {
        mw_nearest_surface_point hit = nearest(a->prober[t], q, INFINITY);
        if (hit.triangle == MW_NONE || (best != MW_NONE && hit.distance >= *distance)) continue;
        best = t;
        *distance = hit.distance;
    }
    return best;
}

static void check_none(const mw_nearest_surface_point *hit)
{
    assert_int_equal(hit->triangle, MW_NONE);
    assert_true(isnan(hit->distance) && isnan(hit->point[0]) && isnan(hit->weight[0]));
}

/* Do the members of the answer fit together, to within `slack`? */
static void check_hit(const mw_surface *surface, const double q[3],
                      const mw_nearest_surface_point *hit, double slack)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        assert_true(hit->weight[k] >= 0);
        sum += hit->weight[k];
        double at = 0;
        for (uint32_t i = 0; i < 3; i++)
            at += hit->weight[i] * mw__surface_corner(surface, hit->triangle, i)[k];
        assert_true(fabs(at - hit->point[k]) <= slack);
    }
    assert_true(fabs(sum - 1) < 1e-15);
    long double square = 0;
    for (int k = 0; k < 3; k++) {
        long double away = (long double)hit->point[k] - q[k];
        square += away * away;
    }
    assert_true(fabsl(sqrtl(square) - hit->distance) <= slack);
}

static double extent_of(const shape *s, const double q[3])
{
    double largest = 0;
    for (uint32_t i = 0; i < 3 * s->point_count; i++)
        if (isfinite(s->points[i])) largest = fmax(largest, fabs(s->points[i]));
    for (int k = 0; k < 3; k++) largest = fmax(largest, fabs(q[k]));
    return largest;
}

/* Points of all kinds against one surface: of its queries, on it, beside it and off it, with a
 * little noise. */
static void check_shape(const shape *s, size_t n, uint64_t *random)
{
    mw_surface *surface = shape_surface(s, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    alone each = take_apart(s);
    double *queries = shape_queries(s, n, random);
    for (size_t i = 0; i < n; i++) {
        double *q = queries + 6 * i, distance = NAN;
        if (!mw__is_finite3(q)) continue;
        if (i % 3 == 1)
            for (int k = 0; k < 3; k++) q[k] += random_unit(random) - 0.5;
        double slack = 1e-14 * extent_of(s, q);
        uint32_t best = ask_each(&each, q, &distance);
        mw_nearest_surface_point hit = nearest(prober, q, INFINITY);
        assert_int_equal(hit.triangle, best);
        if (best == MW_NONE) {
            check_none(&hit);
            continue;
        }
        assert_true(hit.distance == distance);
        assert_true(fabsl(hit.distance - least_distance(surface, q)) <= slack);
        check_hit(surface, q, &hit, slack);
        mw_nearest_surface_point again = nearest(prober, q, distance);
        assert_int_equal(again.triangle, best);
        if (distance > 0) {
            again = nearest(prober, q, nextafter(distance, 0));
            check_none(&again);
        }
    }
    free(queries);
    alone_free(&each);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
}

/* --- tests ------------------------------------------------------------------------------------ */

static void test_shapes(void **state)
{
    (void)state;
    uint64_t random = new_seed("shapes");
    for (int round = 0; round < 3; round++) {
        shape shapes[4] = {shape_ball(5, 12, 0.3, &random), shape_torus(12, 10, 3),
                           shape_patch(10, 4, &random), shape_soup(40, 120, &random)};
        for (int i = 0; i < 4; i++) {
            if (round == 1) shape_flatten(&shapes[i], 0.1, &random);
            if (round == 2) shape_shuffle(&shapes[i], &random);
            check_shape(&shapes[i], 150, &random);
            shape_free(&shapes[i]);
        }
    }
}

/* Triangles whose height is down to 10^-12 of their length. */
static void test_slivers(void **state)
{
    (void)state;
    uint64_t random = new_seed("slivers");
    for (double thin = 1; thin > 1e-13; thin /= 10) {
        shape s = shape_soup(60, 40, &random);
        for (uint32_t t = 0; t < s.triangle_count; t++) {
            const uint32_t *v = s.triangles + 3 * (size_t)t;
            double at = random_unit(&random);
            for (uint32_t k = 0; k < 3; k++)
                s.points[3 * v[2] + k] = s.points[3 * v[0] + k] * at +
                                         s.points[3 * v[1] + k] * (1 - at) +
                                         thin * (random_unit(&random) - 0.5);
        }
        check_shape(&s, 100, &random);
        shape_free(&s);
    }
}

/* The same surface in other units: the same triangle, and distances that scale. */
static void test_units(void **state)
{
    (void)state;
    uint64_t random = new_seed("units");
    static const int exponent[] = {-1070, -1040, -1000, -700, -300, -60, 60, 300, 700, 1000, 1018};
    shape s = shape_torus(14, 10, 3);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(&s, 60, &random);
    for (size_t e = 0; e < sizeof exponent / sizeof *exponent; e++) {
        shape scaled = shape_scaled(&s, ldexp(1, exponent[e]), 0);
        mw_surface *other = shape_surface(&scaled, (mw_surface_options){0});
        mw_prober *other_prober = prober_with_boxes(other);
        for (size_t i = 0; i < 60; i++) {
            double q[3];
            for (int k = 0; k < 3; k++) {
                /* exact also in the smallest unit */
                queries[6 * i + (size_t)k] = floor(queries[6 * i + (size_t)k]);
                q[k] = ldexp(queries[6 * i + (size_t)k], exponent[e]);
            }
            if (!mw__is_finite3(q)) continue;
            mw_nearest_surface_point hit = nearest(prober, queries + 6 * i, INFINITY),
                                     there = nearest(other_prober, q, INFINITY);
            assert_int_not_equal(there.triangle, MW_NONE);
            if (isinf(ldexp(hit.distance, exponent[e]))) {
                assert_true(isinf(there.distance));
                continue;
            }
            /* down there lengths are whole numbers of units of the last place */
            double unit = exponent[e] < -1000 ? ldexp(1, -1074 - exponent[e]) : 0;
            assert_true(fabs(ldexp(there.distance, -exponent[e]) - hit.distance) <=
                        4 * unit + 1e-13);
            /* beyond, lengths are rounded otherwise, and other triangles are the lowest of those
             * equally far */
            if (abs(exponent[e]) <= 300) assert_int_equal(there.triangle, hit.triangle);
        }
        mw_prober_destroy(other_prober);
        mw_surface_destroy(other);
        shape_free(&scaled);
    }
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* A triangle alone. */
static mw_nearest_surface_point nearest_of(const double points[9], const double q[3],
                                           double max_distance)
{
    static const uint32_t corners[3] = {0, 1, 2};
    const mw_arrays one = {
        .points = points, .point_count = 3, .triangles = corners, .triangle_count = 1};
    mw_surface *surface;
    mw_error error;
    expect_ok(mw_surface_create(&one, NULL, &surface, &error), "surface", &error);
    mw_prober *prober = prober_with_boxes(surface);
    mw_nearest_surface_point hit = nearest(prober, q, max_distance);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return hit;
}

/* Far from the origin the point is rounded to what doubles there are, the distance is not. */
static void test_offset(void **state)
{
    (void)state;
    const double o = 1e15, a[9] = {o, o, o, o + 1, o, o + 0.5, o, o + 1, o + 0.25},
                 q[3] = {o + 0.25, o + 0.25, o + 0.5};
    mw_nearest_surface_point hit = nearest_of(a, q, INFINITY);
    assert_true(fabs(hit.distance - 0.27277236279499051) < 1e-16);
    assert_int_equal(nearest_of(a, q, 0.2728).triangle, 0);
    assert_int_equal(nearest_of(a, q, 0.2727).triangle, MW_NONE);
    const double corner[3] = {o + 1, o - 1, o + 0.5};
    hit = nearest_of(a, corner, INFINITY);
    assert_true(hit.distance == 1 && hit.weight[1] == 1 && hit.point[0] == o + 1 &&
                hit.point[2] == o + 0.5);
}

/* However much larger than the distance a triangle is. */
static void test_huge(void **state)
{
    (void)state;
    static const double size[] = {1, 1e10, 1e100, 1e300, 1.7e308};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        double x = size[i], q[3] = {0, 0, 1}, a[9] = {-x, -x, 0, x, -x, 0, 0, x, 0};
        mw_nearest_surface_point hit = nearest_of(a, q, INFINITY);
        assert_true(fabs(hit.distance - 1) < 1e-14);
        assert_true(hit.point[0] == 0 && hit.point[1] == 0 && hit.point[2] == 0);
        const double b[9] = {-x, 0, 0, x, 0, 0, 0, 0, -x};
        hit = nearest_of(b, q, INFINITY);
        assert_true(fabs(hit.distance - 1) < 1e-14);
        const double far[3] = {-x, -x, x};
        assert_true(fabs(nearest_of(a, far, INFINITY).distance / x - 1) < 1e-14);
    }
}

/* How far the farthest corner is. */
static long double size_from(const double points[9], const double q[3])
{
    long double size = 0;
    for (int i = 0; i < 3; i++) {
        long double square = 0;
        for (int k = 0; k < 3; k++)
            square +=
                ((long double)points[3 * i + k] - q[k]) * ((long double)points[3 * i + k] - q[k]);
        size = fmaxl(size, sqrtl(square));
    }
    return size;
}

/* A triangle at `offset`, whose height is about `thin`, and q about `away` from a point of it, an
 * edge, or a corner. */
static void random_case(double points[9], double q[3], double offset, double thin, double away,
                        uint64_t *random)
{
    double at = random_unit(random), weight[3] = {random_unit(random), 0, 0};
    int kind = (int)mw__random_below(random, 4);
    weight[1] = kind < 2 ? 1 - weight[0] : (1 - weight[0]) * random_unit(random);
    weight[2] = 1 - weight[0] - weight[1];
    for (int k = 0; k < 3; k++) {
        double *p = points + k;
        for (int i = 0; i < 2; i++) p[3 * i] = offset + random_unit(random);
        p[6] = p[0] * at + p[3] * (1 - at) + thin * (random_unit(random) - 0.5);
        q[k] = (kind == 3 ? p[0] : p[0] * weight[0] + p[3] * weight[1] + p[6] * weight[2]) +
               away * (random_unit(random) - 0.5);
    }
}

/* Off by less than 2^-48 of the size; inside a triangle that is not thin of the distance itself.
 * So also inside an edge, but for the face's foot that is taken to lie on the wrong side of it. */
static void test_accuracy(void **state)
{
    (void)state;
    if (WIDE_DIGITS < 106) {
        print_message("left out: long double has fewer than 106 bits\n");
        skip();
    }
    uint64_t random = new_seed("accuracy");
    static const double offset[] = {0, 1, 1e6, 1e12}, thin[] = {1, 1e-3, 1e-9, 1e-14, 1e-40};
    for (int round = 0; round < 12000; round++) {
        double points[9], q[3], height = thin[mw__random_below(&random, 5)],
                                away = pow(10, 4 - 20 * random_unit(&random));
        random_case(points, q, offset[mw__random_below(&random, 4)], height, away, &random);
        const double *const corner[3] = {points, points + 3, points + 6};
        mw_nearest_surface_point hit = nearest_of(points, q, INFINITY);
        if (hit.triangle == MW_NONE) continue; /* too thin for its place */
        long double right = distance_to_triangle(corner, q), error = fabsl(right - hit.distance);
        long double size = size_from(points, q);
        assert_true(error <= 0x1p-48L * size);
        if (height < 1 || size > 100 ||
            fmax(hit.weight[0], fmax(hit.weight[1], hit.weight[2])) > 1 - 1e-6)
            continue;
        double least = fmin(hit.weight[0], fmin(hit.weight[1], hit.weight[2]));
        if (least > 1e-6) assert_true(error <= 0x1p-48L * right + 1e-28L);
        if (least == 0)
            assert_true(error <= 0x1p-48L * right + 1e-28L + 0x1p-100L * size * size / right);
    }
}

/* Strays, points far away, coordinates at the end of the range. */
static void test_far(void **state)
{
    (void)state;
    uint64_t random = new_seed("far");
    static const double far[] = {1e10, 1e40, 1e160, 1e308};
    for (size_t f = 0; f < sizeof far / sizeof *far; f++) {
        shape s = shape_torus(10, 8, 3);
        for (int i = 0; i < 3; i++) s.points[mw__random_below(&random, 3 * s.point_count)] = far[f];
        mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
        mw_prober *prober = prober_with_boxes(surface);
        alone each = take_apart(&s);
        for (int i = 0; i < 60; i++) {
            double q[3], distance = NAN;
            for (int k = 0; k < 3; k++)
                q[k] = (i % 2 ? far[f] : 20) * (2 * random_unit(&random) - 1);
            uint32_t best = ask_each(&each, q, &distance);
            mw_nearest_surface_point hit = nearest(prober, q, INFINITY);
            assert_int_equal(hit.triangle, best);
            assert_true(hit.distance == distance);
        }
        alone_free(&each);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&s);
    }
}

static void test_motion(void **state)
{
    (void)state;
    uint64_t random = new_seed("motion");
    shape s = shape_ball(6, 30, 0.2, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double step = prober->slack_limit / 6, *points = mw_surface_points(surface);
    for (int frame = 0; frame < 30; frame++) {
        mw_surface_begin_update(surface);
        for (uint32_t i = 0; i < 3 * s.point_count; i++)
            s.points[i] = points[i] += step * (2 * random_unit(&random) - 1);
        if (frame == 20) s.points[0] = points[0] = NAN;
        mw_prober_update(prober, frame == 20 ? NAN : 1.75 * step, 1);
        mw_surface_end_update(surface);
        for (int i = 0; i < 30; i++) {
            double q[3];
            for (int k = 0; k < 3; k++) q[k] = 60 * random_unit(&random) - 30;
            mw_nearest_surface_point hit = nearest(prober, q, INFINITY);
            assert_true(fabsl(hit.distance - least_distance(surface, q)) < 1e-12L);
        }
    }
    assert_in_range(prober->fits, 3, 20);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

static void test_arguments(void **state)
{
    (void)state;
    uint64_t random = new_seed("arguments");
    shape s = shape_patch(4, 1, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){.shared = 1});
    mw_prober *prober = prober_with_boxes(surface), *bare;
    mw_error error;
    mw_nearest_surface_point hit;
    const double q[3] = {1, 2, 9}, bad[3] = {1, NAN, 2};
    assert_int_equal(mw_prober_create(surface, NULL, &bare, &error), MW_OK);
    assert_int_equal(mw_nearest_on_surface(bare, q, 1, &hit, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface(NULL, q, 1, &hit, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface(prober, NULL, 1, &hit, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface(prober, q, 1, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface(prober, q, -1, &hit, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_nearest_on_surface(prober, q, NAN, &hit, &error), MW_ERROR_ARGUMENT);
    hit = nearest(prober, bad, 1);
    check_none(&hit);
    hit = nearest(prober, q, 1);
    check_none(&hit);
    hit = nearest(prober, q, 9);
    assert_true(hit.triangle < 2);

    mw_surface_begin_update(surface);
    mw_surface_end_update(surface);
    assert_int_equal(mw_nearest_on_surface(prober, q, 1, &hit, &error), MW_ERROR_ARGUMENT);
    mw_surface_begin_update(surface);
    mw_prober_update(prober, NAN, 1);
    mw_surface_end_update(surface);
    assert_int_equal(mw_nearest_on_surface(prober, q, 9, &hit, &error), MW_OK);
    mw_prober_destroy(bare);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),    cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_units),     cmocka_unit_test(test_offset),
        cmocka_unit_test(test_huge),      cmocka_unit_test(test_accuracy),
        cmocka_unit_test(test_far),       cmocka_unit_test(test_motion),
        cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
