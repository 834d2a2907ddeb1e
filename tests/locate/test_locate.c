/* test_locate.c - every walk from every start in both arithmetics against brute force in
 * rationals. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static mw_mesh *mesh_of(const arrays *a, mw_mesh_layout layout)
{
    mw_arrays view = arrays_view(a);
    mw_mesh *mesh;
    mw_error error;
    if (mw_mesh_create(&view, &(mw_mesh_options){.layout = layout}, &mesh, &error))
        fail_msg("mesh: %s", error.message);
    return mesh;
}

static mw_locator *locator_of(const mw_mesh *mesh, int border)
{
    mw_locator *locator;
    mw_error error;
    mw_locator_options options = {.border = border};
    if (mw_locator_create(mesh, &options, &locator, &error)) fail_msg("locator: %s", error.message);
    return locator;
}

static bool is_embedding(const mw_arrays *view)
{
    mw_check check;
    assert_int_equal(mw_check_arrays(view, NULL, &check, NULL), MW_OK);
    bool embedding = check.valid;
    mw_check_release(&check);
    return embedding;
}

static void compare(const mw_location *got, const location_answer *want, const double q[2],
                    const char *how)
{
    int where = got->where == MW_IN_HOLE ? MW_OUTSIDE : got->where;
    if (got->triangle == want->triangle && where == want->where && got->local == want->local)
        return;
    fail_msg("%s: (%.17g, %.17g): triangle %u where %d local %d, not %u %d %d", how, q[0], q[1],
             got->triangle, got->where, got->local, want->triangle, want->where, want->local);
}

/* Weights are not negative, sum to 1, vanish where they must, and reproduce the point. */
static void check_weights(const arrays *a, const mw_location *at, const double q[2])
{
    if (at->triangle == MW_NONE) {
        assert_true(isnan(at->weight[0]));
        return;
    }
    double sum = 0, x = 0, y = 0, size = 0;
    int zeros = 0;
    for (int k = 0; k < 3; k++) {
        const double *p =
            a->points + 2 * (size_t)a->triangles[3 * (size_t)at->triangle + (size_t)k];
        assert_true(at->weight[k] >= 0 && at->weight[k] <= 1);
        zeros += at->weight[k] == 0;
        sum += at->weight[k];
        x += at->weight[k] * p[0];
        y += at->weight[k] * p[1];
        size = fmax(size, fmax(fabs(p[0]), fabs(p[1])));
    }
    assert_true(fabs(sum - 1) < 1e-15);
    double off = 1e-12 * size + 0x1p-1070; /* subnormal coordinates round coarsely */
    assert_true(fabs(x - q[0]) <= off && fabs(y - q[1]) <= off);
    if (at->where == MW_ON_EDGE) assert_true(zeros >= 1 && at->weight[(at->local + 2) % 3] == 0);
    if (at->where == MW_ON_VERTEX) assert_true(zeros == 2 && at->weight[at->local] == 1);
}

static void try_singles(const arrays *a, const mw_locator *locator, const mw_query_options *options,
                        const double *q, const location_answer *want, size_t n, const char *how)
{
    mw_cursor cursor;
    assert_int_equal(mw_cursor_init(locator, options, &cursor, NULL), MW_OK);
    for (size_t i = 0; i < n; i++) {
        mw_location at = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        compare(&at, &want[i], q + 2 * i, how);
        check_weights(a, &at, q + 2 * i);
    }
}

static void try_batch(const mw_locator *locator, const mw_query_options *options, const double *q,
                      const location_answer *want, size_t n, const char *how)
{
    mw_location *at = malloc(n * sizeof *at);
    assert_int_equal(mw_locate_batch(locator, q, n, 2, options, at, NULL, NULL), MW_OK);
    for (size_t i = 0; i < n; i++) compare(&at[i], &want[i], q + 2 * i, how);
    free(at);
}

