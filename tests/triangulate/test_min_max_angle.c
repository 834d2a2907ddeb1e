/* The triangulation with the smallest largest angle: against all triangulations of small sets,
 * exactly; and the comparison of angles against GMP. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/mesh.h"
#include "support/allocations.h"
#include "support/meshes.h"
#include "support/predicate_cases.h"
#include "triangulate/kinds/edge_insertion.h"
#include "triangulate/kinds/min_max_angle.h"

#include <meshwalk/triangulate.h>

/* --- the comparison of angles --- */

static mw_angle angle_at(const double *p)
{
    return mw__angle((mw_point){p[0], p[1]}, (mw_point){p[2], p[3]}, (mw_point){p[4], p[5]});
}

/* The square of the cosine of the angle at the middle one of three points, with the sign of the
 * cosine. False if a point equals the middle one. */
static bool exact_cosine(const double p[6], mpq_t cosine)
{
    mpq_t v[6], dot, length[2], s;
    mpq_inits(dot, length[0], length[1], s, NULL);
    for (int i = 0; i < 6; i++) {
        mpq_init(v[i]);
        mpq_set_d(v[i], p[i]);
    }
    for (int i = 0; i < 2; i++) {
        mpq_sub(v[i], v[i], v[2 + i]);
        mpq_sub(v[4 + i], v[4 + i], v[2 + i]);
        mpq_mul(s, v[i], v[4 + i]);
        mpq_add(dot, dot, s);
        for (int k = 0; k < 2; k++) {
            mpq_mul(s, v[4 * k + i], v[4 * k + i]);
            mpq_add(length[k], length[k], s);
        }
    }
    bool defined = mpq_sgn(length[0]) != 0 && mpq_sgn(length[1]) != 0;
    mpq_mul(s, length[0], length[1]);
    mpq_abs(cosine, dot);
    mpq_mul(cosine, cosine, dot);
    if (defined) mpq_div(cosine, cosine, s);
    for (int i = 0; i < 6; i++) mpq_clear(v[i]);
    mpq_clears(dot, length[0], length[1], s, NULL);
    return defined;
}

/* In another way than the library: by the cosines. *defined: no point equals the corner. */
static int oracle_compare_angles(const double p[12], bool *defined)
{
    mpq_t s, t;
    mpq_inits(s, t, NULL);
    *defined = exact_cosine(p, s);
    *defined &= exact_cosine(p + 6, t);
    int order = mpq_cmp(t, s);
    mpq_clears(s, t, NULL);
    return (order > 0) - (order < 0);
}

static void check_angles(const double p[12])
{
    bool defined, finite = true;
    for (int i = 0; i < 12; i++) finite &= (bool)isfinite(p[i]);
    if (!finite) return;
    mw_angle s = angle_at(p), t = angle_at(p + 6), turned = mw__angle(s.c, s.b, s.a);
    int expected = oracle_compare_angles(p, &defined);
    if (!defined) return;
    if (mw__compare_angles(&s, &t) == expected && mw__compare_angles(&t, &s) == -expected &&
        mw__compare_angles_exact(&turned, &t) == expected)
        return;
    for (int i = 0; i < 12; i++) fprintf(stderr, " %a", p[i]);
    fail_msg("angles: %d is wrong, it is %d", mw__compare_angles(&s, &t), expected);
}

/* The first angle, turned and scaled by a product with (x, y) as a complex number, moved, perhaps
 * mirrored; exact where the numbers are small. */
static void make_similar(double p[12])
{
    double x = (double)cases_below(1000) - 500, y = (double)cases_below(1000) - 500;
    bool mirrored = cases_below(2);
    for (int i = 0; i < 6; i += 2) {
        double u = p[i], v = mirrored ? -p[i + 1] : p[i + 1];
        p[6 + i] = u * x - v * y + 7;
        p[7 + i] = u * y + v * x - 9;
    }
}

