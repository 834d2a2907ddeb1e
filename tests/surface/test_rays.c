/* Rays, segments and lines: nearest, any and all triangles, either face, least and greatest
 * distance; the same in batches; points inside of closed surfaces. Against brute force in
 * rationals. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "oracle/touch_oracle.h"
#include "probe/prober.h"
#include "support/allocations.h"
#include "support/environment.h"
#include "support/make_prober.h"
#include "support/meshes.h"
#include "support/shapes.h"

static uint64_t new_seed(const char *name)
{
    return environment_print_seed(name, 20240712);
}

/* --- brute force ------------------------------------------------------------------------------ */

/* Is |t| |m| less than d (-1), equal (0) or greater (1)? */
static int compare_distance(const touch_oracle *o, uint32_t i, double d)
{
    mpq_t away, limit;
    mpq_inits(away, limit, NULL);
    mpq_mul(away, o->t[i], o->t[i]);
    mpq_mul(away, away, o->square);
    mpq_set_d(limit, d);
    mpq_mul(limit, limit, limit);
    int order = mpq_cmp(away, limit);
    mpq_clears(away, limit, NULL);
    return order < 0 ? -1 : order > 0;
}

/* Does triangle i count? */
static bool counts(const touch_oracle *o, uint32_t i, const mw_probe_options *options)
{
    if (!o->met[i]) return false;
    if (options->faces == MW_PROBE_FRONT && !o->touched[i]) return false;
    if (options->faces == MW_PROBE_BACK && o->touched[i]) return false;
    if (options->extent != MW_PROBE_LINE && mpq_sgn(o->t[i]) < 0) return false;
    if (options->extent == MW_PROBE_SEGMENT && mpq_cmp_si(o->t[i], 1, 1) > 0) return false;
    if (options->min_distance > 0 && compare_distance(o, i, options->min_distance) < 0)
        return false;
    return options->max_distance == 0 || compare_distance(o, i, options->max_distance) <= 0;
}

static const touch_oracle *sorted;

static int compare_along(const void *a, const void *b)
{
    uint32_t i = *(const uint32_t *)a, j = *(const uint32_t *)b;
    int order = mpq_cmp(sorted->t[i], sorted->t[j]);
    return order != 0 ? order : i < j ? -1 : 1;
}

static int compare_near(const touch_oracle *o, uint32_t i, uint32_t j)
{
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_abs(a, o->t[i]);
    mpq_abs(b, o->t[j]);
    int order = mpq_cmp(a, b);
    mpq_clears(a, b, NULL);
    return order;
}

/* --- one query -------------------------------------------------------------------------------- */

static void check_touch(const touch_oracle *o, const mw_touch *touch, uint32_t t)
{
    int local, where = touch_oracle_where(o, t, &local);
    double distance = touch_oracle_distance(o, t);
    assert_int_equal(touch->state, MW_TOUCH_HIT);
    assert_int_equal(touch->triangle, t);
    assert_int_equal(touch->back, !o->touched[t]);
    assert_int_equal(touch->where, where);
    assert_int_equal(touch->local, local);
    assert_true(fabs(touch->distance - distance) <= 1e-12 * fabs(distance));
    assert_true(fabs(touch->weight[0] + touch->weight[1] + touch->weight[2] - 1) < 1e-14);
}

