/* test_star_borrow.c - stars on the surface's own records: the answers of an ordinary star bit for
 * bit, no memory, and surfaces that were trusted wrongly. test_star.c has more shapes. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/star_oracle.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/shapes.h"
#include "support/star_shapes.h"

typedef struct borrow_world {
    star_shape shape;
    mw_surface *surface;
    mw_star *whole, *borrowed, *trusting;
} borrow_world;

static mw_star *make_star(const mw_surface *surface, mw_star_options options)
{
    mw_star *star;
    mw_error error;
    expect_ok(mw_star_create(surface, &options, &star, &error), "star", &error);
    return star;
}

static borrow_world make_borrow_world(star_shape p, mw_surface_options how)
{
    borrow_world w = {.shape = p};
    mw_error error;
    mw_arrays view = star_shape_arrays(&w.shape);
    expect_ok(mw_surface_create(&view, &how, &w.surface, &error), "surface", &error);
    w.whole = make_star(w.surface, (mw_star_options){0});
    w.borrowed = make_star(w.surface, (mw_star_options){.borrow = 1});
    w.trusting = make_star(w.surface, (mw_star_options){.borrow = 1, .unchecked = 1});
    return w;
}

static void release_borrow_world(borrow_world *w)
{
    mw_star_destroy(w->whole);
    mw_star_destroy(w->borrowed);
    mw_star_destroy(w->trusting);
    mw_surface_destroy(w->surface);
    star_shape_free(&w->shape);
}

/* Rays anywhere, through vertices, edges and facets; some that are none. */
static void draw_rays(const star_shape *p, double *q, size_t n, uint64_t *random)
{
    for (size_t i = 0; i < n; i++) {
        const uint32_t *v = p->corner + 3 * (size_t)mw__random_below(random, p->triangles);
        uint32_t kind = mw__random_below(random, 5);
        for (size_t k = 0; k < 3; k++) {
            double a = p->point[3 * v[0] + k], b = p->point[3 * v[1] + k],
                   c = p->point[3 * v[2] + k];
            q[3 * i + k] = kind == 0   ? random_unit(random) - 0.5
                           : kind == 1 ? a
                           : kind == 2 ? a + b
                           : kind == 3 ? a / 2 + b / 4 + c / 4
                                       : -b;
        }
    }
    q[0] = NAN;
    q[4] = INFINITY;
    q[6] = q[7] = q[8] = 0;
}

enum { RAYS = 1200 };

static void expect_batch(const mw_star *star, const double *q, mw_star_query_options options,
                         const mw_location *expected)
{
    static mw_location found[RAYS];
    mw_counters counters;
    mw_error error;
    for (uint32_t threads = 1; threads <= 3; threads += 2)
        for (int count = 0; count < 2; count++) {
            options.threads = threads;
            options.counters = count;
            memset(found, 0xff, sizeof found);
            expect_ok(mw_star_locate_batch(star, q, RAYS, 0, &options, found, &counters, &error),
                      "batch", &error);
            assert_memory_equal(found, expected, sizeof found);
            if (!count) continue;
            assert_int_equal(counters.queries, RAYS - 3);
            assert_true(counters.triangles_visited >= RAYS - 3);
            assert_true(counters.orient >= RAYS);
        }
}