static void test_angles(void **unused)
{
    (void)unused;
    double p[12];
    for (long i = cases_count(50000); i > 0; i--) {
        cases_generate(p, 12, 2);
        uint32_t how = cases_below(4);
        if (how == 0) make_similar(p);
        if (how == 1)
            for (int k = 0; k < 6; k++) p[k] = (double)cases_below(2000) - 1000;
        if (how == 1) make_similar(p);
        if (how == 1 && cases_below(4) == 0) cases_rescale(p, 12);
        if (how < 2 && cases_below(4) == 0) cases_perturb(p, 12);
        check_angles(p);
    }
}

/* Angles of 0, a right angle and pi, of all lengths. */
static void test_angles_of_quarters(void **unused)
{
    (void)unused;
    static const double way[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (long i = 0; i < 20000; i++) {
        double p[12] = {0};
        for (int k = 0; k < 12; k += 2) {
            const double *w = way[cases_below(4)];
            double length =
                ldexp(1 + cases_below(3), (int)cases_below(1000) * (cases_below(2) ? 1 : -1));
            if (k % 6 == 2) continue;
            p[k] = w[0] * length;
            p[k + 1] = w[1] * length;
        }
        check_angles(p);
    }
    const mw_point o = {0, 0}, far = {INFINITY, 1}, a = {1, 0};
    mw_angle s = mw__angle(a, o, far), t = mw__angle(a, o, a);
    assert_int_equal(mw__compare_angles(&s, &t), 0);
}

/* --- all triangulations of a few points --- */

enum { MOST = 11, MOST_TRIANGLES = MOST * (MOST - 1) * (MOST - 2) / 6 };

typedef struct small_triangle {
    uint32_t v[3]; /* counter-clockwise */
    mw_angle largest;
    int rank; /* among all triangles, by the largest angle; equal ones have the same */
} small_triangle;

typedef struct small_set {
    mw_point point[MOST];
    uint32_t n;
    small_triangle triangle[MOST_TRIANGLES];
    int count;
    /* no inner point in common */
    bool apart[MOST_TRIANGLES][MOST_TRIANGLES];
    /* two triangles of equal rank */
    bool ties;
    /* directed edges with a triangle on their left, or the outside */
    bool covered[MOST][MOST];
    int chosen[2 * MOST], chosen_count;
    int best[2 * MOST], best_count; /* ranks by falling angle, the least list so far */
    long found;
} small_set;

static small_set set;

static bool left_of(uint32_t a, uint32_t b, uint32_t c)
{
    return mw__orient2d(set.point[a], set.point[b], set.point[c]) > 0;
}

static bool in_closed_triangle(const uint32_t v[3], uint32_t i)
{
    return i != v[0] && i != v[1] && i != v[2] && !left_of(v[1], v[0], i) &&
           !left_of(v[2], v[1], i) && !left_of(v[0], v[2], i);
}

/* An edge of one of them parts them. */
static bool parted(const uint32_t a[3], const uint32_t b[3])
{
    for (int k = 0; k < 3; k++) {
        uint32_t from = a[k], to = a[(k + 1) % 3];
        if (!left_of(from, to, b[0]) && !left_of(from, to, b[1]) && !left_of(from, to, b[2]))
            return true;
    }
    return false;
}

static void add_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    small_triangle *t = &set.triangle[set.count];
    *t = (small_triangle){.v = {a, b, c}};
    if (!left_of(a, b, c)) t->v[1] = c, t->v[2] = b;
    if (!left_of(t->v[0], t->v[1], t->v[2])) return;
    for (uint32_t i = 0; i < set.n; i++)
        if (in_closed_triangle(t->v, i)) return;
    for (int k = 0; k < 3; k++) {
        mw_angle angle = mw__angle(set.point[t->v[k]], set.point[t->v[(k + 1) % 3]],
                                   set.point[t->v[(k + 2) % 3]]);
        if (k == 0 || mw__compare_angles(&angle, &t->largest) > 0) t->largest = angle;
    }
    set.count++;
}

static void rank_triangles(void)
{
    set.ties = false;
    for (int i = 0; i < set.count; i++) {
        set.triangle[i].rank = 0;
        for (int j = 0; j < set.count; j++) {
            int order = mw__compare_angles(&set.triangle[i].largest, &set.triangle[j].largest);
            set.triangle[i].rank += order > 0;
            set.ties |= i != j && order == 0;
            set.apart[i][j] = parted(set.triangle[i].v, set.triangle[j].v) ||
                              parted(set.triangle[j].v, set.triangle[i].v);
        }
    }
}

