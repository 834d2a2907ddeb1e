/* The greedy triangulation against its definition: all pairs of points sorted by length in
 * integers (GMP), each taken unless a taken edge or a point is in its way. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <gmp.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/random.h"
#include "mesh/mesh.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"

#include <meshwalk/triangulate.h>

enum { MOST = 120 }; /* points that are compared with the definition */

/* --- sets of points --- */

typedef void make_points(mw_point *p, uint32_t n, uint64_t *random);

static double symmetric(uint64_t *random)
{
    return 2 * random_unit(random) - 1;
}

static void uniform(mw_point *p, uint32_t n, uint64_t *random)
{
    for (uint32_t i = 0; i < n; i++) p[i] = (mw_point){symmetric(random), symmetric(random)};
}

/* Integers: ties, collinear and cocircular points, and duplicates. */
static void lattice(mw_point *p, uint32_t n, uint64_t *random)
{
    uint32_t size = 2 + mw__random_below(random, 14);
    for (uint32_t i = 0; i < n; i++)
        p[i] = (mw_point){mw__random_below(random, size), mw__random_below(random, size)};
}

/* All of a square lattice, in order. */
static void full_lattice(mw_point *p, uint32_t n, uint64_t *random)
{
    uint32_t side = (uint32_t)sqrt(n);
    if (mw__random(random) >> 63) side = 2;
    for (uint32_t i = 0; i < n; i++) p[i] = (mw_point){i % side, i / side};
}

/* Integers on one circle, its centre, and some inside. */
static void cocircular(mw_point *p, uint32_t n, uint64_t *random)
{
    static const int on[9][2] = {{65, 0},  {16, 63}, {33, 56}, {25, 60}, {39, 52},
                                 {63, 16}, {56, 33}, {60, 25}, {52, 39}};
    for (uint32_t i = 0; i < n; i++) {
        const int *v = on[mw__random_below(random, 9)];
        uint64_t signs = mw__random(random);
        p[i] = (mw_point){signs >> 63 ? v[0] : -v[0], signs >> 62 & 1 ? v[1] : -v[1]};
        if (i % 11 == 10)
            p[i] = (mw_point){mw__random_below(random, 30), mw__random_below(random, 30)};
    }
    p[0] = (mw_point){0, 0};
}

/* Corners of a regular polygon: lengths that differ by rounding only. */
static void polygon(mw_point *p, uint32_t n, uint64_t *random)
{
    double turn = random_unit(random);
    for (uint32_t i = 0; i < n; i++)
        p[i] = (mw_point){cos(turn + 6.283185307179586 * i / n),
                          sin(turn + 6.283185307179586 * i / n)};
}

static void two_circles(mw_point *p, uint32_t n, uint64_t *random)
{
    polygon(p, n, random);
    double inner = random_unit(random);
    for (uint32_t i = 0; i < n; i += 2) p[i] = (mw_point){inner * p[i].x, inner * p[i].y};
}

static void clusters(mw_point *p, uint32_t n, uint64_t *random)
{
    uniform(p, n, random);
    double size = ldexp(1, -(int)mw__random_below(random, 40));
    for (uint32_t i = 4; i < n; i++)
        p[i] = (mw_point){p[i % 4].x + size * p[i].x, p[i % 4].y + size * p[i].y};
}

/* Two curves that bulge towards or away from each other, or are straight. */
static void lens(mw_point *p, uint32_t n, uint64_t *random)
{
    double bend = (int)mw__random_below(random, 3) - 1, apart = random_unit(random);
    for (uint32_t i = 0; i < n; i++) {
        double x = symmetric(random), y = apart + bend * x * x;
        p[i] = (mw_point){x, i % 2 ? y : -y};
    }
}

/* Rows that are straight up to 1e-9. */
static void slivers(mw_point *p, uint32_t n, uint64_t *random)
{
    for (uint32_t i = 0; i < n; i++)
        p[i] = (mw_point){random_unit(random), 0.1 * (i % 3) + 1e-9 * random_unit(random)};
}