/* Single rays, batches and projections of both borrowed stars are those of the ordinary one. */
static void expect_same(const borrow_world *w, uint64_t *random)
{
    static const mw_star_start_kind starts[] = {MW_STAR_START_AUTO, MW_STAR_START_RANDOM,
                                                MW_STAR_START_SAMPLE, MW_STAR_START_LAST,
                                                MW_STAR_START_SORTED};
    static double q[3 * RAYS], meet[3 * RAYS], met[3 * RAYS];
    static mw_location expected[RAYS];
    draw_rays(&w->shape, q, RAYS, random);
    expect_ok(mw_star_project_batch(w->whole, q, RAYS, 0, NULL, meet, expected, NULL), "rays",
              NULL);
    for (int trusting = 0; trusting < 2; trusting++) {
        const mw_star *star = trusting ? w->trusting : w->borrowed;
        for (size_t s = 0; s < sizeof starts / sizeof *starts; s++) {
            mw_star_query_options options = {.start = starts[s], .seed = s};
            mw_star_cursor cursor;
            expect_ok(mw_star_cursor_init(star, &options, &cursor, NULL), "cursor", NULL);
            for (size_t i = 0; i < RAYS; i += 3) {
                mw_location at = mw_star_locate(star, &cursor, q + 3 * i);
                assert_memory_equal(&at, &expected[i], sizeof at);
            }
            if (s < 2 || trusting == 0) expect_batch(star, q, options, expected);
        }
        expect_ok(mw_star_project_batch(star, q, RAYS, 0, NULL, met, NULL, NULL), "rays", NULL);
        assert_memory_equal(met, meet, sizeof meet);
    }
}

static star_shape spiky(unsigned levels, uint64_t *random)
{
    star_shape p = star_shape_octahedron(levels);
    star_shape_stretch(&p, 40, random);
    star_shape_shuffle(&p, random);
    return p;
}

/* Two poles of many facets; all coordinates are integers. */
static star_shape poles(uint32_t around, uint64_t *random)
{
    star_shape p = {0};
    uint32_t north = star_shape_point(&p, 0, 0, 0x1p20), south = star_shape_point(&p, 0, 0, -77);
    for (uint32_t i = 0; i < around; i++) {
        double angle = 6.2831853071795862 * i / around;
        star_shape_point(&p, rint(0x1p24 * cos(angle)), rint(0x1p24 * sin(angle)), i % 7);
    }
    for (uint32_t i = 0; i < around; i++) {
        star_shape_triangle(&p, north, 2 + i, 2 + (i + 1) % around);
        star_shape_triangle(&p, south, 2 + (i + 1) % around, 2 + i);
    }
    star_shape_shuffle(&p, random);
    return p;
}

static void test_same_answers(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("borrowed stars", 61);
    for (int form = 0; form < 6; form++) {
        star_shape p = form < 2   ? spiky(2 + 3 * (unsigned)form, &random)
                       : form < 4 ? poles(form == 2 ? 80 : 1500, &random)
                                  : star_shape_octahedron(4);
        if (form == 4)
            for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 64;
        for (uint32_t i = 0; form == 4 && i < 60; i++)
            star_shape_add_flat(&p, mw__random_below(&random, p.triangles),
                                mw__random_below(&random, 3));
        if (form == 5) star_shape_tear(&p);
        borrow_world w = make_borrow_world(p, (mw_surface_options){.weld = form == 5});
        expect_same(&w, &random);
        release_borrow_world(&w);
    }
}

/* A star is as small on any surface; what it tells of the surface is what the ordinary one tells.
 */
static void test_no_memory(void **state)
{
    (void)state;
    size_t bytes = 0;
    for (unsigned levels = 1; levels <= 6; levels += 5) {
        star_shape p = star_shape_octahedron(levels);
        if (levels == 1)
            for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 2;
        if (levels == 1) assert_true(star_shape_add_flat(&p, 0, 0));
        borrow_world w = make_borrow_world(p, (mw_surface_options){0});
        mw_star_info whole, borrowed, trusting;
        mw_star_describe(w.whole, &whole);
        mw_star_describe(w.borrowed, &borrowed);
        mw_star_describe(w.trusting, &trusting);
        assert_int_equal(borrowed.bytes, trusting.bytes);
        assert_true(borrowed.bytes < 512 && whole.bytes > 2 * borrowed.bytes);
        if (bytes) assert_int_equal(borrowed.bytes, bytes);
        bytes = borrowed.bytes;
        assert_int_equal(whole.flat_facets, levels == 1);
        assert_int_equal(borrowed.flat_facets, whole.flat_facets);
        assert_int_equal(trusting.flat_facets, 0);
        assert_int_equal(borrowed.angle_bytes, 0);
        release_borrow_world(&w);
    }
}

