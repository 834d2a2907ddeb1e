/* The check names every defect and its place; the description of a mesh. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "support/meshes.h"

/* A mesh from literals: n points, m triangles. */
static mw_arrays literal(const double *points, size_t n, const uint32_t *triangles, size_t m)
{
    return (mw_arrays){
        .points = points, .point_count = n, .triangles = triangles, .triangle_count = m};
}

static mw_check check_of(mw_arrays a)
{
    mw_check check;
    assert_int_equal(mw_check_arrays(&a, NULL, &check, NULL), MW_OK);
    for (size_t i = 1; i < check.defect_count; i++) {
        const mw_defect *p = &check.defects[i - 1], *q = &check.defects[i];
        assert_true(p->kind < q->kind || (p->kind == q->kind && p->triangle <= q->triangle));
    }
    bool remarks = check.defect_count == 0 || check.defects[0].kind == MW_DEFECT_FLAT;
    assert_int_equal(check.valid, remarks);
    return check;
}

static size_t count_kind(const mw_check *check, mw_defect_kind kind)
{
    size_t count = 0;
    for (size_t i = 0; i < check->defect_count; i++) count += check->defects[i].kind == kind;
    return count;
}

#define NO_EDGE 255

static mw_defect expect(mw_defect_kind kind, uint32_t triangle, uint32_t other, uint32_t vertex,
                        uint8_t edge, uint8_t other_edge)
{
    return (mw_defect){kind, triangle, other, vertex, edge, other_edge};
}

static void assert_defect(const mw_defect *found, mw_defect expected)
{
    assert_int_equal(found->kind, expected.kind);
    assert_int_equal(found->triangle, expected.triangle);
    assert_int_equal(found->other, expected.other);
    assert_int_equal(found->vertex, expected.vertex);
    assert_int_equal(found->edge, expected.edge);
    assert_int_equal(found->other_edge, expected.other_edge);
}

/* The mesh has exactly this defect. */
static void assert_only(mw_arrays a, mw_defect expected)
{
    mw_check check = check_of(a);
    if (check.defect_count != 1)
        for (size_t i = 0; i < check.defect_count; i++) {
            char text[200];
            mw_defect_describe(&check.defects[i], text, sizeof text);
            print_message("%s\n", text);
        }
    assert_int_equal(check.defect_count, 1);
    assert_defect(&check.defects[0], expected);
    mw_check_release(&check);
}

/* --- single triangles --- */

static void test_sound(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 4, 4, NAN, NAN};
    /* mixed orientation is no defect, nor is an unused vertex that is NaN */
    const uint32_t t[] = {0, 1, 2, 1, 2, 3};
    mw_check check = check_of(literal(p, 5, t, 2));
    assert_int_equal(check.defect_count, 0);
    assert_null(check.defects);
    mw_check_release(&check);
    check = check_of(literal(NULL, 0, NULL, 0));
    assert_int_equal(check.defect_count, 0);
    mw_check_release(&check);
    mw_check_release(NULL);
}

static void test_index(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 4, 4};
    const uint32_t t[] = {0, 1, 2, 1, 3, 4};
    assert_only(literal(p, 4, t, 2),
                expect(MW_DEFECT_MISSING_VERTEX, 1, MW_NONE, 4, NO_EDGE, NO_EDGE));
    const int32_t negative[] = {0, 1, 2, -1, 3, 2};
    mw_arrays a = {.points = p,
                   .point_count = 4,
                   .triangles = negative,
                   .triangle_count = 2,
                   .integer_type = MW_INT32};
    assert_only(a, expect(MW_DEFECT_MISSING_VERTEX, 1, MW_NONE, MW_NONE, NO_EDGE, NO_EDGE));
    const int64_t large[] = {0, 1, INT64_C(1) << 32, 1, 3, 2};
    a.triangles = large;
    a.integer_type = MW_INT64;
    assert_only(a, expect(MW_DEFECT_MISSING_VERTEX, 0, MW_NONE, MW_NONE, NO_EDGE, NO_EDGE));
    mw_check check = check_of(literal(NULL, 0, (const uint32_t[]){0, 8, 9}, 1));
    assert_int_equal(check.defect_count, 3);
    assert_defect(&check.defects[2],
                  expect(MW_DEFECT_MISSING_VERTEX, 0, MW_NONE, 9, NO_EDGE, NO_EDGE));
    mw_check_release(&check);
}

