/* Triangulations of least weight: held against all triangulations of small sets, against plain
 * dynamic programming on convex polygons, against what every triangulation of least weight must
 * be; candidates against all edges. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/random.h"
#include "predicates/predicates.h"
#include "support/allocations.h"
#include "support/meshes.h"
#include "triangulate/kinds/lmt.h"

#define PI 3.14159265358979323846

/* --- sets of points --- */

static double normal(uint64_t *random)
{
    return sqrt(-2 * log(1 - random_unit(random))) * cos(2 * PI * random_unit(random));
}

enum { UNIFORM, LATTICE, FINE_LATTICE, CIRCLE, COCIRCULAR, CLUSTERS, SLIVER, WHEEL, LINE, KINDS };

/* Point i of n. */
static mw_point draw(int kind, uint32_t i, uint32_t n, uint64_t *random)
{
    static const double on_circle[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                            {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
    double x = random_unit(random), y = random_unit(random),
           turn = 2 * PI * (kind == WHEEL ? (double)i / (n - 1) : x);
    uint32_t k = mw__random_below(random, 12);
    switch (kind) {
    case LATTICE: return (mw_point){floor(4 * x), floor(4 * y)};
    case FINE_LATTICE: return (mw_point){floor(2 * sqrt(n) * x), floor(2 * sqrt(n) * y)};
    case CIRCLE: return (mw_point){cos(turn), sin(turn)};
    case COCIRCULAR:
        return y < 0.2 ? (mw_point){floor(9 * x) - 4, 0}
                       : (mw_point){on_circle[k][0], on_circle[k][1]};
    case CLUSTERS: return (mw_point){k % 3 + 1e-3 * normal(random), k % 2 + 1e-3 * normal(random)};
    case SLIVER: return (mw_point){x, 1e-7 * y};
    case WHEEL: return i == n - 1 ? (mw_point){0, 0} : (mw_point){cos(turn), sin(turn)};
    case LINE: return (mw_point){x, i % 2 ? 0 : y};
    default: return (mw_point){x, y};
    }
}

static double *make_points(int kind, uint32_t n, uint64_t seed)
{
    uint64_t random = mw__random_seed(seed, (uint64_t)kind);
    double *points = malloc(2 * (n + 1) * sizeof *points);
    for (uint32_t i = 0; i < n; i++) {
        mw_point p = draw(kind, i, n, &random);
        points[2 * i] = p.x;
        points[2 * i + 1] = p.y;
    }
    return points;
}

static mw_point at(const double *points, uint32_t i)
{
    return (mw_point){points[2 * i], points[2 * i + 1]};
}

static double turn_of(const double *points, uint32_t a, uint32_t b, uint32_t c)
{
    return mw__orient2d(at(points, a), at(points, b), at(points, c));
}

static double distance(const double *points, uint32_t a, uint32_t b)
{
    return hypot(points[2 * a] - points[2 * b], points[2 * a + 1] - points[2 * b + 1]);
}

/* --- triangulations --- */

/* In a unit in which no square overflows. */
static double area(const arrays *a)
{
    double sum = 0, unit = 0;
    for (uint32_t i = 0; i < 2 * a->point_count; i++) unit = fmax(unit, fabs(a->points[i]));
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        double p[6];
        for (uint32_t k = 0; k < 6; k++)
            p[k] = a->points[2 * a->triangles[3 * t + k / 2] + k % 2] / unit;
        sum += turn_of(p, 0, 1, 2);
    }
    return sum;
}

/* The triangulation; NULL if the points are on one line. It is checked for being one, with no edge
 * that could be exchanged for a shorter one. */
static mw_mesh *triangulate(const double *points, uint32_t n, uint32_t limit,
                            mw_kind_report *report)
{
    mw_kind_options options = {.limit = limit};
    mw_mesh *mesh, *delaunay;
    mw_error error;
    mw_status status =
        mw_triangulate(MW_KIND_MIN_WEIGHT, points, n, 2, &options, NULL, report, &mesh, &error);
    if (status == MW_ERROR_INPUT) return NULL;
    expect_ok(status, "triangulation", &error);
    delaunay = mesh_delaunay(points, n);
    arrays a = arrays_of_mesh(mesh), d = arrays_of_mesh(delaunay);
    mw_arrays view = arrays_view(&a);
    mw_check check;
    assert_int_equal(mw_check_arrays(&view, NULL, &check, &error), MW_OK);
    assert_true(check.valid);
    mw_check_release(&check);
    assert_int_equal(a.triangle_count, d.triangle_count);
    assert_true(fabs(area(&a) - area(&d)) <= 1e-9 * area(&d));
    double twice = 0;
    for (uint32_t t = 0; t < a.triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t *v = a.triangles + 3 * t, *w;
            uint32_t p = v[k], q = v[(k + 1) % 3], apex = v[(k + 2) % 3],
                     other = mw_mesh_neighbour(mesh, t, k, NULL), l = 0;
            if (k == 0) assert_true(turn_of(points, v[0], v[1], v[2]) > 0);
            twice += distance(points, p, q) * (other == MW_NONE ? 2 : 1);
            if (other == MW_NONE) continue;
            w = a.triangles + 3 * (size_t)other;
            while (w[l] == p || w[l] == q) l++;
            bool convex = turn_of(points, apex, p, w[l]) > 0 && turn_of(points, w[l], q, apex) > 0;
            assert_true(!convex ||
                        distance(points, p, q) <= distance(points, apex, w[l]) * (1 + 1e-12));
        }
    assert_true(fabs(twice / 2 - report->edge_length) <= 1e-12 * twice);
    arrays_free(&a);
    arrays_free(&d);
    mw_mesh_destroy(delaunay);
    return mesh;
}

/* --- all triangulations of a small set --- */

enum { SMALL = 11 };

typedef struct weight_scene {
    const double *points;
    uint32_t n;
    bool edge[SMALL][SMALL];         /* holds no point                                            */
    bool empty[SMALL][SMALL][SMALL]; /* counter-clockwise, and no point in it or on its sides     */
    uint64_t crossed[SMALL][SMALL];  /* by which edges                                            */
    bool open[SMALL][SMALL];         /* directed edges whose triangle is still to be chosen       */
    bool used[SMALL][SMALL];         /* directed edges that have theirs, or are outside           */
    uint64_t taken;                  /* edges                                                     */
    double weight, best;
    uint64_t hull, best_edges;
} weight_scene;

static uint64_t bit(uint32_t a, uint32_t b)
{
    return UINT64_C(1) << (a < b ? b * (b - 1) / 2 + a : a * (a - 1) / 2 + b);
}

static bool in_closed_segment(const weight_scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    mw_point p = at(s->points, a), q = at(s->points, b), r = at(s->points, c);
    return turn_of(s->points, a, b, c) == 0 && fmin(p.x, q.x) <= r.x && r.x <= fmax(p.x, q.x) &&
           fmin(p.y, q.y) <= r.y && r.y <= fmax(p.y, q.y);
}

static bool is_empty(const weight_scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (turn_of(s->points, a, b, c) <= 0) return false;
    for (uint32_t d = 0; d < s->n; d++)
        if (d != a && d != b && d != c && turn_of(s->points, a, b, d) >= 0 &&
            turn_of(s->points, b, c, d) >= 0 && turn_of(s->points, c, a, d) >= 0)
            return false;
    return true;
}

static void prepare(weight_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++)
        for (uint32_t b = 0; b < s->n; b++) {
            s->edge[a][b] = a != b;
            for (uint32_t c = 0; c < s->n; c++) {
                if (c != a && c != b && in_closed_segment(s, a, b, c)) s->edge[a][b] = false;
                s->empty[a][b][c] = a != b && b != c && c != a && is_empty(s, a, b, c);
                for (uint32_t d = 0; d < s->n; d++)
                    if (c != d && turn_of(s->points, a, b, c) * turn_of(s->points, a, b, d) < 0 &&
                        turn_of(s->points, c, d, a) * turn_of(s->points, c, d, b) < 0)
                        s->crossed[a][b] |= bit(c, d);
            }
        }
}

