/* Surfaces in space from arrays: links, places, flips, descriptions and checks, beside counts by
 * brute force; every allocation fails once. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "surface/surface.h"
#include "support/allocations.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/solids.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- brute force ------------------------------------------------------------------------------ */

/* What the library finds in linear time, over all pairs. */
typedef struct naive {
    uint32_t place[256], link[256][3];
    uint8_t proper[256]; /* triangles at three places */
    uint32_t border, loops, clashing, pinched, pieces, used, extra;
    int64_t euler;
} naive;

static uint32_t naive_root(const uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) i = parent[i];
    return i;
}

static uint32_t naive_join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = naive_root(parent, a);
    b = naive_root(parent, b);
    parent[a] = b;
    return a != b;
}

static uint32_t corner(const naive *n, const solid *s, uint32_t t, uint32_t k)
{
    return n->place[s->triangles[3 * t + k % 3]];
}

static int same_edge(const naive *n, const solid *s, uint32_t t, uint32_t k, uint32_t u, uint32_t j)
{
    uint32_t a = corner(n, s, t, k), b = corner(n, s, t, k + 1), c = corner(n, s, u, j),
             d = corner(n, s, u, j + 1);
    return (a == c && b == d) || (a == d && b == c);
}

static void naive_links(naive *n, const solid *s)
{
    uint32_t count = s->triangle_count;
    for (uint32_t t = 0; t < count; t++) {
        uint32_t a = corner(n, s, t, 0), b = corner(n, s, t, 1), c = corner(n, s, t, 2);
        n->proper[t] = a != b && b != c && c != a;
        for (int k = 0; k < 3; k++) n->link[t][k] = MW_NONE;
    }
    for (uint32_t t = 0; t < count; t++)
        for (uint32_t k = 0; k < 3 && n->proper[t]; k++) {
            uint32_t before = 0, first = 0;
            for (uint32_t u = 0; u < t; u++)
                for (uint32_t j = 0; j < 3 && n->proper[u]; j++)
                    if (same_edge(n, s, t, k, u, j) && before++ == 0) first = 4 * u + j;
            n->extra += before > 1;
            if (before != 1) continue;
            n->link[t][k] = first;
            n->link[first >> 2][first & 3] = 4 * t + k;
        }
}

static void naive_counts(naive *n, const solid *s)
{
    static uint32_t fan[4 * 256], loop[4 * 256], piece[256];
    uint8_t seen[256] = {0}, in_face[256] = {0};
    for (uint32_t i = 0; i < 4 * 256; i++) fan[i] = loop[i] = i;
    for (uint32_t v = 0; v < s->point_count; v++) piece[v] = v;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        n->euler += n->proper[t];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = corner(n, s, t, k), link = n->link[t][k];
            n->used += !seen[v];
            n->pieces += !seen[v];
            n->euler += !in_face[v] && n->proper[t];
            seen[v] = 1;
            in_face[v] |= n->proper[t];
            if (!n->proper[t]) continue;
            n->border += link == MW_NONE;
            n->euler -= link == MW_NONE || link >> 2 > t;
            if (link == MW_NONE) continue;
            uint32_t same_way = corner(n, s, link >> 2, link & 3) == v;
            n->clashing += same_way && link >> 2 > t;
            naive_join(fan, 4 * t + k, 4 * (link >> 2) + ((link & 3) + !same_way) % 3);
            naive_join(fan, 4 * t + (k + 1) % 3, 4 * (link >> 2) + ((link & 3) + same_way) % 3);
        }
    }
    n->loops = n->border;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++)
            n->pieces -= naive_join(piece, corner(n, s, t, k), corner(n, s, t, 0));
        for (uint32_t k = 0; k < 3 && n->proper[t]; k++)
            for (uint32_t other = 0; other < 4 * s->triangle_count && n->link[t][k] == MW_NONE;
                 other++) {
                if ((other & 3) == 3 || !n->proper[other >> 2] ||
                    n->link[other >> 2][other & 3] != MW_NONE)
                    continue;
                for (uint32_t end = 0; end < 4;
                     end++) /* border edges that end at the two sides of one fan */
                    if (naive_root(fan, 4 * t + (k + end % 2) % 3) ==
                        naive_root(fan, (other & ~3u) + ((other & 3) + end / 2) % 3))
                        n->loops -= naive_join(loop, 4 * t + k, other);
            }
    }
    for (uint32_t v = 0; v < s->point_count; v++) {
        uint32_t fans = 0;
        for (uint32_t i = 0; i < 4 * s->triangle_count; i++)
            fans +=
                (i & 3) < 3 && n->proper[i >> 2] && corner(n, s, i >> 2, i & 3) == v && fan[i] == i;
        n->pinched += fans > 1;
    }
}

static naive *count_naively(const solid *s, int weld)
{
    naive *n = calloc(1, sizeof *n);
    assert_true(n && s->point_count <= 256 && s->triangle_count <= 256);
    for (uint32_t v = 0; v < s->point_count; v++) {
        const double *p = s->points + 3 * v, *q = s->points;
        n->place[v] = 0;
        while (n->place[v] < v &&
               !(weld && p[0] == q[0] && p[1] == q[1] && p[2] == q[2] && mw__is_finite3(p))) {
            n->place[v]++;
            q += 3;
        }
    }
    naive_links(n, s);
    naive_counts(n, s);
    return n;
}