/* A batch of two good probes and one that is bad, with and without all triangles of a place. */
static void check_lists(const mw_prober *prober, const touch_oracle *o, const double q[6],
                        const mw_probe_options *given, const uint32_t *met, uint32_t n)
{
    double queries[21] = {0};
    mw_probe_options options = *given;
    mw_touch_lists lists;
    uint8_t states[3];
    memcpy(queries, q, 6 * sizeof *q);
    memcpy(queries + 14, q, 6 * sizeof *q);
    queries[8] = NAN;
    assert_int_equal(mw_probe_any_batch(prober, queries, 3, 7, &options, states, NULL, NULL),
                     MW_OK);
    assert_int_equal(states[0], n ? MW_TOUCH_HIT : MW_TOUCH_NONE);
    assert_int_equal(states[1], MW_TOUCH_BAD);
    assert_int_equal(states[2], states[0]);
    for (options.one_per_place = 0; options.one_per_place < 2; options.one_per_place++) {
        assert_int_equal(mw_probe_all_batch(prober, queries, 3, 7, &options, &lists, NULL, NULL),
                         MW_OK);
        uint32_t count = 0;
        for (uint32_t i = 0; i < n; i++) {
            bool again = i > 0 && mpq_equal(o->t[met[i]], o->t[met[i - 1]]);
            if (again && options.one_per_place) continue;
            assert_true(count < lists.offset[1]);
            check_touch(o, &lists.touch[count], met[i]);
            check_touch(o, &lists.touch[lists.offset[2] + count++], met[i]);
        }
        assert_int_equal(lists.probe_count, 3);
        assert_int_equal(lists.bad_count, 1);
        assert_int_equal(lists.offset[0], 0);
        assert_int_equal(lists.offset[1], count);
        assert_int_equal(lists.offset[2], count);
        assert_int_equal(lists.offset[3], 2 * count);
        assert_int_equal(lists.touch_count, 2 * count);
        mw_touch_lists_release(&lists);
        assert_null(lists.offset);
    }
}

/* Returns the number of triangles that the query meets. */
static uint32_t check_query(const mw_prober *prober, const touch_oracle *o, const double q[6],
                            const mw_probe_options *options, mw_probe_cursor *cursor)
{
    uint32_t *met = malloc((o->count + 1) * sizeof *met), n = 0, best = MW_NONE;
    for (uint32_t i = 0; i < o->count; i++) {
        if (!counts(o, i, options)) continue;
        met[n++] = i;
        if (best == MW_NONE || compare_near(o, i, best) < 0) best = i;
    }
    sorted = o;
    qsort(met, n, sizeof *met, compare_along);
    mw_touch touch = mw_probe(prober, cursor, q, q + 3), same;
    if (n)
        check_touch(o, &touch, best);
    else
        assert_int_equal(touch.state, MW_TOUCH_NONE);
    assert_int_equal(mw_probe_batch(prober, q, 1, 6, options, &same, NULL, NULL), MW_OK);
    assert_memory_equal(&same, &touch, sizeof same);
    assert_int_equal(mw_probe_any(prober, cursor, q, q + 3), n ? MW_TOUCH_HIT : MW_TOUCH_NONE);
    mw_touch *all = malloc((n + 1) * sizeof *all);
    mw_touch_state state;
    for (size_t room = n + 1; room + 3 > n && room <= n + 1; room--) { /* also too little room */
        assert_int_equal(mw_probe_all(prober, cursor, q, q + 3, all, room, &state), n);
        assert_int_equal(state, n ? MW_TOUCH_HIT : MW_TOUCH_NONE);
        for (uint32_t i = 0; i < n && i < room; i++) check_touch(o, &all[i], met[i]);
        if (room == 0) break;
    }
    free(all);
    check_lists(prober, o, q, options, met, n);
    free(met);
    return n;
}

/* --- surfaces --------------------------------------------------------------------------------- */

/* Limits: none, or at the distance of some triangle as rounded, and its neighbours. */
static double some_limit(const touch_oracle *o, uint64_t *random)
{
    uint32_t i = mw__random_below(random, o->count), kind = mw__random_below(random, 5);
    double d = o->met[i] ? fabs(touch_oracle_distance(o, i)) : 4 * random_unit(random);
    if (kind == 0) return 0;
    return kind == 1 ? nextafter(d, 0) : kind == 2 ? nextafter(d, INFINITY) : d;
}