static void test_unusable(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 4, 4, NAN, 1, 1, INFINITY};
    const uint32_t nan[] = {0, 1, 2, 1, 3, 4};
    assert_only(literal(p, 6, nan, 2),
                expect(MW_DEFECT_NOT_FINITE, 1, MW_NONE, 4, NO_EDGE, NO_EDGE));
    const uint32_t infinite[] = {5, 1, 2, 1, 3, 2};
    assert_only(literal(p, 6, infinite, 2),
                expect(MW_DEFECT_NOT_FINITE, 0, MW_NONE, 5, NO_EDGE, NO_EDGE));
    const uint32_t repeated[] = {0, 1, 2, 3, 2, 3};
    assert_only(literal(p, 6, repeated, 2),
                expect(MW_DEFECT_REPEATED_VERTEX, 1, MW_NONE, 3, NO_EDGE, NO_EDGE));
    const uint32_t thrice[] = {0, 1, 2, 3, 3, 3};
    assert_only(literal(p, 6, thrice, 2),
                expect(MW_DEFECT_REPEATED_VERTEX, 1, MW_NONE, 3, NO_EDGE, NO_EDGE));
    const uint32_t both[] = {4, 5, 4};
    mw_check check = check_of(literal(p, 6, both, 1));
    assert_int_equal(check.defect_count, 3);
    assert_defect(&check.defects[0], expect(MW_DEFECT_NOT_FINITE, 0, MW_NONE, 4, NO_EDGE, NO_EDGE));
    assert_defect(&check.defects[1], expect(MW_DEFECT_NOT_FINITE, 0, MW_NONE, 5, NO_EDGE, NO_EDGE));
    assert_defect(&check.defects[2],
                  expect(MW_DEFECT_REPEATED_VERTEX, 0, MW_NONE, 4, NO_EDGE, NO_EDGE));
    mw_check_release(&check);
}

static void test_flat(void **state)
{
    (void)state;
    const double p[] = {0, 0, 1, 1, 2, 2, 0, 4};
    const uint32_t t[] = {0, 1, 2, 0, 2, 3};
    assert_only(literal(p, 4, t, 2), expect(MW_DEFECT_FLAT, 0, MW_NONE, MW_NONE, NO_EDGE, NO_EDGE));
    /* 0.1 + 0.2 is not 0.3 in doubles: a sliver with an area, though a rounded determinant calls
     * it flat */
    const double sliver[] = {0, 0, 0.1, 0.1, 0.3, 0.1 + 0.2};
    const uint32_t one[] = {0, 1, 2};
    mw_check check = check_of(literal(sliver, 3, one, 1));
    assert_int_equal(check.defect_count, 0);
    mw_check_release(&check);
}

/* --- edges and vertices --- */

static void test_shared_edge(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 0, -4, 1, 1};
    const uint32_t t[] = {0, 1, 2, 1, 0, 3, 4, 0, 1};
    mw_check check = check_of(literal(p, 5, t, 3));
    assert_defect(&check.defects[0],
                  expect(MW_DEFECT_NON_MANIFOLD_EDGE, 2, 0, MW_NONE, 1, NO_EDGE));
    assert_int_equal(count_kind(&check, MW_DEFECT_NON_MANIFOLD_EDGE), 1);
    assert_int_equal(count_kind(&check, MW_DEFECT_OVERLAP), 1); /* it lies on triangle 0 */
    mw_check_release(&check);
}

static void test_folded(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 4, 4, 1, 1};
    const uint32_t t[] = {0, 1, 2, 1, 0, 4}, clockwise[] = {2, 1, 0, 4, 1, 0};
    mw_check check = check_of(literal(p, 5, t, 2));
    assert_int_equal(check.defect_count, 2);
    assert_defect(&check.defects[0], expect(MW_DEFECT_FOLDED, 0, 1, MW_NONE, 0, 0));
    assert_defect(&check.defects[1], expect(MW_DEFECT_OVERLAP, 1, MW_NONE, MW_NONE, 2, NO_EDGE));
    mw_check_release(&check);
    check = check_of(literal(p, 5, clockwise, 2));
    assert_defect(&check.defects[0], expect(MW_DEFECT_FOLDED, 0, 1, MW_NONE, 1, 1));
    mw_check_release(&check);
}

