/* The Delaunay triangulation: every one made here is checked exactly, triangle by triangle. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/random.h"
#include "memory.h"
#include "mesh/mesh.h"

#include <meshwalk/triangulate.h>

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
    find_equal_points(mesh->point, n, first);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) used[mesh->tri[t].v[k]] = 1;
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

/* Triangulate and check; returns the report. */
static mw_triangulation_report triangulate(const mw_point *points, uint32_t n)
{
    mw_mesh *mesh;
    mw_error error;
    mw_triangulation_report report;
    uint32_t *duplicate_of = malloc((n + 1) * sizeof *duplicate_of);
    if (mw_delaunay(&points->x, n, 0, duplicate_of, &report, &mesh, &error) != MW_OK) fail_msg("%s", error.message);
    assert_int_equal(mesh->point_count, n);
    assert_memory_equal(mesh->point, points, n * sizeof *points);
    check_mesh(mesh, duplicate_of);
    size_t duplicates = 0;
    for (uint32_t i = 0; i < n; i++) duplicates += duplicate_of[i] != MW_NONE;
    assert_int_equal(report.points, n);
    assert_int_equal(report.duplicates, duplicates);
    mw_mesh_destroy(mesh);
    free(duplicate_of);
    return report;
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

/* No set of points, and no order that they are given in, costs more than a few visits for each. */
static void test_sets(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        uint32_t sizes[] = {20, 300, sets[i].largest};
        mw_point *points = malloc(sets[i].largest * sizeof *points + 300 * sizeof *points);
        for (int k = 0; k < 3; k++) {
            if (k < 2 && sizes[k] >= sets[i].largest) continue;
            fill(&sets[i], 17, points, sizes[k]);
            mw_triangulation_report report = triangulate(points, sizes[k]);
            double visits = (double)report.triangles_visited / sizes[k];
            if (visits > sets[i].visits) fail_msg("%s: %u points, %g visits each", sets[i].name, sizes[k], visits);
        }
        free(points);
    }
}

/* --- all small sets on a grid --- */

static int on_one_line(const mw_point *points, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++)
            for (uint32_t k = 0; k < j; k++)
                if (mw__orient2d(points[i], points[j], points[k]) != 0) return 0;
    return 1;
}

static void triangulate_or_refuse(const mw_point *points, uint32_t n)
{
    if (on_one_line(points, n)) {
        mw_mesh *mesh;
        assert_int_equal(mw_delaunay(&points->x, n, 2, NULL, NULL, &mesh, NULL), MW_ERROR_INPUT);
        assert_null(mesh);
    } else {
        triangulate(points, n);
    }
}

/* Every sequence of four points of a 3 x 3 grid. */
static void test_all_fours(void **state)
{
    (void)state;
    for (uint32_t code = 0; code < 9 * 9 * 9 * 9; code++) {
        mw_point points[4];
        for (uint32_t i = 0, c = code; i < 4; i++, c /= 9) points[i] = (mw_point){c % 9 % 3, c % 9 / 3};
        triangulate_or_refuse(points, 4);
    }
}

/* Random sequences of up to 14 points of a 4 x 4 grid. */
static void test_small_sets(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 5000; seed++) {
        mw_point points[14];
        uint64_t random = seed;
        uint32_t n = 3 + mw__random_below(&random, 12);
        for (uint32_t i = 0; i < n; i++)
            points[i] = (mw_point){mw__random_below(&random, 4), mw__random_below(&random, 4)};
        triangulate_or_refuse(points, n);
    }
}

/* --- real points --- */

static mw_point *read_points(const char *path, uint32_t *n)
{
    gzFile file = gzopen(path, "rb");
    if (!file) return NULL;
    uint32_t room = 1 << 20;
    mw_point *points = malloc(room * sizeof *points);
    char line[256];
    for (*n = 0; *n < room && gzgets(file, line, sizeof line);) {
        char *end;
        points[*n].x = strtod(line, &end);
        points[*n].y = strtod(end, NULL);
        *n += 1;
    }
    gzclose(file);
    return points;
}

static void test_lidar(void **state)
{
    (void)state;
    static const char *const names[] = {"autzen", "crop_4_6", "topography", "delft"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[512];
        uint32_t n = 0;
        snprintf(path, sizeof path, "%s/terrain/%s_ground.xyz.gz", MW_TEST_SHARED, names[i]);
        mw_point *points = read_points(path, &n);
        if (!points) skip();
        mw_triangulation_report report = triangulate(points, n);
        assert_true(report.triangles_visited < 10 * (uint64_t)n);
        free(points);
    }
}

/* --- the interface --- */

static void refuses(const mw_point *points, size_t n, int64_t vertex, const char *message)
{
    mw_mesh *mesh = (mw_mesh *)1;
    mw_error error;
    assert_int_equal(mw_delaunay(points ? &points->x : NULL, n, 2, NULL, NULL, &mesh, &error), MW_ERROR_INPUT);
    assert_null(mesh);
    assert_int_equal(error.status, MW_ERROR_INPUT);
    assert_int_equal(error.vertex, vertex);
    assert_string_equal(error.message, message);
}