/* Ask n queries in all ways. Returns how many triangles were met. */
static uint32_t check_shape(const shape *s, size_t n, bool portable, uint64_t *random)
{
    mw_surface *surface = shape_surface(s, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(s, n, random);
    uint32_t hits = 0;
    prober->portable = portable;
    for (size_t i = 0; i < n; i++) {
        const double *q = queries + 6 * i;
        double ends[6];
        for (int k = 0; k < 3; k++) {
            ends[k] = q[k];
            ends[3 + k] = i % 2 ? q[k] + q[3 + k] : q[k] + q[3 + k] * random_unit(random);
        }
        if (!touch_oracle_finite(q, 6) || memcmp(ends, ends + 3, 24) == 0) continue;
        touch_oracle line = touch_oracle_make(s, q), through = touch_oracle_through(s, ends);
        for (uint32_t way = 0; way < 9; way++) {
            mw_probe_options options = {.certain = 1,
                                        .faces = (mw_probe_faces)(way % 3),
                                        .extent = (mw_probe_extent)(way / 3)};
            bool segment = options.extent == MW_PROBE_SEGMENT;
            const touch_oracle *o = segment ? &through : &line;
            mw_probe_cursor cursor;
            for (int limits = 0; limits < 3; limits++) {
                if (limits) options.max_distance = some_limit(o, random);
                if (limits > 1) options.min_distance = some_limit(o, random);
                if (options.max_distance > 0 && options.min_distance > options.max_distance)
                    options.max_distance = 0;
                assert_int_equal(mw_probe_cursor_init(prober, &options, &cursor, NULL), MW_OK);
                cursor.last = mw__random_below(random, s->triangle_count);
                hits += check_query(prober, o, segment ? ends : q, &options, &cursor);
            }
        }
        touch_oracle_free(&line);
        touch_oracle_free(&through);
    }
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    return hits;
}

static void test_shapes(void **state)
{
    (void)state;
    uint64_t random = new_seed("shapes");
    shape shapes[] = {
        shape_ball(4, 12, 0.3, &random),
        shape_torus(10, 7, 3),
        shape_patch(6, 3, &random),
        shape_soup(20, 60, &random),
        shape_patch(5, 0, &random), /* a plane: many lines lie in it */
        shape_join(shape_patch(4, 2, &random), shape_patch(4, 2, &random), 0), /* layers */
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        if (i % 2) shape_shuffle(&shapes[i], &random);
        assert_true(check_shape(&shapes[i], 40, i % 3 == 0, &random) > 100);
        for (uint32_t k = 0; k < 3 * shapes[i].point_count; k++)
            shapes[i].points[k] += random_unit(&random);
        check_shape(&shapes[i], 15, i % 3 != 0, &random);
        shape_free(&shapes[i]);
    }
}

/* Segments between points whose difference takes two doubles, along planes and through vertices. */
static void test_long_segments(void **state)
{
    (void)state;
    uint64_t random = new_seed("long segments");
    shape s = shape_torus(8, 6, 2);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    mw_probe_options options = {.certain = 1, .faces = MW_PROBE_BOTH, .extent = MW_PROBE_SEGMENT};
    mw_probe_cursor cursor;
    assert_int_equal(mw_probe_cursor_init(prober, &options, &cursor, NULL), MW_OK);
    uint32_t hits = 0;
    for (int i = 0; i < 300; i++) {
        const double *at = s.points + 3 * (size_t)mw__random_below(&random, s.point_count);
        double ends[6], far = ldexp(1, (int)mw__random_below(&random, 80));
        int axis = (int)mw__random_below(&random, 3);
        for (int k = 0; k < 3; k++) {
            ends[k] = at[k] + (k == axis ? 0x1p-30 * random_unit(&random) - far : 0);
            ends[3 + k] = at[k] + (k == axis ? far * random_unit(&random) : 0);
            if (i % 4 == 3) ends[k] += (random_unit(&random) - 0.5) * 0x1p-50;
        }
        touch_oracle o = touch_oracle_through(&s, ends);
        hits += check_query(prober, &o, ends, &options, &cursor);
        touch_oracle_free(&o);
    }
    assert_true(hits > 300);
    const double same[6] = {1, 2, 3, 1, 2, 3}, wide[6] = {-1.5e308, 0, 0, 1.5e308, 0, 0};
    assert_int_equal(mw_probe(prober, &cursor, same, same + 3).state, MW_TOUCH_BAD);
    assert_int_equal(mw_probe(prober, &cursor, wide, wide + 3).state, MW_TOUCH_BAD);
    assert_int_equal(mw_probe_any(prober, &cursor, same, same + 3), MW_TOUCH_BAD);
    mw_touch_state found;
    assert_int_equal(mw_probe_all(prober, &cursor, wide, wide + 3, NULL, 0, &found), 0);
    assert_int_equal(found, MW_TOUCH_BAD);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* Many probes: all of them, in order, whatever the threads; and the counters add up. */
static void test_batches(void **state)
{
    (void)state;
    enum { PROBES = 5000 };
    uint64_t random = new_seed("batches");
    shape s = shape_torus(12, 9, 3);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(&s, PROBES, &random);
    static uint8_t states[PROBES], others[PROBES];
    mw_probe_options options = {.certain = 1, .faces = MW_PROBE_BOTH, .counters = 1, .threads = 1};
    mw_probe_cursor cursor;
    mw_probe_counters any, all;
    mw_touch_lists lists, same;
    queries[6 * 1500] = INFINITY;
    assert_int_equal(mw_probe_cursor_init(prober, &options, &cursor, NULL), MW_OK);
    assert_int_equal(mw_probe_any_batch(prober, queries, PROBES, 0, &options, states, &any, NULL),
                     MW_OK);
    assert_int_equal(mw_probe_all_batch(prober, queries, PROBES, 0, &options, &lists, &all, NULL),
                     MW_OK);
    options.threads = 3;
    assert_int_equal(mw_probe_any_batch(prober, queries, PROBES, 6, &options, others, NULL, NULL),
                     MW_OK);
    assert_int_equal(mw_probe_all_batch(prober, queries, PROBES, 6, &options, &same, NULL, NULL),
                     MW_OK);
    assert_memory_equal(states, others, sizeof states);
    assert_memory_equal(lists.offset, same.offset, (PROBES + 1) * sizeof *lists.offset);
    assert_memory_equal(lists.touch, same.touch, lists.touch_count * sizeof *lists.touch);
    size_t hits = 0;
    for (size_t i = 0; i < PROBES; i++) {
        static mw_touch touches[64];
        mw_touch_state one;
        size_t n =
            mw_probe_all(prober, &cursor, queries + 6 * i, queries + 6 * i + 3, touches, 64, &one);
        assert_true(n <= 64);
        assert_int_equal(states[i], one);
        assert_int_equal(lists.offset[i + 1] - lists.offset[i], n);
        if (n) assert_memory_equal(lists.touch + lists.offset[i], touches, n * sizeof *touches);
        hits += n > 0;
    }
    assert_true(hits > PROBES / 10);
    assert_int_equal(lists.bad_count, 1);
    assert_int_equal(any.queries, PROBES);
    assert_int_equal(any.hits, hits);
    assert_int_equal(all.hits, hits);
    assert_true(all.intersections >= lists.touch_count && any.boxes < all.boxes);
    mw_touch_lists_release(&lists);
    mw_touch_lists_release(&same);
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* --- rays that lie close together ------------------------------------------------------------- */

enum { SIDE = 40, PICTURE = SIDE * SIDE };

/* Rays from one point, or from a plane if `parallel`, line by line to and fro over a picture whose
 * points are `step` apart; along z they go from above down. Coordinates are whole numbers, so rays
 * pass through vertices and edges. */
static void picture_draw(double *rays, size_t stride, const double eye[3], double step,
                         bool parallel)
{
    for (size_t i = 0; i < PICTURE; i++) {
        size_t row = i / SIDE, column = row % 2 ? SIDE - 1 - i % SIDE : i % SIDE;
        double x = step * (double)column, y = step * (double)row, *ray = rays + i * stride;
        for (int k = 0; k < 3; k++) ray[k] = eye[k];
        if (parallel) {
            ray[0] += x;
            ray[1] += y;
        }
        ray[3] = (parallel ? 0 : x) - 7 - eye[0] / 4;
        ray[4] = (parallel ? 0 : y) - 3 - eye[1] / 4;
        ray[5] = -eye[2] - 200;
    }
}

/* Batches find bundles of rays; without vectors there are none, and the answers are the same. */
static void check_picture(mw_prober *prober, const double *rays, size_t stride,
                          mw_probe_options options, mw_probe_counters counters[2])
{
    static mw_touch touches[2][PICTURE];
    for (int portable = 0; portable < 2; portable++) {
        prober->portable = portable;
        memset(touches[portable], 0, sizeof touches[portable]);
        assert_int_equal(mw_probe_batch(prober, rays, PICTURE, stride, &options, touches[portable],
                                        &counters[portable], NULL),
                         MW_OK);
    }
    prober->portable = false;
    assert_int_equal(counters[0].queries, PICTURE);
    assert_int_equal(counters[0].hits, counters[1].hits);
    assert_memory_equal(touches[0], touches[1], sizeof touches[0]);
}

static void check_pictures_of(const shape *s, bool bundles, uint64_t *random)
{
    enum { STRIDE = 7 };
    static double rays[STRIDE * PICTURE];
    mw_surface *surface = shape_surface(s, (mw_surface_options){.tolerant = 1});
    mw_prober *prober = prober_with_boxes(surface);
    uint64_t boxes[2] = {0, 0}, hits = 0;
    for (int i = 0; i < 60; i++) {
        double eye[3] = {(double)(mw__random(random) % 64) - 90, -60,
                         1 + 400 * (double)(mw__random(random) % 2)};
        mw_probe_options options = {.certain = 1,
                                    .extent = i % 10 == 9 ? MW_PROBE_LINE : MW_PROBE_RAY,
                                    .faces = (mw_probe_faces)(i % 3),
                                    .max_distance = i % 4 == 3 ? 500 : 0,
                                    .min_distance = i % 5 == 4 ? 3 : 0,
                                    .counters = 1,
                                    .threads = 1};
        mw_probe_counters counters[2];
        picture_draw(rays, STRIDE, eye, i % 2 ? 1 : 0.25, i % 7 == 6);
        if (i % 6 == 5) rays[STRIDE * (mw__random(random) % PICTURE)] = NAN;
        if (i % 6 == 4) rays[STRIDE * (mw__random(random) % PICTURE) + 5] = INFINITY;
        check_picture(prober, rays, STRIDE, options, counters);
        hits += counters[0].hits;
        for (int k = 0; k < 2; k++) boxes[k] += counters[k].boxes;
    }
    print_message("%u triangles: %llu of %d rays hit; boxes in bundles %.2f of all\n",
                  s->triangle_count, (unsigned long long)hits, 60 * PICTURE,
                  (double)boxes[0] / (double)boxes[1]);
    assert_true(hits > 60);
#ifdef __x86_64__
    /* of large triangles in disorder, few help */
    if (bundles && __builtin_cpu_supports("avx2")) assert_true(boxes[0] < boxes[1] / 2);
#else
    (void)bundles;
#endif
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
}

static void test_pictures(void **state)
{
    (void)state;
    uint64_t random = new_seed("pictures");
    shape patch = shape_patch(8, 9, &random), soup = shape_soup(30, 60, &random);
    shape shapes[] = {shape_ball(6, 60, 0.2, &random), shape_torus(12, 9, 20),
                      shape_scaled(&patch, 9, -40), shape_scaled(&soup, 9, -40)};
    shape_free(&patch);
    shape_free(&soup);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        check_pictures_of(&shapes[i], i < 2, &random);
        shape_free(&shapes[i]);
    }
}

/* Each allocation of a batch fails once. */
static void test_batch_memory(void **state)
{
    (void)state;
    enum { PROBES = 1500 };
    uint64_t random = 8;
    shape s = shape_torus(12, 9, 3);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    double *queries = shape_queries(&s, PROBES, &random);
    mw_probe_options options = {.certain = 1, .faces = MW_PROBE_BOTH, .threads = 1};
    for (long failures = 0;; failures++) {
        mw_touch_lists lists;
        mw_error error = {0};
        allocations_left = failures;
        mw_status status =
            mw_probe_all_batch(prober, queries, PROBES, 6, &options, &lists, NULL, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        if (!failed) {
            assert_true(failures > 10);
            mw_touch_lists_release(&lists);
            break;
        }
        assert_null(lists.touch);
        assert_null(lists.offset);
    }
    free(queries);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

static void check_batch_arguments(const mw_prober *prober, const mw_prober *bare)
{
    const double q[6] = {0, 0, 9, 0, 0, -1};
    const mw_probe_options ray = {.extent = MW_PROBE_RAY}, spare = {.reserved = {1}};
    mw_touch_lists lists;
    uint8_t answer;
    const struct {
        const mw_prober *prober;
        const double *queries;
        size_t stride;
        const mw_probe_options *options;
    } wrong[] = {
        {NULL, q, 0, NULL},   {bare, q, 0, NULL},   {prober, NULL, 0, NULL},
        {prober, q, 5, NULL}, {prober, q, 0, &ray}, {prober, q, 0, &spare},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(mw_probe_any_batch(wrong[i].prober, wrong[i].queries, 1, wrong[i].stride,
                                            wrong[i].options, &answer, NULL, NULL),
                         MW_ERROR_ARGUMENT);
        assert_int_equal(mw_probe_all_batch(wrong[i].prober, wrong[i].queries, 1, wrong[i].stride,
                                            wrong[i].options, &lists, NULL, NULL),
                         MW_ERROR_ARGUMENT);
    }
    assert_int_equal(mw_probe_any_batch(prober, q, 1, 0, NULL, NULL, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_all_batch(prober, q, 1, 0, NULL, NULL, NULL, NULL),
                     MW_ERROR_ARGUMENT);
    assert_int_equal(mw_probe_any_batch(prober, NULL, 0, 0, NULL, NULL, NULL, NULL), MW_OK);
    assert_int_equal(mw_probe_all_batch(prober, NULL, 0, 0, NULL, &lists, NULL, NULL), MW_OK);
    assert_int_equal(lists.offset[0], 0);
    mw_touch_lists_release(&lists);
    mw_touch_lists_release(NULL);
}

static void test_arguments(void **state)
{
    (void)state;
    shape s = shape_torus(8, 6, 2);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface), *bare;
    mw_probe_cursor cursor;
    const mw_probe_options wrong[] = {
        {.certain = 1, .min_distance = -1},
        {.certain = 1, .min_distance = NAN},
        {.certain = 1, .min_distance = INFINITY},
        {.certain = 1, .min_distance = 2, .max_distance = 1},
        {.certain = 1, .faces = MW_PROBE_FACES_COUNT},
        {.certain = 1, .extent = MW_PROBE_EXTENT_COUNT},
        {.faces = MW_PROBE_BACK},
        {.extent = MW_PROBE_RAY},
        {.min_distance = 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(mw_probe_cursor_init(prober, &wrong[i], &cursor, NULL), MW_ERROR_ARGUMENT);
    assert_string_equal(mw_probe_faces_name(MW_PROBE_BOTH), "both");
    assert_null(mw_probe_faces_name(MW_PROBE_FACES_COUNT));
    assert_string_equal(mw_probe_extent_name(MW_PROBE_SEGMENT), "segment");
    assert_null(mw_probe_extent_name(MW_PROBE_EXTENT_COUNT));
    assert_int_equal(mw_prober_create(surface, NULL, &bare, NULL), MW_OK);
    const double q[6] = {0, 0, 9, 0, 0, -1};
    assert_int_equal(mw_probe_cursor_init(bare, NULL, &cursor, NULL), MW_OK);
    assert_int_equal(mw_probe_any(bare, &cursor, q, q + 3), MW_TOUCH_BAD);
    uint8_t side;
    assert_int_equal(mw_inside_surface(bare, q, 1, 0, 1, &side, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_inside_surface(prober, q, 1, 2, 1, &side, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_inside_surface(prober, NULL, 1, 0, 1, &side, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_inside_surface(prober, NULL, 0, 0, 1, NULL, NULL), MW_OK);
    check_batch_arguments(prober, bare);
    mw_prober_destroy(bare);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

/* --- inside ----------------------------------------------------------------------------------- */

/* By a ray in a general direction, which meets no edge; or the point lies on a triangle. */
static mw_surface_side true_side(const shape *s, const double p[3], uint64_t *random)
{
    for (;;) {
        double q[6] = {p[0], p[1], p[2]};
        for (int k = 3; k < 6; k++) q[k] = random_unit(random) - 0.5;
        touch_oracle o = touch_oracle_make(s, q);
        bool on = false, edge = false;
        uint32_t ahead = 0;
        for (uint32_t i = 0; i < o.count; i++) {
            if (!o.met[i]) continue;
            on = on || mpq_sgn(o.t[i]) == 0;
            edge = edge || o.side[i][0] == 0 || o.side[i][1] == 0 || o.side[i][2] == 0;
            ahead += mpq_sgn(o.t[i]) > 0;
        }
        touch_oracle_free(&o);
        if (on) return MW_SURFACE_ON;
        if (!edge) return ahead % 2 ? MW_SURFACE_INSIDE : MW_SURFACE_OUTSIDE;
    }
}

/* Points of a lattice, where the ray along x goes through edges and vertices, and others. */
static void check_inside(const shape *s, const mw_prober *prober, uint64_t *random)
{
    enum { POINTS = 300 };
    double points[4 * POINTS];
    uint8_t sides[POINTS], again[POINTS];
    size_t count[MW_SURFACE_SIDE_COUNT] = {0};
    for (int i = 0; i < POINTS; i++) {
        const double *a = s->points + 3 * (size_t)mw__random_below(random, s->point_count),
                     *b = s->points + 3 * (size_t)mw__random_below(random, s->point_count),
                     *c = s->points + 3 * (size_t)mw__random_below(random, s->point_count);
        for (int k = 0; k < 3; k++) {
            double at = i % 3 == 0 ? (a[k] + b[k]) / 2 : (k == 0 ? a : k == 1 ? b : c)[k];
            points[4 * i + k] = i % 3 == 2 ? at + random_unit(random) - 0.5 : at;
            if (i % 16 == 1) points[4 * i + k] = a[k];
        }
        points[4 * i + 3] = NAN;
    }
    assert_int_equal(mw_inside_surface(prober, points, POINTS, 4, 1, sides, NULL), MW_OK);
    assert_int_equal(mw_inside_surface(prober, points, POINTS, 4, 3, again, NULL), MW_OK);
    assert_memory_equal(sides, again, sizeof sides);
    for (int i = 0; i < POINTS; i++) {
        assert_int_equal(sides[i], true_side(s, points + 4 * i, random));
        count[sides[i]]++;
    }
    assert_true(count[MW_SURFACE_OUTSIDE] > 10 && count[MW_SURFACE_INSIDE] > 10 &&
                count[MW_SURFACE_ON] > 10);
}

static void test_inside(void **state)
{
    (void)state;
    uint64_t random = new_seed("inside");
    shape shapes[] = {
        shape_ball(4, 12, 0.3, &random),
        shape_torus(12, 8, 4),
        /* one in another, and two that cross */
        shape_join(shape_ball(4, 16, 0.2, &random), shape_ball(2, 6, 0.2, &random), 0),
        shape_join(shape_ball(3, 16, 0.2, &random), shape_ball(3, 16, 0.2, &random), 9),
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        mw_surface *surface = shape_surface(&shapes[i], (mw_surface_options){0});
        mw_prober *prober = prober_with_boxes(surface);
        check_inside(&shapes[i], prober, &random);
        prober->portable = true;
        check_inside(&shapes[i], prober, &random);
        const double bad[3] = {0, NAN, 0};
        uint8_t side;
        assert_int_equal(mw_inside_surface(prober, bad, 1, 0, 1, &side, NULL), MW_OK);
        assert_int_equal(side, MW_SURFACE_BAD);
        mw_prober_destroy(prober);
        mw_surface_destroy(surface);
        shape_free(&shapes[i]);
    }
    assert_string_equal(mw_surface_side_name(MW_SURFACE_ON), "on");
    assert_null(mw_surface_side_name(MW_SURFACE_SIDE_COUNT));
}

/* What has no inside is refused. */
static void test_not_closed(void **state)
{
    (void)state;
    uint64_t random = new_seed("not closed");
    const double p[3] = {0, 0, 0};
    uint8_t side;
    mw_error error;
    shape s = shape_patch(6, 3, &random);
    mw_surface *surface = shape_surface(&s, (mw_surface_options){0});
    mw_prober *prober = prober_with_boxes(surface);
    assert_int_equal(mw_inside_surface(prober, p, 1, 0, 1, &side, &error), MW_ERROR_INPUT);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);

    s = shape_ball(4, 16, 0.3, &random);
    shape_tear(&s, &random);
    surface = shape_surface(&s, (mw_surface_options){.weld = 1});
    prober = prober_with_boxes(surface);
    assert_int_equal(mw_inside_surface(prober, p, 1, 0, 1, &side, &error), MW_OK);
    mw_surface_begin_update(surface);
    mw_prober_update(prober, prober->slack_limit / 4, 1); /* nobody knows how they moved */
    mw_surface_end_update(surface);
    assert_int_equal(mw_inside_surface(prober, p, 1, 0, 1, &side, &error), MW_ERROR_INPUT);
    for (int apart = 0; apart < 3; apart++) {
        mw_surface_begin_update(surface);
        for (uint32_t v = 0; v < (apart == 1 ? 1u : apart ? s.point_count : 0u); v++)
            mw_surface_points(surface)[3 * (size_t)v] = apart == 1 ? 1 : NAN;
        mw_prober_update(prober, -1, 1);
        mw_surface_end_update(surface);
        bool joined = surface->coincident && apart == 0;
        assert_int_equal(mw_inside_surface(prober, p, 1, 0, 1, &side, &error),
                         joined ? MW_OK : MW_ERROR_INPUT);
    }
    mw_surface_begin_update(surface);
    mw_surface_end_update(surface);
    assert_int_equal(mw_inside_surface(prober, p, 1, 0, 1, &side, &error), MW_ERROR_ARGUMENT);
    mw_prober_destroy(prober);
    mw_surface_destroy(surface);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shapes),     cmocka_unit_test(test_long_segments),
        cmocka_unit_test(test_batches),    cmocka_unit_test(test_batch_memory),
        cmocka_unit_test(test_arguments),  cmocka_unit_test(test_inside),
        cmocka_unit_test(test_not_closed), cmocka_unit_test(test_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
