/* delaunay.h - sets of points that are hard to triangulate, and an exact check of what was made of them. */
#ifndef MW_TEST_DELAUNAY_H
#define MW_TEST_DELAUNAY_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "mesh/mesh.h"

static double unit(uint64_t *random)
{
    return (double)(mw__random(random) >> 11) * 0x1p-53;
}

/* --- what is checked --- */

static const mw_point *sorted_points;

static int by_place(const void *left, const void *right)
{
    uint32_t i = *(const uint32_t *)left, j = *(const uint32_t *)right;
    mw_point p = sorted_points[i], q = sorted_points[j];
    if (p.x != q.x) return p.x < q.x ? -1 : 1;
    if (p.y != q.y) return p.y < q.y ? -1 : 1;
    return i < j ? -1 : i > j;
}

/* first[i] = the lowest number of a point equal to point i. */
static void find_equal_points(const mw_point *points, uint32_t n, uint32_t *first)
{
    uint32_t *order = malloc((n + 1) * sizeof *order);
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    sorted_points = points;
    qsort(order, n, sizeof *order, by_place);
    for (uint32_t i = 0, from = 0; i < n; i++) {
        if (points[order[i]].x != points[order[from]].x || points[order[i]].y != points[order[from]].y) from = i;
        first[order[i]] = order[from];
    }
    free(order);
}

/* Counter-clockwise triangles, symmetric links, the order of records. Returns the number of border edges. */
static uint32_t check_records(const mw_mesh *mesh)
{
    uint32_t border = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        assert_int_equal(tri->user, t);
        assert_int_equal(tri->v[3], tri->v[0]);
        for (int k = 0; k < 3; k++) assert_true(tri->v[k] < mesh->point_count);
        assert_true(mw__has_area(mesh->point, tri));
        for (uint32_t k = 0; k < 3; k++) {
            if (tri->link[k] == MW_NONE) {
                border++;
                continue;
            }
            uint32_t e = mw__link_edge(tri->link[k]);
            assert_true(mw__link_triangle(tri->link[k]) < mesh->tri_count && e < 3);
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            assert_int_equal(other->link[e], mw__link(t, k));
            assert_int_equal(other->v[e], tri->v[k + 1]);
            assert_int_equal(other->v[e + 1], tri->v[k]);
        }
    }
    return border;
}

/* No vertex across an edge lies in the circle. */
static void check_edges_delaunay(const mw_mesh *mesh)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        for (int k = 0; k < 3; k++) {
            if (tri->link[k] == MW_NONE) continue;
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            uint32_t apex = other->v[mw__prev(mw__link_edge(tri->link[k]))];
            const mw_point *p = mesh->point;
            assert_true(mw__incircle(p[tri->v[0]], p[tri->v[1]], p[tri->v[2]], p[apex]) <= 0);
        }
    }
}

/* No point at all lies in the circle of a triangle. */
static void check_circles_empty(const mw_mesh *mesh)
{
    const mw_point *p = mesh->point;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t i = 0; i < mesh->point_count; i++) {
            const mw_triangle *tri = &mesh->tri[t];
            assert_true(mw__incircle(p[tri->v[0]], p[tri->v[1]], p[tri->v[2]], p[i]) <= 0);
        }
}

/* Does the edge from a to b point into the upper half plane, the positive x axis included? */
static int points_up(mw_point a, mw_point b)
{
    return b.y > a.y || (b.y == a.y && b.x > a.x);
}

/* The border is one loop that never turns right and turns once: a convex polygon. All points lie in it. */
static void check_hull(const mw_mesh *mesh, uint32_t border)
{
    const mw_point *p = mesh->point;
    uint32_t *after = malloc(mesh->point_count * sizeof *after), first = MW_NONE, length = 0, half_turns = 0;
    memset(after, 255, mesh->point_count * sizeof *after);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            if (mesh->tri[t].link[k] != MW_NONE) continue;
            first = mesh->tri[t].v[k];
            assert_int_equal(after[first], MW_NONE);
            after[first] = mesh->tri[t].v[k + 1];
        }
    assert_true(first != MW_NONE);
    uint32_t a = first;
    do {
        uint32_t b = after[a];
        assert_true(b != MW_NONE && after[b] != MW_NONE);
        assert_true(mw__orient2d(p[a], p[b], p[after[b]]) >= 0);
        half_turns += points_up(p[a], p[b]) != points_up(p[b], p[after[b]]);
        if ((uint64_t)border * mesh->point_count < 2000000)
            for (uint32_t i = 0; i < mesh->point_count; i++) assert_true(mw__orient2d(p[a], p[b], p[i]) >= 0);
        a = b;
        length++;
    } while (a != first);
    assert_int_equal(length, border);
    assert_int_equal(half_turns, 2);
    free(after);
}