/* All walks x starts x arithmetics, single, and in batches of different lanes. */
static void try_everything(const arrays *a, size_t queries, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, queries, &n, random);
    location_answer *want = malloc(n * sizeof *want);
    for (size_t i = 0; i < n; i++)
        want[i] = location_oracle_locate(a->points, a->triangles, a->triangle_count, q + 2 * i);
    for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
        mw_mesh *mesh = mesh_of(a, layout);
        mw_locator *locator = locator_of(mesh, 0);
        mw_index *index[MW_START_COUNT];
        starts_open(locator, index);
        for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
            for (int start = MW_START_AUTO; start < MW_START_COUNT; start++)
                for (int arithmetic = MW_EXACT; arithmetic <= MW_DOUBLE; arithmetic++) {
                    char how[80];
                    snprintf(how, sizeof how, "%s from %s, arithmetic %d, layout %d",
                             mw_walk_name((mw_walk_kind)walk), mw_start_name((mw_start_kind)start),
                             arithmetic, layout);
                    mw_query_options options = {.walk = (mw_walk_kind)walk,
                                                .start = (mw_start_kind)start,
                                                .arithmetic = (mw_arithmetic)arithmetic,
                                                .seed = mw__random(random),
                                                .counters = walk % 2,
                                                .index = index[start]};
                    try_singles(a, locator, &options, q, want, n, how);
                    options.lanes = 1 + mw__random_below(random, 40);
                    options.threads = 1 + mw__random_below(random, 3);
                    try_batch(locator, &options, q, want, n, how);
                }
        starts_close(index);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
    free(want);
    free(q);
}

static void test_grids(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (uint32_t n = 1; n <= 9; n += 2)
        for (int kind = 0; kind < 4; kind++) {
            arrays a = arrays_grid(n, kind % 2 ? 0.4 : 0, &random);
            arrays_scramble(&a, kind >= 2, &random);
            try_everything(&a, 12, &random);
            arrays_free(&a);
        }
}

static void test_offset_and_scale(void **state)
{
    (void)state;
    uint64_t random = 2;
    const double to[][3] = {{1, 5e6, 5e6},  {1e-3, 5e6, -5e6}, {1e-9, 1, 1},
                            {1e-300, 0, 0}, {1e300, 0, 0},     {0x1p-1060, 0, 0}};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++) {
        arrays a = arrays_grid(4, i < 3 ? 0.3 : 0, &random);
        arrays_scramble(&a, 1, &random);
        arrays_transform(&a, to[i][0], to[i][1], to[i][2]);
        try_everything(&a, 6, &random);
        arrays_free(&a);
    }
}

static void test_slivers(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < 4; i++) {
        arrays a = arrays_grid(6, 0.3, &random);
        for (uint32_t v = 0; v < a.point_count; v++)
            a.points[2 * v + 1] = a.points[2 * v + 1] * 0x1p-40 + 3 * a.points[2 * v];
        arrays_scramble(&a, i % 2, &random);
        mw_arrays view = arrays_view(&a);
        if (is_embedding(&view)) try_everything(&a, 8, &random); /* rounding may have folded it */
        arrays_free(&a);
    }
}

static void test_fan(void **state)
{
    (void)state;
    uint64_t random = 4;
    arrays a = arrays_fan(60);
    arrays_scramble(&a, 1, &random);
    try_everything(&a, 12, &random);
    arrays_free(&a);
}

static void test_holes(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int i = 0; i < 24; i++) {
        arrays a = arrays_grid(2 + (uint32_t)i / 4, i % 2 ? 0.4 : 0, &random);
        arrays_punch(&a, 0.1 + 0.1 * (i % 7), &random);
        arrays_scramble(&a, i % 3 == 0, &random);
        try_everything(&a, 6, &random);
        arrays_free(&a);
    }
}

