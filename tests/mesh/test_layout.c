/* test_layout.c - a mesh laid out along a curve, or not, is the mesh of the arrays, for any number
 * of threads. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "mesh/point_order.h"
#include "mesh/mesh.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A grid of squares, each cut in two, some taken out or turned, in random order; the mesh comes in
 * several parts. */
typedef struct layout_scene {
    double *points;
    uint32_t *triangles, point_count, triangle_count;
} layout_scene;

static void shuffle(uint32_t *order, uint32_t n, uint64_t *random)
{
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    for (uint32_t i = n; i > 1; i--) {
        uint32_t j = mw__random_below(random, i), old = order[i - 1];
        order[i - 1] = order[j];
        order[j] = old;
    }
}

static layout_scene make_scene(uint32_t side, uint64_t seed)
{
    uint64_t random = mw__random_seed(seed, 0);
    layout_scene s = {.point_count = side * side};
    s.points = malloc(2 * (size_t)s.point_count * sizeof *s.points);
    s.triangles = malloc(6 * (size_t)s.point_count * sizeof *s.triangles);
    uint32_t *name = malloc(s.point_count * sizeof *name),
             *order = malloc(2 * (size_t)s.point_count * sizeof *order);
    shuffle(name, s.point_count, &random);
    for (uint32_t i = 0; i < s.point_count; i++) {
        s.points[2 * (size_t)name[i]] = i % side;
        s.points[2 * (size_t)name[i] + 1] = i / side;
    }
    uint32_t squares = (side - 1) * (side - 1);
    shuffle(order, 2 * squares, &random);
    for (uint32_t i = 0; i < 2 * squares; i++) {
        uint32_t at = order[i] / 2, low = at / (side - 1) * side + at % (side - 1),
                 odd = order[i] % 2;
        if (mw__random_below(&random, 10) == 0) continue;
        uint32_t v[3] = {low, odd ? low + side + 1 : low + 1, odd ? low + side : low + side + 1};
        uint32_t turn = mw__random_below(&random, 6);
        for (uint32_t k = 0; k < 3; k++)
            s.triangles[3 * (size_t)s.triangle_count + k] =
                name[v[turn < 3 ? (k + turn) % 3 : (5 + turn - k) % 3]];
        s.triangle_count++;
    }
    free(name);
    free(order);
    return s;
}

static void release(layout_scene *s)
{
    free(s->points);
    free(s->triangles);
}

static mw_status create(const layout_scene *s, mw_mesh_layout layout, uint32_t threads,
                        mw_mesh **mesh, mw_error *error)
{
    mw_arrays view = {.points = s->points,
                      .point_count = s->point_count,
                      .triangles = s->triangles,
                      .triangle_count = s->triangle_count};
    return mw_mesh_create(&view, &(mw_mesh_options){.layout = layout, .threads = threads}, mesh,
                          error);
}

static void expect_same(const mw_mesh *a, const mw_mesh *b)
{
    assert_int_equal(mw_mesh_vertex_count(a), mw_mesh_vertex_count(b));
    assert_int_equal(mw_mesh_triangle_count(a), mw_mesh_triangle_count(b));
    for (uint32_t v = 0; v < mw_mesh_vertex_count(a); v++) {
        double p[2], q[2];
        mw_mesh_vertex(a, v, p);
        mw_mesh_vertex(b, v, q);
        assert_memory_equal(p, q, sizeof p);
    }
    for (uint32_t t = 0; t < mw_mesh_triangle_count(a); t++) {
        uint32_t u[3], v[3];
        mw_mesh_triangle(a, t, u);
        mw_mesh_triangle(b, t, v);
        assert_memory_equal(u, v, sizeof u);
        for (unsigned k = 0; k < 3; k++) {
            unsigned i = 7, j = 7;
            assert_int_equal(mw_mesh_neighbour(a, t, k, &i), mw_mesh_neighbour(b, t, k, &j));
            assert_int_equal(i, j);
        }
    }
    assert_int_equal(a->flat_count, b->flat_count);
    assert_int_equal(a->reversed_count, b->reversed_count);
}

