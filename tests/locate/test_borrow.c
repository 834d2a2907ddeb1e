/* test_borrow.c - location in arrays that stay the caller's: the answers are those of an ordinary
 * mesh and of brute force; arrays that are wrong are refused by the check, and do no harm without
 * it. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/location_oracle.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A mesh as other libraries hand it out, in one of the layouts and types. */
typedef struct foreign {
    mw_borrowed_arrays arrays;
    void *triangles, *neighbours;
} foreign;

static void put_number(void *array, mw_integer_type type, size_t i, uint32_t number)
{
    if (type == MW_INT64)
        ((int64_t *)array)[i] = number == MW_NONE ? -1 : (int64_t)number;
    else
        ((uint32_t *)array)[i] = number;
}

static foreign foreign_of(const arrays *a, mw_integer_type type, mw_neighbour_layout layout)
{
    size_t n = 3 * (size_t)a->triangle_count;
    foreign f = {.triangles = malloc(n * 8 + 1), .neighbours = malloc(n * 8 + 1)};
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    uint32_t *opposite = mesh_neighbours(mesh);
    for (size_t i = 0; i < n; i++) {
        /* edge k is opposite to vertex k + 2 */
        size_t k = layout == MW_NEIGHBOUR_OPPOSITE ? i % 3 : (i + 2) % 3;
        put_number(f.triangles, type, i, a->triangles[i]);
        put_number(f.neighbours, type, i, opposite[i - i % 3 + k]);
    }
    free(opposite);
    mw_mesh_destroy(mesh);
    f.arrays =
        (mw_borrowed_arrays){.mesh = arrays_view(a), .neighbours = f.neighbours, .layout = layout};
    f.arrays.mesh.triangles = f.triangles;
    f.arrays.mesh.integer_type = type;
    return f;
}

static void foreign_free(foreign *f)
{
    free(f->triangles);
    free(f->neighbours);
}

static mw_borrowed *borrow(const foreign *f, mw_borrow_options options)
{
    mw_borrowed *mesh;
    mw_error error = {0};
    if (mw_mesh_borrow(&f->arrays, &options, &mesh, &error)) fail_msg("borrow: %s", error.message);
    return mesh;
}

/* --- answers ---------------------------------------------------------------------------------- */

static bool same(const mw_location *a, const mw_location *b)
{
    return a->triangle == b->triangle &&
           (a->where == MW_IN_HOLE ? MW_OUTSIDE : a->where) == b->where && a->local == b->local &&
           (a->triangle == MW_NONE || memcmp(a->weight, b->weight, sizeof a->weight) == 0);
}

static void compare(const mw_location *want, const mw_location *got, const double *q,
                    const char *how)
{
    if (!same(want, got))
        fail_msg("%s: (%.17g, %.17g): triangle %u where %d local %d, not %u %d %d", how, q[0], q[1],
                 got->triangle, got->where, got->local, want->triangle, want->where, want->local);
}

/* By every walk, one by one and in batches. */
static void try_walks(const mw_borrowed *mesh, const mw_location *want, const double *q, size_t n)
{
    static const mw_walk_kind walks[] = {MW_WALK_AUTO, MW_WALK_REMEMBERING, MW_WALK_BARYCENTRIC,
                                         MW_WALK_DIRECT};
    mw_location *got = malloc(n * sizeof *got);
    for (size_t w = 0; w < sizeof walks / sizeof *walks; w++) {
        mw_borrowed_query_options options = {.walk = walks[w], .threads = 2, .in_order = w == 1};
        mw_borrowed_cursor cursor;
        mw_counters counters;
        assert_int_equal(mw_borrowed_cursor_init(&options, &cursor, NULL), MW_OK);
        for (size_t i = 0; i < n; i++) {
            mw_location at = mw_borrowed_locate(mesh, &cursor, q[2 * i], q[2 * i + 1]);
            compare(&want[i], &at, q + 2 * i, mw_walk_name(walks[w]));
        }
        assert_int_equal(mw_borrowed_locate_batch(mesh, q, n, 0, &options, got, &counters, NULL),
                         MW_OK);
        for (size_t i = 0; i < n; i++) compare(&want[i], &got[i], q + 2 * i, "batch");
        assert_true(counters.queries <= n && counters.triangles_visited >= counters.queries);
    }
    free(got);
}

static bool is_convex(const mw_mesh *mesh)
{
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    return info.convex;
}

/* Against a locator of the same arrays, which other tests hold against rationals; the first queries
 * against rationals here, too. */