static void test_celestial_trap(void **state)
{
    (void)state;
    uint64_t random = 6;
    arrays a = arrays_trap();
    mw_mesh *mesh = mesh_of(&a, 0);
    mw_locator *locator = locator_of(mesh, 0);
    mw_query_options options = {.walk = MW_WALK_CELESTIAL, .start = MW_START_LAST, .counters = 1};
    const double q[2] = {.551665, .106155};
    for (uint32_t start = 0; start < a.triangle_count; start++) {
        mw_cursor cursor;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
        cursor.last = start;
        mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
        location_answer want = location_oracle_locate(a.points, a.triangles, a.triangle_count, q);
        compare(&at, &want, q, "celestial in its trap");
        assert_int_equal(cursor.counters.handovers, 0);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    try_everything(&a, 40, &random);
    arrays_free(&a);
}

static void test_bad_points(void **state)
{
    (void)state;
    uint64_t random = 7;
    arrays a = arrays_grid(3, 0, &random);
    mw_mesh *mesh = mesh_of(&a, 0);
    mw_locator *locator = locator_of(mesh, 0);
    const double q[] = {NAN, 1,     1,      INFINITY, -INFINITY, NAN,     1.5,
                        1.5, 1e308, -1e308, 5e-324,   5e-324,    -5e-324, 1};
    mw_location at[7];
    mw_index *index[MW_START_COUNT];
    starts_open(locator, index);
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        mw_query_options options = {.start = (mw_start_kind)start, .index = index[start]};
        assert_int_equal(mw_locate_batch(locator, q, 7, 0, &options, at, NULL, NULL), MW_OK);
        for (int i = 0; i < 7; i++) {
            location_answer want =
                location_oracle_locate(a.points, a.triangles, a.triangle_count, q + 2 * i);
            compare(&at[i], &want, q + 2 * i, "odd points");
        }
    }
    starts_close(index);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static mw_location locate_in(const double points[6], double x, double y)
{
    const uint32_t corners[3] = {0, 1, 2};
    mw_arrays view = {
        .points = points, .point_count = 3, .triangles = corners, .triangle_count = 1};
    mw_mesh *mesh;
    mw_locator *locator;
    mw_cursor cursor;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_locator_create(mesh, NULL, &locator, NULL), MW_OK);
    assert_int_equal(mw_cursor_init(locator, NULL, &cursor, NULL), MW_OK);
    mw_location at = mw_locate(locator, &cursor, x, y);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return at;
}

/* Areas below or above the doubles, long and thin, in one direction or the other. */
static void test_weights_at_any_scale(void **state)
{
    (void)state;
    const double thin[6] = {1e-307, -1, -1e-307, -1, 0, -0.5}, low[6] = {0, 0, 1, 0, 0, 0x1p-1030};
    const double large[6] = {-0x1p1023, -0x1p1023, 0x1p1023, -0x1p1023, 0, 0x1p1023};
    const double mixed[6] = {-0.383, -5.74e307, -3.406e-320, 7.314073710692655e306, 0, -7.69e307};
    mw_location at = locate_in(thin, 0, -0.99);
    assert_true(fabs(at.weight[0] - 0.49) < 1e-12 && fabs(at.weight[2] - 0.02) < 1e-12);
    at = locate_in(thin, 0, -0.51);
    assert_true(fabs(at.weight[1] - 0.01) < 1e-12 && fabs(at.weight[2] - 0.98) < 1e-12);
    at = locate_in(low, 0.25, 0x1p-1031);
    assert_true(at.weight[0] == 0.25 && at.weight[1] == 0.25 && at.weight[2] == 0.5);
    at = locate_in(large, 0, 0);
    assert_true(at.weight[0] == 0.25 && at.weight[1] == 0.25 && at.weight[2] == 0.5);
    const double needle[6] = {-1, nextafter(1, 2), 0, -5e-324, 0, 5e-324};
    at = locate_in(needle, -0.5, nextafter(0.5, 1));
    assert_true(at.weight[0] == 0.5 && at.weight[1] == 0.25 && at.weight[2] == 0.25);
    at = locate_in(mixed, -3.406e-320, 7.314073710692654e306);
    assert_int_equal(at.where, MW_INSIDE);
    assert_true(fabs(at.weight[1] - 1) < 1e-12 && at.weight[0] > 0 && at.weight[2] > 0);
}

