/* test_mesh.c - meshes from arrays: every type of index, defects by name, neighbours, fields,
 * orders. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};

static mw_status create(const double *points, size_t n, const void *triangles, size_t count,
                        mw_integer_type type, int tolerant, mw_mesh **mesh, mw_error *error)
{
    mw_arrays view = {.points = points,
                      .point_count = n,
                      .triangles = triangles,
                      .triangle_count = count,
                      .integer_type = type};
    mw_mesh_options options = {.tolerant = tolerant};
    return mw_mesh_create(&view, &options, mesh, error);
}

static void expect_square(const mw_mesh *mesh)
{
    uint32_t v[3];
    unsigned edge;
    double p[2];
    assert_int_equal(mw_mesh_vertex_count(mesh), 4);
    assert_int_equal(mw_mesh_triangle_count(mesh), 2);
    mw_mesh_triangle(mesh, 1, v); /* given clockwise: 0 3 2 */
    assert_true(v[0] == 0 && v[1] == 3 && v[2] == 2);
    assert_int_equal(mw_mesh_neighbour(mesh, 0, 2, &edge), 1);
    assert_int_equal(edge, 2);
    assert_int_equal(mw_mesh_neighbour(mesh, 1, 2, &edge), 0);
    assert_int_equal(edge, 2);
    for (unsigned k = 0; k < 2; k++) {
        assert_int_equal(mw_mesh_neighbour(mesh, 0, k, NULL), MW_NONE);
        assert_int_equal(mw_mesh_neighbour(mesh, 1, k, NULL), MW_NONE);
    }
    mw_mesh_vertex(mesh, 2, p);
    assert_true(p[0] == 1 && p[1] == 1);
}

static void test_index_types(void **state)
{
    (void)state;
    const uint32_t u32[] = {0, 1, 2, 0, 3, 2};
    const int32_t i32[] = {0, 1, 2, 0, 3, 2};
    const int64_t i64[] = {0, 1, 2, 0, 3, 2};
    const void *all[] = {u32, i32, i64};
    for (int type = MW_UINT32; type <= MW_INT64; type++) {
        mw_mesh *mesh;
        assert_int_equal(create(square, 4, all[type], 2, (mw_integer_type)type, 0, &mesh, NULL),
                         MW_OK);
        expect_square(mesh);
        mw_mesh_destroy(mesh);
    }
}

static void test_stride(void **state)
{
    (void)state;
    const double xyz[] = {0, 0, 7, 1, 0, 7, 1, 1, 7, 0, 1, 7};
    const uint32_t t[] = {0, 1, 2, 0, 3, 2};
    mw_arrays view = {
        .points = xyz, .point_count = 4, .point_stride = 3, .triangles = t, .triangle_count = 2};
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    expect_square(mesh);
    mw_mesh_destroy(mesh);
    view.point_stride = 1;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_ERROR_ARGUMENT);
    assert_null(mesh);
}

static void expect_refused(const double *points, size_t n, const int64_t *t, size_t count,
                           int64_t triangle, int64_t vertex)
{
    mw_mesh *mesh;
    mw_error error;
    assert_int_equal(create(points, n, t, count, MW_INT64, 0, &mesh, &error), MW_ERROR_INPUT);
    assert_null(mesh);
    assert_int_equal(error.triangle, triangle);
    assert_int_equal(error.vertex, vertex);
    char name[32];
    snprintf(name, sizeof name, "triangle %lld", (long long)triangle);
    assert_non_null(strstr(error.message, name));
}

static void test_defects_are_named(void **state)
{
    (void)state;
    const double odd[] = {0, 0, 1, 0, 1, NAN, 0, 1, 2, 2, INFINITY, 0};
    expect_refused(square, 4, (const int64_t[]){0, 1, 2, 0, 4, 2}, 2, 1, -1);
    expect_refused(square, 4, (const int64_t[]){0, 1, 2, 0, -1, 2}, 2, 1, -1);
    expect_refused(square, 4, (const int64_t[]){0, 1, 2, 0, INT64_C(1) << 32, 2}, 2, 1, -1);
    expect_refused(square, 4, (const int64_t[]){0, 1, 2, 0, UINT32_MAX, 2}, 2, 1, -1);
    expect_refused(square, 4, (const int64_t[]){0, 1, 2, 0, 3, 3}, 2, 1, 3);
    expect_refused(odd, 6, (const int64_t[]){0, 1, 3, 0, 1, 2}, 2, 1, 2);
    expect_refused(odd, 6, (const int64_t[]){0, 1, 3, 0, 1, 5}, 2, 1, 5);
    expect_refused(odd, 6, (const int64_t[]){0, 1, 3, 1, 0, 4, 1, 0, 3}, 3, 2, 0);
    /* a vertex that is not finite, but in no triangle, does not matter */
    mw_mesh *mesh;
    assert_int_equal(create(odd, 6, (const int64_t[]){0, 1, 3}, 1, MW_INT64, 0, &mesh, NULL),
                     MW_OK);
    mw_mesh_destroy(mesh);
}

static void test_tolerant(void **state)
{
    (void)state;
    const double odd[] = {0, 0, 1, 0, 1, NAN, 0, 1, 2, 2};
    const int64_t t[] = {0, 1, 3, 1, 0, 4, 1, 0, 3, 0, 1, 2, 3, 3, 1};
    mw_mesh *mesh;
    assert_int_equal(create(odd, 5, t, 5, MW_INT64, 1, &mesh, NULL), MW_OK);
    /* the first two share edge 0 1 */
    assert_int_equal(mw_mesh_neighbour(mesh, 0, 0, NULL), 1);
    /* the third is not linked there */
    assert_int_equal(mw_mesh_neighbour(mesh, 2, 0, NULL), MW_NONE);
    for (unsigned k = 0; k < 3; k++) assert_int_equal(mw_mesh_neighbour(mesh, 4, k, NULL), MW_NONE);
    mw_mesh_destroy(mesh);
    assert_int_equal(create(odd, 5, (const int64_t[]){0, 1, 9}, 1, MW_INT64, 1, &mesh, NULL),
                     MW_ERROR_INPUT);
}