static void test_turn(void **state)
{
    (void)state;
    /* a fan that closes after two turns; every second vertex farther out, so that the rim crosses
     * itself */
    enum { SPOKES = 10 };
    double p[2 * (SPOKES + 1)] = {0};
    uint32_t t[3 * SPOKES];
    for (uint32_t i = 0; i < SPOKES; i++) {
        double angle = 4 * 3.14159265358979 * i / SPOKES + 0.1, radius = 1 + 0.03 * i;
        p[2 * i + 2] = radius * cos(angle);
        p[2 * i + 3] = radius * sin(angle);
        memcpy(t + 3 * i, (const uint32_t[]){0, i + 1, (i + 1) % SPOKES + 1}, 3 * sizeof *t);
    }
    mw_check check = check_of(literal(p, SPOKES + 1, t, SPOKES));
    assert_int_equal(count_kind(&check, MW_DEFECT_WINDING), 1);
    assert_defect(&check.defects[0], expect(MW_DEFECT_WINDING, 0, MW_NONE, 0, NO_EDGE, NO_EDGE));
    mw_check_release(&check);
    /* left open, it overlaps itself, but the vertex is on the border */
    check = check_of(literal(p, SPOKES + 1, t, SPOKES - 2));
    assert_int_equal(count_kind(&check, MW_DEFECT_WINDING), 0);
    assert_false(check.valid);
    mw_check_release(&check);
}

static void test_vertex_in_edge(void **state)
{
    (void)state;
    /*   3          Triangle 1 begins in the middle of edge 0-1 of triangle 0. */
    const double p[] = {0, 0, 4, 0, 2, 0, 2, 3, 1, -3, 3, -3};
    const uint32_t t[] = {0, 1, 3, 2, 4, 5};
    assert_only(literal(p, 6, t, 2), expect(MW_DEFECT_VERTEX_IN_EDGE, 0, MW_NONE, 2, 0, NO_EDGE));
    /* filled with a flat triangle, the same is right */
    const uint32_t filled[] = {0, 1, 3, 2, 4, 5, 0, 2, 1};
    mw_check check = check_of(literal(p, 6, filled, 3));
    assert_true(check.valid);
    assert_int_equal(check.defect_count, 1);
    mw_check_release(&check);
}

/* --- pieces over one another --- */

static void test_crossing(void **state)
{
    (void)state;
    /* A triangle stuck into another's edge 2-0: two of its edges, 0 and 1, cross that one. Either
     * both tell so, or the one that is looked at after the edge. */
    const double p[] = {0, 0, 4, 0, 0, 4, -2, 1, 1, 1, -2, 2};
    const uint32_t t[] = {0, 1, 2, 3, 4, 5};
    mw_check check = check_of(literal(p, 6, t, 2));
    assert_in_range(check.defect_count, 1, 2);
    for (size_t i = 0; i < check.defect_count; i++) {
        mw_defect d = check.defects[i];
        bool stuck = d.triangle == 1;
        assert_in_range(stuck ? d.edge : d.other_edge, 0, 1);
        assert_defect(&d, stuck ? expect(MW_DEFECT_CROSSING, 1, 0, MW_NONE, d.edge, 2)
                                : expect(MW_DEFECT_CROSSING, 0, 1, MW_NONE, 2, d.other_edge));
    }
    mw_check_release(&check);
}

static void test_piece_inside(void **state)
{
    (void)state;
    const double p[] = {0, 0, 9, 0, 0, 9, 1, 1, 2, 1, 1, 2, 2, 2};
    const uint32_t t[] = {0, 1, 2, 3, 4, 5, 5, 4, 6};
    assert_only(literal(p, 7, t, 3), expect(MW_DEFECT_OVERLAP, 1, MW_NONE, MW_NONE, 0, NO_EDGE));
}

/* Borders that cross in one place do not hide what is wrong in another. */
static void test_crossing_hides_nothing(void **state)
{
    (void)state;
    const double p[] = {0,  0, 4,  0, 0,  4, -2, 1, 1,  1, -2, 2,
                        20, 0, 29, 0, 20, 9, 21, 1, 22, 1, 21, 2};
    const uint32_t t[] = {3, 4, 5, 0, 1, 2, 6, 7, 8, 9, 10, 11};
    mw_check check = check_of(literal(p, 12, t, 4));
    assert_int_equal(check.defect_count, 2);
    assert_int_equal(check.defects[0].kind, MW_DEFECT_CROSSING);
    assert_int_equal(check.defects[0].triangle, 1);
    assert_defect(&check.defects[1], expect(MW_DEFECT_OVERLAP, 3, MW_NONE, MW_NONE, 0, NO_EDGE));
    mw_check_release(&check);
}

