/* Tilings: brute force says which small meshes are embeddings, and what their tilings must be. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>

#include "domain_oracle.h"

/* --- small meshes of every kind --- */

typedef struct maker {
    arrays a;
    uint64_t random;
} maker;

static uint32_t below(maker *m, uint32_t n)
{
    return mw__random_below(&m->random, n);
}

/* Any triangles over any points of a small grid, some points at one place. */
static void make_soup(maker *m)
{
    uint32_t grid = 2 + below(m, 4), points = 3 + below(m, 6), triangles = 1 + below(m, 5);
    m->a = arrays_make(64, 64);
    for (uint32_t i = 0; i < points; i++) arrays_point(&m->a, below(m, grid), below(m, grid));
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t u = below(m, points), v = below(m, points), w = below(m, points);
        if (u == v || v == w || w == u) continue; /* repeated vertices are the subject of another test */
        arrays_triangle(&m->a, u, v, w);
    }
}

/* Cells of a grid, some triangles missing; coordinates are multiples of 12. */
static void make_grid(maker *m)
{
    uint32_t n = 1 + below(m, 3);
    arrays grid = grid_mesh(n, 0, &m->random);
    m->a = arrays_make(256, 256);
    for (uint32_t i = 0; i < grid.point_count; i++)
        arrays_point(&m->a, 12 * grid.points[2 * i], 12 * grid.points[2 * i + 1]);
    for (uint32_t i = 0; i < grid.triangle_count; i++) {
        const uint32_t *t = grid.triangles + 3 * (size_t)i;
        arrays_triangle(&m->a, t[0], t[1], t[2]);
    }
    arrays_free(&grid);
    if (below(m, 4) > 0) punch(&m->a, random_unit(&m->random) * 0.7, &m->random);
}

/* Give some corners a vertex of their own at the same place. */
static void split_vertices(maker *m)
{
    double share = random_unit(&m->random) * 0.4;
    for (uint32_t i = 0; i < 3 * m->a.triangle_count && m->a.point_count < 200; i++) {
        if (random_unit(&m->random) >= share) continue;
        uint32_t v = m->a.triangles[i];
        m->a.triangles[i] = arrays_point(&m->a, m->a.points[2 * v], m->a.points[2 * v + 1]);
    }
}

/* Put `count` vertices inside an edge, in a random triangle only, as a fan from its apex. With `flat`, fill the gap with
 * flat triangles; else the triangle beyond has vertices inside its edge. */
static void break_edge(maker *m, bool flat)
{
    arrays *a = &m->a;
    if (a->triangle_count == 0) return;
    uint32_t t = below(m, a->triangle_count), k = below(m, 3), count = 1 + below(m, 3);
    uint32_t *v = a->triangles + 3 * (size_t)t, from = v[k], to = v[(k + 1) % 3], apex = v[(k + 2) % 3], last = from;
    for (uint32_t i = 1; i <= count + 1; i++) {
        uint32_t next = to;
        if (i <= count) {
            double s = i / (count + 1.0);
            next = arrays_point(a, rint(a->points[2 * from] + s * (a->points[2 * to] - a->points[2 * from])),
                                rint(a->points[2 * from + 1] + s * (a->points[2 * to + 1] - a->points[2 * from + 1])));
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
static void add_triangle(maker *m)
{
    uint32_t n = m->a.point_count, u = below(m, n), v = below(m, n), w = below(m, n);
    if (u != v && v != w && w != u) arrays_triangle(&m->a, u, v, w);
}

static void move_vertex(maker *m)
{
    uint32_t v = below(m, m->a.point_count);
    for (uint32_t i = 0; i < 2; i++) m->a.points[2 * v + i] += (double)below(m, 25) - 12;
}

/* The mesh once more, elsewhere: in a hole, over it, or beside it. */
static void add_copy(maker *m)
{
    uint32_t points = m->a.point_count, triangles = m->a.triangle_count;
    int32_t dx = ((int32_t)below(m, 7) - 3) * 6, dy = ((int32_t)below(m, 7) - 3) * 6;
    if (points > 100 || triangles > 100) return;
    for (uint32_t i = 0; i < points; i++) arrays_point(&m->a, m->a.points[2 * i] + dx, m->a.points[2 * i + 1] + dy);
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t *t = m->a.triangles + 3 * (size_t)i;
        arrays_triangle(&m->a, t[0] + points, t[1] + points, t[2] + points);
    }
}

static void make_mesh(maker *m)
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
        if (below(m, 8) == 0) punch(&m->a, 0.3, &m->random);
    }
    scramble(&m->a, below(m, 2) == 0, &m->random);
}

static void print_mesh(uint64_t seed, const arrays *a)
{
    print_message("seed %llu\n", (unsigned long long)seed);
    for (uint32_t i = 0; i < a->point_count; i++)
        print_message("v %u: %g %g\n", i, a->points[2 * i], a->points[2 * i + 1]);
    for (uint32_t i = 0; i < a->triangle_count; i++)
        print_message("t %u: %u %u %u\n", i, a->triangles[3 * i], a->triangles[3 * i + 1], a->triangles[3 * i + 2]);
}

/* --- tests --- */

typedef struct counts {
    uint32_t embeddings, cut, holes, full, refused;
} counts;

static const char *compare(const arrays *a, counts *tally)
{
    mw_arrays view = arrays_view(a);
    mw_check check;
    if (mw_check_arrays(&view, &check, NULL) != MW_OK) return "check failed";
    bool expected = oracle_embedding(a), found = check.embedding;
    mw_check_release(&check);
    if (expected != found) return expected ? "an embedding is refused" : "taken for an embedding";
    mw_mesh *mesh;
    mw_error error = {0};
    mw_tiling tiling;
    const char *fault = NULL;
    if (mw_mesh_create(&view, NULL, &mesh, &error) != MW_OK) return is_usable(a) ? "no mesh" : NULL;
    mw_status status = mw__tiling_create(mesh, false, &tiling, &error);
    if (!expected) {
        tally->refused++;
        if (status != MW_ERROR_INPUT || error.message[0] == 0) fault = "no error";
    } else if (status != MW_OK) {
        fault = "no tiling";
    } else {
        tally->embeddings++;
        tally->cut += tiling.cut;
        tally->holes += tiling.hole_count;
        tally->full += tiling.ghost_count == 0;
        fault = fault_of_tiling(a, &tiling);
        if (!fault && mw__tiling_order(&tiling, NULL) == MW_OK) fault = fault_of_tiling(a, &tiling);
        mw__tiling_release(&tiling);
    }
    mw_mesh_destroy(mesh);
    return fault;
}

static void test_verdicts(void **state)
{
    (void)state;
    counts tally = {0};
    const char *wanted = getenv("MW_TEST_SEED");
    uint64_t first = wanted ? strtoull(wanted, NULL, 10) : 1, count = wanted ? 1 : 150000;
    for (uint64_t seed = first; seed < first + count; seed++) {
        maker m = {.random = mw__random_seed(seed, 0)};
        make_mesh(&m);
        const char *fault = compare(&m.a, &tally);
        if (fault) {
            print_mesh(seed, &m.a);
            fail_msg("%s", fault);
        }
        arrays_free(&m.a);
    }
    print_message("%u embeddings, %u of them cut, %u full; %u holes; %u refused\n", tally.embeddings, tally.cut,
                  tally.full, tally.holes, tally.refused);
    if (count > 1) assert_true(tally.embeddings > 20000 && tally.cut > 1000 && tally.refused > 20000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdicts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