/* Open the hull: edges with no point on their right. */
static void open_hull(weight_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++)
        for (uint32_t b = 0; b < s->n; b++) {
            bool hull = s->edge[a][b];
            for (uint32_t c = 0; c < s->n; c++) hull &= turn_of(s->points, a, b, c) >= 0;
            if (!hull) continue;
            s->open[a][b] = s->used[b][a] = true;
            s->hull = s->taken |= bit(a, b);
            s->weight += distance(s->points, a, b);
        }
}

static bool take(weight_scene *s, uint32_t a, uint32_t b, bool *made)
{
    *made = false;
    if (s->open[a][b]) {
        s->open[a][b] = false;
        s->used[a][b] = true;
        return true;
    }
    if (s->used[a][b] || s->taken & bit(a, b) || s->taken & s->crossed[a][b]) return false;
    *made = s->used[a][b] = s->open[b][a] = true;
    s->taken |= bit(a, b);
    s->weight += distance(s->points, a, b);
    return true;
}

static void give_back(weight_scene *s, uint32_t a, uint32_t b, bool made)
{
    s->used[a][b] = false;
    s->open[a][b] = !made;
    if (!made) return;
    s->open[b][a] = false;
    s->taken &= ~bit(a, b);
    s->weight -= distance(s->points, a, b);
}

