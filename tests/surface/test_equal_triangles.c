/* Many triangles with the same corners: a search for one triangle looks at one for all, and answers
 * as if it looked at each, also when some of them move by as little as there is. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "probe/nearest_in_triangle.h"
#include "probe/ray.h"
#include "support/environment.h"
#include "support/make_prober.h"
#include "support/meshes.h"
#include "support/shapes.h"

/* --- crowds ----------------------------------------------------------------------------------- */

static const double corners[3][3] = {{0, 0, 1}, {4, 0, 2}, {0, 4, 3}};

/* n triangles, each with vertices of its own. Triangle t has kind t % kinds: of the first three
 * kinds it begins at another corner, the others are turned round. */
static shape crowd_of(uint32_t n, uint32_t kinds)
{
    shape s = shape_make(3 * n, n);
    for (uint32_t t = 0; t < n; t++) {
        uint32_t kind = t % kinds, turned = kind / 3;
        for (uint32_t k = 0; k < 3; k++) {
            const double *p = corners[(turned ? 3 - k + kind : k + kind) % 3];
            shape_point(&s, p[0], p[1], p[2]);
        }
        shape_triangle(&s, 3 * t, 3 * t + 1, 3 * t + 2);
    }
    return s;
}

/* --- answers by looking at all ---------------------------------------------------------------- */

static uint32_t best_of_all(const mw_surface *surface, const mw_line *line)
{
    uint32_t best = MW_NONE;
    for (uint32_t t = 0; t < surface->tri_count; t++)
        if (!mw__surface_is_freed(surface, t) && mw__line_touches(surface, line, t) &&
            (best == MW_NONE || mw__touch_is_better(surface, line, t, best)))
            best = t;
    return best;
}

/* Probes through the crowd, from either side, at its edges and beside it. */
static void check_probes(const mw_prober *prober, uint64_t *random)
{
    for (int i = 0; i < 12; i++) {
        const double down = i % 2 ? 1 : -1;
        mw_line line = {
            {i % 3 ? 4 * random_unit(random) : 0, 5 * random_unit(random), 0}, {0, 0, down}, {0}};
        const uint32_t best = best_of_all(prober->surface, &line);
        assert_int_equal(mw__probe_certain(prober, &line, 0, MW_NONE, NULL), best);
        double q[6] = {line.q[0], line.q[1], -8 * down, 0, 0, down};
        mw_probe_options any = {.certain = 1};
        uint8_t met;
        assert_int_equal(mw_probe_any_batch(prober, q, 1, 6, &any, &met, NULL, NULL), MW_OK);
        assert_int_equal(met, best == MW_NONE ? MW_TOUCH_NONE : MW_TOUCH_HIT);
        mw_touch touch;
        assert_int_equal(mw_probe_batch(prober, q, 1, 6, &any, &touch, NULL, NULL), MW_OK);
        assert_int_equal(touch.triangle == MW_NONE, best == MW_NONE);
    }
}

/* The nearest triangle of a point is the lowest of the nearest. */
static void check_nearest(const mw_prober *prober, uint64_t *random)
{
    const mw_surface *surface = prober->surface;
    double q[3], least = INFINITY;
    uint32_t best = MW_NONE;
    for (int k = 0; k < 3; k++) q[k] = 6 * random_unit(random);
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (mw__surface_is_freed(surface, t)) continue;
        if (mw__collinear3(mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                           mw__surface_corner(surface, t, 2)))
            continue;
        double distance = mw__distance_to_triangle(surface, t, q);
        if (distance < least) {
            least = distance;
            best = t;
        }
    }
    mw_nearest_surface_point hit;
    assert_int_equal(mw_nearest_on_surface(prober, q, INFINITY, &hit, NULL), MW_OK);
    assert_int_equal(hit.triangle, best);
}

/* Where a node tells of equal triangles, are they equal, and is the one told the lowest? Returns
 * the lowest triangle below the node, and in *told how many nodes tell. */