static void assert_links(const mw_surface *surface, const naive *n)
{
    for (uint32_t t = 0; t < mw_surface_triangle_count(surface); t++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned edge = 9;
            uint32_t other = mw_surface_neighbour(surface, t, k, &edge);
            assert_int_equal(other == MW_NONE ? MW_NONE : 4 * other + edge, n->link[t][k]);
            assert_int_equal(mw_surface_neighbour(surface, t, k, NULL), other);
        }
}

static void assert_counts(const mw_surface *surface, const solid *s, const naive *n)
{
    mw_surface_info info;
    assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
    uint32_t places = 0, proper = 0;
    for (uint32_t v = 0; v < s->point_count; v++) places += n->place[v] == v;
    for (uint32_t t = 0; t < s->triangle_count; t++) proper += n->proper[t];
    assert_int_equal(info.vertices, places);
    assert_int_equal(info.triangles, s->triangle_count);
    assert_int_equal(info.unused_vertices, places - n->used);
    assert_int_equal(info.border_edges, n->border);
    assert_int_equal(info.border_loops, n->loops);
    assert_int_equal(info.clashing_edges, n->clashing);
    assert_int_equal(info.pinched_vertices, n->pinched);
    assert_int_equal(info.components, n->pieces);
    assert_int_equal(info.euler, n->euler);
    assert_int_equal(info.closed, n->border == 0 && proper > 0);
    assert_int_equal(info.oriented, n->clashing == 0);
    assert_true(isnan(info.volume) || (info.closed && info.oriented));
}

static size_t count_kind(const mw_check *check, mw_defect_kind kind)
{
    size_t count = 0;
    for (size_t i = 0; i < check->defect_count; i++) count += check->defects[i].kind == kind;
    return count;
}

static void assert_checked(const solid *s, int weld, const naive *n)
{
    mw_arrays view = solid_view(s);
    mw_check check;
    assert_int_equal(mw_surface_check_arrays(&view, weld, NULL, &check, NULL), MW_OK);
    assert_int_equal(count_kind(&check, MW_DEFECT_NON_MANIFOLD_EDGE), n->extra);
    assert_int_equal(count_kind(&check, MW_DEFECT_CLASHING), n->clashing);
    assert_int_equal(check.valid, check.defect_count == count_kind(&check, MW_DEFECT_FLAT));
    for (size_t i = 1; i < check.defect_count; i++) {
        const mw_defect *p = &check.defects[i - 1], *q = &check.defects[i];
        assert_true(p->kind < q->kind || (p->kind == q->kind && p->triangle <= q->triangle));
    }
    for (size_t i = 0; i < check.defect_count; i++) {
        const mw_defect *d = &check.defects[i];
        if (d->kind == MW_DEFECT_CLASHING)
            assert_int_equal(n->link[d->triangle][d->edge], 4 * d->other + d->other_edge);
        if (d->kind == MW_DEFECT_NON_MANIFOLD_EDGE)
            assert_int_equal(n->link[d->triangle][d->edge], MW_NONE);
    }
    mw_surface *surface;
    mw_status status =
        mw_surface_create(&view, &(mw_surface_options){.weld = weld}, &surface, NULL);
    mw_surface_destroy(surface);
    int usable = count_kind(&check, MW_DEFECT_CLASHING) + count_kind(&check, MW_DEFECT_FLAT) ==
                 check.defect_count;
    assert_int_equal(status, usable ? MW_OK : MW_ERROR_INPUT);
    mw_check_release(&check);
}

static void test_random_soups(void **state)
{
    (void)state;
    const uint64_t seed = 20;
    uint64_t random = seed;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int round = 0; round < 600; round++) {
        uint32_t points = 3 + mw__random_below(&random, round % 3 ? 12 : 60),
                 triangles = 1 + mw__random_below(&random, 40);
        solid s = solid_soup(points, triangles, round % 2, &random);
        for (int weld = 0; weld < 2; weld++) {
            naive *n = count_naively(&s, weld);
            mw_surface *surface =
                solid_surface(&s, (mw_surface_options){.tolerant = 1, .weld = weld});
            assert_links(surface, n);
            assert_counts(surface, &s, n);
            assert_checked(&s, weld, n);
            for (uint32_t t = 0; t < triangles; t++) {
                uint32_t v[3];
                mw_surface_triangle(surface, t, v);
                assert_memory_equal(v, s.triangles + 3 * t, sizeof v);
            }
            mw_surface_destroy(surface);
            free(n);
        }
        solid_free(&s);
    }
}

/* --- from arrays ------------------------------------------------------------------------------ */