static void search(weight_scene *s)
{
    if (s->weight >= s->best) return;
    uint32_t a = 0, b = 0;
    while (a < s->n && !s->open[a][b]) {
        b = b + 1 == s->n ? 0 : b + 1;
        if (b == 0) a++;
    }
    if (a == s->n) {
        s->best = s->weight;
        s->best_edges = s->taken;
        return;
    }
    s->open[a][b] = false;
    s->used[a][b] = true;
    for (uint32_t c = 0; c < s->n; c++) {
        bool first, second;
        if (!s->empty[a][b][c] || !take(s, b, c, &first)) continue;
        if (take(s, c, a, &second)) {
            search(s);
            give_back(s, c, a, second);
        }
        give_back(s, b, c, first);
    }
    s->open[a][b] = true;
    s->used[a][b] = false;
}

static void search_all(weight_scene *s, const double *points, uint32_t n)
{
    *s = (weight_scene){.points = points, .n = n, .best = INFINITY};
    prepare(s);
    open_hull(s);
    search(s);
}

/* Reduce all edges there are: those of the least triangulation must remain. Returns how many do. */
static uint32_t check_reduced(const weight_scene *s)
{
    mw_scaled scaled = {(const mw_point *)s->points, (const mw_point *)s->points, s->n};
    mw_edge_list list = {0};
    mw_effort effort = {UINT64_MAX, UINT64_MAX, MW_ALONE};
    mw_lmt lmt;
    uint32_t alive = 0;
    for (uint32_t a = 0; a < s->n; a++)
        for (uint32_t b = a + 1; b < s->n; b++)
            if (s->edge[a][b])
                assert_true(mw__edge_push(&list, mw__edge_key(a, b) |
                                                     (s->hull & bit(a, b) ? MW_EDGE_KNOWN : 0)));
    assert_int_equal(mw__lmt_create(&lmt, &scaled, &list), MW_LMT_DONE);
    mw__lmt_reduce(&lmt, &effort);
    for (uint32_t e = 0; e < lmt.edge_count; e++) {
        bool wanted = s->best_edges & bit(lmt.from[2 * e], lmt.from[2 * e + 1]);
        assert_true(!wanted || lmt.state[e] & MW_LMT_ALIVE);
        alive += lmt.state[e] & MW_LMT_ALIVE;
    }
    mw__lmt_release(&lmt);
    free(list.key);
    return alive;
}

/* Of points that differ; adds to the numbers of edges that there are, and that remain of them. */
static double least_weight(const double *points, uint32_t n, uint32_t *all, uint32_t *remaining)
{
    weight_scene s;
    search_all(&s, points, n);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < a; b++) *all += s.edge[a][b];
    *remaining += check_reduced(&s);
    return s.best;
}