static uint32_t check_same_below(const mw_bvh *b, const mw_surface *surface, uint32_t node,
                                 uint32_t *told)
{
    uint32_t lowest = MW_NONE, same = b->same[node];
    *told += same != MW_NONE;
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
        uint32_t child = b->node[node].child[k];
        if (child == MW_NONE) continue;
        uint32_t t = child & MW_BVH_TRIANGLE ? child & ~MW_BVH_TRIANGLE
                                             : check_same_below(b, surface, child, told);
        if (same != MW_NONE) {
            assert_true(child & MW_BVH_TRIANGLE || b->same[child] != MW_NONE);
            for (uint32_t i = 0; i < 9; i++)
                assert_true(mw__surface_corner(surface, t, i / 3)[i % 3] ==
                            mw__surface_corner(surface, same, i / 3)[i % 3]);
        }
        lowest = t < lowest ? t : lowest;
    }
    if (same != MW_NONE) assert_int_equal(same, lowest);
    return lowest;
}

static uint32_t check_same(const mw_prober *prober)
{
    uint32_t told = 0;
    check_same_below(&prober->bvh, prober->surface, 0, &told);
    return told;
}

/* --- counts ----------------------------------------------------------------------------------- */

static uint64_t triangles_of_probe(const mw_prober *prober, mw_probe_faces faces)
{
    mw_probe_options options = {
        .certain = 1, .extent = MW_PROBE_RAY, .faces = faces, .counters = 1};
    mw_probe_cursor cursor;
    const double q[3] = {1, 1, 9}, m[3] = {0, 0, -1};
    assert_int_equal(mw_probe_cursor_init(prober, &options, &cursor, NULL), MW_OK);
    mw_touch touch = mw_probe(prober, &cursor, q, m);
    assert_int_equal(touch.triangle, faces == MW_PROBE_BACK ? 3 : 0);
    return cursor.counters.box_triangles;
}

/* A search looks at no more triangles than the tree has levels, a few for each kind; a list has
 * all. */
static void test_counts(void **state)
{
    (void)state;
    enum { MOST = 30000 };
    uint64_t random = environment_print_seed("counts", 41);
    static mw_touch touches[MOST];
    for (uint32_t n = 1000; n <= MOST; n = 5 * n + 7)
        for (uint32_t kinds = 1; kinds <= 6; kinds += 5) {
            shape s = crowd_of(n, kinds);
            mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
            mw_prober *prober = prober_with_boxes(surface);
            check_probes(prober, &random);
            check_nearest(prober, &random);
            assert_true(check_same(prober) >= n / MW_BVH_WIDTH / 2);
            for (int faces = 0; faces < MW_PROBE_FACES_COUNT; faces++) {
                if (kinds == 1 && faces == MW_PROBE_BACK) continue;
                uint64_t looks = triangles_of_probe(prober, (mw_probe_faces)faces);
                assert_true(kinds == 1 ? looks == 1 : (double)looks <= 24 * log2(n));
            }
            mw_probe_options options = {.certain = 1, .faces = MW_PROBE_BOTH};
            mw_probe_cursor cursor;
            mw_touch_state met;
            const double q[3] = {1, 1, 9}, m[3] = {0, 0, -1};
            assert_int_equal(mw_probe_cursor_init(prober, &options, &cursor, NULL), MW_OK);
            assert_int_equal(mw_probe_all(prober, &cursor, q, m, touches, n, &met), n);
            for (uint32_t t = 0; t < n; t++) assert_int_equal(touches[t].triangle, t);
            mw_prober_destroy(prober);
            mw_surface_destroy(surface);
            shape_free(&s);
        }
}

