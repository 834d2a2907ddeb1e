/* test_star_project.c - where rays meet star-shaped polyhedra: every coordinate is the double
 * nearest to the exact one, by rationals; through vertices, along edges, along axes, in coordinates
 * of any size. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/star_oracle.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/star_shapes.h"

/* A polyhedron about a centre that is not the origin. */
typedef struct project_world {
    star_shape shape;
    double centre[3];
    mw_surface *surface;
    mw_star *star;
} project_world;

static void world_open(project_world *w, mw_surface_options how)
{
    mw_error error;
    mw_arrays view = star_shape_arrays(&w->shape);
    mw_star_options options = {.centre = {w->centre[0], w->centre[1], w->centre[2]}};
    expect_ok(mw_surface_create(&view, &how, &w->surface, &error), "surface", &error);
    expect_ok(mw_star_create(w->surface, &options, &w->star, &error), "star", &error);
}

static void world_release(project_world *w)
{
    mw_star_destroy(w->star);
    mw_surface_destroy(w->surface);
    star_shape_free(&w->shape);
}

/* Vertices at `centre` + size * (integers); `rough` moves them outwards by random factors. */
static project_world world_make(unsigned levels, const double centre[3], double size, bool rough,
                                uint64_t *random)
{
    project_world w = {.shape = star_shape_octahedron(levels)};
    star_shape_stretch(&w.shape, 4, random);
    star_shape_shuffle(&w.shape, random);
    memcpy(w.centre, centre, sizeof w.centre);
    for (uint32_t v = 0; v < w.shape.points; v++) {
        const double factor = rough ? 1 + random_unit(random) : 1;
        for (uint32_t k = 0; k < 3; k++)
            w.shape.point[3 * v + k] = centre[k] + size * factor * w.shape.point[3 * v + k];
    }
    world_open(&w, (mw_surface_options){0});
    return w;
}

/* A point on a ray of some kind: anywhere, through a vertex or the middle of an edge, within a
 * coordinate plane, along an axis, hardly off an edge. */
static void ray_draw(const project_world *w, double size, uint64_t *random, double q[3])
{
    const uint32_t kind = mw__random_below(random, 6),
                   t = mw__random_below(random, w->shape.triangles),
                   axis = mw__random_below(random, 3), *v = w->shape.corner + 3 * (size_t)t;
    for (uint32_t k = 0; k < 3; k++) {
        const double a = w->shape.point[3 * v[0] + k], b = w->shape.point[3 * v[1] + k];
        q[k] = w->centre[k] + size * (random_unit(random) - 0.5);
        if (kind == 1) q[k] = a;
        if (kind == 2) q[k] = a / 2 + b / 2;
        if (kind == 3 && k == axis) q[k] = w->centre[k];
        if (kind == 4 && k != axis) q[k] = w->centre[k];
        if (kind == 5) q[k] = a / 2 + b / 2 + (random_unit(random) - 0.5) * 0x1p-40 * size;
    }
}

static void meeting_expect(const project_world *w, const double q[3], const mw_location *at,
                           const double meeting[3])
{
    if (q[0] == w->centre[0] && q[1] == w->centre[1] && q[2] == w->centre[2]) {
        assert_int_equal(at->where, MW_BAD);
        assert_true(isnan(meeting[0]) && isnan(meeting[1]) && isnan(meeting[2]));
        return;
    }
    const uint32_t *v = w->shape.corner + 3 * (size_t)at->triangle;
    if (!star_oracle_is_meeting(w->shape.point, v, w->centre, q, meeting))
        fail_msg("ray from %a %a %a through %a %a %a, facet %u: not %a %a %a", w->centre[0],
                 w->centre[1], w->centre[2], q[0], q[1], q[2], at->triangle, meeting[0], meeting[1],
                 meeting[2]);
    for (int k = 0; k < 3; k++) {
        double beside[3] = {meeting[0], meeting[1], meeting[2]};
        assert_false(meeting[k] == 0 && signbit(meeting[k]));
        beside[k] = nextafter(meeting[k], q[k]);
        assert_true(beside[k] == meeting[k] ||
                    !star_oracle_is_meeting(w->shape.point, v, w->centre, q, beside));
    }
    for (uint32_t k = 0; k < 3 && at->where == MW_ON_VERTEX; k++)
        assert_true(meeting[k] == w->shape.point[3 * v[at->local] + k]);
}