static uint32_t without_duplicates(const double *points, uint32_t n, double *out)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < n; i++) {
        bool seen = false;
        for (uint32_t j = 0; j < kept; j++)
            seen |= out[2 * j] == points[2 * i] && out[2 * j + 1] == points[2 * i + 1];
        if (seen) continue;
        out[2 * kept] = points[2 * i];
        out[2 * kept++ + 1] = points[2 * i + 1];
    }
    return kept;
}

static void test_small(void **state)
{
    (void)state;
    enum { SEEDS = 60 };
    uint32_t tried = 0, optimal = 0, all = 0, remaining = 0;
    print_message("seeds 1 to %d\n", SEEDS);
    for (uint64_t seed = 1; seed <= SEEDS; seed++)
        for (int kind = 0; kind < KINDS; kind++) {
            uint32_t n = 4 + (uint32_t)(seed % (SMALL - 3));
            double *points = make_points(kind, n, seed), different[2 * SMALL];
            mw_kind_report report;
            mw_mesh *mesh = triangulate(points, n, 0, &report);
            if (mesh) {
                double least = least_weight(different, without_duplicates(points, n, different),
                                            &all, &remaining);
                tried++;
                optimal += report.optimal != 0;
                assert_true(report.edge_length >= least * (1 - 1e-12));
                if (report.optimal) assert_true(report.edge_length <= least * (1 + 1e-12));
                assert_true(report.optimal == (report.local_faces == 0));
            }
            mw_mesh_destroy(mesh);
            free(points);
        }
    print_message("%u sets, %u edges, %u of them remain\n", tried, all, remaining);
    assert_true(tried > 500 && optimal == tried && remaining < 0.75 * all);
}

/* Small faces are filled, larger ones keep their triangles, whose edges are then exchanged. */
static void test_limited(void **state)
{
    (void)state;
    enum { SEEDS = 20, CORNERS = 5 };
    uint32_t both = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++)
        for (int kind = 0; kind < KINDS; kind++) {
            double *points = make_points(kind, 60, seed);
            mw_kind_report report;
            mw_mesh *mesh = triangulate(points, 60, CORNERS, &report);
            if (mesh) both += report.local_faces > 0 && report.local_faces < report.faces;
            mw_mesh_destroy(mesh);
            free(points);
        }
    print_message("%u triangulations with faces of both kinds\n", both);
    assert_true(both > 20);
}

/* --- convex polygons --- */

/* The least weight of a triangulation of a convex polygon, its border included. */
static double polygon_weight(const double *points, uint32_t n)
{
    double *best = calloc((size_t)n * n, sizeof *best), length;
    for (uint32_t gap = 1; gap < n; gap++)
        for (uint32_t i = 0; i + gap < n; i++) {
            uint32_t j = i + gap;
            double least = gap > 1 ? INFINITY : 0;
            for (uint32_t m = i + 1; m < j; m++)
                least = fmin(least, best[i * n + m] + best[m * n + j]);
            best[i * n + j] = least + distance(points, i, j);
        }
    length = best[n - 1];
    free(best);
    return length;
}

/* Corners of a convex polygon, counter-clockwise. */
static double *make_polygon(uint32_t n, uint64_t seed)
{
    uint64_t random = seed;
    double *points = malloc(2 * n * sizeof *points);
    for (uint32_t i = 0; i < n; i++) {
        double turn = 2 * PI * (i + 0.9 * random_unit(&random)) / n;
        points[2 * i] = 3 * cos(turn);
        points[2 * i + 1] = sin(turn);
    }
    return points;
}

static void test_convex(void **state)
{
    (void)state;
    for (uint32_t n = 4; n <= 150; n = n * 3 / 2) {
        double *points = make_polygon(n, n);
        mw_kind_report report, limited;
        mw_mesh *mesh = triangulate(points, n, 0, &report);
        double least = polygon_weight(points, n);
        assert_true(report.optimal && fabs(report.edge_length - least) <= 1e-12 * least);
        mw_mesh_destroy(mesh);
        mw_mesh_destroy(triangulate(points, n, 5, &limited));
        assert_true(limited.edge_length >= least * (1 - 1e-12));
        assert_true(limited.optimal == (limited.largest_face <= 5) &&
                    limited.faces == report.faces);
        free(points);
    }
}

