/* test_locator_threads.c - a locator, its guide and its grids are the same, bit for bit, whatever
 * the number of threads that made them. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "locate/locator.h"
#include "support/meshes.h"

enum { VERTICES = 60000 }; /* enough for three threads to be worth it */

static const uint32_t teams[] = {2, 3, 7};

/* --- meshes ----------------------------------------------------------------------------------- */

static arrays triangulated(const double *points)
{
    mw_mesh *mesh = mesh_delaunay(points, VERTICES);
    arrays a = arrays_of_mesh(mesh);
    mw_mesh_destroy(mesh);
    return a;
}

static arrays uniform(void)
{
    uint64_t random = 1;
    double *points = malloc(2 * VERTICES * sizeof *points);
    for (uint32_t i = 0; i < 2 * VERTICES; i++) points[i] = random_unit(&random);
    arrays a = triangulated(points);
    free(points);
    return a;
}

/* Most vertices in a few places, so that the guide is a grid and a curve. */
static arrays clusters(void)
{
    enum { CLUSTERS = 20 };
    uint64_t random = 2;
    double *points = malloc(2 * VERTICES * sizeof *points), middle[2 * CLUSTERS];
    for (uint32_t i = 0; i < 2 * CLUSTERS; i++) middle[i] = random_unit(&random);
    for (uint32_t i = 0; i < VERTICES; i++)
        for (uint32_t k = 0; k < 2; k++)
            points[2 * i + k] = middle[2 * (i % CLUSTERS) + k] +
                                0.001 * (random_unit(&random) + random_unit(&random));
    arrays a = triangulated(points);
    free(points);
    return a;
}

/* Tiles that are long in one direction, and vertices on both sides of 0. */
static arrays stretched(void)
{
    arrays a = uniform();
    for (uint32_t i = 0; i < a.point_count; i++) {
        double x = a.points[2 * i] - 0.5, y = 50 * (a.points[2 * i + 1] - 0.5);
        a.points[2 * i] = 0.8 * x - 0.6 * y;
        a.points[2 * i + 1] = 0.6 * x + 0.8 * y;
    }
    return a;
}

/* Without triangles here and there, so that there are holes, pockets, and vertices that no
 * triangle has; some are clockwise. */
static arrays with_holes(void)
{
    uint64_t random = 3;
    arrays a = uniform();
    uint32_t kept = 0;
    for (uint32_t t = 0; t < a.triangle_count; t++) {
        const uint32_t *v = a.triangles + 3 * (size_t)t;
        double x = 6 * a.points[2 * v[0]], y = 6 * a.points[2 * v[0] + 1];
        x -= floor(x) + 0.5;
        y -= floor(y) + 0.5;
        if (x * x + y * y < 0.05 || mw__random_below(&random, 500) == 0) continue;
        uint32_t turn = mw__random_below(&random, 2);
        uint32_t turned[3] = {v[0], v[1 + turn], v[2 - turn]};
        memcpy(a.triangles + 3 * (size_t)kept++, turned, sizeof turned);
    }
    a.triangle_count = kept;
    return a;
}

/* --- comparing -------------------------------------------------------------------------------- */

static void expect_same_grid(const mw_grid *a, const mw_grid *b)
{
    assert_memory_equal(&a->lattice, &b->lattice, sizeof a->lattice);
    assert_memory_equal(a->tile, b->tile, mw__grid_bytes(a));
}

static void expect_same_index(const mw_index *a, const mw_index *b)
{
    assert_int_equal(a->start, b->start);
    if (a->start == MW_START_GRID) expect_same_grid(&a->grid, &b->grid);
    if (a->start != MW_START_CURVE) return;
    assert_int_equal(a->curve.count, b->curve.count);
    assert_memory_equal(a->curve.sample, b->curve.sample, a->curve.count * sizeof *a->curve.sample);
    assert_true((a->curve.sparse.tile != NULL) == (b->curve.sparse.tile != NULL));
    if (a->curve.sparse.tile) expect_same_grid(&a->curve.sparse, &b->curve.sparse);
}

static void expect_same_locator(const mw_locator *a, const mw_locator *b)
{
    const mw_tiling *s = &a->tiling, *t = &b->tiling;
    assert_int_equal(s->point_count, t->point_count);
    assert_int_equal(s->tri_count, t->tri_count);
    assert_memory_equal(s->point, t->point, s->point_count * sizeof *s->point);
    assert_memory_equal(s->tri, t->tri, s->tri_count * sizeof *s->tri);
    assert_memory_equal(s->owner, t->owner, s->point_count * sizeof *s->owner);
    if (s->area) assert_memory_equal(s->area, t->area, s->tri_count * sizeof *s->area);
    assert_memory_equal(a->low, b->low, sizeof a->low);
    assert_memory_equal(a->high, b->high, sizeof a->high);
    assert_int_equal(a->centre, b->centre);
    assert_int_equal(a->auto_walk, b->auto_walk);
    expect_same_index(&a->guide, &b->guide);
}

static mw_index *grid_of(const mw_locator *locator)
{
    mw_index *index;
    assert_int_equal(mw_index_create(locator, MW_START_GRID, NULL, &index, NULL), MW_OK);
    return index;
}

/* Mesh and locator by several threads, beside the same by one. */
static void expect_same(arrays a, mw_start_kind guide)
{
    for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
        mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.layout = layout, .threads = 1});
        mw_locator *one = mesh_locator(mesh, (mw_locator_options){.threads = 1, .areas = 1});
        mw_index *index = grid_of(one);
        if (layout == MW_LAYOUT_HILBERT) assert_int_equal(one->guide.start, guide);
        for (size_t i = 0; i < sizeof teams / sizeof *teams; i++) {
            mw_mesh *same =
                arrays_mesh(&a, (mw_mesh_options){.layout = layout, .threads = teams[i]});
            mw_locator *several =
                mesh_locator(same, (mw_locator_options){.threads = teams[i], .areas = 1});
            mw_index *grid = grid_of(several);
            expect_same_locator(one, several);
            expect_same_index(index, grid);
            mw_index_destroy(grid);
            mw_locator_destroy(several);
            mw_mesh_destroy(same);
        }
        mw_index_destroy(index);
        mw_locator_destroy(one);
        mw_mesh_destroy(mesh);
    }
    arrays_free(&a);
}

static void test_uniform_threads(void **state)
{
    (void)state;
    expect_same(uniform(), MW_START_GRID);
}
static void test_clusters_threads(void **state)
{
    (void)state;
    expect_same(clusters(), MW_START_CURVE);
}
static void test_stretched_threads(void **state)
{
    (void)state;
    expect_same(stretched(), MW_START_GRID);
}
static void test_holes_threads(void **state)
{
    (void)state;
    expect_same(with_holes(), MW_START_GRID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform_threads),
        cmocka_unit_test(test_clusters_threads),
        cmocka_unit_test(test_stretched_threads),
        cmocka_unit_test(test_holes_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
