/* test_agreement.c - large and real meshes: all walks, starts, lanes and threads give the same
 * answers, bit for bit, and these are those of brute force. Real files are read from a folder of
 * data beside the project where it is there. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/meshes.h"
#include "support/start_list.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static arrays arrays_of(const mw_mesh *mesh)
{
    arrays a = arrays_make(mw_mesh_vertex_count(mesh), mw_mesh_triangle_count(mesh));
    a.point_count = mw_mesh_vertex_count(mesh);
    for (uint32_t v = 0; v < a.point_count; v++) mw_mesh_vertex(mesh, v, a.points + 2 * (size_t)v);
    a.triangle_count = mw_mesh_triangle_count(mesh);
    for (uint32_t t = 0; t < a.triangle_count; t++)
        mw_mesh_triangle(mesh, t, a.triangles + 3 * (size_t)t);
    return a;
}

static arrays triangulated(const double *points, size_t n, size_t stride)
{
    mw_mesh *mesh;
    mw_error error;
    if (mw_delaunay(points, n, stride, NULL, NULL, NULL, &mesh, &error))
        fail_msg("%s", error.message);
    arrays a = arrays_of(mesh);
    mw_mesh_destroy(mesh);
    return a;
}

/* The lowest triangle that contains q, by looking at all of them with the exact predicate. */
static uint32_t by_force(const arrays *a, const double *q)
{
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        const double *p[3];
        for (size_t k = 0; k < 3; k++)
            p[k] = a->points + 2 * (size_t)a->triangles[3 * (size_t)t + k];
        double turn = mw_orient2d(p[0], p[1], p[2]);
        int inside = turn != 0;
        for (int k = 0; k < 3 && inside; k++) {
            double side = mw_orient2d(p[k], p[(k + 1) % 3], q);
            inside = turn > 0 ? side >= 0 : side <= 0;
        }
        if (inside) return t;
    }
    return MW_NONE;
}

static void expect_same(const mw_location *a, const mw_location *b, size_t n, const char *how)
{
    for (size_t i = 0; i < n; i++)
        if (a[i].triangle != b[i].triangle || a[i].where != b[i].where ||
            a[i].local != b[i].local || a[i].hole != b[i].hole ||
            (a[i].triangle != MW_NONE && memcmp(a[i].weight, b[i].weight, sizeof a[i].weight)))
            fail_msg("%s: query %zu is in triangle %u (%s), not %u (%s)", how, i, b[i].triangle,
                     mw_where_name((mw_where)b[i].where), a[i].triangle,
                     mw_where_name((mw_where)a[i].where));
}

static void try_combinations(const arrays *a, const double *q, size_t n, const mw_location *want)
{
    mw_location *at = malloc(n * sizeof *at);
    for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
        mw_locator *locator;
        mw_mesh *mesh = arrays_mesh(a, (mw_mesh_options){.layout = layout});
        assert_int_equal(mw_locator_create(mesh, NULL, &locator, NULL), MW_OK);
        mw_index *index[MW_START_COUNT];
        starts_open(locator, index);
        for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
            for (int start = MW_START_AUTO; start < MW_START_COUNT; start++) {
                mw_query_options options = {.walk = (mw_walk_kind)walk,
                                            .start = (mw_start_kind)start,
                                            .arithmetic =
                                                (mw_arithmetic)((walk + start + (int)layout) % 2),
                                            .threads = 1 + (uint32_t)start % 3,
                                            .lanes = (uint32_t)(walk * 7 + start),
                                            .index = index[start]};
                char how[96];
                snprintf(how, sizeof how, "%s from %s, arithmetic %d, layout %d",
                         mw_walk_name(options.walk), mw_start_name(options.start),
                         options.arithmetic, layout);
                assert_int_equal(mw_locate_batch(locator, q, n, 2, &options, at, NULL, NULL),
                                 MW_OK);
                expect_same(want, at, n, how);
            }
        starts_close(index);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
    free(at);
}

static void agree(arrays *a, uint64_t *random)
{
    mw_arrays view = arrays_view(a);
    mw_mesh *mesh;
    mw_locator *locator;
    mw_cursor cursor;
    mw_error error;
    mw_query_options options = {.walk = MW_WALK_CELESTIAL};
    if (mw_mesh_create(&view, NULL, &mesh, &error)) fail_msg("%s", error.message);
    if (mw_locator_create(mesh, NULL, &locator, &error)) fail_msg("%s", error.message);
    assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
    size_t n;
    double *q = arrays_queries(a, 300, &n, random);
    mw_location *want = malloc(n * sizeof *want);
    for (size_t i = 0; i < n; i++) want[i] = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
    for (size_t i = 0; i < n; i += 13) assert_int_equal(want[i].triangle, by_force(a, q + 2 * i));
    try_combinations(a, q, n, want);
    free(want);
    free(q);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(a);
}