static void try_arrays(const arrays *a, uint64_t *random)
{
    enum { EACH = 25, ORACLE = 40 };
    size_t n;
    double *q = arrays_queries(a, EACH, &n, random);
    mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_location *want = malloc(n * sizeof *want);
    assert_int_equal(mw_locate_batch(locator, q, n, 0, NULL, want, NULL, NULL), MW_OK);
    for (size_t i = 0; i < n && i < ORACLE; i++) {
        location_answer sure =
            location_oracle_locate(a->points, a->triangles, a->triangle_count, q + 2 * i);
        assert_true(sure.triangle == want[i].triangle && sure.local == want[i].local);
    }
    for (int form = 0; form < 6; form++) {
        static const mw_integer_type types[] = {MW_UINT32, MW_INT32, MW_INT64};
        foreign f = foreign_of(a, types[form % 3],
                               form / 3 ? MW_NEIGHBOUR_ACROSS_EDGE : MW_NEIGHBOUR_OPPOSITE);
        mw_borrowed *view = borrow(&f, (mw_borrow_options){.unchecked = form & 1});
        mw_borrowed_info info;
        mw_borrowed_describe(view, &info);
        assert_int_equal(info.checked, !(form & 1));
        if (info.checked) assert_int_equal(info.convex, is_convex(mesh));
        try_walks(view, want, q, n);
        mw_borrowed_release(view);
        foreign_free(&f);
    }
    free(want);
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* Squares of points on integers (ties everywhere) and moved at random, of triangles that are
 * scrambled and turned round, whole, with holes, and in several pieces. */
static void answers_are_those_of_a_mesh(void **state)
{
    uint64_t random = environment_print_seed("borrow", 11);
    (void)state;
    for (int round = 0; round < 16; round++) {
        arrays a = arrays_grid(1 + (uint32_t)round / 2, round & 1 ? 0 : 0.9, &random);
        if (round & 2) arrays_scramble(&a, round & 4, &random);
        if (round >= 8) arrays_punch(&a, 0.2, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_mesh_info info;
        assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
        mw_mesh_destroy(mesh);
        if (info.embedding) try_arrays(&a, &random);
        arrays_free(&a);
    }
    arrays fan = arrays_fan(300), trap = arrays_trap();
    try_arrays(&fan, &random);
    try_arrays(&trap, &random);
    arrays_free(&fan);
    arrays_free(&trap);
}

/* Coordinates at the ends of the doubles. */
static void extreme_coordinates_are_exact(void **state)
{
    static const double scale[] = {1e-300, 1e300, 1e-15};
    uint64_t random = environment_print_seed("borrow", 12);
    (void)state;
    for (size_t i = 0; i < sizeof scale / sizeof *scale; i++) {
        arrays a = arrays_grid(4, 0.7, &random);
        arrays_scramble(&a, 1, &random);
        arrays_transform(&a, scale[i], scale[i] < 1e-20 ? 0 : 1, 0);
        mw_check check;
        mw_arrays view = arrays_view(&a);
        assert_int_equal(mw_check_arrays(&view, NULL, &check, NULL), MW_OK);
        if (check.valid) try_arrays(&a, &random);
        mw_check_release(&check);
        arrays_free(&a);
    }
}

/* Triangles without area, inside of the mesh and along its hull. */
static void flat_triangles_own_no_point(void **state)
{
    uint64_t random = environment_print_seed("borrow", 13);
    (void)state;
    for (int at_hull = 0; at_hull < 2; at_hull++) {
        /* a square with a vertex on its diagonal or its lowest side, where a flat triangle closes
         * the gap */
        arrays a = arrays_make(5, 5);
        arrays_point(&a, 0, 0);
        arrays_point(&a, 2, 0);
        arrays_point(&a, 2, 2);
        arrays_point(&a, 0, 2);
        arrays_point(&a, 1, at_hull ? 0 : 1);
        arrays_triangle(&a, 0, at_hull ? 1 : 4, at_hull ? 4 : 2);
        if (!at_hull) {
            arrays_triangle(&a, 0, 2, 3);
            arrays_triangle(&a, 0, 1, 4);
            arrays_triangle(&a, 4, 1, 2);
        } else {
            arrays_triangle(&a, 0, 1, 2);
            arrays_triangle(&a, 0, 2, 3);
        }
        try_arrays(&a, &random);
        arrays_free(&a);
    }
}

/* Flat triangles beside one another: the mesh is taken, and answers are right, though it is not
 * known to be convex. */
static void flat_neighbours_are_taken(void **state)
{
    uint64_t random = environment_print_seed("borrow", 14);
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        arrays a = arrays_make(6, 6);
        static const double points[6][2] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 2}};
        for (int i = 0; i < 6; i++) arrays_point(&a, points[i][turned], points[i][!turned]);
        arrays_triangle(&a, 0, 2, 3);
        arrays_triangle(&a, 0, 4, 2);
        arrays_triangle(&a, 4, 5, 2);
        arrays_triangle(&a, 0, 1, 4);
        arrays_triangle(&a, 4, 1, 5);
        arrays_triangle(&a, 5, 1, 2);
        size_t n;
        double *q = arrays_queries(&a, 25, &n, &random);
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_location *want = malloc(n * sizeof *want);
        assert_int_equal(mw_locate_batch(locator, q, n, 0, NULL, want, NULL, NULL), MW_OK);
        foreign f = foreign_of(&a, MW_UINT32, MW_NEIGHBOUR_ACROSS_EDGE);
        mw_borrowed *view = borrow(&f, (mw_borrow_options){0});
        mw_borrowed_info info;
        mw_borrowed_describe(view, &info);
        assert_false(info.convex);
        try_walks(view, want, q, n);
        mw_borrowed_release(view);
        foreign_free(&f);
        free(want);
        free(q);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* --- wrong arrays ----------------------------------------------------------------------------- */

enum { ANY = -2 };

/* Borrowing with the check fails, and names the triangle. */
static void expect_refused(const foreign *f, int64_t triangle, const char *words)
{
    mw_borrowed *mesh;
    mw_error error = {0};
    assert_int_equal(mw_mesh_borrow(&f->arrays, NULL, &mesh, &error), MW_ERROR_INPUT);
    assert_null(mesh);
    assert_true(error.triangle >= 0);
    if ((triangle != ANY && error.triangle != triangle) || !strstr(error.message, words))
        fail_msg("triangle %lld, \"%s\", not %lld, \"%s\"", (long long)error.triangle,
                 error.message, (long long)triangle, words);
}

/* Counts over more triangles than one thread takes at a time. */
static void clockwise_triangles_are_counted(void **state)
{
    enum { SIDE = 130, TURNED = 3 };
    uint64_t random = 1;
    (void)state;
    arrays a = arrays_grid(SIDE, 0.5, &random);
    uint32_t turned = 0;
    for (uint32_t t = 0; t < a.triangle_count; t += TURNED, turned++) {
        uint32_t *v = a.triangles + 3 * (size_t)t, was = v[1];
        v[1] = v[2];
        v[2] = was;
    }
    foreign f = foreign_of(&a, MW_UINT32, MW_NEIGHBOUR_ACROSS_EDGE);
    mw_borrowed *view = borrow(&f, (mw_borrow_options){0});
    mw_borrowed_info info;
    mw_borrowed_describe(view, &info);
    assert_int_equal(info.clockwise_triangles, turned);
    assert_true(info.convex);
    mw_borrowed_release(view);
    foreign_free(&f);
    arrays_free(&a);
}

static void wrong_neighbours_are_refused(void **state)
{
    uint64_t random = 1;
    (void)state;
    arrays a = arrays_grid(4, 0.5, &random);
    foreign f = foreign_of(&a, MW_INT32, MW_NEIGHBOUR_OPPOSITE);
    int32_t *next = f.neighbours, *tri = f.triangles;
    uint32_t k = 0;
    while (next[3 * 9 + k] < 9) k++; /* so that the lower of the two is named */
    int32_t was = next[3 * 9 + k];
    next[3 * 9 + k] = (was + 7) % 32;
    expect_refused(&f, 9, "does not have the vertices");
    next[3 * 9 + k] = 9;
    expect_refused(&f, 9, "does not have the vertices");
    next[3 * 9 + k] = -1;
    expect_refused(&f, was, "not the other way round");
    next[3 * 9 + k] = was;
    int32_t corner = tri[3 * 0 + 1];
    tri[3 * 0 + 1] = 1000;
    expect_refused(&f, 0, "names a vertex that does not exist");
    tri[3 * 0 + 1] = -1;
    expect_refused(&f, 0, "names a vertex that does not exist");
    tri[3 * 0 + 1] = tri[3 * 0];
    expect_refused(&f, 0, "is in it twice");
    tri[3 * 0 + 1] = corner;
    double x = a.points[2 * tri[0]];
    a.points[2 * tri[0]] = NAN;
    expect_refused(&f, 0, "is not finite");
    a.points[2 * tri[0]] = x;
    f.arrays.layout = MW_NEIGHBOUR_ACROSS_EDGE;
    expect_refused(&f, ANY, "would fit the other layout");
    foreign_free(&f);
    arrays_free(&a);
}

/* Two triangles that lie on the same side of their edge. */
static void folds_are_refused(void **state)
{
    (void)state;
    arrays a = arrays_make(4, 2);
    arrays_point(&a, 0, 0);
    arrays_point(&a, 1, 0);
    arrays_point(&a, 0, 1);
    arrays_point(&a, 1, 1);
    arrays_triangle(&a, 0, 1, 2);
    arrays_triangle(&a, 0, 1, 3);
    foreign f = foreign_of(&a, MW_INT64, MW_NEIGHBOUR_ACROSS_EDGE);
    expect_refused(&f, 0, "the same side");
    foreign_free(&f);
    arrays_free(&a);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    uint64_t random = 1;
    arrays a = arrays_grid(2, 0, &random);
    foreign f = foreign_of(&a, MW_INT32, MW_NEIGHBOUR_OPPOSITE);
    mw_borrowed *mesh = borrow(&f, (mw_borrow_options){0}), *none;
    mw_location at;
    mw_borrowed_cursor cursor;
    assert_int_equal(mw_mesh_borrow(NULL, NULL, &none, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_borrow(&f.arrays, NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_borrow(&f.arrays, &(mw_borrow_options){.convex = 1}, &none, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_borrow(&f.arrays, &(mw_borrow_options){.reserved = {1}}, &none, NULL),
                     MW_ERROR_ARGUMENT);
    f.arrays.layout = (mw_neighbour_layout)2;
    assert_int_equal(mw_mesh_borrow(&f.arrays, NULL, &none, NULL), MW_ERROR_ARGUMENT);
    f.arrays.layout = MW_NEIGHBOUR_OPPOSITE;
    f.arrays.neighbours = NULL;
    assert_int_equal(mw_mesh_borrow(&f.arrays, NULL, &none, NULL), MW_ERROR_ARGUMENT);
    mw_borrowed_query_options straight = {.walk = MW_WALK_STRAIGHT};
    assert_int_equal(mw_borrowed_cursor_init(&straight, &cursor, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_borrowed_locate_batch(mesh, a.points, 1, 1, NULL, &at, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_borrowed_locate_batch(mesh, NULL, 1, 0, NULL, &at, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    cursor = (mw_borrowed_cursor){0};
    assert_int_equal(mw_borrowed_locate(mesh, &cursor, NAN, 0).where, MW_BAD);
    assert_int_equal(mw_borrowed_locate(mesh, &cursor, 0.3, INFINITY).where, MW_BAD);
    mw_borrowed_release(mesh);
    mw_borrowed_release(NULL);
    foreign_free(&f);
    arrays_free(&a);
}

/* Nothing to find anything in. */
static void an_empty_mesh_contains_nothing(void **state)
{
    (void)state;
    mw_borrowed *mesh;
    mw_borrowed_arrays nothing = {.layout = MW_NEIGHBOUR_OPPOSITE};
    double q[4] = {0, 0, NAN, 1};
    mw_location at[2];
    mw_borrowed_cursor cursor = {0};
    assert_int_equal(mw_mesh_borrow(&nothing, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_borrowed_locate(mesh, &cursor, 0, 0).where, MW_OUTSIDE);
    assert_int_equal(mw_borrowed_locate_batch(mesh, q, 2, 0, NULL, at, NULL, NULL), MW_OK);
    assert_true(at[0].where == MW_OUTSIDE && at[1].where == MW_BAD);
    mw_borrowed_release(mesh);
}

/* Arrays damaged anywhere, unchecked: no crash and an end; a triangle that is reported contains its
 * point. Damage to links alone, where the mesh is not taken to be convex, hides no triangle. */
static void damage_does_no_harm(void **state)
{
    enum { ROUNDS = 40, EACH = 6 };
    uint64_t random = environment_print_seed("borrow", 14);
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        arrays a = arrays_grid(6, 0.8, &random);
        arrays_scramble(&a, 1, &random);
        foreign f =
            foreign_of(&a, MW_INT32, round & 1 ? MW_NEIGHBOUR_ACROSS_EDGE : MW_NEIGHBOUR_OPPOSITE);
        uint32_t *tri = f.triangles, *next = f.neighbours, size = 3 * a.triangle_count;
        for (int i = 0; i < 1 + round; i++) {
            uint32_t junk = mw__random_below(&random, 4) ? mw__random_below(&random, size / 3)
                                                         : (uint32_t)mw__random(&random);
            next[mw__random_below(&random, size)] = junk;
            if (round & 2) tri[mw__random_below(&random, size)] = junk;
        }
        mw_borrowed *mesh =
            borrow(&f, (mw_borrow_options){.unchecked = 1, .convex = round & 4 ? 1 : 0});
        size_t n;
        double *q = arrays_queries(&a, EACH, &n, &random);
        for (int walk = 0; walk < 3; walk++) {
            static const mw_walk_kind walks[] = {MW_WALK_REMEMBERING, MW_WALK_BARYCENTRIC,
                                                 MW_WALK_DIRECT};
            mw_borrowed_cursor cursor = {.walk = (uint32_t)walks[walk]};
            for (size_t i = 0; i < n; i++) {
                mw_location at = mw_borrowed_locate(mesh, &cursor, q[2 * i], q[2 * i + 1]);
                location_answer in, all;
                if (at.triangle != MW_NONE)
                    assert_true(location_oracle_contains(a.points, tri + 3 * (size_t)at.triangle,
                                                         q + 2 * i, &in));
                if (round & 6) continue;
                all = location_oracle_locate(a.points, tri, a.triangle_count, q + 2 * i);
                assert_int_equal(all.triangle == MW_NONE, at.triangle == MW_NONE);
            }
        }
        free(q);
        mw_borrowed_release(mesh);
        foreign_free(&f);
        arrays_free(&a);
    }
}

/* --- what the walks cost ---------------------------------------------------------------------- */

/* The coordinates of the barycentric and the direct walk do not depend on the orientation of
 * triangles: they visit the same triangles, whichever are clockwise, and make as many tests as
 * published: three a triangle, or two and one more in the first. */
static void coordinates_are_independent_of_orientation(void **state)
{
    enum { QUERIES = 200 };
    uint64_t random = environment_print_seed("borrow", 15);
    (void)state;
    mw_walk_kind walks[2] = {MW_WALK_BARYCENTRIC, MW_WALK_DIRECT};
    arrays a = arrays_grid(20, 0.6, &random);
    foreign turned[2];
    turned[0] = foreign_of(&a, MW_INT32, MW_NEIGHBOUR_OPPOSITE);
    turned[1] = foreign_of(&a, MW_INT32, MW_NEIGHBOUR_OPPOSITE);
    for (uint32_t t = 0; t < a.triangle_count; t++) {
        uint32_t *v = (uint32_t *)turned[1].triangles + 3 * (size_t)t,
                 *n = (uint32_t *)turned[1].neighbours + 3 * (size_t)t;
        if (mw__random_below(&random, 2)) continue;
        mw__swap(&v[1], &v[2]);
        mw__swap(&n[1], &n[2]);
    }
    for (int w = 0; w < 2; w++) {
        mw_borrowed_cursor cursor[2];
        uint64_t draw = 5;
        mw_borrowed *mesh[2];
        for (int i = 0; i < 2; i++) {
            mesh[i] = borrow(&turned[i], (mw_borrow_options){0});
            assert_int_equal(mw_borrowed_cursor_init(&(mw_borrowed_query_options){.walk = walks[w]},
                                                     &cursor[i], NULL),
                             MW_OK);
        }
        for (int q = 0; q < QUERIES; q++) {
            double x = 20 * random_unit(&draw), y = 20 * random_unit(&draw);
            mw_location one = mw_borrowed_locate(mesh[0], &cursor[0], x, y);
            mw_location two = mw_borrowed_locate(mesh[1], &cursor[1], x, y);
            assert_int_equal(one.triangle, two.triangle);
        }
        const mw_counters *c = &cursor[0].counters, *d = &cursor[1].counters;
        assert_int_equal(c->triangles, d->triangles);
        assert_int_equal(c->orient, d->orient);
        assert_int_equal(c->handovers, 0);
        assert_int_equal(c->orient, w == 0 ? 3 * c->triangles : 2 * c->triangles + c->queries);
        assert_true(c->triangles > 3 * c->queries && c->triangles_final < 2 * c->queries);
        mw_borrowed_release(mesh[0]);
        mw_borrowed_release(mesh[1]);
    }
    foreign_free(&turned[0]);
    foreign_free(&turned[1]);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_a_mesh),
        cmocka_unit_test(extreme_coordinates_are_exact),
        cmocka_unit_test(flat_triangles_own_no_point),
        cmocka_unit_test(flat_neighbours_are_taken),
        cmocka_unit_test(clockwise_triangles_are_counted),
        cmocka_unit_test(wrong_neighbours_are_refused),
        cmocka_unit_test(folds_are_refused),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(an_empty_mesh_contains_nothing),
        cmocka_unit_test(damage_does_no_harm),
        cmocka_unit_test(coordinates_are_independent_of_orientation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
