/* Tilings: brute force says which small meshes are embeddings, and what their tilings must be. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "tiling/tiling_create.h"
#include "base/random.h"
#include "tiling/embedding_check.h"
#include "oracle/domain_oracle.h"
#include "support/meshes.h"

/* --- small meshes of every kind --- */

typedef struct mesh_maker {
    arrays a;
    uint64_t random;
} mesh_maker;

static uint32_t below(mesh_maker *m, uint32_t n)
{
    return mw__random_below(&m->random, n);
}

/* Any triangles over any points of a small grid, some points at one place. */
static void make_soup(mesh_maker *m)
{
    uint32_t grid = 2 + below(m, 4), points = 3 + below(m, 6), triangles = 1 + below(m, 5);
    m->a = arrays_make(64, 64);
    for (uint32_t i = 0; i < points; i++) arrays_point(&m->a, below(m, grid), below(m, grid));
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t u = below(m, points), v = below(m, points), w = below(m, points);
        /* repeated vertices are the subject of another test */
        if (u == v || v == w || w == u) continue;
        arrays_triangle(&m->a, u, v, w);
    }
}

/* Cells of a grid, some triangles missing; coordinates are multiples of 12. */
static void make_grid(mesh_maker *m)
{
    uint32_t n = 1 + below(m, 3);
    arrays grid = arrays_grid(n, 0, &m->random);
    m->a = arrays_make(256, 256);
    for (uint32_t i = 0; i < grid.point_count; i++)
        arrays_point(&m->a, 12 * grid.points[2 * i], 12 * grid.points[2 * i + 1]);
    for (uint32_t i = 0; i < grid.triangle_count; i++) {
        const uint32_t *t = grid.triangles + 3 * (size_t)i;
        arrays_triangle(&m->a, t[0], t[1], t[2]);
    }
    arrays_free(&grid);
    if (below(m, 4) > 0) arrays_punch(&m->a, random_unit(&m->random) * 0.7, &m->random);
}

/* Give some corners a vertex of their own at the same place. */
static void split_vertices(mesh_maker *m)
{
    double share = random_unit(&m->random) * 0.4;
    for (uint32_t i = 0; i < 3 * m->a.triangle_count && m->a.point_count < 200; i++) {
        if (random_unit(&m->random) >= share) continue;
        uint32_t v = m->a.triangles[i];
        m->a.triangles[i] = arrays_point(&m->a, m->a.points[2 * v], m->a.points[2 * v + 1]);
    }
}

/* Put `count` vertices inside an edge, in a random triangle only, as a fan from its apex. With
 * `flat`, fill the gap with flat triangles; else the triangle beyond has vertices inside its edge.
 */
static void break_edge(mesh_maker *m, bool flat)
{
    arrays *a = &m->a;
    if (a->triangle_count == 0) return;
    uint32_t t = below(m, a->triangle_count), k = below(m, 3), count = 1 + below(m, 3);
    uint32_t *v = a->triangles + 3 * (size_t)t, from = v[k], to = v[(k + 1) % 3],
             apex = v[(k + 2) % 3], last = from;
    for (uint32_t i = 1; i <= count + 1; i++) {
        uint32_t next = to;
        if (i <= count) {
            double s = i / (count + 1.0);
            next = arrays_point(
                a, rint(a->points[2 * from] + s * (a->points[2 * to] - a->points[2 * from])),
                rint(a->points[2 * from + 1] +
                     s * (a->points[2 * to + 1] - a->points[2 * from + 1])));
        }
        if (i == 1) {
            v[k] = from;
            v[(k + 1) % 3] = next;
        } else {
            arrays_triangle(a, last, next, apex);
            v = a->triangles + 3 * (size_t)t;
            if (flat) arrays_triangle(a, from, next, last);
        }
        last = next;
    }
}

/* A triangle over points that are there. */
static void add_triangle(mesh_maker *m)
{
    uint32_t n = m->a.point_count, u = below(m, n), v = below(m, n), w = below(m, n);
    if (u != v && v != w && w != u) arrays_triangle(&m->a, u, v, w);
}

static void move_vertex(mesh_maker *m)
{
    uint32_t v = below(m, m->a.point_count);
    for (uint32_t i = 0; i < 2; i++) m->a.points[2 * v + i] += (double)below(m, 25) - 12;
}