typedef void (*point_spread)(double *point, uint64_t *random);

static void uniform(double *p, uint64_t *random)
{
    p[0] = random_unit(random);
    p[1] = random_unit(random);
}

static void clustered(double *p, uint64_t *random)
{
    uint64_t centre = mw__random_below(random, 9);
    for (int k = 0; k < 2; k++)
        p[k] = random_unit(&centre) +
               0.01 * (random_unit(random) + random_unit(random) - 1) * random_unit(random);
}

static void on_grid(double *p, uint64_t *random)
{
    p[0] = mw__random_below(random, 80);
    p[1] = mw__random_below(random, 80);
}

static void far_off(double *p, uint64_t *random)
{
    p[0] = 5e6 + 1e-3 * mw__random_below(random, 1000000);
    p[1] = 5e6 + 1e-6 * mw__random_below(random, 1000000);
}

static void test_generated(void **state)
{
    (void)state;
    const point_spread all[] = {uniform, clustered, on_grid, far_off};
    uint64_t random = 1;
    for (int i = 0; i < 8; i++) {
        enum { N = 5000 };
        double *points = malloc(2 * N * sizeof *points);
        for (int v = 0; v < N; v++) all[i % 4](points + 2 * v, &random);
        arrays a = triangulated(points, N, 2);
        arrays_scramble(&a, i % 2, &random);
        if (i >= 4) arrays_punch(&a, 0.03 * i, &random);
        agree(&a, &random);
        free(points);
    }
}

static bool have(const char *name, char path[512])
{
    snprintf(path, 512, "%s/%s", MW_TEST_SHARED, name);
    return access(path, R_OK) == 0;
}

/* Planar meshes as they are: rivers, ice, lakes; with a border that is not convex. */
static void test_real_meshes(void **state)
{
    (void)state;
    const char *const names[] = {"domain/greenland.node.gz", "ocean/malpasset.node.gz",
                                 "terrain/mountain.obj.gz", "terrain/terrain.stl.gz"};
    uint64_t random = 2;
    char path[512];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!have(names[i], path)) continue;
        mw_mesh_file file;
        mw_error error;
        if (mw_read_mesh(path, NULL, &file, &error)) fail_msg("%s", error.message);
        mw_arrays view = mw_mesh_file_arrays(&file);
        mw_check check;
        assert_int_equal(mw_check_arrays(&view, NULL, &check, NULL), MW_OK);
        if (check.valid) {
            arrays a = arrays_make((uint32_t)file.point_count, (uint32_t)file.triangle_count);
            for (size_t v = 0; v < file.point_count; v++)
                arrays_point(&a, file.points[3 * v], file.points[3 * v + 1]);
            memcpy(a.triangles, file.triangles, 3 * file.triangle_count * sizeof *a.triangles);
            a.triangle_count = (uint32_t)file.triangle_count;
            agree(&a, &random);
        } else {
            print_message("%s is no embedding\n", names[i]);
        }
        mw_check_release(&check);
        mw_mesh_file_release(&file);
    }
}

/* Ground points of laser scans, triangulated. */
static void test_real_points(void **state)
{
    (void)state;
    const char *const names[] = {"terrain/autzen_ground.xyz.gz", "terrain/topography_ground.xyz.gz",
                                 "terrain/crop_4_6_ground.xyz.gz"};
    uint64_t random = 3;
    char path[512];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!have(names[i], path)) continue;
        mw_point_reader *reader;
        mw_error error;
        if (mw_point_reader_open(path, NULL, &reader, &error)) fail_msg("%s", error.message);
        size_t width = mw_point_reader_width(reader), room = 200000, n;
        double *points = malloc(width * room * sizeof *points);
        assert_int_equal(mw_point_reader_read(reader, points, room, &n, &error), MW_OK);
        mw_point_reader_close(reader);
        arrays a = triangulated(points, n, width);
        agree(&a, &random);
        free(points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated),
        cmocka_unit_test(test_real_meshes),
        cmocka_unit_test(test_real_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