/* --- larger sets --- */

static void test_large(void **state)
{
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        uint32_t n = kind == CIRCLE || kind == WHEEL ? 200 : 2000;
        double *points = make_points(kind, n, 5);
        mw_kind_report report, delaunay, greedy;
        mw_mesh *mesh = triangulate(points, n, 0, &report), *other;
        mw_error error;
        expect_ok(mw_triangulate(MW_KIND_GREEDY, points, n, 2, NULL, NULL, &greedy, &other, &error),
                  "greedy", &error);
        mw_mesh_destroy(other);
        expect_ok(
            mw_triangulate(MW_KIND_DELAUNAY, points, n, 2, NULL, NULL, &delaunay, &other, &error),
            "delaunay", &error);
        print_message("kind %d: %g of Delaunay, %zu faces, largest %zu, local %zu\n", kind,
                      report.edge_length / delaunay.edge_length, report.faces, report.largest_face,
                      report.local_faces);
        assert_true(report.edge_length <= delaunay.edge_length * (1 + 1e-12));
        assert_true(report.edge_length <= greedy.edge_length * (1 + 1e-12));
        assert_true(report.optimal == (report.local_faces == 0));
        if (kind != WHEEL) assert_true(report.optimal);
        mw_mesh_destroy(mesh);
        mw_mesh_destroy(other);
        free(points);
    }
}

/* A regular polygon of many corners and its centre: every spoke is crossed by a candidate, so a
 * face holds a point. */
static void test_point_in_face(void **state)
{
    (void)state;
    double *points = make_points(WHEEL, 40, 1);
    mw_kind_report report;
    mw_mesh_destroy(triangulate(points, 40, 0, &report));
    assert_true(!report.optimal && report.local_faces == 1 && report.faces == 1 &&
                report.largest_face == 39);
    free(points);
}

/* More candidates than can be looked at: a local optimum, and said so. */
static void test_too_many(void **state)
{
    (void)state;
    enum { MANY = 4000 };
    double *points = make_points(CIRCLE, MANY, 1);
    mw_kind_report report;
    mw_mesh_destroy(triangulate(points, MANY, 0, &report));
    assert_true(!report.optimal && report.local_faces == 1 && report.faces == 1 &&
                report.largest_face == MANY);
    free(points);
}

/* Coordinates near the ends of the doubles change nothing. */
static void test_scales(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        double *points = make_points(UNIFORM, 300, seed);
        mw_kind_report plain, scaled;
        mw_mesh_destroy(triangulate(points, 300, 0, &plain));
        for (int power = -900; power <= 900; power += 1800) {
            for (int i = 0; i < 600; i++) points[i] = ldexp(points[i], power);
            mw_mesh_destroy(triangulate(points, 300, 0, &scaled));
            assert_true(scaled.edge_length == ldexp(plain.edge_length, power) &&
                        scaled.faces == plain.faces);
            for (int i = 0; i < 600; i++) points[i] = ldexp(points[i], -power);
        }
        free(points);
    }
}

/* Coordinates so far apart that scaling brings points together: the way from one to the other has
 * no direction then, and must rule out no edge. If it does, the last four sets come out too heavy.
 */
static void test_span(void **state)
{
    (void)state;
    enum { POINTS = 8, SEEDS = 8 };
    static const uint64_t seeds[SEEDS] = {1, 2, 3, 4, 5245, 5375, 8893, 9133};
    for (int k = 0; k < SEEDS; k++) {
        uint64_t random = seeds[k];
        double points[2 * POINTS];
        for (int i = 0; i < POINTS; i++) {
            int power =
                i < 4 ? (seeds[k] % 2 ? -1030 : -300) + (int)mw__random_below(&random, 30) : 1020;
            double x = random_unit(&random) - 0.5, y = random_unit(&random) - 0.5;
            points[2 * i] = ldexp(i < 4 ? x : fabs(x), power);
            points[2 * i + 1] = ldexp(y, power);
        }
        mw_kind_report report;
        mw_error error;
        mw_mesh *mesh;
        weight_scene s;
        expect_ok(mw_triangulate(MW_KIND_MIN_WEIGHT, points, POINTS, 2, NULL, NULL, &report, &mesh,
                                 &error),
                  "mesh", &error);
        search_all(&s, points, POINTS);
        assert_true(!report.optimal || report.edge_length <= s.best * (1 + 1e-12));
        mw_mesh_destroy(mesh);
    }
}