/* Triangles and vertices at their places: each once, as by number. */
static void expect_stored(const mw_mesh *mesh)
{
    const uint32_t n = mw_mesh_vertex_count(mesh), count = mw_mesh_triangle_count(mesh);
    uint32_t *vertices = malloc(n * sizeof *vertices), *seen = calloc(n + count, sizeof *seen);
    double *points = malloc(2 * (size_t)n * sizeof *points), p[2];
    mw_mesh_stored_vertices(mesh, 0, n / 2, points, vertices);
    mw_mesh_stored_vertices(mesh, n / 2, n - n / 2, points + 2 * (size_t)(n / 2), vertices + n / 2);
    for (uint32_t i = 0; i < n; i++) {
        mw_mesh_vertex(mesh, vertices[i], p);
        assert_memory_equal(p, points + 2 * (size_t)i, sizeof p);
        assert_int_equal(seen[vertices[i]]++, 0);
    }
    for (uint32_t t = 0; t < count; t++) {
        uint32_t corner[3], number, v[3];
        mw_mesh_stored_triangles(mesh, t, 1, corner, &number);
        mw_mesh_triangle(mesh, number, v);
        for (int k = 0; k < 3; k++) assert_int_equal(vertices[corner[k]], v[k]);
        assert_int_equal(seen[n + number]++, 0);
    }
    mw_mesh_stored_vertices(mesh, 0, n, points, NULL);
    mw_mesh_stored_triangles(mesh, 0, count / 3, seen, NULL);
    for (uint32_t t = 0; t < count / 3; t++) {
        uint32_t corner[3];
        mw_mesh_stored_triangles(mesh, t, 1, corner, NULL);
        assert_memory_equal(corner, seen + 3 * (size_t)t, sizeof corner);
    }
    free(vertices);
    free(points);
    free(seen);
}

/* What the mesh tells of its edges is so. */
static void expect_true_count(const mw_mesh *mesh)
{
    uint32_t border = 0;
    for (uint32_t t = 0; t < mesh->tri_count && mesh->opposite; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const mw_triangle *tri = &mesh->tri[t];
            border += tri->link[k] == MW_NONE;
            if (tri->link[k] == MW_NONE) continue;
            const mw_triangle *other = &mesh->tri[mw__link_triangle(tri->link[k])];
            assert_int_equal(other->v[mw__link_edge(tri->link[k])], tri->v[k + 1]);
        }
    if (mesh->opposite) assert_int_equal(mesh->border_count, border);
}

/* Neighbours in the plane are neighbours in memory: few links lead far. */
static void expect_local(const mw_mesh *mesh)
{
    uint32_t far = 0, links = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            if (mesh->tri[t].link[k] == MW_NONE) continue;
            uint32_t other = mw__link_triangle(mesh->tri[t].link[k]);
            links++;
            far += (other > t ? other - t : t - other) > 4096;
        }
    assert_true(far < links / 20);
}

static void test_same_mesh_threads(void **state)
{
    (void)state;
    layout_scene s = make_scene(300, 1);
    mw_mesh *kept, *laid;
    assert_int_equal(create(&s, MW_LAYOUT_AS_GIVEN, 1, &kept, NULL), MW_OK);
    assert_null(kept->vertex_slot);
    for (uint32_t threads = 0; threads < 8; threads++)
        for (mw_mesh_layout layout = MW_LAYOUT_AUTO; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
            assert_int_equal(create(&s, layout, threads, &laid, NULL), MW_OK);
            assert_true((laid->vertex_slot != NULL) == (layout != MW_LAYOUT_AS_GIVEN));
            expect_same(kept, laid);
            if (threads == 1) expect_stored(laid);
            if (layout != MW_LAYOUT_AS_GIVEN) expect_local(laid);
            assert_true(laid->opposite);
            expect_true_count(laid);
            mw_mesh_destroy(laid);
        }
    mw_mesh_destroy(kept);
    release(&s);
}

static void expect_same_linked(const layout_scene *s)
{
    mw_mesh *kept, *laid;
    assert_int_equal(create(s, MW_LAYOUT_AS_GIVEN, 1, &kept, NULL), MW_OK);
    for (uint32_t threads = 1; threads < 4; threads++)
        for (mw_mesh_layout layout = MW_LAYOUT_HILBERT; layout <= MW_LAYOUT_AS_GIVEN; layout++) {
            assert_int_equal(create(s, layout, threads, &laid, NULL), MW_OK);
            expect_same(kept, laid);
            expect_true_count(laid);
            assert_int_equal(kept->opposite, laid->opposite);
            mw_mesh_destroy(laid);
        }
    expect_true_count(kept);
    mw_mesh_destroy(kept);
}