/* A point that sees all others, on a bent row, and some behind them. */
static void hub(mw_point *p, uint32_t n, uint64_t *random)
{
    double bend = symmetric(random);
    for (uint32_t i = 0; i < n; i++) {
        double x = symmetric(random);
        p[i] = (mw_point){x, 1 + bend * x * x + (i % 8 == 7 ? random_unit(random) : 0)};
    }
    p[0] = (mw_point){0, -random_unit(random)};
}

static void spiral(mw_point *p, uint32_t n, uint64_t *random)
{
    double turns = 40 * random_unit(random);
    for (uint32_t i = 0; i < n; i++) {
        double s = (i + 1.0) / n;
        p[i] = (mw_point){s * cos(turns * s), s * sin(turns * s)};
    }
}

static make_points *const makers[] = {uniform,    lattice, lattice,  full_lattice,
                                      cocircular, polygon, clusters, lens,
                                      slivers,    hub,     spiral,   two_circles};
enum { MAKERS = sizeof makers / sizeof makers[0] };

/* Large, small, subnormal, or far from the origin. */
static void rescale(mw_point *p, uint32_t n, uint64_t *random)
{
    static const int exponents[] = {1000, 510, -480, -1060, -30};
    uint32_t how = mw__random_below(random, 12);
    for (uint32_t i = 0; i < n; i++) {
        if (how < 5)
            p[i] = (mw_point){ldexp(p[i].x, exponents[how]), ldexp(p[i].y, exponents[how])};
        if (how == 5) p[i] = (mw_point){p[i].x + 5e6, p[i].y - 4e5};
        if (how == 6) p[i].y = ldexp(p[i].y, -20);
        if (how == 7) p[i].x = ldexp(p[i].x, -1000);
    }
}

/* --- the definition --- */

typedef struct pair {
    mpz_t square;
    uint32_t low, high;
} pair;

static pair pairs[MOST * (MOST - 1) / 2];

/* v * 2^1074 */
static void set_integer(mpz_t z, double v)
{
    int exponent;
    double fraction = frexp(v, &exponent);
    mpz_set_d(z, ldexp(fraction, 53));
    exponent += 1074 - 53;
    if (exponent >= 0)
        mpz_mul_2exp(z, z, (mp_bitcnt_t)exponent);
    else
        mpz_tdiv_q_2exp(z, z, (mp_bitcnt_t)-exponent); /* subnormal: these bits are 0 */
}

static void set_square(mpz_t square, mw_point a, mw_point b)
{
    mpz_t s, t;
    mpz_inits(s, t, NULL);
    set_integer(s, a.x);
    set_integer(t, b.x);
    mpz_sub(s, s, t);
    mpz_mul(square, s, s);
    set_integer(s, a.y);
    set_integer(t, b.y);
    mpz_sub(s, s, t);
    mpz_addmul(square, s, s);
    mpz_clears(s, t, NULL);
}

static int by_length(const void *left, const void *right)
{
    const pair *p = left, *q = right;
    int order = mpz_cmp(p->square, q->square);
    if (order != 0) return order;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return p->high < q->high ? -1 : 1;
}

static int side(const mw_point *p, uint32_t a, uint32_t b, uint32_t c)
{
    double s = mw__orient2d(p[a], p[b], p[c]);
    return (s > 0) - (s < 0);
}

static bool crosses(const mw_point *p, const pair *e, const pair *f)
{
    return side(p, e->low, e->high, f->low) * side(p, e->low, e->high, f->high) < 0 &&
           side(p, f->low, f->high, e->low) * side(p, f->low, f->high, e->high) < 0;
}

static bool holds_point(const mw_point *p, uint32_t n, const pair *e)
{
    mw_point a = p[e->low], b = p[e->high];
    for (uint32_t i = 0; i < n; i++)
        if (side(p, e->low, e->high, i) == 0 && fmin(a.x, b.x) <= p[i].x &&
            p[i].x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p[i].y && p[i].y <= fmax(a.y, b.y) &&
            (p[i].x != a.x || p[i].y != a.y) && (p[i].x != b.x || p[i].y != b.y))
            return true;
    return false;
}

/* The greedy triangulation of points that are no duplicates; its edges come first in `pairs`.
 * Returns their number. */