/* The mesh once more, elsewhere: in a hole, over it, or beside it. */
static void add_copy(mesh_maker *m)
{
    uint32_t points = m->a.point_count, triangles = m->a.triangle_count;
    int32_t dx = ((int32_t)below(m, 7) - 3) * 6, dy = ((int32_t)below(m, 7) - 3) * 6;
    if (points > 100 || triangles > 100) return;
    for (uint32_t i = 0; i < points; i++)
        arrays_point(&m->a, m->a.points[2 * i] + dx, m->a.points[2 * i + 1] + dy);
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t *t = m->a.triangles + 3 * (size_t)i;
        arrays_triangle(&m->a, t[0] + points, t[1] + points, t[2] + points);
    }
}

static void make_mesh(mesh_maker *m)
{
    if (below(m, 4) == 0) {
        make_soup(m);
    } else {
        make_grid(m);
        for (uint32_t i = below(m, 4); i > 0; i--) break_edge(m, true);
        if (below(m, 2) == 0) split_vertices(m);
        if (below(m, 4) == 0) break_edge(m, false);
        if (below(m, 4) == 0) add_triangle(m);
        if (below(m, 4) == 0) move_vertex(m);
        if (below(m, 5) == 0) add_copy(m);
        if (below(m, 8) == 0) arrays_punch(&m->a, 0.3, &m->random);
    }
    arrays_scramble(&m->a, below(m, 2) == 0, &m->random);
}

static void print_mesh(uint64_t seed, const arrays *a)
{
    print_message("seed %llu\n", (unsigned long long)seed);
    for (uint32_t i = 0; i < a->point_count; i++)
        print_message("v %u: %g %g\n", i, a->points[2 * i], a->points[2 * i + 1]);
    for (uint32_t i = 0; i < a->triangle_count; i++)
        print_message("t %u: %u %u %u\n", i, a->triangles[3 * i], a->triangles[3 * i + 1],
                      a->triangles[3 * i + 2]);
}

/* --- verdicts and tilings --- */

typedef struct counts {
    uint32_t embeddings, cut, holes, full, refused;
} counts;

static const char *fault_of_description(const mw_mesh *mesh, const mw_tiling *tiling,
                                        bool embedding)
{
    mw_mesh_info info;
    if (mw_mesh_describe(mesh, NULL, &info, NULL) != MW_OK) return "no description";
    if (info.embedding != embedding) return "described otherwise";
    if (!embedding)
        return info.holes || info.convex || info.delaunay ? "what is no embedding has holes" : NULL;
    if (info.holes != tiling->hole_count) return "described with other holes";
    if (info.convex != (tiling->tri_count > 0 && tiling->ghost_count == 0))
        return "convexity described otherwise";
    if (tiling->cut && info.delaunay) return "described as Delaunay";
    return NULL;
}

/* The tiling of a mesh that is no embedding: refused, or with `any` the mesh's own arrays. */
static const char *fault_of_refusal(const mw_mesh *mesh, const arrays *a)
{
    mw_error error = {0};
    mw_tiling tiling;
    if (mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, &error) !=
        MW_ERROR_INPUT)
        return "taken though it is no embedding";
    if (error.message[0] == 0 || error.triangle < 0 || error.triangle >= a->triangle_count)
        return "no place of an error";
    if (mw__tiling_create(mesh, (mw_tiling_options){.any = true}, MW_ALONE, &tiling, &error) !=
        MW_OK)
        return "refused with option any";
    const char *fault = NULL;
    domain_spot c[3];
    if (tiling.embedding || !tiling.borrowed || tiling.tri_count != a->triangle_count)
        fault = "not the mesh's own tiles";
    for (uint32_t t = 0; t < a->triangle_count && !fault; t++)
        for (int k = 0; k < 3; k++)
            if (domain_oracle_corners(a, t, c) &&
                tiling.owner[mw__vertex_slot(mesh, a->triangles[3 * t + (uint32_t)k])] > t)
                fault = "a vertex has no owner";
    mw__tiling_release(&tiling);
    return fault;
}

static const char *fault_of_mesh(const mw_mesh *mesh, const arrays *a, bool embedding,
                                 counts *tally)
{
    mw_tiling tiling = {0};
    if (!embedding) {
        tally->refused++;
        const char *fault = fault_of_refusal(mesh, a);
        return fault ? fault : fault_of_description(mesh, NULL, false);
    }
    if (mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL) != MW_OK)
        return "no tiling";
    tally->embeddings++;
    tally->cut += tiling.cut;
    tally->holes += tiling.hole_count;
    tally->full += tiling.ghost_count == 0;
    const char *fault = domain_oracle_fault(a, &tiling);
    if (!fault) fault = fault_of_description(mesh, &tiling, true);
    mw__tiling_release(&tiling);
    return fault;
}