/* Making one takes the star alone, or the memory of the check where facets are flat. */
static void test_every_allocation_of_borrowed(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        star_shape p = star_shape_octahedron(2);
        for (uint32_t i = 0; i < 3 * p.points; i++) p.point[i] *= 2;
        if (flat) assert_true(star_shape_add_flat(&p, 0, 0));
        mw_surface *surface;
        mw_arrays view = star_shape_arrays(&p);
        expect_ok(mw_surface_create(&view, NULL, &surface, NULL), "surface", NULL);
        long k = 0;
        for (mw_status status = MW_ERROR_MEMORY; status; k++) {
            const mw_star_options options = {.borrow = 1, .threads = 1};
            mw_star *star;
            allocations_left = k;
            status = mw_star_create(surface, &options, &star, NULL);
            allocations_left = -1;
            assert_true(status == MW_OK || (status == MW_ERROR_MEMORY && !star));
            mw_star_destroy(star);
        }
        assert_int_equal(k, flat ? 6 : 2);
        mw_surface_destroy(surface);
        star_shape_free(&p);
    }
}

static void test_paths_of_borrowed(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("paths", 62);
    borrow_world w = make_borrow_world(star_shape_octahedron(4), (mw_surface_options){0});
    for (uint64_t i = 0; i < 100; i++) {
        mw_star_query_options options = {
            .start = i % 2 ? MW_STAR_START_RANDOM : MW_STAR_START_AUTO, .seed = i, .counters = 1};
        mw_star_cursor cursor;
        mw_location location;
        uint32_t facet[4096];
        double q[3];
        for (int k = 0; k < 3; k++) q[k] = random_unit(&random) - 0.5;
        expect_ok(mw_star_cursor_init(w.borrowed, &options, &cursor, NULL), "cursor", NULL);
        size_t count = mw_star_path(w.borrowed, &cursor, q, facet, 4096, &location);
        assert_true(count >= 1 && count <= 4096);
        assert_int_equal(count, cursor.counters.triangles_visited);
        assert_int_equal(cursor.counters.handovers, 0);
        assert_int_equal(facet[count - 1], location.triangle);
        for (size_t j = 1; j < count; j++) {
            bool linked = false;
            for (unsigned k = 0; k < 3; k++)
                linked |= mw_surface_neighbour(w.surface, facet[j - 1], k, NULL) == facet[j];
            assert_true(linked);
        }
        size_t again = mw_star_path(w.borrowed, &cursor, q, facet, 1, NULL);
        assert_true(i % 2 ? again >= 1 : again == 1); /* from there */
    }
    release_borrow_world(&w);
}

/* --- surfaces that change --- */

static mw_where where_of(const mw_star *star)
{
    mw_star_cursor cursor;
    expect_ok(mw_star_cursor_init(star, NULL, &cursor, NULL), "cursor", NULL);
    return (mw_where)mw_star_locate(star, &cursor, (double[3]){1, 2, 3}).where;
}

/* Moves vertices along their rays: the surface stays star-shaped. */
static void move_outwards(borrow_world *w, uint64_t *random)
{
    double *point = mw_surface_points(w->surface);
    for (uint32_t v = 0; v < w->shape.points; v++) {
        double factor = 1 + mw__random_below(random, 3);
        for (uint32_t k = 0; k < 3; k++) {
            point[3 * (size_t)v + k] *= factor;
            w->shape.point[3 * (size_t)v + k] = point[3 * (size_t)v + k];
        }
    }
}