static size_t take_greedily(const mw_point *p, uint32_t n, const uint32_t *duplicate_of)
{
    size_t count = 0, taken = 0;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n; j++) {
            if (duplicate_of[i] != MW_NONE || duplicate_of[j] != MW_NONE) continue;
            pairs[count].low = i;
            pairs[count].high = j;
            set_square(pairs[count++].square, p[i], p[j]);
        }
    qsort(pairs, count, sizeof *pairs, by_length);
    for (size_t i = 0; i < count; i++) {
        bool open = !holds_point(p, n, &pairs[i]);
        for (size_t j = 0; j < taken && open; j++) open = !crosses(p, &pairs[i], &pairs[j]);
        if (!open) continue;
        pair other = pairs[taken];
        pairs[taken++] = pairs[i];
        pairs[i] = other;
    }
    return taken;
}

/* --- what is checked --- */

/* The greedy triangulation, or NULL where all points lie on one line. */
static mw_mesh *greedy_mesh(const mw_point *p, uint32_t n, uint32_t *duplicate_of,
                            mw_kind_report *report)
{
    mw_mesh *mesh;
    mw_error error;
    mw_status status =
        mw_triangulate(MW_KIND_GREEDY, &p->x, n, 2, NULL, duplicate_of, report, &mesh, &error);
    if (status == MW_ERROR_INPUT) return NULL;
    expect_ok(status, "greedy", &error);
    return mesh;
}

static bool has_edge(const mw_mesh *mesh, uint32_t a, uint32_t b)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t *v = mesh->tri[t].v + k;
            if ((v[0] == a && v[1] == b) || (v[0] == b && v[1] == a)) return true;
        }
    return false;
}

static uint32_t count_edges(const mw_mesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) count += mw__link(t, k) < mesh->tri[t].link[k];
    return count;
}

/* Triangles counter-clockwise, links symmetric, an embedding; as many as the Delaunay
 * triangulation has. */
static void check_sound(const mw_mesh *mesh, const mw_point *p, uint32_t n)
{
    mw_mesh *delaunay = mesh_delaunay(&p->x, n);
    assert_int_equal(mesh->tri_count, delaunay->tri_count);
    assert_int_equal(count_edges(mesh), count_edges(delaunay));
    mw_mesh_destroy(delaunay);
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        assert_true(side(p, tri->v[0], tri->v[1], tri->v[2]) > 0);
        assert_true(tri->v[3] == tri->v[0] && tri->user == t);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tri->link[k];
            if (link == MW_NONE) continue;
            const mw_triangle *other = &mesh->tri[mw__link_triangle(link)];
            assert_int_equal(other->link[mw__link_edge(link)], mw__link(t, k));
            assert_true(other->v[mw__link_edge(link)] == tri->v[k + 1]);
            assert_true(other->v[mw__link_edge(link) + 1] == tri->v[k]);
        }
    }
    arrays a = arrays_of_mesh(mesh);
    mw_arrays view = arrays_view(&a);
    mw_check check;
    mw_error error;
    expect_ok(mw_check_arrays(&view, NULL, &check, &error), "check", &error);
    assert_true(check.valid);
    mw_check_release(&check);
    arrays_free(&a);
}

/* No edge could be exchanged for the other diagonal of its two triangles, were that to be taken
 * first. */
static void check_diagonals(const mw_mesh *mesh, const mw_point *p)
{
    pair e, f;
    mpz_inits(e.square, f.square, NULL);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const mw_triangle *tri = &mesh->tri[t];
            if (tri->link[k] == MW_NONE || tri->link[k] < mw__link(t, k)) continue;
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            uint32_t v[4] = {tri->v[k], tri->v[k + 1], tri->v[mw__prev(k)],
                             other->v[mw__prev(mw__link_edge(tri->link[k]))]};
            e.low = v[0] < v[1] ? v[0] : v[1];
            e.high = v[0] < v[1] ? v[1] : v[0];
            f.low = v[2] < v[3] ? v[2] : v[3];
            f.high = v[2] < v[3] ? v[3] : v[2];
            if (!crosses(p, &e, &f)) continue;
            set_square(e.square, p[e.low], p[e.high]);
            set_square(f.square, p[f.low], p[f.high]);
            assert_true(by_length(&e, &f) < 0);
        }
    mpz_clears(e.square, f.square, NULL);
}

