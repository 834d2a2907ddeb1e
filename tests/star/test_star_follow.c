/* test_star_follow.c - a star that follows single vertices equals one made anew, and is refused
 * where that is. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "star/star.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/star_shapes.h"

typedef struct moving_star {
    star_shape shape;
    mw_surface *surface;
    mw_star *star;
    mw_star_options options;
    size_t bytes; /* before it followed single vertices */
} moving_star;

static size_t star_bytes(const mw_star *star)
{
    mw_star_info info;
    mw_star_describe(star, &info);
    return info.bytes;
}

static moving_star make_moving(star_shape shape, int weld)
{
    moving_star m = {.shape = shape, .options = {.angles = 1, .threads = 1}};
    mw_arrays view = star_shape_arrays(&m.shape);
    mw_error error;
    expect_ok(mw_surface_create(&view, &(mw_surface_options){.weld = weld}, &m.surface, &error),
              "surface", &error);
    expect_ok(mw_star_create(m.surface, &m.options, &m.star, &error), "star", &error);
    m.bytes = star_bytes(m.star);
    return m;
}

static void release_moving(moving_star *m)
{
    mw_star_destroy(m->star);
    mw_surface_destroy(m->surface);
    star_shape_free(&m->shape);
}

static mw_status update_moved(moving_star *m, const uint32_t *moved, size_t count, mw_error *error)
{
    mw_star_update_options options = {.moved = moved, .moved_count = count};
    return mw_star_update(m->star, &options, error);
}

/* Has the last update decided single facets only? Deciding all releases what that needs. */
static bool has_followed(const moving_star *m)
{
    return star_bytes(m->star) ==
           m->bytes + 5 * (size_t)m->shape.triangles + 4 * (size_t)m->shape.points;
}

/* --- equal to one made anew --- */

static const mw_star_facet *facet_of(const mw_star *star, uint32_t user)
{
    uint32_t i = 0;
    while ((star->facet[i].user & MW_USER_MASK) != user) i++;
    return &star->facet[i];
}

static void expect_facet(const mw_star *star, const mw_star_facet *a, const mw_star *fresh,
                         const mw_star_facet *b)
{
    assert_int_equal(a->user, b->user); /* marks included */
    assert_memory_equal(a->v, b->v, sizeof a->v);
    assert_memory_equal(a->normal, b->normal, sizeof a->normal);
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t there = star->facet[mw__link_triangle(a->link[k])].user,
                 wanted = fresh->facet[mw__link_triangle(b->link[k])].user;
        assert_int_equal(there & MW_USER_MASK, wanted & MW_USER_MASK);
    }
}

static mw_location locate(const mw_star *star, const double q[3])
{
    mw_star_cursor cursor;
    expect_ok(mw_star_cursor_init(star, NULL, &cursor, NULL), "cursor", NULL);
    return mw_star_locate(star, &cursor, q);
}

static void expect_equal_to_fresh(const moving_star *m, uint64_t *random)
{
    mw_star *fresh;
    mw_error error;
    expect_ok(mw_star_create(m->surface, &m->options, &fresh, &error), "star made anew", &error);
    for (uint32_t i = 0; i < m->shape.triangles; i++) {
        const mw_star_facet *a = &m->star->facet[i];
        expect_facet(m->star, a, fresh, facet_of(fresh, a->user & MW_USER_MASK));
    }
    assert_memory_equal(m->star->angle, fresh->angle, 2 * sizeof *fresh->angle * m->shape.points);
    for (int i = 0; i < 300; i++) {
        double q[3];
        for (uint32_t k = 0; k < 3; k++) q[k] = random_unit(random) - 0.5;
        mw_location a = locate(m->star, q), b = locate(fresh, q);
        assert_memory_equal(&a, &b, sizeof a);
    }
    mw_star_destroy(fresh);
}