/* Has any triangle an area? The coordinates of these meshes are small whole numbers. */
static bool any_area(const arrays *a)
{
    for (uint32_t i = 0; i < a->triangle_count; i++) {
        const uint32_t *v = a->triangles + 3 * (size_t)i;
        const double *p = a->points + 2 * (size_t)v[0], *q = a->points + 2 * (size_t)v[1],
                     *r = a->points + 2 * (size_t)v[2];
        if ((q[0] - p[0]) * (r[1] - p[1]) != (q[1] - p[1]) * (r[0] - p[0])) return true;
    }
    return false;
}

/* In a mesh that is no embedding too, flat triangles own no point, and weights are weights. */
static void test_any(void **state)
{
    (void)state;
    uint64_t random = 9;
    int made = 0;
    for (int round = 0; round < 3000; round++) {
        enum { V = 6, T = 4 };
        arrays a = arrays_make(V, T);
        for (int i = 0; i < V; i++)
            arrays_point(&a, mw__random_below(&random, 3), mw__random_below(&random, 3));
        for (int i = 0; i < T; i++) {
            uint32_t u = mw__random_below(&random, V),
                     v = (u + 1 + mw__random_below(&random, V - 1)) % V, w = u;
            while (w == u || w == v) w = mw__random_below(&random, V);
            arrays_triangle(&a, u, v, w);
        }
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        mw_locator *locator;
        mw_mesh_options tolerant = {.tolerant = 1};
        mw_locator_options any = {.any = 1};
        assert_int_equal(mw_mesh_create(&view, &tolerant, &mesh, NULL), MW_OK);
        mw_error error;
        mw_status status = mw_locator_create(mesh, &any, &locator, &error);
        assert_int_equal(status, any_area(&a) ? MW_OK : MW_ERROR_INPUT);
        if (status == MW_OK) {
            made++;
            for (int i = 0; i < MW_WALK_COUNT; i++) {
                mw_query_options options = {
                    .walk = (mw_walk_kind)i, .start = MW_START_RANDOM, .seed = (uint64_t)i};
                mw_cursor cursor;
                assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
                double q[2] = {mw__random_below(&random, 5) / 2.0,
                               mw__random_below(&random, 5) / 2.0};
                mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
                check_weights(&a, &at, q);
                location_answer answer;
                if (at.triangle != MW_NONE)
                    assert_true(location_oracle_contains(
                        a.points, a.triangles + 3 * (size_t)at.triangle, q, &answer));
            }
            assert_true((mw_locator_void_promise(locator) == NULL) == is_embedding(&view));
            mw_locator_destroy(locator);
        }
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
    assert_true(made > 2000); /* of 3000 */
}

/* Remembering where the mesh is Delaunay, celestial where it is far from that: seen in what the
 * walks count. */
static void test_auto_looks_at_the_mesh(void **state)
{
    (void)state;
    uint64_t random = 10;
    for (int delaunay = 0; delaunay < 2; delaunay++) {
        arrays a = arrays_grid(40, 0.9, &random);
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        if (delaunay)
            assert_int_equal(mw_delaunay(a.points, a.point_count, 2, NULL, NULL, NULL, &mesh, NULL),
                             MW_OK);
        else
            assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        mw_locator *locator;
        mw_locator_options any = {.any = 1};
        assert_int_equal(mw_locator_create(mesh, &any, &locator, NULL), MW_OK);
        mw_counters as_auto, as_named;
        double q[200];
        mw_location at[100];
        for (int i = 0; i < 200; i++) q[i] = 40 * random_unit(&random);
        mw_query_options options = {.start = MW_START_RANDOM, .counters = 1};
        assert_int_equal(mw_locate_batch(locator, q, 100, 2, &options, at, &as_auto, NULL), MW_OK);
        options.walk = delaunay ? MW_WALK_REMEMBERING : MW_WALK_CELESTIAL;
        assert_int_equal(mw_locate_batch(locator, q, 100, 2, &options, at, &as_named, NULL), MW_OK);
        assert_memory_equal(&as_auto, &as_named, sizeof as_auto);
        mw_counters twice = as_auto;
        mw_counters_add(&twice, &as_named);
        assert_int_equal(twice.queries, 200);
        assert_int_equal(twice.orient, 2 * as_auto.orient);
        assert_int_equal(twice.triangles_max, as_auto.triangles_max);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Counters do not depend on the number of threads, answers on nothing. */
/* In doubles, too, a walk that left the hull where the point is outside was right: that is no
 * hand-over. */
static void test_no_handover_outside(void **state)
{
    (void)state;
    enum { N = 500 };
    uint64_t random = 11;
    double q[2 * N];
    arrays a = arrays_grid(20, 0.6, &random);
    mw_mesh *mesh;
    assert_int_equal(mw_delaunay(a.points, a.point_count, 2, NULL, NULL, NULL, &mesh, NULL), MW_OK);
    mw_locator *locator = locator_of(mesh, 0);
    for (int i = 0; i < N; i++) {
        q[2 * i] = 200 * random_unit(&random) - 90;
        q[2 * i + 1] = i % 2 ? -10 - 50 * random_unit(&random) : 30 + 50 * random_unit(&random);
    }
    for (mw_walk_kind walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++) {
        mw_query_options options = {
            .walk = walk, .start = MW_START_RANDOM, .arithmetic = MW_DOUBLE, .counters = 1};
        mw_location at[N];
        mw_counters counters;
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &counters, NULL), MW_OK);
        for (int i = 0; i < N; i++) assert_int_equal(at[i].where, MW_OUTSIDE);
        if (counters.handovers)
            fail_msg("%s: %d hand-overs", mw_walk_name(walk), (int)counters.handovers);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_determinism(void **state)
{
    (void)state;
    uint64_t random = 8;
    arrays a = arrays_grid(150, 0.4, &random);
    arrays_scramble(&a, 1, &random);
    mw_mesh *mesh = mesh_of(&a, 0);
    mw_locator *locator = locator_of(mesh, 0);
    enum { N = 100000 };
    double *q = malloc(2 * N * sizeof *q);
    for (int i = 0; i < 2 * N; i++) q[i] = 160 * random_unit(&random) - 5;
    mw_location *first = malloc(N * sizeof *first), *again = malloc(N * sizeof *again);
    assert_int_equal(mw_locate_batch(locator, q, N, 2, NULL, first, NULL, NULL), MW_OK);
    mw_index *index[MW_START_COUNT];
    starts_open(locator, index);
    for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
        mw_counters one = {0};
        for (uint32_t threads = 1; threads <= 5; threads += 2) {
            mw_query_options options = {.start = (mw_start_kind)start,
                                        .threads = threads,
                                        .counters = 1,
                                        .seed = 5,
                                        .index = index[start]};
            mw_counters counters;
            assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, again, &counters, NULL),
                             MW_OK);
            for (int i = 0; i < N; i++)
                if (!isnan(first[i].weight[0]) || !isnan(again[i].weight[0]))
                    assert_memory_equal(&first[i], &again[i], sizeof *first);
                else
                    assert_int_equal(first[i].where, again[i].where);
            if (threads == 1) one = counters;
            assert_memory_equal(&one, &counters, sizeof one);
            assert_int_equal(counters.queries, N);
        }
    }
    starts_close(index);
    free(q);
    free(first);
    free(again);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grids),
        cmocka_unit_test(test_offset_and_scale),
        cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_fan),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_celestial_trap),
        cmocka_unit_test(test_bad_points),
        cmocka_unit_test(test_determinism),
        cmocka_unit_test(test_no_handover_outside),
        cmocka_unit_test(test_weights_at_any_scale),
        cmocka_unit_test(test_any),
        cmocka_unit_test(test_auto_looks_at_the_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