/* Equal points are merged with the first of them; every other point is a vertex of a triangle. Returns their number. */
static uint32_t check_vertices(const mw_mesh *mesh, const uint32_t *duplicate_of)
{
    uint32_t n = mesh->point_count, distinct = 0;
    uint32_t *first = malloc(n * sizeof *first), *used = calloc(n, sizeof *used);
    mw_point *points = malloc(n * sizeof *points); /* by the user's numbers */
    for (uint32_t i = 0; i < n; i++) {
        double p[2];
        mw_mesh_vertex(mesh, i, p);
        points[i] = (mw_point){p[0], p[1]};
    }
    find_equal_points(points, n, first);
    free(points);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) used[mw__users_vertex(mesh, mesh->tri[t].v[k])] = 1;
    for (uint32_t i = 0; i < n; i++) {
        assert_int_equal(duplicate_of[i], first[i] == i ? MW_NONE : first[i]);
        assert_int_equal(used[i], first[i] == i);
        distinct += first[i] == i;
    }
    free(first);
    free(used);
    return distinct;
}

static void check_mesh(const mw_mesh *mesh, const uint32_t *duplicate_of)
{
    uint32_t border = check_records(mesh);
    uint32_t distinct = check_vertices(mesh, duplicate_of);
    assert_int_equal(mesh->tri_count, 2 * distinct - 2 - border); /* Euler */
    check_hull(mesh, border);
    check_edges_delaunay(mesh);
    if ((uint64_t)mesh->tri_count * mesh->point_count < 100000) check_circles_empty(mesh);
}

/* --- sets of points --- */

static mw_point uniform(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){unit(random), unit(random)};
}

static mw_point gaussian(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double r = sqrt(-2 * log(1 - unit(random))), angle = 6.283185307179586 * unit(random);
    return (mw_point){r * cos(angle), r * sin(angle)};
}

static mw_point integer_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    uint32_t width = (uint32_t)sqrt(n);
    return (mw_point){i % width, i / width};
}

/* Nearly cocircular, nearly collinear: tenths are rounded. */
static mw_point decimal_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = integer_grid(random, i, n);
    return (mw_point){p.x * 0.1, p.y * 0.1};
}

static mw_point rotated_grid(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = integer_grid(random, i, n);
    return (mw_point){p.x * 0.8 - p.y * 0.6, p.x * 0.6 + p.y * 0.8};
}

static mw_point circle(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double angle = 6.283185307179586 * i / n;
    return (mw_point){cos(angle), sin(angle)};
}

/* Exactly on a circle: the integer points at distance 65 from the origin. */
static mw_point exact_circle(uint64_t *random, uint32_t i, uint32_t n)
{
    static const int legs[][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {52, 39},
                                  {56, 33}, {60, 25}, {63, 16}, {65, 0}};
    (void)random, (void)n;
    int x = legs[i / 4 % 9][0], y = legs[i / 4 % 9][1];
    switch (i % 4) {
    case 0: return (mw_point){x, y};
    case 1: return (mw_point){-y, x};
    case 2: return (mw_point){-x, -y};
    default: return (mw_point){y, -x};
    }
}

static mw_point clusters(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = gaussian(random, i, n);
    uint64_t cluster = mw__random_below(random, 7);
    return (mw_point){unit(&cluster) + 1e-9 * p.x, unit(&cluster) + 1e-9 * p.y};
}

static mw_point rising_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = unit(random);
    return (mw_point){x, x * x};
}

static mw_point falling_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = rising_parabola(random, i, n);
    return (mw_point){-p.x, p.y};
}

static mw_point integer_parabola(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double x = i - n / 2.0;
    return (mw_point){x, x * x};
}

static mw_point spiral(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)random;
    double angle = 60.0 * i / n;
    return (mw_point){angle * cos(angle), angle * sin(angle)};
}

static mw_point two_lines(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)n;
    return (mw_point){unit(random), i % 2};
}

static mw_point cross_lines(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)n;
    return i % 2 ? (mw_point){unit(random), 0.5} : (mw_point){0.5, unit(random)};
}

/* All on one line but one. */
static mw_point line_and_point(uint64_t *random, uint32_t i, uint32_t n)
{
    double x = 1 + floor(unit(random) * 1e6);
    return (mw_point){x, i == n / 2 ? 3 * x + 1 : 3 * x};
}

