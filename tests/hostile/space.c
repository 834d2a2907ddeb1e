/* space.c - hostile polyhedra and surfaces in space. */
#include "hostile/hostile.h"
#include "oracle/star_oracle.h"
#include "oracle/touch_oracle.h"
#include "support/make_prober.h"
#include "support/shapes.h"
#include "support/star_shapes.h"

#include <stdlib.h>

/* --- stars ------------------------------------------------------------------------------------ */

static star_shape any_star(uint64_t *random)
{
    star_shape s = star_shape_octahedron(mw__random_below(random, 4));
    if (mw__random_below(random, 2))
        star_shape_stretch(&s, 1 + mw__random_below(random, 40), random);
    for (uint32_t flats = mw__random_below(random, 3); flats > 0; flats--)
        star_shape_add_flat(&s, mw__random_below(random, s.triangles), mw__random_below(random, 3));
    for (uint32_t moved = mw__random_below(random, 3); moved > 0; moved--)
        s.point[mw__random_below(random, 3 * s.points)] += (double)mw__random_below(random, 5) - 2;
    star_shape_shuffle(&s, random);
    return s;
}

static void check_ray(const star_shape *s, const mw_star *star, uint64_t *random)
{
    static const double centre[3] = {0, 0, 0};
    const double *v = s->point + 3 * (size_t)mw__random_below(random, s->points);
    double q[3];
    for (int k = 0; k < 3; k++)
        q[k] = mw__random_below(random, 2) ? v[k] : (double)mw__random_below(random, 9) - 4;
    if (q[0] == 0 && q[1] == 0 && q[2] == 0) return;
    mw_location want = star_oracle_locate(s->point, s->corner, s->triangles, centre, q);
    for (int walk = 0; walk < MW_STAR_WALK_COUNT; walk++) {
        mw_star_query_options options = {.walk = (mw_star_walk_kind)walk,
                                         .start = MW_STAR_START_RANDOM,
                                         .seed = mw__random(random)};
        mw_star_cursor cursor;
        mw_error error;
        expect_ok(mw_star_cursor_init(star, &options, &cursor, &error), "a cursor", &error);
        mw_location got = mw_star_locate(star, &cursor, q);
        if (got.triangle != want.triangle || got.where != want.where || got.local != want.local)
            hostile_failed("%s: the ray (%.17g, %.17g, %.17g) meets facet %u, not %u",
                           mw_star_walk_name((mw_star_walk_kind)walk), q[0], q[1], q[2],
                           want.triangle, got.triangle);
    }
}

void hostile_stars(uint64_t *random)
{
    star_shape s = any_star(random);
    mw_arrays view = star_shape_arrays(&s);
    mw_star_options angles = {.angles = 1};
    mw_surface *surface = NULL;
    mw_star *star = NULL;
    mw_check check;
    mw_error error;
    mw_status accepted = mw_surface_create(&view, NULL, &surface, &error);
    if (!accepted) accepted = mw_star_create(surface, &angles, &star, &error);
    expect_ok(mw_star_check_arrays(&view, 0, NULL, &check, &error), "a check", &error);
    if ((check.valid != 0) != (accepted == MW_OK)) hostile_failed("the check and the star differ");
    for (int i = 0; star && i < 40; i++) check_ray(&s, star, random);
    mw_check_release(&check);
    mw_star_destroy(star);
    mw_surface_destroy(surface);
    star_shape_free(&s);
}

/* --- probes ----------------------------------------------------------------------------------- */

static shape any_shape(uint64_t *random)
{
    switch (mw__random_below(random, 5)) {
    case 0: return shape_ball(1 + mw__random_below(random, 4), 64, random_unit(random), random);
    case 1:
        return shape_torus(3 + mw__random_below(random, 6), 3 + mw__random_below(random, 6), 16);
    case 2:
        return shape_patch(1 + mw__random_below(random, 8), mw__random_below(random, 6), random);
    case 3:
        return shape_soup(4 + mw__random_below(random, 30), 1 + mw__random_below(random, 60),
                          random);
    default:
        return shape_join(
            shape_ball(1, 32, 0, random),
            shape_soup(4 + mw__random_below(random, 9), 1 + mw__random_below(random, 12), random),
            40);
    }
}

static void check_probe(const shape *s, const mw_prober *prober, const double query[6],
                        uint64_t *random)
{
    mw_error error;
    touch_oracle o = touch_oracle_make(s, query);
    uint32_t best = touch_oracle_best(&o, 0);
    for (int certain = 0; certain <= 1; certain++) {
        mw_probe_options options = {.certain = certain, .seed = mw__random(random)};
        mw_probe_cursor cursor;
        expect_ok(mw_probe_cursor_init(prober, &options, &cursor, &error), "a cursor", &error);
        mw_touch touch = mw_probe(prober, &cursor, query, query + 3);
        bool hit = touch.state == MW_TOUCH_HIT;
        if (certain ? touch.triangle != best || hit != (best != MW_NONE)
                    : hit && !o.touched[touch.triangle])
            hostile_failed("certain %d: the line from (%.17g, %.17g, %.17g) along (%.17g, %.17g, "
                           "%.17g) touches %u, "
                           "not %u",
                           certain, query[0], query[1], query[2], query[3], query[4], query[5],
                           best, touch.triangle);
    }
    touch_oracle_free(&o);
}

void hostile_probes(uint64_t *random)
{
    enum { LINES = 30 };
    shape s = any_shape(random);
    if (mw__random_below(random, 3) == 0) shape_flatten(&s, random_unit(random), random);
    if (mw__random_below(random, 3) == 0) shape_clash(&s, random_unit(random), random);
    if (mw__random_below(random, 3) == 0) shape_tear(&s, random);
    mw_surface *surface = shape_surface(
        &s, (mw_surface_options){.tolerant = 1, .weld = (int)mw__random_below(random, 2)});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(&s, LINES, random);
    for (int i = 0; i < LINES; i++) {
        const double *q = queries + 6 * (size_t)i;
        if (touch_oracle_finite(q, 6) && (q[3] != 0 || q[4] != 0 || q[5] != 0))
            check_probe(&s, prober, q, random);
    }
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}