static void test_same_piece_twice(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 0, 4, 0, 4, 0, 0, 4, 0};
    const uint32_t t[] = {0, 1, 2, 3, 4, 5};
    mw_check check = check_of(literal(p, 6, t, 2));
    assert_int_equal(check.defect_count, 3);
    bool seen[3] = {false};
    for (size_t i = 0; i < 3; i++) { /* edge k of triangle 1 runs along edge k + 2 of triangle 0 */
        mw_defect d = check.defects[i];
        uint8_t edge = d.triangle == 1 ? d.edge : d.other_edge, along = (uint8_t)((edge + 2) % 3);
        assert_in_range(edge, 0, 2);
        assert_false(seen[edge]);
        seen[edge] = true;
        assert_defect(&d, d.triangle == 1 ? expect(MW_DEFECT_OVERLAP, 1, 0, MW_NONE, edge, along)
                                          : expect(MW_DEFECT_OVERLAP, 0, 1, MW_NONE, along, edge));
    }
    mw_check_release(&check);
}

/* A grid of n x n, and one of its inner vertices pulled far across its neighbours: told where it
 * is. */
static void test_pulled_vertex(void **state)
{
    (void)state;
    uint64_t random = 5;
    enum { N = 20 };
    arrays a = arrays_grid(N, 0, &random);
    uint32_t v = 7 * (N + 1) + 9;
    a.points[2 * v] += 5.5;
    mw_check check = check_of(arrays_view(&a));
    assert_true(count_kind(&check, MW_DEFECT_FOLDED) > 0);
    for (size_t i = 0; i < check.defect_count; i++) {
        const uint32_t *t = a.triangles + 3 * (size_t)check.defects[i].triangle;
        const uint32_t *u = a.triangles + 3 * (size_t)check.defects[i].other;
        if (check.defects[i].kind != MW_DEFECT_FOLDED) continue;
        assert_true(t[0] == v || t[1] == v || t[2] == v || u[0] == v || u[1] == v || u[2] == v);
    }
    mw_check_release(&check);
    arrays_free(&a);
}

static void test_all_at_once(void **state)
{
    (void)state;
    const double p[] = {0,  0, 4,  0, 0,   4, 10, 0, 14, 0, 10, 4, 11, 1,
                        12, 1, 11, 2, NAN, 0, 20, 0, 21, 0, 22, 0, 1,  1};
    const uint32_t t[] = {0, 1, 2, 3,  4,  5,  6, 7, 8,  0, 9, 1,
                          2, 2, 3, 10, 11, 12, 0, 1, 99, 1, 0, 13};
    mw_check check = check_of(literal(p, 14, t, 8));
    /* triangle 3 with its NaN is the second at edge 0-1 of triangle 0; so triangle 7 is no fold
     * there, but one too many */
    const mw_defect_kind kinds[] = {MW_DEFECT_MISSING_VERTEX,
                                    MW_DEFECT_NOT_FINITE,
                                    MW_DEFECT_REPEATED_VERTEX,
                                    MW_DEFECT_NON_MANIFOLD_EDGE,
                                    MW_DEFECT_OVERLAP,
                                    MW_DEFECT_OVERLAP,
                                    MW_DEFECT_FLAT};
    const uint32_t triangles[] = {6, 3, 4, 7, 2, 7, 5};
    assert_int_equal(check.defect_count, 7);
    for (size_t i = 0; i < 7; i++) {
        assert_int_equal(check.defects[i].kind, kinds[i]);
        assert_int_equal(check.defects[i].triangle, triangles[i]);
    }
    mw_check_release(&check);
}

/* --- texts and arguments --- */

static void test_texts(void **state)
{
    (void)state;
    for (int kind = 0; kind <= MW_DEFECT_COUNT; kind++) {
        assert_true(strlen(mw_defect_text((mw_defect_kind)kind)) > 3);
        mw_defect defect = {(mw_defect_kind)kind, 1234567, 7654321, 55555, 1, 2};
        char text[160], little[9];
        mw_defect_describe(&defect, text, sizeof text);
        assert_memory_equal(text, "triangle 1234567: ", 18);
        assert_true(strlen(text) < sizeof text - 1);
        bool alone = kind == MW_DEFECT_FLAT || kind == MW_DEFECT_OPEN_EDGE ||
                     kind == MW_DEFECT_THROUGH_CENTRE;
        assert_true(alone || kind == MW_DEFECT_COUNT || strstr(text, "7654321") ||
                    strstr(text, "55555"));
        mw_defect_describe(&defect, little, sizeof little);
        assert_string_equal(little, "triangle");
    }
}