static void test_arrays(void **state)
{
    (void)state;
    const double points[] = {0, 0, 0, 7, 1, 0, 0, 7, 0, 1, 0, 7, 0, 0, 1};
    const uint32_t v[] = {2, 1, 0, 0, 1, 3};
    const int64_t wide[] = {2, 1, 0, 0, 1, 3};
    for (int type = 0; type < 3; type++) {
        mw_arrays a = {.points = points,
                       .point_count = 4,
                       .point_stride = 4,
                       .triangles = type == MW_INT64 ? (const void *)wide : v,
                       .triangle_count = 2,
                       .integer_type = (mw_integer_type)type};
        mw_surface *surface;
        assert_int_equal(mw_surface_create(&a, NULL, &surface, NULL), MW_OK);
        assert_int_equal(mw_surface_vertex_count(surface), 4);
        assert_int_equal(mw_surface_triangle_count(surface), 2);
        double p[3];
        mw_surface_vertex(surface, 3, p);
        assert_true(p[0] == 0 && p[1] == 0 && p[2] == 1);
        unsigned edge;
        assert_int_equal(mw_surface_neighbour(surface, 0, 1, &edge), 1);
        assert_int_equal(edge, 0);
        assert_int_equal(mw_surface_neighbour(surface, 0, 0, &edge), MW_NONE);
        assert_true(mw_surface_bytes(surface) >= 4 * 24 + 2 * 32);
        mw_surface_destroy(surface);
    }
    mw_surface_destroy(NULL);
}

static mw_error refused(mw_arrays a, mw_surface_options options, mw_status status)
{
    mw_surface *surface = (mw_surface *)&a;
    mw_error error;
    assert_int_equal(mw_surface_create(&a, &options, &surface, &error), status);
    assert_int_equal(error.status, status);
    assert_null(surface);
    return error;
}