/* Moves vertices along their rays, and a little beside them. */
static void move_vertices(moving_star *m, const uint32_t *moved, uint32_t count, double beside,
                          uint64_t *random)
{
    double *point = mw_surface_points(m->surface);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            double *x = &point[3 * (size_t)moved[i] + k];
            *x = *x * 1.125 + beside * (random_unit(random) - 0.5);
        }
}

static void follow_rounds(moving_star *m, double beside, uint64_t *random)
{
    for (int round = 0; round < 12; round++) {
        uint32_t moved[4], count = 1 + mw__random_below(random, 4);
        for (uint32_t i = 0; i < count; i++) moved[i] = mw__random_below(random, m->shape.points);
        mw_surface_begin_update(m->surface);
        move_vertices(m, moved, count, beside, random);
        mw_error error;
        assert_int_equal(locate(m->star, (double[3]){1, 2, 3}).where, MW_BAD);
        expect_ok(update_moved(m, moved, count, &error), "update", &error);
        mw_surface_end_update(m->surface);
        assert_true(has_followed(m));
        expect_equal_to_fresh(m, random);
    }
}

static void test_follow(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("follow", 41);
    star_shape shape = star_shape_octahedron(3);
    star_shape_shuffle(&shape, &random);
    moving_star m = make_moving(shape, 0);
    follow_rounds(&m, 0.3, &random);
    release_moving(&m);
}

/* Two poles of 80 facets each: hubs, whose facets are in angular order. */
static void test_follow_at_poles(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("follow at poles", 42);
    moving_star m = make_moving(star_shape_globe(80, 9), 0);
    assert_int_equal(m.star->hubs.count, 2);
    follow_rounds(&m, 0.02, &random);
    for (uint32_t pole = 0; pole < 2; pole++) {
        mw_surface_begin_update(m.surface);
        move_vertices(&m, &pole, 1, 0.1, &random);
        expect_ok(update_moved(&m, &pole, 1, NULL), "update", NULL);
        mw_surface_end_update(m.surface);
        assert_true(has_followed(&m));
        expect_equal_to_fresh(&m, &random);
    }
    release_moving(&m);
}

/* --- where all must be decided --- */

/* The update must end as a check of everything does, with the same words. */
static void expect_as_fresh(moving_star *m, const uint32_t *moved, size_t count)
{
    mw_star *fresh;
    mw_error error, wanted;
    mw_status status = mw_star_create(m->surface, &m->options, &fresh, &wanted);
    assert_int_equal(update_moved(m, moved, count, &error), status);
    mw_surface_end_update(m->surface);
    assert_false(has_followed(m));
    if (status) {
        assert_string_equal(error.message, wanted.message);
        assert_int_equal(locate(m->star, (double[3]){1, 2, 3}).where, MW_BAD);
    }
    mw_star_destroy(fresh);
}

/* A vertex beyond the centre, at it, or at a corner of its own facets; and back. */
static void test_not_star_shaped(void **state)
{
    (void)state;
    moving_star m = make_moving(star_shape_octahedron(3), 0);
    uint64_t random = 5;
    for (uint32_t round = 0; round < 30; round++) {
        uint32_t v = mw__random_below(&random, m.shape.points);
        double *p = mw_surface_points(m.surface) + 3 * (size_t)v;
        double old[3] = {p[0], p[1], p[2]};
        mw_surface_begin_update(m.surface);
        for (uint32_t k = 0; k < 3; k++)
            p[k] = round % 3 == 0   ? -p[k]
                   : round % 3 == 1 ? 0
                   : round == 2     ? NAN
                                    : 8 * p[(k + 1) % 3];
        expect_as_fresh(&m, &v, 1);
        mw_surface_begin_update(m.surface);
        memcpy(p, old, sizeof old);
        expect_ok(update_moved(&m, &v, 1, NULL), "back", NULL);
        assert_false(has_followed(&m)); /* the update before it failed */
        mw_surface_end_update(m.surface);
        mw_surface_begin_update(m.surface);
        expect_ok(update_moved(&m, &v, 1, NULL), "again", NULL);
        assert_true(has_followed(&m));
        mw_surface_end_update(m.surface);
    }
    release_moving(&m);
}