/* Vertices at wrong places: triangles are folded over others, some without an area. */
static void test_folded_threads(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (uint32_t share = 1; share <= 1000; share *= 10) {
        layout_scene s = make_scene(120, share);
        for (uint32_t i = 0; i < s.point_count; i++)
            if (mw__random_below(&random, share) == 0)
                s.points[2 * (size_t)i] = mw__random_below(&random, 120);
        expect_same_linked(&s);
        release(&s);
    }
}

/* Triangles that share no vertex, and one vertex that all share, without an edge between. */
static void test_loose_threads(void **state)
{
    (void)state;
    enum { TRIANGLES = 20000 };
    uint64_t random = 5;
    for (int hub = 0; hub < 2; hub++) {
        layout_scene s = {.point_count = 3 * TRIANGLES, .triangle_count = TRIANGLES};
        s.points = malloc(2 * (size_t)s.point_count * sizeof *s.points);
        s.triangles = malloc(3 * (size_t)TRIANGLES * sizeof *s.triangles);
        for (uint32_t i = 0; i < 2 * s.point_count; i++) s.points[i] = random_unit(&random);
        shuffle(s.triangles, s.point_count, &random);
        for (uint32_t t = 1; t < TRIANGLES && hub; t++) s.triangles[3 * (size_t)t] = s.triangles[0];
        expect_same_linked(&s);
        release(&s);
    }
}

/* Every type of index, and points that are not packed. */
static void test_views(void **state)
{
    (void)state;
    layout_scene s = make_scene(150, 6);
    size_t indices = 3 * (size_t)s.triangle_count;
    double *points = malloc(3 * (size_t)s.point_count * sizeof *points);
    int64_t *triangles = malloc(indices * sizeof *triangles);
    for (uint32_t i = 0; i < s.point_count; i++) {
        points[3 * (size_t)i] = s.points[2 * (size_t)i];
        points[3 * (size_t)i + 1] = s.points[2 * (size_t)i + 1];
        points[3 * (size_t)i + 2] = NAN;
    }
    for (size_t i = 0; i < indices; i++) triangles[i] = s.triangles[i];
    mw_arrays view = {.points = points,
                      .point_count = s.point_count,
                      .point_stride = 3,
                      .triangles = s.triangles,
                      .triangle_count = s.triangle_count,
                      .integer_type = MW_INT32};
    mw_mesh *kept, *laid;
    assert_int_equal(create(&s, MW_LAYOUT_AS_GIVEN, 1, &kept, NULL), MW_OK);
    for (int wide = 0; wide < 2; wide++) {
        if (wide) view.triangles = triangles;
        if (wide) view.integer_type = MW_INT64;
        assert_int_equal(
            mw_mesh_create(&view, &(mw_mesh_options){.layout = MW_LAYOUT_HILBERT, .threads = 2},
                           &laid, NULL),
            MW_OK);
        expect_same(kept, laid);
        mw_mesh_destroy(laid);
    }
    mw_error error;
    triangles[3 * 777 + 1] = -1;
    triangles[3 * 888] = INT64_C(1) << 40;
    assert_int_equal(mw_mesh_create(&view,
                                    &(mw_mesh_options){.layout = MW_LAYOUT_HILBERT, .threads = 2},
                                    &laid, &error),
                     MW_ERROR_INPUT);
    assert_int_equal(error.triangle, 777);
    mw_mesh_destroy(kept);
    free(points);
    free(triangles);
    release(&s);
}

/* The errors are those of the arrays, too. */
static void expect_refused(const layout_scene *s)
{
    mw_mesh *mesh;
    mw_error one, other;
    assert_int_equal(create(s, MW_LAYOUT_AS_GIVEN, 1, &mesh, &one), MW_ERROR_INPUT);
    for (uint32_t threads = 1; threads < 4; threads++) {
        assert_int_equal(create(s, MW_LAYOUT_HILBERT, threads, &mesh, &other), MW_ERROR_INPUT);
        assert_null(mesh);
        assert_string_equal(one.message, other.message);
        assert_int_equal(one.triangle, other.triangle);
        assert_int_equal(one.vertex, other.vertex);
    }
}

