/* test_trap.c - the mesh data/trap.off is what data/README.md says: for the queries of
 * data/trap.csv Lawson's walk, the remembering walk and those that follow the least value cycle,
 * in exact arithmetic, from the triangles named there. The walks are written here once more, from
 * their definitions, as a choice of the edge to cross. And the library's walks get out of there. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "oracle/location_oracle.h"

#include <gmp.h>
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdbool.h>

enum { RING = 10, INSIDE_END = 17, TRIANGLES = 40, QUERIES = 16, NO_EDGE = 3 };

typedef struct trap_data {
    mw_mesh *mesh;
    double query[QUERIES][2];
} trap_data;

static void read_queries(trap_data *trap)
{
    mw_point_reader *reader;
    mw_error error;
    size_t count;
    double more[2];
    if (mw_point_reader_open(MW_TEST_SOURCE "/data/trap.csv", NULL, &reader, &error))
        fail_msg("%s", error.message);
    assert_int_equal(mw_point_reader_width(reader), 2);
    assert_int_equal(mw_point_reader_read(reader, trap->query[0], QUERIES, &count, NULL), MW_OK);
    assert_int_equal(count, QUERIES);
    assert_int_equal(mw_point_reader_read(reader, more, 1, &count, NULL), MW_OK);
    assert_int_equal(count, 0);
    mw_point_reader_close(reader);
}

static int trap_read(void **state)
{
    static trap_data trap;
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh(MW_TEST_SOURCE "/data/trap.off", NULL, &file, &error))
        fail_msg("%s", error.message);
    mw_arrays view = mw_mesh_file_arrays(&file);
    if (mw_mesh_create(&view, NULL, &trap.mesh, &error)) fail_msg("%s", error.message);
    mw_mesh_file_release(&file);
    read_queries(&trap);
    *state = &trap;
    return 0;
}

static int trap_release(void **state)
{
    trap_data *trap = *state;
    mw_mesh_destroy(trap->mesh);
    return 0;
}

/* The corners of triangle t. */
static void corners_of(const mw_mesh *mesh, uint32_t t, double corner[3][2])
{
    uint32_t v[3];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], corner[k]);
}

/* Which edge does a walk cross that came to t by the edge `entry`? NO_EDGE: q is in t. */
typedef int choice(const mw_mesh *mesh, uint32_t t, int entry, const double q[2]);

static int first_beyond(const mw_mesh *mesh, uint32_t t, const double q[2])
{
    double corner[3][2];
    corners_of(mesh, t, corner);
    for (int k = 0; k < 3; k++)
        if (mw_orient2d(corner[k], corner[(k + 1) % 3], q) < 0) return k;
    return NO_EDGE;
}

static int lawson(const mw_mesh *mesh, uint32_t t, int entry, const double q[2])
{
    (void)entry;
    return first_beyond(mesh, t, q);
}

/* The point never lies beyond the edge that the walk came by. */
static int remembering(const mw_mesh *mesh, uint32_t t, int entry, const double q[2])
{
    int edge = first_beyond(mesh, t, q);
    assert_true(edge == NO_EDGE || edge != entry);
    return edge;
}

/* Twice the signed area of abc, as a rational. */
static void area(mpq_t twice, const double a[2], const double b[2], const double c[2])
{
    mpq_t v[6];
    const double *from[6] = {&a[0], &a[1], &b[0], &b[1], &c[0], &c[1]};
    for (int i = 0; i < 6; i++) {
        mpq_init(v[i]);
        mpq_set_d(v[i], *from[i]);
    }
    for (int i = 0; i < 4; i++) mpq_sub(v[i], v[i], v[4 + i % 2]);
    mpq_mul(v[0], v[0], v[3]);
    mpq_mul(v[1], v[1], v[2]);
    mpq_sub(twice, v[0], v[1]);
    for (int i = 0; i < 6; i++) mpq_clear(v[i]);
}

/* The edge with the least value, if that is negative: areas, or their shares in the triangle's. */
static int least(const mw_mesh *mesh, uint32_t t, bool shares, const double q[2])
{
    double corner[3][2];
    mpq_t value[3], whole;
    corners_of(mesh, t, corner);
    mpq_init(whole);
    area(whole, corner[0], corner[1], corner[2]);
    int best = 0;
    for (int k = 0; k < 3; k++) {
        mpq_init(value[k]);
        area(value[k], corner[k], corner[(k + 1) % 3], q);
        if (shares) mpq_div(value[k], value[k], whole);
        if (mpq_cmp(value[k], value[best]) < 0) best = k;
    }
    if (mpq_sgn(value[best]) >= 0) best = NO_EDGE;
    for (int k = 0; k < 3; k++) mpq_clear(value[k]);
    mpq_clear(whole);
    return best;
}

static int barycentric(const mw_mesh *mesh, uint32_t t, int entry, const double q[2])
{
    (void)entry;
    return least(mesh, t, true, q);
}

static int direct(const mw_mesh *mesh, uint32_t t, int entry, const double q[2])
{
    (void)entry;
    return least(mesh, t, false, q);
}

/* Walk until the walk ends or comes to a triangle by the same edge again. Returns whether it did
 * the latter; *t is the last triangle. */