static void check_definition(uint64_t seed, uint32_t most)
{
    uint64_t random = mw__random_seed(seed, 3);
    mw_point p[MOST];
    uint32_t n = 3 + mw__random_below(&random, most - 3), duplicate_of[MOST];
    makers[seed % MAKERS](p, n, &random);
    if (mw__random(&random) >> 63) rescale(p, n, &random);
    mw_kind_report report;
    mw_mesh *mesh = greedy_mesh(p, n, duplicate_of, &report);
    if (!mesh) return;
    assert_true(report.optimal && report.edge_length > 0);
    check_sound(mesh, p, n);
    size_t taken = take_greedily(p, n, duplicate_of);
    assert_int_equal(taken, count_edges(mesh));
    for (size_t i = 0; i < taken; i++)
        if (!has_edge(mesh, pairs[i].low, pairs[i].high)) {
            print_error("seed %d: %u-%u is missing\n", (int)seed, pairs[i].low, pairs[i].high);
            fail();
        }
    mw_mesh_destroy(mesh);
}

static void test_definition(void **state)
{
    (void)state;
    uint64_t first = environment_print_seed("first", 1);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) mpz_init(pairs[i].square);
    for (uint64_t seed = first; seed < first + 240 * MAKERS; seed++) check_definition(seed, 24);
    for (uint64_t seed = first; seed < first + 15 * MAKERS; seed++) check_definition(seed, 60);
    for (uint64_t seed = first; seed < first + 2 * MAKERS; seed++) check_definition(seed, MOST);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) mpz_clear(pairs[i].square);
}

static void check_large(make_points *make, uint64_t seed)
{
    enum { N = 3000 };
    static mw_point p[N];
    uint64_t random = mw__random_seed(seed, 4);
    make(p, N, &random);
    mw_mesh *mesh = greedy_mesh(p, N, NULL, NULL);
    assert_non_null(mesh);
    check_sound(mesh, p, N);
    check_diagonals(mesh, p);
    mw_mesh_destroy(mesh);
}

static void test_larger(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2 * MAKERS; seed++) check_large(makers[seed % MAKERS], seed);
}

/* Two curves that bulge towards each other make many corners that cannot be cut off: the heap is
 * filled anew. */
static void bulges(mw_point *p, uint32_t n, uint64_t *random)
{
    for (uint32_t i = 0; i < n; i++) {
        double x = random_unit(random) - 0.5, y = 1 + x * x;
        p[i] = (mw_point){x, i % 2 ? y : -y};
    }
}

static void test_many_corners(void **state)
{
    (void)state;
    check_large(bulges, 1);
}

/* Of the two diagonals of a square, that with the lowest number wins; then lowest other end. */
static void test_ties(void **state)
{
    (void)state;
    const mw_point square[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                   turned[4] = {{1, 0}, {1, 1}, {0, 0}, {0, 1}};
    mw_mesh *mesh = greedy_mesh(square, 4, NULL, NULL);
    assert_true(has_edge(mesh, 0, 2) && !has_edge(mesh, 1, 3));
    mw_mesh_destroy(mesh);
    mesh = greedy_mesh(turned, 4, NULL, NULL);
    assert_true(has_edge(mesh, 0, 3) && !has_edge(mesh, 1, 2));
    mw_mesh_destroy(mesh);
}

static void test_memory(void **state)
{
    (void)state;
    enum { N = 300 };
    mw_point p[N];
    uint64_t random = 8;
    lens(p, N, &random);
    for (long allowed = 0;; allowed++) {
        mw_mesh *mesh = (mw_mesh *)1;
        mw_error error;
        allocations_left = allowed;
        mw_status status =
            mw_triangulate(MW_KIND_GREEDY, &p->x, N, 2, NULL, NULL, NULL, &mesh, &error);
        allocations_left = -1;
        if (status == MW_OK) {
            assert_true(allowed > 15);
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
        cmocka_unit_test(test_definition),   cmocka_unit_test(test_larger),
        cmocka_unit_test(test_many_corners), cmocka_unit_test(test_ties),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests_name("greedy", tests, NULL, NULL);
}