/* Of a double pyramid with 400 sides, 40 corners of the equator, which go a tenth of the way round,
 * now go once more round: each facet faces out, and every ray meets two facets. */
static void test_wound_twice(void **state)
{
    (void)state;
    enum { AROUND = 400, MOVED = 40 };
    moving_star m = make_moving(star_shape_globe(AROUND, 1), 0);
    uint32_t moved[MOVED];
    double *point = mw_surface_points(m.surface), turn = 6.2831853071795862;
    mw_surface_begin_update(m.surface);
    for (uint32_t i = 0; i < MOVED; i++) {
        double phi = turn * i / AROUND + turn * (i + 1) / (MOVED + 1);
        moved[i] = 2 + i;
        point[3 * moved[i]] = 4 * cos(phi);
        point[3 * moved[i] + 1] = 4 * sin(phi);
    }
    expect_as_fresh(&m, moved, MOVED);
    assert_false(m.star->ready);
    release_moving(&m);
}

/* Corners that are one must move together. */
static void test_follow_welded(void **state)
{
    (void)state;
    uint64_t random = 7;
    star_shape p = star_shape_octahedron(3);
    star_shape_tear(&p);
    moving_star m = make_moving(p, 1);
    double *point = mw_surface_points(m.surface), old[3];
    uint32_t moved[16], count = 0, v = 3 * (m.shape.triangles / 2);
    memcpy(old, point + 3 * v, sizeof old);
    for (uint32_t i = 0; i < m.shape.points && count < 16; i++)
        if (memcmp(point + 3 * i, old, sizeof old) == 0) moved[count++] = i;
    assert_true(count >= 4);
    for (uint32_t together = 0; together < 2; together++) {
        mw_surface_begin_update(m.surface);
        for (uint32_t i = 0; i < (together ? count : 1); i++)
            for (uint32_t k = 0; k < 3; k++) point[3 * moved[i] + k] = 1.25 * old[k];
        if (!together) {
            expect_as_fresh(&m, moved, 1);
            continue;
        }
        for (int again = 0; again < 2; again++) /* the update before it failed */
            expect_ok(update_moved(&m, moved, count, NULL), "update", NULL);
        assert_true(has_followed(&m));
        mw_surface_end_update(m.surface);
        expect_equal_to_fresh(&m, &random);
    }
    release_moving(&m);
}

/* After a flip, or an update left out, all is decided. */
static void test_other_changes(void **state)
{
    (void)state;
    uint64_t random = 9;
    moving_star m = make_moving(star_shape_octahedron(3), 0);
    uint32_t v = 20;
    mw_error error;
    double *point = mw_surface_points(m.surface);
    for (uint32_t k = 0; k < 3; k++) point[3 * v + k] *= 1.5;
    mw_surface_begin_update(m.surface);
    mw_surface_end_update(m.surface);
    mw_surface_begin_update(m.surface);
    expect_ok(update_moved(&m, NULL, 0, &error), "all", &error);
    mw_surface_end_update(m.surface);
    expect_equal_to_fresh(&m, &random);
    for (int left_out = 0; left_out < 2; left_out++) {
        mw_surface_begin_update(m.surface);
        if (left_out) {
            mw_surface_end_update(m.surface);
            mw_surface_begin_update(m.surface);
        } else {
            uint32_t t = 0;
            while (t < m.shape.triangles && mw_surface_flip(m.surface, t, 0, NULL)) t++;
        }
        mw_star *fresh;
        mw_status wanted = mw_star_create(m.surface, &m.options, &fresh, NULL);
        assert_int_equal(update_moved(&m, &v, 1, &error), wanted);
        assert_false(has_followed(&m));
        mw_surface_end_update(m.surface);
        mw_star_destroy(fresh);
    }
    uint32_t none = m.shape.points;
    assert_int_equal(update_moved(&m, &none, 1, &error), MW_ERROR_ARGUMENT);
    release_moving(&m);
}