static bool cycles(const mw_mesh *mesh, choice *choose, uint32_t *t, const double q[2])
{
    bool been[TRIANGLES][4] = {{false}};
    int entry = NO_EDGE;
    while (!been[*t][entry]) {
        been[*t][entry] = true;
        int k = choose(mesh, *t, entry, q);
        if (k == NO_EDGE) return false;
        unsigned there;
        *t = mw_mesh_neighbour(mesh, *t, (unsigned)k, &there);
        assert_true(*t != MW_NONE);
        entry = (int)there;
    }
    return true;
}

static bool contains(const mw_mesh *mesh, uint32_t t, const double q[2])
{
    double corner[3][2];
    location_answer answer;
    corners_of(mesh, t, corner);
    return location_oracle_contains(corner[0], (const uint32_t[3]){0, 1, 2}, q, &answer);
}

/* From every triangle but those inside the ring the walk goes round the ring; from there it ends
 * at q. */
static void expect_trapped(const trap_data *trap, choice *choose)
{
    for (int i = 0; i < QUERIES; i++)
        for (uint32_t start = 0; start < TRIANGLES; start++) {
            uint32_t t = start;
            bool cycle = cycles(trap->mesh, choose, &t, trap->query[i]);
            if (cycle != (start < RING || start >= INSIDE_END))
                fail_msg("query %d from triangle %u: %s", i, start, cycle ? "cycles" : "ends");
            assert_true(cycle ? t < RING : contains(trap->mesh, t, trap->query[i]));
        }
}

static void test_mesh(void **state)
{
    trap_data *trap = *state;
    mw_mesh_info info;
    assert_int_equal(mw_mesh_describe(trap->mesh, NULL, &info, NULL), MW_OK);
    assert_int_equal(info.triangles, TRIANGLES);
    assert_true(info.convex && !info.delaunay);
    assert_int_equal(info.flat_triangles + info.clockwise_triangles + info.unused_vertices, 0);
}

/* The queries lie inside the ring, and its triangles with an odd number have two edges that lie in
 * q's way. */
static void test_queries(void **state)
{
    trap_data *trap = *state;
    for (int i = 0; i < QUERIES; i++)
        for (uint32_t t = 0; t < TRIANGLES; t++) {
            if (t < RING || t >= INSIDE_END) assert_false(contains(trap->mesh, t, trap->query[i]));
            double corner[3][2];
            corners_of(trap->mesh, t, corner);
            int beyond = 0;
            for (int k = 0; k < 3; k++)
                beyond +=
                    location_oracle_orient(corner[k], corner[(k + 1) % 3], trap->query[i]) < 0;
            if (t < RING) assert_int_equal(beyond, 1 + t % 2);
        }
}

static void test_lawson(void **state)
{
    expect_trapped(*state, lawson);
}

static void test_remembering(void **state)
{
    expect_trapped(*state, remembering);
}

static void test_barycentric(void **state)
{
    expect_trapped(*state, barycentric);
}

static void test_direct(void **state)
{
    expect_trapped(*state, direct);
}

/* What the library's walks do in the trap: from each start they answer, and say how. */
static mw_counters locate_all(const trap_data *trap, mw_walk_kind walk, mw_arithmetic arithmetic,
                              int areas)
{
    enum { ROUNDS = 20 };
    mw_locator *locator;
    mw_cursor cursor;
    mw_locator_options how = {.areas = areas};
    mw_query_options options = {
        .walk = walk, .start = MW_START_RANDOM, .arithmetic = arithmetic, .counters = 1};
    assert_int_equal(mw_locator_create(trap->mesh, &how, &locator, NULL), MW_OK);
    assert_int_equal(mw_cursor_init(locator, &options, &cursor, NULL), MW_OK);
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < QUERIES; i++) {
            const double *q = trap->query[i];
            mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
            assert_true(at.triangle != MW_NONE && contains(trap->mesh, at.triangle, q));
        }
    mw_locator_destroy(locator);
    assert_int_equal(cursor.counters.queries, ROUNDS * QUERIES);
    return cursor.counters;
}

/* From 33 of 40 triangles these walks go round; they are caught, counted and ended by another. */
static void test_caught(void **state)
{
    const mw_walk_kind trapped[] = {MW_WALK_LAWSON, MW_WALK_REMEMBERING, MW_WALK_BARYCENTRIC,
                                    MW_WALK_DIRECT};
    for (size_t i = 0; i < sizeof trapped / sizeof *trapped; i++)
        for (int how = 0; how < 4; how++) {
            mw_counters c =
                locate_all(*state, trapped[i], how & 1 ? MW_DOUBLE : MW_EXACT, how >> 1);
            assert_true(c.cycles > c.queries / 2);
            assert_int_equal(c.handovers, c.cycles);
        }
}

static void test_not_caught(void **state)
{
    for (mw_walk_kind walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++) {
        if (walk == MW_WALK_LAWSON || walk == MW_WALK_REMEMBERING || walk == MW_WALK_BARYCENTRIC ||
            walk == MW_WALK_DIRECT)
            continue;
        mw_counters c = locate_all(*state, walk, MW_EXACT, 0);
        assert_int_equal(c.cycles, 0);
        assert_int_equal(c.handovers, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh),        cmocka_unit_test(test_queries),
        cmocka_unit_test(test_lawson),      cmocka_unit_test(test_remembering),
        cmocka_unit_test(test_barycentric), cmocka_unit_test(test_direct),
        cmocka_unit_test(test_caught),      cmocka_unit_test(test_not_caught)};
    return cmocka_run_group_tests(tests, trap_read, trap_release);
}