/* Hold check, tiling and description against the oracle; NULL if all is right. */
static const char *compare(const arrays *a, counts *tally)
{
    mw_arrays view = arrays_view(a);
    double *scaled = malloc((2 * (size_t)a->point_count + 1) * sizeof *scaled);
    for (uint32_t i = 0; i < 2 * a->point_count; i++)
        scaled[i] = ldexp(a->points[i], domain_oracle_exponent);
    view.points = scaled;
    mw_check check;
    mw_mesh *mesh;
    bool expected = domain_oracle_is_embedding(a);
    const char *fault = mw_check_arrays(&view, NULL, &check, NULL) == MW_OK ? NULL : "check failed";
    if (!fault && check.valid != expected)
        fault = expected ? "an embedding is refused" : "taken for an embedding";
    if (!fault) mw_check_release(&check);
    for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN && !fault;
         layout++) {
        mw_mesh_options options = {.layout = layout, .threads = 1};
        if (mw_mesh_create(&view, &options, &mesh, NULL) == MW_OK) {
            fault = fault_of_mesh(mesh, a, expected, tally);
            mw_mesh_destroy(mesh);
        } else if (domain_oracle_is_usable(a)) {
            fault = "no mesh";
        }
    }
    free(scaled);
    return fault;
}

/* Make and compare the meshes of a range of seeds, or only that of MW_TEST_SEED. */
static counts compare_all(void (*make)(mesh_maker *), uint64_t first, uint64_t count)
{
    counts tally = {0};
    const char *wanted = getenv("MW_TEST_SEED");
    for (uint64_t seed = first; seed < first + count; seed++) {
        if (wanted && seed != strtoull(wanted, NULL, 10)) continue;
        mesh_maker m = {.random = mw__random_seed(seed, 0)};
        make(&m);
        const char *fault = compare(&m.a, &tally);
        if (fault) {
            print_mesh(seed, &m.a);
            fail_msg("%s", fault);
        }
        arrays_free(&m.a);
    }
    print_message("%u embeddings, %u of them cut, %u full; %u holes; %u refused\n",
                  tally.embeddings, tally.cut, tally.full, tally.holes, tally.refused);
    return tally;
}

static void test_small(void **state)
{
    (void)state;
    counts tally = compare_all(make_mesh, 1, 110000);
    if (getenv("MW_TEST_SEED")) return;
    assert_true(tally.embeddings > 20000 && tally.cut > 1000 && tally.refused > 20000 &&
                tally.holes > 1000);
}

/* Coordinates so small, or so large, that products of them under- and overflow. */
static void test_extreme(void **state)
{
    (void)state;
    const int exponents[] = {-1074, -1000, 1000};
    for (int i = 0; i < 3; i++) {
        domain_oracle_exponent = exponents[i];
        compare_all(make_mesh, 1000000 + 1000 * (uint64_t)i, 1000);
    }
    domain_oracle_exponent = 0;
}

/* A larger grid, moved about, with holes of all sizes, broken edges and coincident vertices. */
static void make_large(mesh_maker *m)
{
    uint32_t n = 12 + below(m, 5);
    arrays grid = arrays_grid(n, 0.6, &m->random);
    m->a = arrays_make(4096, 4096);
    for (uint32_t i = 0; i < grid.point_count; i++)
        arrays_point(&m->a, 144 * rint(1000 * grid.points[2 * i]),
                     144 * rint(1000 * grid.points[2 * i + 1]));
    for (uint32_t i = 0; i < grid.triangle_count; i++) {
        const uint32_t *t = grid.triangles + 3 * (size_t)i;
        arrays_triangle(&m->a, t[0], t[1], t[2]);
    }
    arrays_free(&grid);
    arrays_punch(&m->a, below(m, 2) ? 0.1 : 0.5, &m->random);
    for (uint32_t i = 0; i < 6; i++) break_edge(m, true);
    if (below(m, 2)) split_vertices(m);
    arrays_scramble(&m->a, 1, &m->random);
}

static void test_large(void **state)
{
    (void)state;
    counts tally = compare_all(make_large, 2000000, 25);
    if (!getenv("MW_TEST_SEED"))
        assert_true(tally.embeddings > 12 && tally.cut > 8 && tally.holes > 200);
}

/* --- long thin triangles: the outline crosses nearly all cells, unless forced in with care --- */