static void test_arguments(void **state)
{
    (void)state;
    mw_check check;
    mw_error error;
    mw_arrays a = {.point_count = 3};
    assert_int_equal(mw_check_arrays(&a, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_check_arrays(NULL, NULL, &check, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_check_arrays(&a, NULL, &check, &error), MW_ERROR_ARGUMENT);
    a = (mw_arrays){.points = (const double[]){0},
                    .point_count = 1,
                    .triangles = &a,
                    .triangle_count = (size_t)MW_MAX_TRIANGLES + 1};
    assert_int_equal(mw_check_arrays(&a, NULL, &check, &error), MW_ERROR_LIMIT);
    assert_int_equal(mw_mesh_describe(NULL, NULL, NULL, &error), MW_ERROR_ARGUMENT);
}

/* --- the description --- */

static mw_mesh_info describe(mw_arrays a)
{
    mw_mesh *mesh;
    mw_mesh_info info;
    assert_int_equal(mw_mesh_create(&a, &(mw_mesh_options){.tolerant = 1}, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_describe(mesh, NULL, &info, NULL), MW_OK);
    mw_mesh_destroy(mesh);
    return info;
}

static void test_describe_empty(void **state)
{
    (void)state;
    const double p[] = {1, 2};
    mw_mesh_info info = describe(literal(p, 1, NULL, 0));
    assert_int_equal(info.vertices, 1);
    assert_int_equal(info.unused_vertices, 1);
    assert_int_equal(info.triangles + info.components + info.border_loops + info.holes, 0);
    assert_true(isnan(info.low[0]) && isnan(info.high[1]) && info.area == 0);
    assert_true(info.embedding && !info.convex && !info.delaunay);
}

static void test_describe_square(void **state)
{
    (void)state;
    const double p[] = {0, 0, 4, 0, 5, 5, 0, 4, 7, 7};
    const uint32_t t[] = {0, 1, 2, 0, 3, 2}, other[] = {0, 1, 3, 1, 2, 3};
    mw_mesh_info info = describe(literal(p, 5, t, 2));
    assert_int_equal(info.unused_vertices, 1);
    assert_int_equal(info.clockwise_triangles, 1);
    assert_int_equal(info.clashing_edges, 1);
    assert_int_equal(info.border_edges, 4);
    assert_int_equal(info.border_loops, 1);
    assert_int_equal(info.components, 1);
    assert_true(!info.oriented && info.embedding && info.convex && !info.delaunay);
    assert_true(info.low[0] == 0 && info.low[1] == 0 && info.high[0] == 5 && info.high[1] == 5 &&
                info.area == 20);
    info = describe(literal(p, 5, other, 2));
    assert_true(info.oriented && info.convex && info.delaunay && info.clashing_edges == 0);
}

/* A 3 x 3 grid without its middle cell, in one piece or in two that touch along coincident edges.
 */
static void test_describe_ring(void **state)
{
    (void)state;
    for (int pieces = 1; pieces <= 2; pieces++) {
        arrays a = arrays_make(64, 64);
        for (uint32_t side = 0; side < 2; side++)
            for (uint32_t i = 0; i < 16; i++) arrays_point(&a, i % 4, i / 4);
        for (uint32_t cell = 0; cell < 9; cell++) {
            uint32_t v = cell % 3 + cell / 3 * 4 + (pieces == 2 && cell < 3 ? 16 : 0);
            if (cell == 4) continue;
            arrays_triangle(&a, v, v + 1, v + 5);
            arrays_triangle(&a, v, v + 5, v + 4);
        }
        mw_mesh_info info = describe(arrays_view(&a));
        assert_int_equal(info.holes, 1);
        assert_int_equal(info.components, pieces);
        assert_int_equal(info.border_loops, 2);
        assert_int_equal(info.border_edges, pieces == 1 ? 16 : 20);
        assert_true(info.embedding && !info.convex && info.delaunay && info.area == 8);
        arrays_free(&a);
    }
}

static void test_describe_defective(void **state)
{
    (void)state;
    /* a Moebius strip of five triangles, seen from above: one border, no orientation */
    const double p[] = {0, 0, 4, 0, 5, 3, 2, 5, -1, 3};
    const uint32_t t[] = {0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 4, 0, 1};
    mw_mesh_info info = describe(literal(p, 5, t, 5));
    assert_int_equal(info.border_loops, 1);
    assert_int_equal(info.border_edges, 5);
    assert_int_equal(info.holes, 0);
    assert_true(!info.oriented && !info.embedding && !info.convex && !info.delaunay);
    /* triangles that are not usable neither spoil the extent nor the area */
    const double q[] = {0, 0, 4, 0, 0, 4, NAN, 1, INFINITY, 8};
    const uint32_t u[] = {0, 1, 2, 0, 3, 4, 1, 1, 2};
    info = describe(literal(q, 5, u, 3));
    assert_true(info.high[0] == 4 && info.high[1] == 4 && info.area == 8 && !info.embedding);
    assert_int_equal(info.flat_triangles, 2);
}

static void test_area_compensated(void **state)
{
    (void)state;
    /* one large triangle and many small ones that a plain sum would lose */
    enum { N = 1000 };
    arrays a = arrays_make(3 * N + 3, N + 1);
    arrays_triangle(&a, arrays_point(&a, -0x1p54, 0), arrays_point(&a, -0x1p53, 0),
                    arrays_point(&a, -0x1p53, 2));
    for (uint32_t i = 0; i < N; i++)
        arrays_triangle(&a, arrays_point(&a, 2 * i, 0), arrays_point(&a, 2 * i + 1, 0),
                        arrays_point(&a, 2 * i, 1));
    mw_mesh_info info = describe(arrays_view(&a));
    assert_true(info.embedding);
    assert_true(info.area == 0x1p53 + N / 2);
    assert_int_equal(info.components, N + 1);
    arrays_free(&a);
}

/* --- real data, where it is at hand --- */

typedef struct real {
    const char *name;
    bool embedding, convex, delaunay;
    /* as the data's own notes count them, or another program */
    uint32_t border_edges, border_loops, components;
} real;

static void check_real(const real *expected)
{
    char path[300];
    mw_mesh_file file;
    snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, expected->name);
    FILE *present = fopen(path, "rb");
    if (!present) return;
    fclose(present);
    assert_int_equal(mw_read_mesh(path, NULL, &file, NULL), MW_OK);
    mw_arrays view = mw_mesh_file_arrays(&file);
    mw_check check = check_of(view);
    mw_mesh_info info = describe(view);
    print_message("%s: %zu triangles, %zu defects\n", expected->name, file.triangle_count,
                  check.defect_count);
    assert_int_equal(check.valid, expected->embedding);
    assert_int_equal(info.embedding, expected->embedding);
    assert_int_equal(info.convex, expected->convex);
    assert_int_equal(info.delaunay, expected->delaunay);
    assert_int_equal(info.border_edges, expected->border_edges);
    assert_int_equal(info.border_loops, expected->border_loops);
    assert_int_equal(info.components, expected->components);
    assert_true(check.defect_count < 10 * (size_t)info.triangles);
    mw_check_release(&check);
    mw_mesh_file_release(&file);
}

static void test_real(void **state)
{
    (void)state;
    const real meshes[] = {
        {"domain/greenland.node.gz", true, false, true, 2559, 1, 1},
        {"ocean/malpasset.node.gz", true, false, false, 1080, 1, 1},
        {"terrain/terrain.stl.gz", true, true, false, 126, 1, 1},
        /* surfaces in space, seen from above: folded, in pieces, with holes in them, without
         * orientation */
        {"surface/bunny_zipper.ply.gz", false, false, false, 223, 5, 1},
        {"surface/shark_holes.off.gz", false, false, false, 304, 4, 1},
        {"surface/lion_head.off.gz", false, false, false, 36, 1, 1},
        {"surface/bones.off.gz", false, false, false, 0, 0, 26},
        {"surface/igea.ply.gz", false, false, false, 0, 0, 1},
        {"bad/blobby_shuffled.off.gz", false, false, false, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) check_real(&meshes[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sound),
        cmocka_unit_test(test_index),
        cmocka_unit_test(test_unusable),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_shared_edge),
        cmocka_unit_test(test_folded),
        cmocka_unit_test(test_turn),
        cmocka_unit_test(test_vertex_in_edge),
        cmocka_unit_test(test_crossing),
        cmocka_unit_test(test_piece_inside),
        cmocka_unit_test(test_crossing_hides_nothing),
        cmocka_unit_test(test_same_piece_twice),
        cmocka_unit_test(test_pulled_vertex),
        cmocka_unit_test(test_all_at_once),
        cmocka_unit_test(test_texts),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_describe_empty),
        cmocka_unit_test(test_describe_square),
        cmocka_unit_test(test_describe_ring),
        cmocka_unit_test(test_describe_defective),
        cmocka_unit_test(test_area_compensated),
        cmocka_unit_test(test_real),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