static void test_refused_points(void **state)
{
    (void)state;
    mw_point points[6] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 3}, {4, 5}};
    refuses(NULL, 0, -1, "fewer than three points: 0");
    refuses(points, 2, -1, "fewer than three points: 2");
    points[3].y = NAN;
    refuses(points, 6, 3, "point 3 is not finite");
    points[3].y = 1;
    points[5].x = -INFINITY;
    refuses(points, 6, 5, "point 5 is not finite");
    const mw_point same[4] = {{1, -0.0}, {1, 0}, {1, 0}, {1, -0.0}};
    refuses(same, 4, -1, "fewer than three different points: all 4 are equal");
    const mw_point two[5] = {{1, 2}, {3, 4}, {1, 2}, {3, 4}, {1, 2}};
    refuses(two, 5, -1, "fewer than three different points: only two among 5");
    const mw_point line[5] = {{1, 2}, {3, 4}, {5, 6}, {3, 4}, {-1e9, -999999999}};
    refuses(line, 5, -1, "all 5 points lie on one line");
    const mw_point vertical[3] = {{1e308, -1e308}, {1e308, 1e308}, {1e308, 1e-300}};
    refuses(vertical, 3, -1, "all 3 points lie on one line");
}

static void test_refused_calls(void **state)
{
    (void)state;
    const double points[6] = {0, 0, 1, 0, 0, 1};
    mw_mesh *mesh = (mw_mesh *)1;
    mw_error error;
    assert_int_equal(mw_delaunay(points, 3, 1, NULL, NULL, &mesh, &error), MW_ERROR_ARGUMENT);
    assert_null(mesh);
    assert_int_equal(mw_delaunay(NULL, 3, 2, NULL, NULL, &mesh, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_delaunay(points, 3, 2, NULL, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_delaunay(points, (size_t)1 << 40, 2, NULL, NULL, &mesh, &error), MW_ERROR_LIMIT);
    assert_null(mesh);
}

/* Heights between the points, and no space after the last. */
static void test_stride(void **state)
{
    (void)state;
    const double points[] = {0, 0, NAN, 1, 0, 7, 0, 1};
    mw_mesh *mesh;
    assert_int_equal(mw_delaunay(points, 3, 3, NULL, NULL, &mesh, NULL), MW_OK);
    assert_int_equal(mw_mesh_triangle_count(mesh), 1);
    double corner[2];
    mw_mesh_vertex(mesh, 2, corner);
    assert_true(corner[0] == 0 && corner[1] == 1);
    mw_mesh_destroy(mesh);
}

/* Triangles that follow each other lie near each other, whatever the order of the points. */
static void test_order_of_triangles(void **state)
{
    (void)state;
    enum { N = 20000 };
    mw_point *points = malloc(N * sizeof *points);
    fill(&sets[0], 3, points, N);
    mw_mesh *mesh;
    assert_int_equal(mw_delaunay(&points->x, N, 2, NULL, NULL, &mesh, NULL), MW_OK);
    double jumps = 0;
    for (uint32_t t = 1; t < mesh->tri_count; t++) {
        mw_point a = mesh->point[mesh->tri[t - 1].v[0]], b = mesh->point[mesh->tri[t].v[0]];
        jumps += hypot(a.x - b.x, a.y - b.y);
    }
    assert_true(jumps / mesh->tri_count < 3 / sqrt(N));
    mw_mesh_destroy(mesh);
    free(points);
}

/* Whichever allocation fails, the call says so and leaves nothing behind (the leak checker looks on). */
static void test_memory_failures(void **state)
{
    (void)state;
    mw_point points[100];
    uint32_t duplicate_of[100];
    fill(&sets[0], 5, points, 100);
    for (long allowed = 0;; allowed++) {
        mw_mesh *mesh = (mw_mesh *)1;
        mw_error error;
        allocations_left = allowed;
        mw_status status = mw_delaunay(&points->x, 100, 2, duplicate_of, NULL, &mesh, &error);
        allocations_left = -1;
        if (status == MW_OK) {
            assert_true(allowed > 5);
            mw_mesh_destroy(mesh);
            return;
        }
        assert_int_equal(status, MW_ERROR_MEMORY);
        assert_int_equal(error.status, MW_ERROR_MEMORY);
        assert_null(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_all_fours),
        cmocka_unit_test(test_small_sets),
        cmocka_unit_test(test_lidar),
        cmocka_unit_test(test_refused_points),
        cmocka_unit_test(test_refused_calls),
        cmocka_unit_test(test_stride),
        cmocka_unit_test(test_order_of_triangles),
        cmocka_unit_test(test_memory_failures),
    };
    return cmocka_run_group_tests_name("delaunay", tests, NULL, NULL);
}