/* --- threads --- */

static void test_threads_make_the_same(void **state)
{
    (void)state;
    uint64_t random = 11;
    star_shape p = star_shape_octahedron(6);
    star_shape_shuffle(&p, &random);
    moving_star m = make_moving(p, 0);
    mw_star *other;
    mw_star_options options = {.angles = 1, .threads = 3};
    mw_error error;
    expect_ok(mw_star_create(m.surface, &options, &other, &error), "three threads", &error);
    assert_memory_equal(m.star->facet, other->facet, sizeof *other->facet * m.shape.triangles);
    assert_memory_equal(m.star->owner, other->owner, sizeof *other->owner * m.shape.points);
    mw_star_destroy(other);
    release_moving(&m);
}

/* --- all decided where they stand --- */

/* The facets' numbers in the order in which they are stored. */
static uint32_t *stored_order(const mw_star *star)
{
    uint32_t *order = malloc(star->facet_count * sizeof *order);
    assert_non_null(order);
    for (uint32_t i = 0; i < star->facet_count; i++) order[i] = star->facet[i].user & MW_USER_MASK;
    return order;
}

/* All vertices move, or the whole turns a quarter about the z axis: then the guide leads to where
 * facets were, and they are stored anew. */
static void test_all_where_they_stand(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("all move", 43);
    for (uint32_t form = 0; form < 4; form++) {
        bool turns = form == 3;
        moving_star m =
            make_moving(form == 1 ? star_shape_globe(80, 9) : star_shape_octahedron(5), 0);
        double *point = mw_surface_points(m.surface);
        for (uint32_t round = 0; round < 3; round++) {
            uint32_t *before = stored_order(m.star);
            mw_surface_begin_update(m.surface);
            for (uint32_t v = 0; v < m.shape.points; v++) {
                double *p = point + 3 * (size_t)v, x = p[0], by = 1 + 0.1 * random_unit(&random);
                p[0] = turns ? -p[1] : p[0];
                p[1] = turns ? x : p[1];
                for (uint32_t k = 0; k < 3; k++) p[k] *= by;
            }
            mw_star_update_options options = {.threads = 1 + round};
            expect_ok(mw_star_update(m.star, &options, NULL), "update", NULL);
            mw_surface_end_update(m.surface);
            expect_equal_to_fresh(&m, &random);
            uint32_t *after = stored_order(m.star);
            bool same = memcmp(after, before, m.shape.triangles * sizeof *after) == 0;
            assert_int_equal(same, !turns);
            free(before);
            free(after);
        }
        release_moving(&m);
    }
}

/* Where the surface is not star-shaped any more the words are those of a new star; and back. */
static void test_all_refused(void **state)
{
    (void)state;
    moving_star m = make_moving(star_shape_octahedron(3), 0);
    double *p = mw_surface_points(m.surface) + 3 * 17, old[3] = {p[0], p[1], p[2]};
    uint64_t random = 11;
    for (int round = 0; round < 4; round++) {
        mw_surface_begin_update(m.surface);
        for (int k = 0; k < 3; k++) p[k] = round % 2 ? NAN : -old[k];
        expect_as_fresh(&m, NULL, 0);
        mw_surface_begin_update(m.surface);
        memcpy(p, old, sizeof old);
        expect_ok(mw_star_update(m.star, NULL, NULL), "back", NULL);
        mw_surface_end_update(m.surface);
        expect_equal_to_fresh(&m, &random);
    }
    release_moving(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_follow),
        cmocka_unit_test(test_follow_at_poles),
        cmocka_unit_test(test_not_star_shaped),
        cmocka_unit_test(test_wound_twice),
        cmocka_unit_test(test_follow_welded),
        cmocka_unit_test(test_other_changes),
        cmocka_unit_test(test_threads_make_the_same),
        cmocka_unit_test(test_all_where_they_stand),
        cmocka_unit_test(test_all_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