static void test_moved_borrowed(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("moves", 63);
    borrow_world w = make_borrow_world(star_shape_octahedron(3), (mw_surface_options){0});
    for (int round = 0; round < 3; round++) {
        mw_surface_begin_update(w.surface);
        move_outwards(&w, &random);
        assert_int_equal(where_of(w.borrowed), MW_BAD);
        assert_int_not_equal(where_of(w.trusting), MW_BAD); /* needs no update */
        const uint32_t moved = 0;
        mw_star_update_options options = {.moved = round == 1 ? &moved : NULL, .moved_count = 1};
        expect_ok(mw_star_update(w.borrowed, &options, NULL), "update", NULL);
        if (round == 2) expect_ok(mw_star_update(w.trusting, NULL, NULL), "update", NULL);
        expect_ok(mw_star_update(w.whole, NULL, NULL), "update", NULL);
        mw_surface_end_update(w.surface);
        expect_same(&w, &random);
    }
    mw_error error, wanted;
    mw_surface_begin_update(w.surface);
    double *point = mw_surface_points(w.surface), before[3];
    for (int k = 0; k < 3; k++) {
        before[k] = point[k];
        point[k] *= -2;
    }
    assert_int_equal(mw_star_update(w.whole, NULL, &wanted), MW_ERROR_INPUT);
    assert_int_equal(mw_star_update(w.borrowed, NULL, &error), MW_ERROR_INPUT);
    assert_string_equal(error.message, wanted.message);
    assert_int_equal(where_of(w.borrowed), MW_BAD);
    for (int k = 0; k < 3; k++) point[k] = before[k];
    expect_ok(mw_star_update(w.borrowed, NULL, NULL), "update", NULL);
    mw_surface_end_update(w.surface);
    assert_int_not_equal(where_of(w.borrowed), MW_BAD);
    release_borrow_world(&w);
}

/* --- surfaces that were trusted wrongly --- */

/* Some facet is met if and only if there is one, and it is met: its weights are those of a ray. */
static void expect_meeting_or_none(const mw_star *star, const shape *s, const double c[3],
                                   const double q[3], mw_star_cursor *cursor)
{
    mw_location at = mw_star_locate(star, cursor, q),
                lowest = star_oracle_locate(s->points, s->triangles, s->triangle_count, c, q);
    assert_int_equal(at.triangle == MW_NONE, lowest.triangle == MW_NONE);
    if (at.triangle == MW_NONE) {
        assert_int_equal(at.where, MW_OUTSIDE);
        return;
    }
    mw_location alone =
        star_oracle_locate(s->points, s->triangles + 3 * (size_t)at.triangle, 1, c, q);
    assert_int_equal(alone.triangle, 0);
    assert_int_equal(alone.where, at.where);
    for (int k = 0; k < 3; k++) assert_true(fabs(alone.weight[k] - at.weight[k]) <= 0x1p-34);
}

static void test_trusted_wrongly(void **state)
{
    static const double centres[][3] = {{0, 0, 0}, {40, 0, 0}, {7, -3, 2}, {500, 400, 300}};
    (void)state;
    uint64_t random = environment_print_seed("trust", 64);
    for (int kind = 0; kind < 3; kind++) {
        shape s = kind == 0   ? shape_torus(12, 8, 16)
                  : kind == 1 ? shape_patch(8, 3, &random)
                              : shape_ball(5, 100, 0.7, &random);
        mw_arrays view = {.points = s.points,
                          .point_count = s.point_count,
                          .triangles = s.triangles,
                          .triangle_count = s.triangle_count};
        mw_surface *surface;
        mw_error error;
        expect_ok(mw_surface_create(&view, NULL, &surface, &error), "surface", &error);
        for (size_t i = 0; i < sizeof centres / sizeof *centres; i++) {
            const double *c = centres[i];
            mw_star *star = make_star(
                surface,
                (mw_star_options){.centre = {c[0], c[1], c[2]}, .borrow = 1, .unchecked = 1});
            mw_star_cursor cursor;
            expect_ok(mw_star_cursor_init(star, NULL, &cursor, NULL), "cursor", NULL);
            for (int ray = 0; ray < 200; ray++) {
                double q[3];
                uint32_t v = mw__random_below(&random, s.point_count);
                for (int k = 0; k < 3; k++)
                    q[k] = ray % 2 ? s.points[3 * (size_t)v + (size_t)k]
                                   : c[k] + random_unit(&random) - 0.5;
                if (q[0] == c[0] && q[1] == c[1] && q[2] == c[2]) continue;
                expect_meeting_or_none(star, &s, c, q, &cursor);
            }
            mw_star_destroy(star);
        }
        mw_surface_destroy(surface);
        shape_free(&s);
    }
}