/* A crowd is a small part of a surface whose other triangles differ. */
static void test_among_others(void **state)
{
    (void)state;
    enum { N = 3000 };
    uint64_t random = environment_print_seed("among others", 43);
    shape s = shape_join(crowd_of(N, 6), shape_patch(40, 3, &random), -6);
    shape_shuffle(&s, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    assert_true(check_same(prober) >= N / MW_BVH_WIDTH / 2);
    for (int i = 0; i < 20; i++) {
        check_probes(prober, &random);
        check_nearest(prober, &random);
    }
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* --- motion ----------------------------------------------------------------------------------- */

/* One corner of one triangle moves by one ulp along z, up or down, and is known to, or is not; then
 * it comes back. */
static void test_one_ulp(void **state)
{
    (void)state;
    enum { N = 400 };
    uint64_t random = environment_print_seed("one ulp", 47);
    shape s = crowd_of(N, 1);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    for (int round = 0; round < 60; round++) {
        double *p = mw_surface_points(surface) + 3 * (size_t)mw__random_below(&random, 3 * N);
        const double was = p[2], is = nextafter(was, round % 2 ? 9 : 0), known = 0x1p-50;
        const double moved[2] = {round % 4 < 2 ? -1 : known, round % 3 ? -1 : known};
        for (int back = 0; back < 2; back++) {
            mw_surface_begin_update(surface);
            p[2] = back ? was : is;
            mw_prober_update(prober, moved[back], 1 + (uint32_t)round % 2);
            mw_surface_end_update(surface);
            assert_true((prober->slack > 0) == (moved[back] > 0));
            if (moved[back] < 0) assert_true(check_same(prober) > N / MW_BVH_WIDTH / 2);
            check_probes(prober, &random);
            check_nearest(prober, &random);
        }
    }
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* --- edits ------------------------------------------------------------------------------------ */

static void edit_once(mw_surface_editor *e, const mw_surface *surface, uint64_t *random)
{
    uint32_t t = mw__random_below(random, surface->tri_count), k = mw__random_below(random, 3);
    if (mw__surface_is_freed(surface, t)) return;
    const uint32_t v = surface->tri[t].v[k], kind = mw__random_below(random, 8);
    double to[3];
    memcpy(to, mw__surface_point(surface, v), sizeof to);
    if (kind == 0) {
        mw_surface_edit_remove_triangle(e, t, NULL, NULL);
    } else if (kind == 1) {
        const double middle[3] = {1, 1, 2};
        mw_surface_edit_split_triangle(e, t, middle, NULL, NULL);
    } else if (kind < 5) { /* where some corner was at first */
        memcpy(to, corners[mw__random_below(random, 3)], sizeof to);
        mw_surface_edit_move_vertex(e, v, to, NULL, NULL);
    } else if (kind == 5) {
        to[2] = nextafter(to[2], random_unit(random) < 0.5 ? 9 : -9);
        mw_surface_edit_move_vertex(e, v, to, NULL, NULL);
    } else { /* one more of the crowd */
        mw_surface_change change;
        uint32_t more[3];
        for (uint32_t i = 0; i < 3; i++) {
            assert_int_equal(mw_surface_edit_add_vertex(e, corners[i], &change, NULL), MW_OK);
            more[i] = change.vertex[0].vertex;
        }
        assert_int_equal(mw_surface_edit_add_triangle(e, more, NULL, NULL), MW_OK);
    }
}

static void test_edits(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("edits", 53);
    for (uint32_t kinds = 1; kinds <= 6; kinds += 5) {
        shape s = crowd_of(300, kinds);
        mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
        mw_prober *prober = prober_with_boxes(surface);
        mw_surface_editor *e;
        mw_surface_editor_options options = {.prober = prober};
        assert_int_equal(mw_surface_editor_create(surface, &options, &e, NULL), MW_OK);
        uint32_t first = check_same(prober), before = first;
        for (int i = 0; i < 400; i++) {
            edit_once(e, surface, &random);
            uint32_t told = check_same(prober);
            assert_true(told <= before); /* until the boxes are fitted anew */
            before = told;
            check_probes(prober, &random);
            check_nearest(prober, &random);
            if (i % 100 != 99) continue;
            mw_surface_begin_update(surface);
            mw_prober_update(prober, -1, 1);
            mw_surface_end_update(surface);
            before = check_same(prober);
            check_probes(prober, &random);
        }
        assert_true(before > 0 && first > 0);
        mw_surface_editor_destroy(e);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_among_others),
        cmocka_unit_test(test_one_ulp),
        cmocka_unit_test(test_edits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