static void test_arguments(void **state)
{
    (void)state;
    solid s = solid_box(0, 0, 0, 1, 0);
    mw_arrays good = solid_view(&s), a = good;
    mw_surface_options none = {0}, borrow = {.borrow = 1};
    mw_error error;
    assert_int_equal(mw_surface_create(&good, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_surface *surface;
    assert_int_equal(mw_surface_create(NULL, NULL, &surface, &error), MW_ERROR_ARGUMENT);
    a.points = NULL;
    refused(a, none, MW_ERROR_ARGUMENT);
    a = good;
    a.triangles = NULL;
    refused(a, none, MW_ERROR_ARGUMENT);
    a = good;
    a.integer_type = (mw_integer_type)3;
    refused(a, none, MW_ERROR_ARGUMENT);
    a = good;
    a.triangle_count = (size_t)MW_MAX_TRIANGLES + 1;
    refused(a, none, MW_ERROR_LIMIT);
    a = good;
    a.point_count = (size_t)MW_MAX_VERTICES + 1;
    refused(a, none, MW_ERROR_LIMIT);
    a = good;
    a.point_stride = 1;
    error = refused(a, none, MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "a point stride of 1 leaves no room for y");
    a.point_stride = 2;
    error = refused(a, none, MW_ERROR_ARGUMENT);
    assert_string_equal(error.message, "a point stride of 2 leaves no room for z");
    a.point_stride = 4;
    refused(a, borrow, MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_describe(NULL, NULL, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_surface_check_arrays(&good, 0, NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_check check;
    assert_int_equal(mw_surface_check_arrays(&a, 0, NULL, &check, &error), MW_OK);
    mw_check_release(&check);
    assert_int_equal(mw_surface_check_arrays(NULL, 0, NULL, &check, &error), MW_ERROR_ARGUMENT);
    solid_free(&s);
}

static void test_defects_are_named(void **state)
{
    (void)state;
    solid s = solid_box(0, 0, 0, 1, 0);
    mw_error error;
    s.triangles[7] = 8;
    error = refused(solid_view(&s), (mw_surface_options){0}, MW_ERROR_INPUT);
    assert_string_equal(error.message,
                        "triangle 2: vertex 8 does not exist; there are 8, numbered from 0");
    assert_int_equal(error.triangle, 2);
    error = refused(solid_view(&s), (mw_surface_options){.tolerant = 1}, MW_ERROR_INPUT);
    s.triangles[7] = 4;
    error = refused(solid_view(&s), (mw_surface_options){0}, MW_ERROR_INPUT);
    assert_string_equal(error.message, "triangle 2: vertex 4 is in it twice");
    assert_true(error.triangle == 2 && error.vertex == 4);
    s.triangles[7] = 5;
    s.points[3 * 3 + 2] = INFINITY; /* z of vertex 3 */
    error = refused(solid_view(&s), (mw_surface_options){0}, MW_ERROR_INPUT);
    assert_string_equal(error.message, "triangle 1: vertex 3 is not finite");
    assert_true(error.triangle == 1 && error.vertex == 3);
    s.points[3 * 3 + 2] = 0;
    s.triangles[3 * 11] = 6; /* 6 7 5: there are two at edge 5 7 and two at 6 7 */
    error = refused(solid_view(&s), (mw_surface_options){0}, MW_ERROR_INPUT);
    assert_true(error.triangle == 11);
    assert_non_null(strstr(error.message, "triangle 11: two others share its edge"));
    solid_free(&s);
}

/* A defect of welded vertices names the user's. */
static void test_shared_by_place(void **state)
{
    (void)state;
    solid s = solid_make(9, 3);
    for (uint32_t t = 0; t < 3; t++) {
        solid_point(&s, 0, 0, 0);
        solid_point(&s, 1, 0, 0);
        solid_point(&s, 0, t, 1);
        solid_triangle(&s, 3 * t, 3 * t + 1, 3 * t + 2);
    }
    mw_surface_destroy(solid_surface(&s, (mw_surface_options){0}));
    mw_error error = refused(solid_view(&s), (mw_surface_options){.weld = 1}, MW_ERROR_INPUT);
    assert_string_equal(error.message,
                        "triangle 2: two others share its edge 0, from vertex 6 to 7");
    solid_free(&s);
}

static void test_weld(void **state)
{
    (void)state;
    solid whole = solid_box(0, -1, -1, 1, 0), soup = solid_box(0, -1, -1, 1, 1);
    mw_surface *one = solid_surface(&whole, (mw_surface_options){0});
    mw_surface *other = solid_surface(&soup, (mw_surface_options){.weld = 1});
    for (uint32_t t = 0; t < 12; t++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned e = 7, f = 8;
            assert_int_equal(mw_surface_neighbour(one, t, k, &e),
                             mw_surface_neighbour(other, t, k, &f));
            assert_int_equal(e, f);
            assert_true(mw__surface_orientations_agree(one, t, k) &&
                        mw__surface_orientations_agree(other, t, k));
        }
    mw_surface_info info;
    assert_int_equal(mw_surface_describe(other, &info, NULL), MW_OK);
    assert_true(info.vertices == 8 && info.closed && info.oriented && info.euler == 2 &&
                info.components == 1);
    assert_true(info.volume == 1 && info.area == 6);
    mw_surface_destroy(other);
    /* A sliver between two triangles, whose ends fell on one place: they are neighbours. */
    solid flat = solid_make(9, 3);
    const double p[9][3] = {{0, 0, 0},    {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0},
                            {0, 0, -0.0}, {1, 0, 0}, {0, 0, 0}, {0, -1, 0}};
    for (int i = 0; i < 9; i++) solid_point(&flat, p[i][0], p[i][1], p[i][2]);
    for (uint32_t t = 0; t < 3; t++) solid_triangle(&flat, 3 * t, 3 * t + 1, 3 * t + 2);
    other = solid_surface(&flat, (mw_surface_options){.weld = 1});
    assert_int_equal(mw_surface_neighbour(other, 0, 0, NULL), 2);
    for (unsigned k = 0; k < 3; k++)
        assert_int_equal(mw_surface_neighbour(other, 1, k, NULL), MW_NONE);
    assert_int_equal(mw_surface_describe(other, &info, NULL), MW_OK);
    assert_true(info.flat_triangles == 1 && info.border_edges == 4 && info.border_loops == 1 &&
                info.euler == 1);
    mw_surface_destroy(other);
    mw_surface_destroy(one);
    solid_free(&flat);
    solid_free(&soup);
    solid_free(&whole);
}

/* --- change ----------------------------------------------------------------------------------- */

static void test_update(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        solid s = solid_box(0, 0, 0, 1, 0);
        mw_surface *surface =
            solid_surface(&s, (mw_surface_options){.borrow = kind & 1, .shared = kind >> 1});
        assert_int_equal(mw_surface_points(surface) == s.points, kind & 1);
        uint64_t version = surface->version;
        mw_surface_begin_update(surface);
        for (int i = 0; i < 24; i++) mw_surface_points(surface)[i] *= 2;
        mw_surface_end_update(surface);
        assert_true(surface->version == version + 1);
        mw_surface_info info;
        assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
        assert_true(info.volume == 8 && info.area == 24);
        mw_surface_begin_update(surface);
        mw_surface_points(surface)[5] = NAN;
        mw_surface_end_update(surface);
        assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
        assert_true(isnan(info.volume) && isfinite(info.area) && info.flat_triangles > 0 &&
                    info.closed);
        mw_surface_destroy(surface);
        solid_free(&s);
    }
}

/* Does a triangle have both vertices (places)? */
static int naively_joined(const naive *n, const solid *s, uint32_t c, uint32_t d)
{
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        int found = 0;
        for (uint32_t k = 0; k < 3; k++)
            found |= (corner(n, s, t, k) == c) | (corner(n, s, t, k) == d) << 1;
        if (found == 3) return 1;
    }
    return c == d;
}

/* Flips at random, each beside a surface made anew of the flipped triangles. */
static void flip_about(solid *s, int weld, uint64_t *random)
{
    mw_surface *surface = solid_surface(s, (mw_surface_options){.weld = weld});
    mw_error error;
    uint32_t flips = 0, refusals = 0;
    mw_surface_begin_update(surface);
    for (int i = 0; i < 400; i++) {
        uint32_t t = mw__random_below(random, s->triangle_count), k = mw__random_below(random, 3),
                 v[3];
        naive *n = count_naively(s, weld);
        uint32_t link = n->link[t][k], u = link >> 2, j = link & 3, *tv = s->triangles + 3 * t;
        int possible = link != MW_NONE && corner(n, s, u, j) == corner(n, s, t, k + 1) &&
                       !naively_joined(n, s, corner(n, s, t, k + 2), corner(n, s, u, j + 2));
        free(n);
        mw_status status = mw_surface_flip(surface, t, k, &error);
        assert_int_equal(status, possible ? MW_OK : MW_ERROR_INPUT);
        if (!possible) assert_int_equal(error.triangle, t);
        if (possible) {
            uint32_t *uv = s->triangles + 3 * u, c = tv[(k + 2) % 3], d = uv[(j + 2) % 3];
            tv[k] = d;
            uv[j] = c;
        }
        if (possible)
            flips++;
        else
            refusals++;
        for (uint32_t w = 0; w < s->triangle_count; w++) {
            mw_surface_triangle(surface, w, v);
            assert_memory_equal(v, s->triangles + 3 * w, sizeof v);
            assert_int_equal(surface->tri[w].v[3], v[0]);
        }
        n = count_naively(s, weld);
        assert_links(surface, n);
        free(n);
    }
    mw_surface_end_update(surface);
    assert_true(flips > 20 && refusals > 20);
    mw_surface_destroy(surface);
}

static void test_flips(void **state)
{
    (void)state;
    const uint64_t seed = 7;
    uint64_t random = seed;
    print_message("seed %llu\n", (unsigned long long)seed);
    for (int kind = 0; kind < 3; kind++) { /* 0: closed, 1: open and with clashes, 2: welded */
        solid s = kind == 2 ? solid_box(0, 0, 0, 1, 1) : solid_sphere(1, &random);
        if (kind == 1) {
            /* the last face: 7 and 29 to 31 */
            memcpy(s.triangles + 21, s.triangles + 84, 3 * sizeof *s.triangles);
            s.triangle_count = 28;
            for (uint32_t t = 0; t < 4; t++) {
                uint32_t *v = s.triangles + 21 * t, first = v[0];
                v[0] = v[1];
                v[1] = first;
            }
        }
        flip_about(&s, kind == 2, &random);
        solid_free(&s);
    }
}

static void test_flips_refused(void **state)
{
    (void)state;
    mw_error error;
    solid s = solid_make(4, 4);
    for (int i = 0; i < 4; i++) solid_point(&s, i == 1, i == 2, i == 3);
    solid_triangle(&s, 0, 2, 1);
    solid_triangle(&s, 0, 1, 3);
    mw_surface *surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_flip(surface, 0, 0, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message, "triangle 0: edge 0 has no neighbour");
    mw_surface_destroy(surface);
    s.triangles[4] = 3;
    s.triangles[5] = 1;
    surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_flip(surface, 0, 2, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message,
                        "triangle 0: its neighbour at edge 2 is oriented differently");
    mw_surface_destroy(surface);
    s.triangles[4] = 1; /* two sides of one triangle */
    s.triangles[5] = 2;
    surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_flip(surface, 0, 0, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "triangle 0: vertices 1 and 1 are the same"));
    mw_surface_destroy(surface);
    s.triangles[5] = 3;
    solid_triangle(&s, 0, 3, 2);
    solid_triangle(&s, 1, 2, 3);
    surface = solid_surface(&s, (mw_surface_options){0}); /* a tetrahedron: all are joined */
    for (uint32_t t = 0; t < 4; t++)
        for (unsigned k = 0; k < 3; k++)
            assert_int_equal(mw_surface_flip(surface, t, k, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "joined already"));
    mw_surface_destroy(surface);
    solid_free(&s);
}

/* --- geometry --------------------------------------------------------------------------------- */

static void test_collinear(void **state)
{
    (void)state;
    const double o[3] = {0, 0, 0}, a[3] = {0.1, 0.2, 0.4}, b[3] = {0.2, 0.4, 0.8},
                 c[3] = {1e300, 2e300, 4e300};
    assert_true(mw__collinear3(o, a, b) && mw__collinear3(a, b, a) && mw__collinear3(a, a, a));
    assert_true(mw__collinear3(o, a, c));
    const double d[3] = {1, 2, 4}, e[3] = {0x1p900, 0x1p901, 0x1p902},
                 f[3] = {0x1p-900, 0x1p-899, 0x1p-898};
    assert_true(mw__collinear3(o, d, e) && mw__collinear3(f, d, o) && mw__collinear3(e, f, o));
    for (int k = 0; k < 3; k++) { /* a rounding beside the line, in each direction */
        for (int way = -1; way < 2; way += 2) {
            double beside[3] = {d[0], d[1], d[2]};
            beside[k] = nextafter(d[k], way < 0 ? -INFINITY : INFINITY);
            assert_false(mw__collinear3(o, beside, e));
            assert_false(mw__collinear3(beside, a, b));
        }
    }
    for (int k = 0; k < 3; k++) { /* along an axis, and in a plane of two */
        double p[3] = {0}, q[3] = {0};
        p[k] = 0.1;
        q[k] = 0.3;
        assert_true(mw__collinear3(o, p, q));
        q[(k + 1) % 3] = 5e-324;
        assert_false(mw__collinear3(o, p, q));
    }
}

static void test_measures(void **state)
{
    (void)state;
    const uint64_t seed = 3;
    uint64_t random = seed;
    mw_surface_info info;
    solid s = solid_box(1e8, -1e8, 1e8, 0.5, 0); /* small and far away */
    mw_surface *surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
    assert_true(info.volume == 0.125 && info.area == 1.5);
    assert_true(info.low[0] == 1e8 && info.low[1] == -1e8 && info.high[2] == 1e8 + 0.5);
    mw_surface_destroy(surface);
    for (uint32_t t = 0; t < 12; t++) { /* turned inside out */
        uint32_t v = s.triangles[3 * t];
        s.triangles[3 * t] = s.triangles[3 * t + 2];
        s.triangles[3 * t + 2] = v;
    }
    surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
    assert_true(info.volume == -0.125);
    mw_surface_destroy(surface);
    solid_free(&s);
    s = solid_sphere(3, &random);
    surface = solid_surface(&s, (mw_surface_options){0});
    assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
    assert_true(fabs(info.volume / 4.18879 - 1) < 0.03 && fabs(info.area / 12.56637 - 1) < 0.02);
    assert_true(info.euler == 2 && info.closed && info.oriented && info.flat_triangles == 0);
    mw_surface_destroy(surface);
    solid_free(&s);
}

static void test_empty(void **state)
{
    (void)state;
    mw_arrays nothing = {0};
    mw_surface *surface;
    mw_surface_info info;
    mw_check check;
    for (int weld = 0; weld < 2; weld++) {
        assert_int_equal(
            mw_surface_create(&nothing, &(mw_surface_options){.weld = weld}, &surface, NULL),
            MW_OK);
        assert_int_equal(mw_surface_describe(surface, &info, NULL), MW_OK);
        assert_true(!info.closed && info.oriented && info.euler == 0 && info.components == 0 &&
                    info.area == 0);
        assert_true(isnan(info.low[2]) && isnan(info.high[0]) && isnan(info.volume));
        mw_surface_destroy(surface);
        assert_int_equal(mw_surface_check_arrays(&nothing, weld, NULL, &check, NULL), MW_OK);
        assert_true(check.valid && check.defect_count == 0);
        mw_check_release(&check);
    }
    /* a triangle, but no vertices */
    mw_arrays loose = {.triangles = cube_triangles, .triangle_count = 1};
    assert_int_equal(mw_surface_check_arrays(&loose, 0, NULL, &check, NULL), MW_OK);
    assert_true(!check.valid && check.defect_count == 3 &&
                check.defects[2].kind == MW_DEFECT_MISSING_VERTEX);
    mw_check_release(&check);
}

/* One of each kind, in one list. */
static void test_every_defect(void **state)
{
    (void)state;
    solid s = solid_make(12, 9);
    for (uint32_t i = 0; i < 12; i++) solid_point(&s, i, i * i, i % 4);
    s.points[3 * 11 + 1] = NAN;
    solid_triangle(&s, 0, 1, 2);
    solid_triangle(&s, 1, 2, 3); /* 1: clashes with 0 along 1 2 */
    solid_triangle(&s, 2, 1, 4); /* 2: the third there */
    solid_triangle(&s, 5, 5, 6);
    solid_triangle(&s, 7, 11, 8);
    solid_triangle(&s, 9, 99, 10);
    solid_triangle(&s, 6, 7, 8);
    /* 6: flat */
    for (int c = 0; c < 3; c++) s.points[3 * 8 + c] = 2 * s.points[3 * 7 + c] - s.points[3 * 6 + c];
    mw_arrays view = solid_view(&s);
    mw_check check;
    assert_int_equal(mw_surface_check_arrays(&view, 0, NULL, &check, NULL), MW_OK);
    static const mw_defect expected[] = {{MW_DEFECT_MISSING_VERTEX, 5, MW_NONE, 99, 255, 255},
                                         {MW_DEFECT_NOT_FINITE, 4, MW_NONE, 11, 255, 255},
                                         {MW_DEFECT_REPEATED_VERTEX, 3, MW_NONE, 5, 255, 255},
                                         {MW_DEFECT_NON_MANIFOLD_EDGE, 2, 0, MW_NONE, 0, 255},
                                         {MW_DEFECT_FLAT, 6, MW_NONE, MW_NONE, 255, 255},
                                         {MW_DEFECT_CLASHING, 0, 1, MW_NONE, 1, 0}};
    assert_int_equal(check.defect_count, 6);
    assert_false(check.valid);
    for (size_t i = 0; i < 6; i++) {
        const mw_defect *d = &check.defects[i], *e = &expected[i];
        assert_int_equal(d->kind, e->kind);
        assert_true(d->triangle == e->triangle && d->other == e->other && d->vertex == e->vertex);
        assert_true(d->edge == e->edge && d->other_edge == e->other_edge);
    }
    mw_check_release(&check);
    solid_free(&s);
}

/* --- out of memory ---------------------------------------------------------------------------- */

typedef mw_status surface_job(const mw_arrays *view, mw_error *error);

static mw_status describe_job(const mw_arrays *view, mw_error *error)
{
    mw_surface *surface;
    mw_surface_info info;
    mw_status status = mw_surface_create(
        view, &(mw_surface_options){.tolerant = 1, .weld = 1, .shared = 1}, &surface, error);
    if (!status) status = mw_surface_describe(surface, &info, error);
    mw_surface_destroy(surface);
    return status;
}

static mw_status check_job(const mw_arrays *view, mw_error *error)
{
    mw_check check;
    mw_status status = mw_surface_check_arrays(view, 1, NULL, &check, error);
    mw_check_release(&check);
    return status;
}

/* Let allocation 0, 1, 2, ... of the job fail until it gets through. */
static long exhaust(surface_job *run, const mw_arrays *view)
{
    for (long failures = 0;; failures++) {
        mw_error error = {0};
        allocations_left = failures;
        mw_status status = run(view, &error);
        int failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        if (!failed) return failures;
        assert_string_equal(error.message, "out of memory");
    }
}

static void test_memory(void **state)
{
    (void)state;
    uint64_t random = 5;
    solid s = solid_box(0, 0, 0, 1, 1), t = solid_soup(20, 60, 1, &random);
    mw_arrays sound = solid_view(&s), damaged = solid_view(&t);
    assert_int_equal(exhaust(describe_job, &sound), 12);
    assert_true(exhaust(check_job, &sound) > 6);
    assert_true(exhaust(check_job, &damaged) > 16);
    t.triangles[5] = 1000;
    assert_true(exhaust(check_job, &damaged) > 16);
    solid_free(&s);
    solid_free(&t);
}

/* --- real surfaces: counts that others counted ------------------------------------------------ */

static const struct {
    const char *name;
    uint32_t vertices, triangles, border, loops, components;
    int euler;
    uint32_t unused, pinched, clashing;
} real[] = {
    {"surface/pawn.obj", 154, 304, 0, 0, 1, 2, 0, 0, 0},
    {"surface/triceratops.off.gz", 2832, 5660, 0, 0, 1, 2, 0, 0, 0},
    {"surface/cow.off.gz", 2904, 5804, 0, 0, 1, 2, 0, 0, 0},
    {"surface/fandisk.off.gz", 6475, 12946, 0, 0, 1, 2, 0, 0, 0},
    {"surface/gargoyle.off.gz", 10002, 20000, 0, 0, 1, 2, 0, 0, 0},
    {"surface/venus_remesh.off.gz", 8671, 17338, 0, 0, 1, 2, 0, 0, 0},
    {"surface/mannequin.off.gz", 11703, 23402, 0, 0, 1, 2, 0, 0, 0},
    {"surface/dinosaur.off.gz", 14050, 28096, 0, 0, 1, 2, 0, 0, 0},
    {"surface/horse.off.gz", 19851, 39698, 0, 0, 1, 2, 0, 0, 0},
    {"surface/skull.off.gz", 20002, 40000, 0, 0, 1, 2, 0, 0, 0},
    {"surface/bunny_closed.off.gz", 34835, 69666, 0, 0, 1, 2, 0, 0, 0},
    {"surface/bunny_zipper.ply.gz", 35947, 69451, 223, 5, 1, -3, 1113, 0, 0},
    {"surface/armadillo.off.gz", 26002, 52000, 0, 0, 1, 2, 0, 0, 0},
    {"surface/venus_100k.off.gz", 50002, 100000, 0, 0, 1, 2, 0, 0, 0},
    {"surface/igea.ply.gz", 134345, 268686, 0, 0, 1, 2, 0, 0, 0},
    {"surface/lucy_low.ply.gz", 49987, 99970, 0, 0, 1, 2, 0, 0, 0},
    {"surface/elephant.off.gz", 2775, 5558, 0, 0, 1, -4, 0, 0, 0},
    {"surface/anchor_dense.off.gz", 3793, 7598, 0, 0, 1, -6, 0, 0, 0},
    {"surface/turbine.off.gz", 9210, 18460, 0, 0, 1, -20, 0, 0, 0},
    {"surface/cheese.off.gz", 8629, 17786, 0, 0, 1, -264, 0, 0, 0},
    {"surface/knot2.off.gz", 5760, 11520, 0, 0, 2, 0, 0, 0, 0},
    {"surface/bones.off.gz", 2154, 4204, 0, 0, 26, 52, 0, 0, 0},
    {"surface/lion_head.off.gz", 8356, 16674, 36, 1, 1, 1, 0, 0, 0},
    {"surface/shark_holes.off.gz", 5246, 10192, 304, 4, 1, -2, 0, 0, 0},
    {"surface/plate_holes.stl", 618, 1252, 0, 0, 1, -8, 0, 0, 0},
    {"surface/rabbit.obj", 644, 1252, 0, 0, 9, 18, 0, 0, 0},
    {"star/eros_7790.obj.gz", 3897, 7790, 0, 0, 1, 2, 0, 0, 0},
    {"star/psyche.obj", 1148, 2292, 0, 0, 1, 2, 0, 0, 0},
    {"star/kw4_alpha.obj.gz", 4586, 9168, 0, 0, 1, 2, 0, 0, 0},
    {"star/sphere_1620.off", 812, 1620, 0, 0, 1, 2, 0, 0, 0},
    {"star/geosphere.off", 162, 320, 0, 0, 1, 2, 0, 0, 0},
    {"star/ellipsoid.off", 162, 320, 0, 0, 1, 2, 0, 0, 0},
    {"star/star.off", 14, 24, 0, 0, 1, 2, 0, 0, 0},
    {"star/tripod.off", 24, 44, 0, 0, 1, 2, 0, 0, 0},
    {"star/sphere_1280.obj", 642, 1280, 0, 0, 1, 2, 0, 0, 0},
    {"star/brain_pial_left.off.gz", 10242, 20480, 0, 0, 1, 2, 0, 0, 0},
    {"star/brain_sphere_left.off.gz", 10242, 20480, 0, 0, 1, 2, 0, 0, 0},
    {"bad/crlf_header.ply", 8, 12, 0, 0, 1, 2, 0, 0, 0},
    {"bad/busted.stl.gz", 1941, 3878, 0, 0, 1, 2, 0, 0, 0},
    {"bad/soup.stl", 300, 100, 300, 100, 100, 100, 0, 0, 0},
    {"bad/hourglass_ico.obj", 23, 40, 0, 0, 1, 3, 0, 1, 0},
    {"bad/moebius.obj", 280, 448, 112, 1, 1, 0, 0, 0, 4},
    {"bad/blobby_shuffled.off.gz", 2027, 4050, 0, 0, 1, 2, 0, 0, 3069},
    {"bad/tet_shuffled.off", 4, 4, 0, 0, 1, 2, 0, 0, 4},
    {"bad/degtri_sliding.off", 8, 8, 6, 1, 1, 1, 0, 0, 0},
    {"bad/boeing.off", 2741, 2564, 2714, 142, 122, 102, 0, 0, 0},
    {"bad/polygon_mesh.off.gz", 16344, 32245, 489, 14, 1, -23, 0, 2, 0},
    {"bad/tetra_intersected_by_triangle.off", 7, 5, 3, 1, 2, 3, 0, 0, 0},
    {"bad/non_manif_hole.ply", 432, 755, 119, 2, 1, -5, 0, 5, 0},
    /* of the loops some meet at a vertex */
    {"bad/brain_pieces.ply.gz", 18844, 36752, 920, 16, 14, 8, 0, 4, 0},
};

static void test_real(void **state)
{
    (void)state;
    if (!files_shared("README.md")) skip();
    for (size_t i = 0; i < sizeof real / sizeof *real; i++) {
        mw_mesh_file file;
        mw_surface *surface;
        mw_surface_info info;
        mw_check check;
        mw_error error;
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, real[i].name);
        expect_ok(mw_read_mesh(path, NULL, &file, &error), path, &error);
        mw_arrays view = mw_mesh_file_arrays(&file);
        expect_ok(mw_surface_create(&view, &(mw_surface_options){.borrow = 1}, &surface, &error),
                  path, &error);
        expect_ok(mw_surface_describe(surface, &info, &error), path, &error);
        expect_ok(mw_surface_check_arrays(&view, 0, NULL, &check, &error), path, &error);
        if (info.vertices != real[i].vertices || info.triangles != real[i].triangles ||
            info.border_edges != real[i].border || info.border_loops != real[i].loops ||
            info.components != real[i].components || info.euler != real[i].euler ||
            info.unused_vertices != real[i].unused || info.pinched_vertices != real[i].pinched ||
            info.clashing_edges != real[i].clashing)
            fail_msg("%s: %u vertices, %u triangles, %u border edges in %u loops, %u components, "
                     "chi %lld, "
                     "%u unused, %u pinched, %u clashing",
                     path, info.vertices, info.triangles, info.border_edges, info.border_loops,
                     info.components, (long long)info.euler, info.unused_vertices,
                     info.pinched_vertices, info.clashing_edges);
        assert_int_equal(info.closed, real[i].border == 0);
        assert_int_equal(count_kind(&check, MW_DEFECT_CLASHING), real[i].clashing);
        assert_int_equal(count_kind(&check, MW_DEFECT_FLAT), info.flat_triangles);
        assert_int_equal(check.defect_count, real[i].clashing + info.flat_triangles);
        assert_int_equal(check.valid, real[i].clashing == 0);
        mw_check_release(&check);
        mw_surface_destroy(surface);
        mw_mesh_file_release(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arrays),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_defects_are_named),
        cmocka_unit_test(test_shared_by_place),
        cmocka_unit_test(test_weld),
        cmocka_unit_test(test_random_soups),
        cmocka_unit_test(test_update),
        cmocka_unit_test(test_flips),
        cmocka_unit_test(test_flips_refused),
        cmocka_unit_test(test_collinear),
        cmocka_unit_test(test_measures),
        cmocka_unit_test(test_empty),
        cmocka_unit_test(test_every_defect),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_real),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