/* All on one line but for rounding. */
static mw_point rounded_line(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = unit(random);
    return (mw_point){x, x * 0.7 + 0.1};
}

/* Within a few units in the last place of the diagonal. */
static mw_point sliver_band(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = 1 + unit(random);
    return (mw_point){x, x + 0x1p-52 * mw__random_below(random, 3)};
}

static mw_point repeated(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){mw__random_below(random, 9), mw__random_below(random, 9)};
}

/* Differences of the last bits of large coordinates. */
static mw_point far_away(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){5e6 + unit(random) * 1e-6, 5e6 + unit(random) * 1e-6};
}

static mw_point surveyed(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){5e5 + 0.01 * mw__random_below(random, 5000), 5e6 + 0.01 * mw__random_below(random, 5000)};
}

static mw_point tiny(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1e-300 * unit(random), 1e-300 * unit(random)};
}

/* Products of four differences are subnormal, and off by more than a filter for normal numbers expects. */
static mw_point underflowing(uint64_t *random, uint32_t i, uint32_t n)
{
    mw_point p = rotated_grid(random, i, n);
    return (mw_point){p.x * 1e-79, p.y * 1e-79};
}

static mw_point subnormal(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){0x1p-1074 * mw__random_below(random, 99), -0x1p-1074 * mw__random_below(random, 99)};
}

static mw_point huge(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1e300 * unit(random), 1e300 * unit(random)};
}

/* Differences overflow. */
static mw_point widest(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    return (mw_point){1.7e308 * (2 * unit(random) - 1), 1.7e308 * (2 * unit(random) - 1)};
}

/* Coordinates of all magnitudes. */
static mw_point magnitudes(uint64_t *random, uint32_t i, uint32_t n)
{
    (void)i, (void)n;
    double x = ldexp(1 + unit(random), (int)mw__random_below(random, 2000) - 1000);
    double y = ldexp(1 + unit(random), (int)mw__random_below(random, 2000) - 1000);
    return (mw_point){mw__random(random) & 1 ? x : -x, mw__random(random) & 1 ? y : -y};
}

static mw_point signed_zeros(uint64_t *random, uint32_t i, uint32_t n)
{
    static const double values[] = {0.0, -0.0, 1.0, -1.0};
    (void)i, (void)n;
    return (mw_point){values[mw__random_below(random, 4)], values[mw__random_below(random, 4)]};
}

static mw_point one_far_point(uint64_t *random, uint32_t i, uint32_t n)
{
    return i ? uniform(random, i, n) : (mw_point){1e30, 1e20};
}

typedef struct set {
    const char *name;
    mw_point (*point)(uint64_t *random, uint32_t i, uint32_t n);
    uint32_t largest; /* where the exact stage decides everything, fewer points do */
    uint32_t visits;  /* bound for the triangles visited per point; magnitudes that no curve can order take more */
} set;

static const set sets[] = {
    {"uniform", uniform, 30000, 10},
    {"gaussian", gaussian, 10000, 10},
    {"integer grid", integer_grid, 10000, 10},
    {"decimal grid", decimal_grid, 10000, 10},
    {"rotated grid", rotated_grid, 10000, 10},
    {"circle", circle, 10000, 10},
    {"exact circle", exact_circle, 36, 10},
    {"clusters", clusters, 10000, 10},
    {"rising parabola", rising_parabola, 20000, 10},
    {"falling parabola", falling_parabola, 20000, 10},
    {"integer parabola", integer_parabola, 20000, 10},
    {"spiral", spiral, 10000, 10},
    {"two lines", two_lines, 10000, 10},
    {"cross", cross_lines, 10000, 10},
    {"line and point", line_and_point, 10000, 10},
    {"rounded line", rounded_line, 10000, 10},
    {"sliver band", sliver_band, 10000, 10},
    {"repeated", repeated, 10000, 10},
    {"far away", far_away, 10000, 10},
    {"surveyed", surveyed, 10000, 10},
    {"tiny", tiny, 1000, 40},
    {"underflowing", underflowing, 3000, 10},
    {"subnormal", subnormal, 1000, 40},
    {"huge", huge, 1000, 10},
    {"widest", widest, 1000, 10},
    {"magnitudes", magnitudes, 1000, 40},
    {"signed zeros", signed_zeros, 100, 10},
    {"one far point", one_far_point, 10000, 10},
};

static void fill(const set *s, uint64_t seed, mw_point *points, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) points[i] = s->point(&seed, i, n);
}

#endif