static void cover(const small_triangle *t, bool covered)
{
    for (int k = 0; k < 3; k++) set.covered[t->v[k]][t->v[(k + 1) % 3]] = covered;
}

static int by_falling_rank(const void *left, const void *right)
{
    return *(const int *)right - *(const int *)left;
}

static int compare_lists(const int *a, const int *b, int n)
{
    for (int i = 0; i < n; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

static void record(void)
{
    int ranks[2 * MOST];
    for (int i = 0; i < set.chosen_count; i++) ranks[i] = set.triangle[set.chosen[i]].rank;
    qsort(ranks, (size_t)set.chosen_count, sizeof ranks[0], by_falling_rank);
    if (set.found++ == 0 || compare_lists(ranks, set.best, set.chosen_count) < 0)
        memcpy(set.best, ranks, sizeof ranks);
    set.best_count = set.chosen_count;
}

static bool fits(int i)
{
    for (int j = 0; j < set.chosen_count; j++)
        if (!set.apart[i][set.chosen[j]]) return false;
    return true;
}

/* Put each triangle that fits on the first edge that still lacks one. An edge lacks one if its
 * other side has one. */
static void enumerate(void)
{
    uint32_t from = 0, to = 0;
    for (uint32_t a = 0; a < set.n && from == to; a++)
        for (uint32_t b = 0; b < set.n && from == to; b++)
            if (set.covered[b][a] && !set.covered[a][b]) from = a, to = b;
    if (from == to) {
        record();
        return;
    }
    for (int i = 0; i < set.count; i++) {
        const small_triangle *t = &set.triangle[i];
        bool on_edge = false;
        for (int k = 0; k < 3; k++) on_edge |= t->v[k] == from && t->v[(k + 1) % 3] == to;
        if (!on_edge || !fits(i)) continue;
        set.chosen[set.chosen_count++] = i;
        cover(t, true);
        enumerate();
        cover(t, false);
        set.chosen_count--;
    }
}

/* The outside covers the far side of the hull's edges: those with nothing on their right, and no
 * point between. */
static bool is_hull_edge(uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < set.n; i++) {
        if (i == a || i == b) continue;
        if (left_of(b, a, i)) return false;
        if (!left_of(a, b, i) && mw__dot2d(set.point[i], set.point[a], set.point[b]) < 0)
            return false;
    }
    return a != b;
}

static void enumerate_all(void)
{
    set.count = set.chosen_count = 0;
    set.found = 0;
    for (uint32_t a = 0; a < set.n; a++)
        for (uint32_t b = a + 1; b < set.n; b++)
            for (uint32_t c = b + 1; c < set.n; c++) add_triangle(a, b, c);
    rank_triangles();
    for (uint32_t a = 0; a < set.n; a++)
        for (uint32_t b = 0; b < set.n; b++) set.covered[b][a] = is_hull_edge(a, b);
    enumerate();
}

static int rank_of(const mw_triangle *tri)
{
    for (int i = 0; i < set.count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *v = set.triangle[i].v;
            if (v[k] == tri->v[0] && v[(k + 1) % 3] == tri->v[1] && v[(k + 2) % 3] == tri->v[2])
                return set.triangle[i].rank;
        }
    fail_msg("no empty triangle");
    return 0;
}

/* Triangulate the set; ranks: by falling angle. */
static int triangulated(uint32_t limit, int ranks[2 * MOST], mw_kind_report *report)
{
    mw_mesh *mesh;
    mw_error error;
    mw_kind_options options = {.limit = limit};
    expect_ok(mw_triangulate(MW_KIND_MIN_MAX_ANGLE, &set.point[0].x, set.n, 0, &options, NULL,
                             report, &mesh, &error),
              "min-max angle", &error);
    int count = (int)mesh->tri_count;
    for (int i = 0; i < count; i++) ranks[i] = rank_of(&mesh->tri[i]);
    qsort(ranks, (size_t)count, sizeof ranks[0], by_falling_rank);
    mw_mesh_destroy(mesh);
    return count;
}

static mw_point small_point(uint32_t kind)
{
    static const int on[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                  {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
    const int *c = on[cases_below(12)];
    switch (kind) {
    case 0: return (mw_point){cases_uniform(), cases_uniform()};
    case 1: return (mw_point){(double)cases_below(4), (double)cases_below(4)};
    case 2: return (mw_point){(double)cases_below(20), (double)cases_below(6)};
    case 3:
        return cases_below(4) ? (mw_point){c[0], c[1]}
                              : (mw_point){(double)cases_below(7) - 3, (double)cases_below(7) - 3};
    case 4: return (mw_point){cases_uniform(), 1e-3 * cases_uniform()};
    case 5:
        return (mw_point){(double)cases_below(1000),
                          (double)cases_below(2) * 0x1p-30 + (double)cases_below(2)};
    default: {
        double angle = 3.14159265 * cases_uniform(), radius = cases_below(5) ? 1 : cases_uniform();
        return (mw_point){radius * cos(angle), radius * sin(angle)};
    }
    }
}

/* n different points, not all on one line. */
static bool make_small_set(uint32_t n, uint32_t kind)
{
    bool flat = true;
    set.n = 0;
    for (int tries = 0; set.n < n && tries < 200; tries++) {
        mw_point p = small_point(kind);
        bool equal = false;
        for (uint32_t i = 0; i < set.n; i++)
            equal |= p.x == set.point[i].x && p.y == set.point[i].y;
        if (!equal) set.point[set.n++] = p;
    }
    for (uint32_t i = 2; i < set.n; i++)
        flat &= mw__orient2d(set.point[0], set.point[1], set.point[i]) == 0;
    return !flat;
}

/* No triangulation has a smaller largest angle; without equal angles, none has a smaller sorted
 * list. */
static void test_all_triangulations(void **unused)
{
    (void)unused;
    long unique = 0, flips_fail = 0, several = 0;
    for (long i = cases_count(3000); i > 0; i--) {
        if (!make_small_set(3 + cases_below(i % 50 == 0 ? MOST - 2 : MOST - 4), cases_below(7)))
            continue;
        enumerate_all();
        assert_true(set.found > 0);
        int ranks[2 * MOST];
        mw_kind_report report;
        assert_int_equal(triangulated(i % 2 ? 0 : 100, ranks, &report), set.best_count);
        assert_true(report.optimal == 1);
        assert_int_equal(ranks[0], set.best[0]);
        if (!set.ties) assert_int_equal(compare_lists(ranks, set.best, set.best_count), 0);
        unique += !set.ties;
        several += set.found > 1;
        triangulated(1, ranks, &report);
        assert_true(report.optimal == 0);
        flips_fail += ranks[0] > set.best[0];
    }
    assert_true(unique > 100 && several > 1000 && flips_fail > 0);
}

/* --- larger sets --- */

static mw_point large_point(uint32_t kind, uint32_t i, uint32_t n)
{
    uint32_t side = (uint32_t)sqrt(n);
    double angle = 3.14159265358979 * cases_uniform();
    switch (kind) {
    case 0: return (mw_point){cases_uniform(), cases_uniform()};
    case 1: return (mw_point){i % side, (double)(i / side)};
    case 2:
        return (mw_point){i % side + 1e-9 * cases_uniform(),
                          (double)(i / side) + 1e-9 * cases_uniform()};
    case 3: return (mw_point){cos(angle), sin(angle)};
    case 4:
        return (mw_point){i / 4 + 0.3 * cases_uniform(),
                          i % 4 * 1e-3 * (1 + 1e-3 * cases_uniform())};
    case 5:
        return (mw_point){1e6 + cases_uniform() * exp(10 * cases_uniform()),
                          cases_uniform() * exp(10 * cases_uniform())};
    case 6:
        return (mw_point){ldexp(cases_uniform(), (int)cases_below(400) - 200),
                          ldexp(cases_uniform(), (int)cases_below(400) - 200)};
    /* many equal ones */
    case 7: return (mw_point){(double)cases_below(40), (double)cases_below(40)};
    default: return (mw_point){cases_uniform(), 1e-7 * cases_uniform()};
    }
}

static mw_angle largest_of(const mw_mesh *mesh, const mw_triangle *t)
{
    const mw_point *p = mesh->point;
    mw_angle largest = mw__angle(p[t->v[2]], p[t->v[0]], p[t->v[1]]);
    for (int k = 0; k < 2; k++) {
        mw_angle angle = mw__angle(p[t->v[k]], p[t->v[k + 1]], p[t->v[(k + 2) % 3]]);
        if (mw__compare_angles(&angle, &largest) > 0) largest = angle;
    }
    return largest;
}

static mw_angle larger(mw_angle a, mw_angle b)
{
    return mw__compare_angles(&a, &b) < 0 ? b : a;
}

static mw_angle largest_angle(const mw_mesh *mesh)
{
    mw_angle largest = largest_of(mesh, &mesh->tri[0]);
    for (uint32_t i = 1; i < mesh->tri_count; i++)
        largest = larger(largest, largest_of(mesh, &mesh->tri[i]));
    return largest;
}

/* Exchanging the diagonal across edge k makes no largest angle smaller. */
static void check_exchange(const mw_mesh *mesh, const mw_triangle *t, uint32_t k)
{
    if (t->link[k] == MW_NONE) return;
    const mw_triangle *u = &mesh->tri[mw__link_triangle(t->link[k])];
    uint32_t a = t->v[k], b = t->v[k + 1], c = t->v[mw__prev(k)],
             d = u->v[mw__prev(mw__link_edge(t->link[k]))];
    mw_triangle one = {.v = {c, a, d, c}}, other = {.v = {d, b, c, d}};
    if (!mw__has_area(mesh->point, &one) || !mw__has_area(mesh->point, &other)) return;
    mw_angle before = larger(largest_of(mesh, t), largest_of(mesh, u));
    mw_angle after = larger(largest_of(mesh, &one), largest_of(mesh, &other));
    assert_true(mw__compare_angles(&after, &before) >= 0);
}

static uint32_t border_count(const mw_mesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < mesh->tri_count; i++)
        for (int k = 0; k < 3; k++) count += mesh->tri[i].link[k] == MW_NONE;
    return count;
}

/* An embedding with the triangles and border edges of the Delaunay triangulation: it fills the
 * hull with all points. */
static void check_large(const mw_mesh *mesh, const mw_mesh *delaunay)
{
    arrays a = arrays_of_mesh(mesh);
    mw_arrays view = arrays_view(&a);
    mw_check check;
    mw_error error;
    expect_ok(mw_check_arrays(&view, NULL, &check, &error), "check", &error);
    assert_true(check.valid);
    mw_check_release(&check);
    arrays_free(&a);
    assert_int_equal(mesh->tri_count, delaunay->tri_count);
    assert_int_equal(border_count(mesh), border_count(delaunay));
    for (uint32_t i = 0; i < mesh->tri_count; i++) {
        assert_true(mw__has_area(mesh->point, &mesh->tri[i]));
        for (uint32_t k = 0; k < 3; k++) check_exchange(mesh, &mesh->tri[i], k);
    }
    mw_angle before = largest_angle(delaunay), after = largest_angle(mesh);
    assert_true(mw__compare_angles(&after, &before) <= 0);
}

static void test_large_sets(void **unused)
{
    (void)unused;
    enum { MOST_POINTS = 1500 };
    mw_point *point = malloc(MOST_POINTS * sizeof *point);
    for (long i = 0; i < cases_count(45); i++) {
        uint32_t n = 10 + cases_below(i % 9 == 3 || i % 9 == 6 ? 100 : MOST_POINTS - 10);
        for (uint32_t k = 0; k < n; k++) point[k] = large_point((uint32_t)(i % 9), k, n);
        mw_mesh *delaunay = mesh_delaunay(&point[0].x, n), *mesh[2];
        mw_error error;
        mw_kind_report report[2];
        for (uint32_t k = 0; k < 2; k++) {
            mw_kind_options options = {.limit = k};
            expect_ok(mw_triangulate(MW_KIND_MIN_MAX_ANGLE, &point[0].x, n, 0, &options, NULL,
                                     &report[k], &mesh[k], &error),
                      "min-max angle", &error);
            check_large(mesh[k], delaunay);
        }
        mw_angle best = largest_angle(mesh[0]), local = largest_angle(mesh[1]);
        assert_true(mw__compare_angles(&best, &local) <= 0);
        assert_true(report[0].optimal == 1 && report[1].optimal == 0);
        for (int k = 0; k < 2; k++) mw_mesh_destroy(mesh[k]);
        mw_mesh_destroy(delaunay);
    }
    free(point);
}

/* --- limits --- */

/* Seen from the first point: a parabola whose points hide one another little by little. */
static void make_parabola(mw_point *point, uint32_t n)
{
    point[0] = (mw_point){0, -1};
    for (uint32_t i = 1; i < n; i++) {
        double x = 1 + 10.0 * (i - 1) / (n - 1);
        point[i] = (mw_point){x, x * x * 0.05};
    }
}

/* A point below a straight side and an arc that face each other. */
static void make_bow(mw_point *point, uint32_t n)
{
    point[0] = (mw_point){0.5, -0.25};
    for (uint32_t i = 1; i < n; i++) {
        double t = (double)(i - 1) / n;
        point[i] = i % 2 ? (mw_point){0, t} : (mw_point){1 + 0.2 * t * (1 - t), t};
    }
}

/* Improve a Delaunay triangulation within limits. */
static mw_mesh *limited_mesh(const mw_point *point, uint32_t n, mw_angle_limits limits,
                             bool *proved)
{
    mw_mesh *mesh = mesh_delaunay(&point[0].x, n);
    mw_triangulation t = {mesh->point, mesh->point_count, mesh->tri, mesh->tri_count, MW_ALONE};
    assert_int_equal(mw__min_max_angle_within(&t, limits, proved), MW_OK);
    return mesh;
}

static mw_angle_limits random_limits(void)
{
    mw_angle_limits limits = {UINT64_MAX, SIZE_MAX};
    if (cases_below(2)) limits.most_work = UINT64_C(1) << cases_below(24);
    if (limits.most_work == UINT64_MAX || cases_below(2))
        limits.most_seen = (size_t)1 << cases_below(16);
    return limits;
}

/* Whatever the limits: a local optimum, and what is proved is true. */
static void test_limits(void **unused)
{
    (void)unused;
    enum { N = 250 };
    mw_point point[N];
    long proofs = 0, none = 0;
    for (long i = 0; i < cases_count(50); i++) {
        uint32_t kind = cases_below(10);
        for (uint32_t k = 0; k < N; k++) point[k] = large_point(kind, k, N);
        if (kind == 8) make_parabola(point, N);
        if (kind == 9) make_bow(point, N);
        bool proved[2];
        mw_mesh *mesh[2] = {
            limited_mesh(point, N, random_limits(), &proved[0]),
            limited_mesh(point, N, (mw_angle_limits){UINT64_MAX, SIZE_MAX}, &proved[1])};
        mw_mesh *delaunay = mesh_delaunay(&point[0].x, N);
        for (int k = 0; k < 2; k++) check_large(mesh[k], delaunay);
        mw_angle limited = largest_angle(mesh[0]), best = largest_angle(mesh[1]);
        int order = mw__compare_angles(&best, &limited);
        assert_true(proved[1] && (proved[0] ? order == 0 : order <= 0));
        proofs += proved[0];
        none += !proved[0];
        mw_mesh_destroy(delaunay);
        for (int k = 0; k < 2; k++) mw_mesh_destroy(mesh[k]);
    }
    assert_true(proofs > 0 && none > 0);
}

/* Some thousand points, and not a hundredth of what a search asks for. */
static void test_spent(void **unused)
{
    (void)unused;
    enum { N = 4001 };
    static const mw_angle_limits limits[2] = {{500, SIZE_MAX}, {UINT64_MAX, 3}};
    mw_point *point = malloc(N * sizeof *point);
    make_bow(point, N);
    mw_mesh *delaunay = mesh_delaunay(&point[0].x, N);
    for (int i = 0; i < 2; i++) {
        bool proved;
        mw_mesh *mesh = limited_mesh(point, N, limits[i], &proved);
        assert_false(proved);
        check_large(mesh, delaunay);
        mw_mesh_destroy(mesh);
    }
    mw_mesh_destroy(delaunay);
    free(point);
}

/* More sights than are allowed without a limit of the caller's. */
static void test_many_sights(void **unused)
{
    (void)unused;
    enum { N = 10001 };
    mw_point *point = malloc(N * sizeof *point);
    make_parabola(point, N);
    mw_mesh *delaunay = mesh_delaunay(&point[0].x, N), *mesh;
    mw_error error;
    expect_ok(
        mw_triangulate(MW_KIND_MIN_MAX_ANGLE, &point[0].x, N, 0, NULL, NULL, NULL, &mesh, &error),
        "min-max angle", &error);
    check_large(mesh, delaunay);
    mw_mesh_destroy(mesh);
    mw_mesh_destroy(delaunay);
    free(point);
}

typedef struct attempts {
    long spent, none, done;
} attempts;

/* An insertion that is not decided stays within its limits and changes nothing. */
static void check_attempt(const mw_mesh *mesh, mw_triangle *tri, mw_angle_limits limits,
                          attempts *count)
{
    mw_insertion in = {.point = mesh->point,
                       .tri = tri,
                       .reach = UINT32_MAX,
                       .most_work = limits.most_work,
                       .most_seen = limits.most_seen};
    for (uint32_t i = 0; i < mesh->tri_count; i++) {
        memcpy(tri, mesh->tri, mesh->tri_count * sizeof *tri);
        for (uint32_t j = 0; j < mesh->tri_count; j++) tri[j].user = MW_INSERTION_FREE;
        in.work = 0;
        mw_insertion_result result = mw__insert_edge(&in, i, cases_below(3));
        assert_true(result != MW_INSERTION_MEMORY && in.seen_count <= limits.most_seen);
        count->done += result == MW_INSERTION_DONE;
        count->none += result == MW_INSERTION_NONE;
        if (result != MW_INSERTION_SPENT) continue;
        count->spent++;
        /* at most an ear on either side too many, all angles compared exactly */
        assert_true(in.work <= limits.most_work || in.work - limits.most_work < 1000);
        for (uint32_t j = 0; j < mesh->tri_count; j++)
            assert_memory_equal(tri[j].v, mesh->tri[j].v, sizeof tri[j].v);
    }
    mw__insertion_release(&in);
}

static void test_attempts(void **unused)
{
    (void)unused;
    enum { N = 200 };
    mw_point point[N];
    attempts count = {0};
    mw_triangle *tri = malloc(2 * N * sizeof *tri);
    for (long i = 0; i < cases_count(30); i++) {
        uint32_t kind = cases_below(9);
        for (uint32_t k = 0; k < N; k++) point[k] = large_point(kind, k, N);
        if (i % 3 == 1) make_parabola(point, N);
        if (i % 3 == 2) make_bow(point, N);
        mw_mesh *delaunay = mesh_delaunay(&point[0].x, N);
        check_attempt(delaunay, tri, random_limits(), &count);
        mw_mesh_destroy(delaunay);
    }
    assert_true(count.spent > 0 && count.none > 0 && count.done > 0);
    free(tri);
}

/* --- allocation failures --- */

static void test_memory(void **unused)
{
    (void)unused;
    mw_point point[300];
    for (uint32_t i = 0; i < 300; i++) point[i] = large_point(i < 200 ? 8 : 3, i, 300);
    mw_status status = MW_ERROR_MEMORY;
    for (long k = 0; status != MW_OK; k++) {
        mw_mesh *mesh = NULL;
        mw_error error;
        allocations_left = k;
        status = mw_triangulate(MW_KIND_MIN_MAX_ANGLE, &point[0].x, 300, 0, NULL, NULL, NULL, &mesh,
                                &error);
        allocations_left = -1;
        assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !mesh));
        mw_mesh_destroy(mesh);
        assert_true(k < 10000);
    }
}

static int setup(void **unused)
{
    (void)unused;
    cases_seed();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_angles),
        cmocka_unit_test(test_angles_of_quarters),
        cmocka_unit_test(test_all_triangulations),
        cmocka_unit_test(test_large_sets),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_spent),
        cmocka_unit_test(test_many_sights),
        cmocka_unit_test(test_attempts),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests_name("min_max_angle", tests, setup, NULL);
}