/* Queries end, and name no facet whose corners are not finite. */
static void test_not_finite(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("not finite", 65);
    borrow_world w = make_borrow_world(star_shape_octahedron(3), (mw_surface_options){0});
    mw_surface_begin_update(w.surface);
    double *point = mw_surface_points(w.surface);
    for (uint32_t i = 0; i < 20; i++)
        point[mw__random_below(&random, 3 * w.shape.points)] = i % 2 ? NAN : INFINITY;
    mw_surface_end_update(w.surface);
    mw_star_cursor cursor;
    expect_ok(mw_star_cursor_init(w.trusting, NULL, &cursor, NULL), "cursor", NULL);
    uint32_t none = 0;
    for (int ray = 0; ray < 2000; ray++) {
        double q[3];
        for (int k = 0; k < 3; k++) q[k] = random_unit(&random) - 0.5;
        mw_location at = mw_star_locate(w.trusting, &cursor, q);
        none += at.triangle == MW_NONE;
        for (uint32_t k = 0; k < 9 && at.triangle != MW_NONE; k++)
            assert_true(isfinite(point[3 * w.shape.corner[3 * at.triangle + k / 3] + k % 3]));
    }
    assert_true(none > 0 && none < 2000);
    release_borrow_world(&w);
}

/* --- arguments --- */

static void test_arguments_of_borrowed(void **state)
{
    (void)state;
    borrow_world w = make_borrow_world(star_shape_octahedron(2), (mw_surface_options){0});
    mw_star *star;
    mw_star_index *index;
    mw_star_cursor cursor;
    mw_error error;
    assert_int_equal(mw_star_create(w.surface, &(mw_star_options){.unchecked = 1}, &star, &error),
                     MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "needs 'borrow'"));
    assert_int_equal(
        mw_star_create(w.surface, &(mw_star_options){.borrow = 1, .angles = 1}, &star, &error),
        MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_index_create(w.borrowed, MW_STAR_START_GRID, NULL, &index, &error),
                     MW_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "a borrowed star has no index"));
    for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++) {
        bool can = walk == MW_STAR_WALK_AUTO || walk == MW_STAR_WALK_STOCHASTIC;
        mw_star_query_options options = {.walk = (mw_star_walk_kind)walk};
        assert_int_equal(mw_star_cursor_init(w.borrowed, &options, &cursor, &error),
                         can ? MW_OK : MW_ERROR_ARGUMENT);
    }
    for (int start = 0; start < MW_STAR_START_COUNT; start++) {
        bool can =
            !mw_star_start_has_index((mw_star_start_kind)start) && start != MW_STAR_START_FRONT;
        mw_star_query_options options = {.start = (mw_star_start_kind)start};
        assert_int_equal(mw_star_cursor_init(w.borrowed, &options, &cursor, &error),
                         can ? MW_OK : MW_ERROR_ARGUMENT);
    }
    release_borrow_world(&w);
}

/* A surface of nothing, trusted. */
static void test_borrowed_nothing(void **state)
{
    (void)state;
    mw_arrays nothing = {0};
    mw_surface *surface;
    mw_star *star;
    mw_error error;
    expect_ok(mw_surface_create(&nothing, NULL, &surface, &error), "surface", &error);
    assert_int_equal(mw_star_create(surface, &(mw_star_options){.borrow = 1}, &star, &error),
                     MW_ERROR_INPUT);
    star = make_star(surface, (mw_star_options){.borrow = 1, .unchecked = 1});
    assert_int_equal(where_of(star), MW_OUTSIDE);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_answers),
        cmocka_unit_test(test_no_memory),
        cmocka_unit_test(test_every_allocation_of_borrowed),
        cmocka_unit_test(test_paths_of_borrowed),
        cmocka_unit_test(test_moved_borrowed),
        cmocka_unit_test(test_trusted_wrongly),
        cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_arguments_of_borrowed),
        cmocka_unit_test(test_borrowed_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