enum { SLIVERS = 20000 };

static void sliver(arrays *a, double x0, double y0, double x1, double y1, double x2, double y2)
{
    uint32_t v = arrays_point(a, x0, y0);
    arrays_point(a, x1, y1);
    arrays_point(a, x2, y2);
    arrays_triangle(a, v, v + 1, v + 2);
}

/* Side by side and slanted, numbered from left to right. */
static void add_parallel(arrays *a)
{
    for (int i = 0; i < SLIVERS; i++) sliver(a, i, 0, i + 0.5, 0, i + 0.25 + SLIVERS, SLIVERS);
}

/* Half of them from left to right, above each other; small triangles in two rows above and below
 * all of them. */
static void add_rails(arrays *a)
{
    for (int i = 0; i < SLIVERS; i++) {
        double y = i % 4 == 1 ? -1 : SLIVERS + 1, tip = i % 4 == 1 ? -1.5 : SLIVERS + 1.5;
        if (i % 2 == 0)
            sliver(a, -1, i, SLIVERS + 1, i + 0.25, -1, i + 0.5);
        else
            sliver(a, i, y, i + 0.5, y, i + 0.25, tip);
    }
}

/* Each crosses all others. */
static void add_bundle(arrays *a)
{
    for (int i = 0; i < SLIVERS; i++) sliver(a, i, 0, i + 0.5, 0, SLIVERS - i, SLIVERS);
}

static mw_embedding_check embedding_check_of(const arrays *a, mw_mesh **mesh)
{
    mw_arrays view = arrays_view(a);
    mw_embedding_check check;
    assert_int_equal(mw_mesh_create(&view, NULL, mesh, NULL), MW_OK);
    assert_int_equal(mw__embedding_check_create(&check, *mesh, MW_ALONE, NULL), MW_OK);
    return check;
}

/* Half a minute where edges are forced in in the order of the mesh: time grew as the square of the
 * number. */