/* Single queries and a batch; each is held against the oracle. */
static void world_try(const project_world *w, double size, size_t n, uint64_t *random)
{
    double *q = malloc(3 * n * sizeof *q), *meeting = malloc(3 * n * sizeof *meeting);
    mw_location *at = malloc(n * sizeof *at);
    mw_star_cursor cursor;
    mw_error error;
    for (size_t i = 0; i < n; i++) ray_draw(w, size, random, q + 3 * i);
    expect_ok(mw_star_project_batch(w->star, q, n, 0, NULL, meeting, at, &error), "batch", &error);
    expect_ok(mw_star_cursor_init(w->star, NULL, &cursor, &error), "cursor", &error);
    for (size_t i = 0; i < n; i++) {
        double single[3];
        const mw_location found = mw_star_project(w->star, &cursor, q + 3 * i, single);
        meeting_expect(w, q + 3 * i, &at[i], meeting + 3 * i);
        assert_int_equal(found.triangle, at[i].triangle);
        assert_memory_equal(single, meeting + 3 * i, sizeof single);
    }
    free(q);
    free(meeting);
    free(at);
}

static void test_places_and_sizes(void **state)
{
    static const double sizes[] = {1, 0x1p-3, 0x1p60, 0x1p-1060, 0x1p-700, 0x1p400, 0x1p1010},
                        places[] = {0, 3, 1.0 / 3, 0x1p30 + 1.0 / 3};
    uint64_t random = environment_print_seed("places and sizes", 41);
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (size_t j = 0; j < sizeof places / sizeof *places; j++)
            for (unsigned rough = 0; rough < 2; rough++) {
                const double s = sizes[i], p = places[j], c[3] = {p * s, -p * s, 2 * p * s};
                if (!isfinite(2 * c[2]) || (s < 0x1p-1000 && (rough || j > 1))) continue;
                project_world w = world_make(2, c, s, rough, &random);
                world_try(&w, 8 * s, environment_is_long() ? 20000 : 150, &random);
                world_release(&w);
            }
}

/* Facets hardly off the ray: the volumes nearly vanish. */
static void test_spikes(void **state)
{
    uint64_t random = environment_print_seed("spikes", 42);
    (void)state;
    for (int round = 0; round < 40; round++) {
        const double c[3] = {random_unit(&random), 0, -1};
        project_world w = {.shape = star_shape_octahedron(2), .centre = {c[0], c[1], c[2]}};
        for (uint32_t v = 0; v < w.shape.points; v++) {
            const double far = v % 3 ? 1 : ldexp(1, (int)mw__random_below(&random, 40));
            for (uint32_t k = 0; k < 3; k++)
                w.shape.point[3 * v + k] =
                    c[k] + far * (1 + random_unit(&random) * 0x1p-20) * w.shape.point[3 * v + k];
        }
        world_open(&w, (mw_surface_options){0});
        world_try(&w, 8, 60, &random);
        world_release(&w);
    }
}

/* A value halfway between two doubles goes to the even one. The ray from 0, c, 0 through 2^53, y, 0
 * meets the side x = 2^54 of a cube at the height 2 y - c, where doubles are 1 apart. */
static void test_halves(void **state)
{
    static const double heights[] = {0.5, 1.5, -0.5, -2.5};
    uint64_t random = environment_print_seed("halves", 43);
    (void)state;
    for (int i = 0; i < 400; i++) {
        project_world w = {.centre = {0, heights[i % 4], 0}};
        for (uint32_t v = 0; v < 8; v++)
            star_shape_point(&w.shape, v & 1 ? 0x1p54 : -0x1p54, v & 2 ? 0x1p54 : -0x1p54,
                             v & 4 ? 0x1p54 : -0x1p54);
        for (uint32_t t = 0; t < 12; t++)
            star_shape_triangle(&w.shape, cube_triangles[t][0], cube_triangles[t][1],
                                cube_triangles[t][2]);
        world_open(&w, (mw_surface_options){0});
        const double y = 0x1p51 + (double)mw__random_below(&random, 1u << 30),
                     q[3] = {0x1p53, y, 0};
        double meeting[3];
        mw_star_cursor cursor;
        expect_ok(mw_star_cursor_init(w.star, NULL, &cursor, NULL), "cursor", NULL);
        const mw_location at = mw_star_project(w.star, &cursor, q, meeting);
        meeting_expect(&w, q, &at, meeting);
        assert_true(meeting[0] == 0x1p54 && fabs(2 * y - w.centre[1] - meeting[1]) <= 0.5);
        assert_true(fmod(meeting[1], 2) == 0);
        world_release(&w);
    }
}