/* --- candidates --- */

/* Is there a point in the triangle on the left of pq with base angles a little less than pi / 4.6?
 */
static bool holds_point(const double *points, uint32_t n, uint32_t p, uint32_t q)
{
    double ux = points[2 * q] - points[2 * p], uy = points[2 * q + 1] - points[2 * p + 1],
           square = ux * ux + uy * uy;
    double tangent = tan(PI / 4.6) * (1 - 1e-9);
    for (uint32_t i = 0; i < n; i++) {
        double wx = points[2 * i] - points[2 * p], wy = points[2 * i + 1] - points[2 * p + 1];
        double height = ux * wy - uy * wx, along = ux * wx + uy * wy;
        if (i != p && i != q && height > 0 && height < tangent * fmin(along, square - along))
            return true;
    }
    return false;
}

static bool is_blocked(const double *points, uint32_t n, uint32_t p, uint32_t q)
{
    weight_scene s = {.points = points, .n = n};
    for (uint32_t i = 0; i < n; i++)
        if (i != p && i != q && in_closed_segment(&s, p, q, i)) return true;
    return false;
}

/* No edge with the diamond property is left out, from either end; none is listed twice. */
static void check_candidates(const double *points, uint32_t n)
{
    mw_scaled s = {(const mw_point *)points, (const mw_point *)points, n};
    mw_effort effort = {UINT64_MAX, UINT64_MAX, MW_ALONE};
    mw_edge_list list = {0};
    uint32_t *vertex = malloc(n * sizeof *vertex);
    uint8_t *found = calloc((size_t)n * n, 1);
    for (uint32_t i = 0; i < n; i++) vertex[i] = i;
    assert_int_equal(mw__diamond(&s, vertex, n, &effort, &list), MW_LMT_DONE);
    for (size_t i = 0; i < list.count; i++)
        found[mw__edge_low(list.key[i]) * n + mw__edge_high(list.key[i])]++;
    for (uint32_t p = 0; p < n; p++)
        for (uint32_t q = p + 1; q < n; q++) {
            bool wanted = !holds_point(points, n, p, q) || !holds_point(points, n, q, p);
            assert_true(found[p * n + q] <= 2);
            if (wanted && found[p * n + q] < 2) assert_true(is_blocked(points, n, p, q));
        }
    free(found);
    free(vertex);
    free(list.key);
}

static void test_candidates(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++)
        for (int kind = 0; kind < KINDS; kind++) {
            uint32_t n = 60 + 120 * (uint32_t)seed;
            double *points = make_points(kind, n, seed),
                   *different = malloc(2 * n * sizeof *different);
            check_candidates(different, without_duplicates(points, n, different));
            free(different);
            free(points);
        }
}

/* --- memory --- */

static void test_memory(void **state)
{
    (void)state;
    double *points = make_points(CIRCLE, 24, 3);
    for (uint32_t i = 0; i < 6; i++) points[2 * i] *= 0.5;
    long left = 0;
    for (mw_status status = MW_ERROR_MEMORY; status == MW_ERROR_MEMORY; left++) {
        mw_mesh *mesh;
        mw_error error;
        allocations_left = left;
        status = mw_triangulate(MW_KIND_MIN_WEIGHT, points, 24, 2, NULL, NULL, NULL, &mesh, &error);
        allocations_left = -1;
        assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !mesh));
        mw_mesh_destroy(mesh);
    }
    assert_true(left > 30);
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small),         cmocka_unit_test(test_limited),
        cmocka_unit_test(test_convex),        cmocka_unit_test(test_large),
        cmocka_unit_test(test_point_in_face), cmocka_unit_test(test_too_many),
        cmocka_unit_test(test_scales),        cmocka_unit_test(test_span),
        cmocka_unit_test(test_candidates),    cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