static void test_slivers(void **state)
{
    (void)state;
    void (*const adds[])(arrays *) = {add_parallel, add_rails};
    for (int i = 0; i < 2; i++) {
        arrays a = arrays_make(3 * SLIVERS, SLIVERS);
        adds[i](&a);
        mw_mesh *mesh;
        mw_embedding_check check = embedding_check_of(&a, &mesh);
        assert_true(check.embedding && !check.convex && check.defects.count == 0);
        assert_int_equal(check.regions.hole_count, 0);
        assert_int_equal(check.coverage.net.wasted, 0);
        mw__embedding_check_release(&check);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

/* Where all edges cross, looking for crossings ends early; a defect elsewhere is still found. */
static void test_bundle(void **state)
{
    (void)state;
    arrays a = arrays_make(3 * SLIVERS + 6, SLIVERS + 2);
    sliver(&a, -90, 0, -60, 0, -75, 30);
    sliver(&a, -80, 5, -70, 5, -75, 15); /* inside that one */
    add_bundle(&a);
    mw_mesh *mesh;
    mw_embedding_check check = embedding_check_of(&a, &mesh);
    assert_false(check.embedding);
    size_t count = check.defects.count, crossings = 0;
    for (size_t i = 0; i < count; i++) {
        const mw_defect *d = &check.defects.list[i], *next = d + 1;
        crossings += d->kind == MW_DEFECT_CROSSING && d->triangle >= 2 && d->other >= 2 &&
                     d->triangle != d->other;
        bool again = i + 1 < count && next->triangle == d->triangle && next->edge == d->edge;
        assert_false(again); /* each edge tells of one crossing at most */
    }
    assert_in_range(crossings, 100, 2 * SLIVERS);
    assert_int_equal(crossings, count - 1);
    assert_int_equal(check.defects.list[count - 1].kind, MW_DEFECT_OVERLAP);
    assert_int_equal(check.defects.list[count - 1].triangle, 1);
    size_t cells = check.coverage.cell_count, edges = check.outline.half_count;
    assert_true(check.coverage.net.wasted <= 65 * cells + 64 * edges);
    mw__embedding_check_release(&check);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* --- single cases --- */

static mw_tiling tile(const arrays *a, mw_mesh **mesh)
{
    mw_arrays view = arrays_view(a);
    mw_tiling tiling;
    assert_int_equal(mw_mesh_create(&view, NULL, mesh, NULL), MW_OK);
    assert_int_equal(mw__tiling_create(*mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    return tiling;
}

static void test_borrowed(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = arrays_grid(5, 0, &random);
    mw_mesh *mesh;
    mw_tiling tiling = tile(&a, &mesh);
    assert_true(tiling.borrowed && tiling.tri == mesh->tri && tiling.point == mesh->point);
    assert_int_equal(mw__tiling_bytes(&tiling), 4 * a.point_count);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

static void test_nothing_to_tile(void **state)
{
    (void)state;
    arrays a = arrays_make(6, 2);
    mw_mesh *mesh;
    for (int pass = 0; pass < 2; pass++) { /* no triangle, then a flat one only */
        mw_tiling tiling = tile(&a, &mesh);
        assert_true(tiling.embedding && tiling.tri_count == 0 && tiling.hole_count == 0);
        mw__tiling_release(&tiling);
        mw_mesh_destroy(mesh);
        for (int i = 0; i < 3; i++) arrays_point(&a, i, i);
        arrays_triangle(&a, 0, 1, 2);
    }
    arrays_free(&a);
}

/* Two rings of different size and number: holes are numbered by the triangles beside them. */
static void test_hole_numbers(void **state)
{
    (void)state;
    uint64_t random = 3;
    arrays a = arrays_grid(7, 0, &random);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a.triangle_count;
         i++) { /* holes of cells (5, 1), and (2, 3) with (2, 4) */
        uint32_t x = i / 2 % 7, y = i / 14;
        if ((x == 5 && y == 1) || (x == 2 && (y == 3 || y == 4))) continue;
        memmove(a.triangles + 3 * kept++, a.triangles + 3 * i, 3 * sizeof *a.triangles);
    }
    a.triangle_count = kept;
    mw_mesh *mesh;
    mw_tiling tiling = tile(&a, &mesh);
    assert_int_equal(tiling.hole_count, 2);
    assert_int_equal(tiling.ghost_count, 6);
    for (uint32_t t = 0; t < tiling.tri_count; t++) {
        const mw_triangle *tri = &tiling.tri[t];
        double x =
            tiling.point[tri->v[0]].x + tiling.point[tri->v[1]].x + tiling.point[tri->v[2]].x;
        if (tri->user & MW_GHOST) assert_int_equal(tri->user & MW_USER_MASK, x > 12 ? 0 : 1);
    }
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* Twice the area of a triangle, in integers of 33 bits, cut to a double. */
static double exact_area(const int64_t p[6])
{
    mpz_t left, right, factor;
    mpz_init_set_d(left, (double)(p[2] - p[0]));
    mpz_init_set_d(right, (double)(p[3] - p[1]));
    mpz_init_set_d(factor, (double)(p[5] - p[1]));
    mpz_mul(left, left, factor);
    mpz_set_d(factor, (double)(p[4] - p[0]));
    mpz_submul(left, right, factor);
    double area = mpz_get_d(left);
    mpz_clears(left, right, factor, NULL);
    return area;
}

/* Stored areas of thin triangles, where doubles round the products. */
static void test_areas_of_thin_triangles(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int round = 0; round < 3000; round++) {
        int64_t p[6];
        for (int i = 0; i < 4; i++) p[i] = (int64_t)(mw__random(&random) >> 33) - (1 << 30);
        double along = random_unit(&random);
        for (int i = 0; i < 2; i++)
            p[4 + i] =
                p[i] + (int64_t)(along * (double)(p[2 + i] - p[i])) + mw__random_below(&random, 3);
        double want = exact_area(p);
        if (want <= 0) continue;
        arrays a = arrays_make(3, 1);
        for (int i = 0; i < 3; i++) arrays_point(&a, (double)p[2 * i], (double)p[2 * i + 1]);
        arrays_triangle(&a, 0, 1, 2);
        mw_mesh *mesh;
        mw_tiling tiling = tile(&a, &mesh);
        assert_int_equal(mw__tiling_areas(&tiling, NULL), MW_OK);
        if (!(fabs(tiling.area[0] - want) <= (MW_AREA_ERROR + 0x1p-52) * want))
            fail_msg("round %d: the area %.17g is %.17g", round, want, tiling.area[0]);
        mw__tiling_release(&tiling);
        mw_mesh_destroy(mesh);
        arrays_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_areas_of_thin_triangles),
        cmocka_unit_test(test_borrowed),
        cmocka_unit_test(test_nothing_to_tile),
        cmocka_unit_test(test_hole_numbers),
        cmocka_unit_test(test_small),
        cmocka_unit_test(test_extreme),
        cmocka_unit_test(test_large),
        cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_bundle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