static void test_refused(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < 20; i++) {
        layout_scene s = make_scene(100, (uint64_t)i);
        for (int n = 0; n < 3; n++) {
            uint32_t t = mw__random_below(&random, s.triangle_count),
                     *v = s.triangles + 3 * (size_t)t;
            if (i % 4 == 0)
                v[mw__random_below(&random, 3)] = s.point_count + mw__random_below(&random, 5);
            if (i % 4 == 1) v[1] = v[2];
            if (i % 4 == 2) s.points[2 * (size_t)v[0]] = NAN;
            if (i % 4 == 3)
                memcpy(v, s.triangles + 3 * (size_t)((t + 1) % s.triangle_count), 3 * sizeof *v);
        }
        if (i % 4 == 3) { /* three at each of its edges */
            memcpy(s.triangles, s.triangles + 3 * 500, 3 * sizeof *s.triangles);
            memcpy(s.triangles + 3 * 700, s.triangles + 3 * 500, 3 * sizeof *s.triangles);
        }
        expect_refused(&s);
        release(&s);
    }
}

/* All round one vertex, and vertices that no triangle has. */
static void test_hub(void **state)
{
    (void)state;
    enum { RIM = 30000 };
    layout_scene s = {.point_count = RIM + 10, .triangle_count = RIM};
    s.points = calloc(2 * (size_t)s.point_count, sizeof *s.points);
    s.triangles = malloc(3 * (size_t)RIM * sizeof *s.triangles);
    for (uint32_t i = 0; i < RIM; i++) {
        s.points[2 * (size_t)i] = cos(i * 6.28 / RIM);
        s.points[2 * (size_t)i + 1] = sin(i * 6.28 / RIM);
        s.triangles[3 * (size_t)i] = RIM;
        s.triangles[3 * (size_t)i + 1] = i;
        s.triangles[3 * (size_t)i + 2] = (i + 1) % RIM;
    }
    s.points[2 * (RIM + 5)] = INFINITY;
    s.points[2 * (RIM + 6)] = NAN;
    mw_mesh *kept, *laid;
    assert_int_equal(create(&s, MW_LAYOUT_AS_GIVEN, 1, &kept, NULL), MW_OK);
    assert_int_equal(create(&s, MW_LAYOUT_HILBERT, 2, &laid, NULL), MW_OK);
    expect_same(kept, laid);
    mw_mesh_destroy(kept);
    mw_mesh_destroy(laid);
    release(&s);
}

/* Crowds within crowds: each is in order along a curve of its own, so that points next in order
 * are close. */
static void test_curve(void **state)
{
    (void)state;
    enum { N = 200000 };
    mw_point *p = malloc(N * sizeof *p);
    uint32_t *order = malloc(N * sizeof *order), *again = malloc(N * sizeof *again);
    uint8_t *seen = calloc(N, 1);
    uint64_t random = 9;
    for (uint32_t i = 0; i < N; i++) {
        double size = i % 2 ? 1 : 1e-9, x = random_unit(&random), y = random_unit(&random);
        p[i] = (mw_point){size * x, size * y};
    }
    p[17] = (mw_point){INFINITY, 0};
    p[18] = (mw_point){NAN, NAN};
    assert_true(mw__points_order(p, N, MW_ALONE, order));
    assert_true(mw__points_order(p, N, &(mw_job){.threads = 3}, again));
    assert_memory_equal(order, again, N * sizeof *order);
    double way = 0;
    for (uint32_t i = 0; i < N; i++) {
        assert_int_equal(seen[order[i]]++, 0);
        mw_point a = p[order[i]], b = p[order[i ? i - 1 : 0]];
        bool both =
            mw__is_finite(a) && mw__is_finite(b) && fmax(fmax(a.x, a.y), fmax(b.x, b.y)) < 1e-8;
        if (both) way += hypot(a.x - b.x, a.y - b.y) / 1e-9;
    }
    assert_true(way < 2 * sqrt(N / 2)); /* a random order: half of N */
    free(p);
    free(order);
    free(again);
    free(seen);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_mesh_threads),
        cmocka_unit_test(test_folded_threads),
        cmocka_unit_test(test_loose_threads),
        cmocka_unit_test(test_views),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_hub),
        cmocka_unit_test(test_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