static void test_arguments(void **state)
{
    (void)state;
    mw_mesh *mesh;
    mw_arrays view = {.point_count = 3};
    assert_int_equal(mw_mesh_create(NULL, NULL, &mesh, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_create(&view, NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    view = (mw_arrays){.points = square, .point_count = SIZE_MAX};
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_ERROR_LIMIT);
    view = (mw_arrays){.points = square,
                       .point_count = 4,
                       .triangles = square,
                       .triangle_count = ((size_t)1 << 30) + 1};
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_ERROR_LIMIT);
    view = (mw_arrays){0};
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK); /* an empty mesh is a mesh */
    assert_int_equal(mw_mesh_triangle_count(mesh), 0);
    mw_mesh_destroy(mesh);
    mw_mesh_destroy(NULL);
}

/* The neighbour's neighbour over the same edge is the triangle itself, and they share that edge's
 * ends. */
static void test_links(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 20; round++) {
        arrays a = arrays_grid(1 + (uint32_t)round, 0.4, &random);
        arrays_punch(&a, 0.05 * (round % 4), &random);
        arrays_scramble(&a, round % 2, &random);
        mw_arrays view = arrays_view(&a);
        mw_mesh *mesh;
        assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
        for (uint32_t t = 0; t < a.triangle_count; t++)
            for (unsigned k = 0; k < 3; k++) {
                unsigned edge = 9, back = 9;
                uint32_t other = mw_mesh_neighbour(mesh, t, k, &edge);
                if (other == MW_NONE) continue;
                assert_int_equal(mw_mesh_neighbour(mesh, other, edge, &back), t);
                assert_int_equal(back, k);
                const uint32_t *u = a.triangles + 3 * (size_t)t,
                               *v = a.triangles + 3 * (size_t)other;
                uint32_t u0 = u[k], u1 = u[(k + 1) % 3], v0 = v[edge], v1 = v[(edge + 1) % 3];
                assert_true((u0 == v0 && u1 == v1) || (u0 == v1 && u1 == v0));
            }
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

static void test_fields(void **state)
{
    (void)state;
    mw_mesh *mesh;
    assert_int_equal(
        create(square, 4, (const uint32_t[]){0, 1, 2, 0, 3, 2}, 2, MW_UINT32, 0, &mesh, NULL),
        MW_OK);
    const double pairs[] = {1, 10, 2, 20, 3, 30, 4, 40};
    assert_null(mw_mesh_field(mesh, "z"));
    assert_int_equal(mw_mesh_set_field(mesh, "z", pairs, 2, NULL), MW_OK);
    assert_int_equal(mw_mesh_set_field(mesh, "depth", pairs + 1, 2, NULL), MW_OK);
    assert_int_equal(mw_mesh_set_field(mesh, "z", pairs, 1, NULL), MW_OK); /* again */
    assert_int_equal(mw_mesh_field_count(mesh), 2);
    assert_string_equal(mw_mesh_field_name(mesh, 1), "depth");
    assert_null(mw_mesh_field_name(mesh, 2));
    assert_true(mw_mesh_field(mesh, "z")[1] == 10 && mw_mesh_field(mesh, "depth")[3] == 40);
    assert_int_equal(mw_mesh_set_field(mesh, NULL, pairs, 1, NULL), MW_ERROR_ARGUMENT);
    assert_true(mw_mesh_bytes(mesh) >= 4 * 32 + 2 * 32);
    mw_mesh_destroy(mesh);
}

static void test_hilbert_order(void **state)
{
    (void)state;
    uint64_t random = 2;
    arrays a = arrays_grid(40, 0.4, &random);
    arrays_point(&a, 1000, 1000); /* used by no triangle: comes last */
    arrays_scramble(&a, 1, &random);
    mw_arrays view = arrays_view(&a);
    mw_mesh *mesh;
    assert_int_equal(mw_mesh_create(&view, NULL, &mesh, NULL), MW_OK);
    uint32_t *triangles = malloc(a.triangle_count * sizeof *triangles),
             *vertices = malloc(a.point_count * sizeof *vertices);
    assert_int_equal(mw_mesh_hilbert_order(mesh, triangles, vertices, NULL), MW_OK);
    uint8_t *seen = calloc(a.triangle_count + a.point_count, 1);
    double jump = 0;
    for (uint32_t i = 0; i < a.triangle_count; i++) {
        assert_int_equal(seen[triangles[i]]++, 0);
        if (!i) continue;
        const double *p = a.points + 2 * (size_t)a.triangles[3 * (size_t)triangles[i]];
        const double *o = a.points + 2 * (size_t)a.triangles[3 * (size_t)triangles[i - 1]];
        jump += hypot(p[0] - o[0], p[1] - o[1]);
    }
    assert_true(jump / a.triangle_count < 2); /* in random order: about 21 */
    for (uint32_t i = 0; i < a.point_count; i++)
        assert_int_equal(seen[a.triangle_count + vertices[i]]++, 0);
    assert_int_equal(vertices[a.point_count - 1], a.point_count - 1);
    free(seen);
    free(triangles);
    free(vertices);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_index_types),
        cmocka_unit_test(test_stride),
        cmocka_unit_test(test_defects_are_named),
        cmocka_unit_test(test_tolerant),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_links),
        cmocka_unit_test(test_fields),
        cmocka_unit_test(test_hilbert_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