/* The same bits for any number of threads, walk and start; blocks of a batch; strides. */
static void test_threads(void **state)
{
    enum { RAYS = 40000 };
    uint64_t random = environment_print_seed("threads", 44);
    const double c[3] = {0.1, -7, 1e3};
    project_world w = world_make(4, c, 1, true, &random);
    double *q = malloc(4 * RAYS * sizeof *q), *meeting = malloc(3 * RAYS * sizeof *meeting),
           *first = malloc(3 * RAYS * sizeof *first);
    mw_error error;
    (void)state;
    for (size_t i = 0; i < RAYS; i++) ray_draw(&w, 30, &random, q + 4 * i);
    memcpy(q, c, sizeof c);
    q[5] = INFINITY;
    expect_ok(mw_star_project_batch(w.star, q, RAYS, 4, NULL, first, NULL, &error), "batch",
              &error);
    assert_true(isnan(first[0]) && isnan(first[3]));
    for (uint32_t threads = 1; threads < 5; threads++) {
        mw_star_query_options options = {
            .threads = threads, .walk = threads == 3 ? MW_STAR_WALK_STRAIGHT : MW_STAR_WALK_AUTO};
        expect_ok(mw_star_project_batch(w.star, q, RAYS, 4, &options, meeting, NULL, &error),
                  "batch", &error);
        for (size_t i = 6; i < 3 * RAYS; i++) assert_true(meeting[i] == first[i]);
    }
    free(q);
    free(meeting);
    free(first);
    world_release(&w);
}

/* A shared surface answers each ray from one state; a star that is out of date answers none. */
static void test_updates(void **state)
{
    enum { RAYS = 500 };
    uint64_t random = environment_print_seed("updates", 45);
    project_world w = {.shape = star_shape_octahedron(3)};
    double q[3 * RAYS], meeting[3 * RAYS];
    mw_error error;
    (void)state;
    world_open(&w, (mw_surface_options){.shared = 1});
    for (size_t i = 0; i < RAYS; i++) ray_draw(&w, 8, &random, q + 3 * i);
    mw_surface_begin_update(w.surface);
    double *p = mw_surface_points(w.surface);
    for (uint32_t i = 0; i < 3 * w.shape.points; i++) p[i] *= 2;
    mw_surface_end_update(w.surface);
    expect_ok(mw_star_project_batch(w.star, q, RAYS, 3, NULL, meeting, NULL, &error), "batch",
              &error);
    for (size_t i = 0; i < 3 * RAYS; i++) assert_true(isnan(meeting[i]));
    mw_surface_begin_update(w.surface);
    expect_ok(mw_star_update(w.star, NULL, &error), "update", &error);
    mw_surface_end_update(w.surface);
    for (uint32_t i = 0; i < 3 * w.shape.points; i++) w.shape.point[i] *= 2;
    world_try(&w, 8, RAYS, &random);
    world_release(&w);
}

static void test_arguments(void **state)
{
    uint64_t random = 3;
    const double c[3] = {0};
    project_world w = world_make(1, c, 1, false, &random);
    double q[3] = {1, 2, 3}, meeting[3];
    (void)state;
    assert_int_equal(mw_star_project_batch(NULL, q, 1, 3, NULL, meeting, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_project_batch(w.star, NULL, 1, 3, NULL, meeting, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_project_batch(w.star, q, 1, 3, NULL, NULL, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_project_batch(w.star, q, 1, 2, NULL, meeting, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_star_project_batch(w.star, NULL, 0, 3, NULL, NULL, NULL, NULL), MW_OK);
    world_release(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_places_and_sizes), cmocka_unit_test(test_spikes),
        cmocka_unit_test(test_halves),           cmocka_unit_test(test_threads),
        cmocka_unit_test(test_updates),          cmocka_unit_test(test_arguments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
