/* The layered hierarchy: what it builds, where its descent ends, what it counts. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "tiling/tiling_create.h"
#include "base/random.h"
#include "start/layers.h"
#include "support/allocations.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DESCENTS = MW_DESCENT_COORDINATE + 1 };

static arrays random_points(uint32_t n, double (*coordinate)(uint64_t *random), uint64_t *random)
{
    arrays a = arrays_make(n, 0);
    for (uint32_t i = 0; i < n; i++) {
        double x = coordinate(random), y = coordinate(random);
        arrays_point(&a, x, y);
    }
    return a;
}

static mw_mesh *delaunay_of(arrays *a)
{
    mw_mesh *mesh = mesh_delaunay(a->points, a->point_count);
    arrays_free(a);
    return mesh;
}

/* About normal. */
static double gaussian(uint64_t *random)
{
    double sum = -3;
    for (int i = 0; i < 6; i++) sum += random_unit(random);
    return sum;
}

/* Four dense spots of very different sizes. */
static double clustered(uint64_t *random)
{
    uint32_t spot = mw__random_below(random, 4);
    return spot + ldexp(random_unit(random), -3 * (int)spot);
}

/* Integers, so that many points are equal, on one line and on one circle. */
static double whole(uint64_t *random)
{
    return mw__random_below(random, 30);
}

static mw_mesh *points_mesh(uint32_t n, double (*coordinate)(uint64_t *random), uint64_t *random)
{
    arrays a = random_points(n, coordinate, random);
    return delaunay_of(&a);
}

static mw_mesh *grid(uint32_t n, double jitter, double holes, uint64_t *random)
{
    arrays a = arrays_grid(n, jitter, random);
    arrays_punch(&a, holes, random);
    arrays_scramble(&a, 1, random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){0});
    arrays_free(&a);
    return mesh;
}

enum { MESHES = 8 };
static mw_mesh *mesh_number(int i, uint64_t *random)
{
    switch (i) {
    case 0: return points_mesh(3000, random_unit, random);
    case 1: return points_mesh(3000, gaussian, random);
    case 2: return points_mesh(3000, clustered, random);
    case 3: return points_mesh(700, whole, random);
    case 4: return grid(30, 0, 0, random);
    case 5: return grid(30, 0.6, 0.3, random);
    case 6: return grid(2, 0, 0.5, random);
    default: return grid(1, 0, 0, random);
    }
}

static bool has_point(const mw_tiling *tiling, uint32_t t, mw_point p)
{
    for (int k = 0; k < 3; k++) {
        mw_point v = tiling->point[tiling->tri[t].v[k]];
        if (v.x == p.x && v.y == p.y) return true;
    }
    return false;
}

/* A layer is a tiling of its own, and its vertices lead to tiles at the same points below. */
static void check_layer(const mw_layer *layer, const mw_tiling *below)
{
    const mw_tiling *tiling = &layer->tiling;
    assert_true(tiling->tri_count > 0 && tiling->point_count < below->point_count);
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        assert_true(mw__has_area(tiling->point, tri));
        assert_int_equal(tri->v[3], tri->v[0]);
        double area = mw__orient2d(tiling->point[tri->v[0]], tiling->point[tri->v[1]],
                                   tiling->point[tri->v[2]]);
        assert_true(fabs(tiling->area[t] - area) <= 1e-9 * area);
        for (uint32_t k = 0; k < 3; k++)
            if (tri->link[k] != MW_NONE)
                assert_int_equal(
                    tiling->tri[mw__link_triangle(tri->link[k])].link[mw__link_edge(tri->link[k])],
                    mw__link(t, k));
    }
    for (uint32_t v = 0; v < tiling->point_count; v++) {
        assert_true(layer->below[v] < below->tri_count);
        assert_true(has_point(below, layer->below[v], tiling->point[v]));
    }
}

static void check_layers(const mw_layers *layers, const mw_tiling *tiling, uint32_t asked)
{
    uint32_t vertices[MW_MAX_LAYERS];
    mw__layers_describe(layers, vertices);
    assert_in_range(layers->count, 1, asked ? asked : MW_MAX_LAYERS);
    assert_true(vertices[0] <= tiling->point_count);
    assert_int_equal(mw__layers_bytes(layers) > 0, layers->count > 1);
    for (uint32_t i = 1; i < MW_MAX_LAYERS; i++) {
        if (i < layers->count)
            assert_in_range(vertices[i], 3, vertices[i - 1] - 1);
        else
            assert_int_equal(vertices[i], 0);
    }
    for (uint32_t i = 0; i + 1 < layers->count; i++)
        check_layer(&layers->layer[i], i == 0 ? tiling : &layers->layer[i - 1].tiling);
}

static mw_point query(const mw_tiling *tiling, uint64_t *random)
{
    mw_point v = tiling->point[mw__random_below(random, tiling->point_count)];
    switch (mw__random_below(random, 4)) {
    case 0: return v;
    case 1: return (mw_point){1e9 * (random_unit(random) - 0.5), 1e9 * (random_unit(random) - 0.5)};
    case 2: return (mw_point){1e300 * (random_unit(random) - 0.5), -1e308};
    default: return (mw_point){v.x + random_unit(random) - 0.5, v.y + random_unit(random) - 0.5};
    }
}

/* Every walk goes down to a tile, and to the same one whether it counts or not. */
static void descend(mw_layers *layers, const mw_tiling *tiling, uint64_t *random)
{
    for (int walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++)
        for (int i = 0; i < 4 * DESCENTS; i++) {
            mw_layer_walk how = {(mw_walk_kind)walk, MW_WALK_STOCHASTIC, i % 2, true, NULL};
            layers->descent = (mw_descent)(i / 4);
            mw_point q = query(tiling, random);
            uint64_t seed = mw__random(random), same = seed;
            mw_work work = {0};
            uint32_t t = mw__layers_first(layers, q, &how, &seed, &work);
            assert_true(t < tiling->tri_count);
            assert_true(work.visited >= layers->count - 1);
            how.count = false;
            assert_int_equal(mw__layers_first(layers, q, &how, &same, NULL), t);
        }
}

static void test_structure(void **state)
{
    (void)state;
    uint64_t seed = 20, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    static const double ratio[] = {0, 0.001, 0.1, 0.5, 0.99};
    for (int i = 0; i < MESHES; i++) {
        mw_mesh *mesh = mesh_number(i, &random);
        mw_tiling tiling;
        assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                         MW_OK);
        for (uint32_t wanted = 0; wanted <= MW_MAX_LAYERS; wanted++)
            for (size_t r = 0; r < sizeof ratio / sizeof *ratio; r++) {
                mw_layers layers;
                mw_layers_options options = {
                    .layers = wanted, .ratio = ratio[r], .seed = mw__random(&random)};
                assert_int_equal(mw__layers_create(&tiling, &options, MW_ALONE, &layers, NULL),
                                 MW_OK);
                check_layers(&layers, &tiling, wanted);
                descend(&layers, &tiling, &random);
                mw__layers_release(&layers);
            }
        mw__tiling_release(&tiling);
        mw_mesh_destroy(mesh);
    }
}

/* How many layers of how many vertices: by the rule, as asked for, or what there can be. */
static void test_sizes(void **state)
{
    (void)state;
    static const struct {
        uint32_t points, asked;
        double ratio;
        uint32_t count;
    } cases[] = {{50, 0, 0, 1},      {100, 0, 0, 2},      {1000, 0, 0, 2},   {10000, 0, 0, 3},
                 {100000, 0, 0, 3},  {10000, 1, 0, 1},    {10000, 2, 0, 2},  {10000, 5, 0.5, 5},
                 {10000, 0, 0.5, 7}, {10000, 0, 0.99, 8}, {10000, 8, 0.2, 6}};
    uint64_t random = 21;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_mesh *mesh = points_mesh(cases[i].points, random_unit, &random);
        mw_tiling tiling;
        mw_layers layers;
        assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                         MW_OK);
        mw_layers_options options = {.layers = cases[i].asked, .ratio = cases[i].ratio};
        assert_int_equal(mw__layers_create(&tiling, &options, MW_ALONE, &layers, NULL), MW_OK);
        uint32_t vertices[MW_MAX_LAYERS];
        mw__layers_describe(&layers, vertices);
        assert_int_equal(layers.count, cases[i].count);
        assert_int_equal(vertices[0], cases[i].points);
        double ratio = cases[i].ratio > 0 ? cases[i].ratio : 0.025;
        for (uint32_t k = 1; k < layers.count; k++)
            assert_int_equal(vertices[k], fmax(3, round(ratio * vertices[k - 1])));
        mw__layers_release(&layers);
        mw__tiling_release(&tiling);
        mw_mesh_destroy(mesh);
    }
}

/* Flat or missing layers end the hierarchy; the descent then gives any tile. */
static void test_no_layer(void **state)
{
    (void)state;
    uint64_t random = 22;
    arrays flat = arrays_make(60, 0); /* all but one on a line */
    for (int i = 0; i <= 50; i++) arrays_point(&flat, i, 0);
    arrays_point(&flat, 25.5, 0.5);
    mw_mesh *mesh = delaunay_of(&flat);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    mw_layers layers;
    assert_int_equal(mw__layers_create(&tiling,
                                       &(mw_layers_options){.layers = 3, .ratio = 1e-9, .seed = 1},
                                       MW_ALONE, &layers, NULL),
                     MW_OK);
    assert_int_equal(layers.count, 1);
    bool seen[64] = {false};
    mw_layer_walk how = {MW_WALK_REMEMBERING, MW_WALK_REMEMBERING, true, true, NULL};
    mw_work work = {0};
    for (int i = 0; i < 2000; i++)
        seen[mw__layers_first(&layers, (mw_point){1, 0}, &how, &random, &work)] = true;
    for (uint32_t t = 0; t < tiling.tri_count; t++) assert_true(seen[t]);
    assert_int_equal(work.visited, 0);
    mw__layers_release(&layers);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

/* Points that are not finite, or equal, in a mesh that is no embedding. */
static void test_any(void **state)
{
    (void)state;
    uint64_t random = 23;
    arrays a = arrays_grid(20, 0, &random);
    for (uint32_t i = 0; i < a.point_count; i += 7) a.points[2 * i] = i % 2 ? NAN : INFINITY;
    for (uint32_t i = 3; i < a.point_count; i += 5)
        memcpy(a.points + 2 * i, a.points, 2 * sizeof *a.points);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.tolerant = 1});
    mw_tiling tiling;
    assert_int_equal(
        mw__tiling_create(mesh, (mw_tiling_options){.any = true}, MW_ALONE, &tiling, NULL), MW_OK);
    mw_layers layers;
    assert_int_equal(mw__layers_create(&tiling, &(mw_layers_options){.layers = 4, .ratio = 0.5},
                                       MW_ALONE, &layers, NULL),
                     MW_OK);
    assert_true(layers.count > 2);
    check_layers(&layers, &tiling, 4);
    descend(&layers, &tiling, &random);
    mw__layers_release(&layers);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
    arrays_free(&a);
}

/* The walk in the mesh that begins where the descent ended: its tiles, on average. To points
 * inside of tiles, since on edges some walks go round in cycles in plain doubles. */
static double mean_walk(const mw_tiling *tiling, const mw_layers *layers, const mw_layer_walk *how,
                        uint64_t *random)
{
    enum { QUERIES = 500 };
    mw_arithmetic arithmetic = how->exact ? MW_EXACT : MW_DOUBLE;
    double sum = 0;
    for (int i = 0; i < QUERIES; i++) {
        const mw_triangle *near = &tiling->tri[mw__random_below(random, tiling->tri_count)];
        mw_point a = tiling->point[near->v[0]], b = tiling->point[near->v[1]],
                 c = tiling->point[near->v[2]];
        mw_point q = {0.5 * a.x + 0.3 * b.x + 0.2 * c.x, 0.5 * a.y + 0.3 * b.y + 0.2 * c.y};
        mw_work work = {0};
        uint32_t t = mw__layers_first(layers, q, how, random, &work);
        mw_walk walk = mw__walk_begin(tiling, q, t, mw__walk_fuel(how->walk, arithmetic, tiling),
                                      mw__random(random), &work);
        work = (mw_work){.visited = 1};
        mw__walk_kernels(how->walk, tiling)->run[how->exact][true](&walk);
        sum += (double)work.visited;
    }
    return sum / QUERIES;
}

static void check_near(mw_mesh *mesh)
{
    uint64_t random = 24;
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    mw_layers layers;
    assert_int_equal(mw__layers_create(&tiling, &(mw_layers_options){0}, MW_ALONE, &layers, NULL),
                     MW_OK);
    for (int walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++)
        for (int i = 0; i < 2 * DESCENTS; i++) {
            mw_layer_walk how = {(mw_walk_kind)walk, MW_WALK_REMEMBERING, i % 2, true, NULL};
            layers.descent = (mw_descent)(i / 2);
            assert_true(mean_walk(&tiling, &layers, &how, &random) < 40);
        }
    mw__layers_release(&layers);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

static void test_near(void **state)
{
    (void)state;
    uint64_t random = 25;
    check_near(points_mesh(20000, random_unit, &random));
    check_near(points_mesh(20000, gaussian, &random));
    check_near(points_mesh(20000, clustered, &random));
}

static double distance2(mw_point a, mw_point b)
{
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/* The walks that know the orientation coordinates of q in the tile where they end. */
static bool has_coordinates(int walk)
{
    return walk == MW_WALK_DIRECT || walk == MW_WALK_BARYCENTRIC;
}

static uint32_t nearest(const mw_tiling *tiling, uint32_t t, mw_point q)
{
    const uint32_t *v = tiling->tri[t].v;
    uint32_t best = 0;
    for (uint32_t k = 1; k < 3; k++)
        if (distance2(tiling->point[v[k]], q) < distance2(tiling->point[v[best]], q)) best = k;
    return v[best];
}

static uint32_t heaviest(const mw_tiling *tiling, uint32_t t, mw_point q)
{
    const uint32_t *v = tiling->tri[t].v;
    double weight[3];
    for (uint32_t k = 0; k < 3; k++)
        weight[k] = mw__orient2d(tiling->point[v[mw__next(k)]], tiling->point[v[mw__prev(k)]], q);
    return v[weight[0] > weight[1] ? weight[0] > weight[2] ? 0 : 2 : weight[1] > weight[2] ? 1 : 2];
}

/* One layer above the mesh: the descent is one walk in it, counted as any other, then a vertex of
 * its last tile. */
static void try_descent(mw_layers *layers, int walk, mw_descent descent, mw_point q, uint64_t seed)
{
    const mw_tiling *top = &layers->layer[0].tiling;
    uint64_t same = seed;
    uint32_t t = mw__random_below(&seed, top->tri_count);
    mw_work expected = {.comparisons = 7};
    mw_walk w = mw__walk_begin(top, q, t, 100000, mw__random(&seed), &expected);
    mw_verdict verdict = mw__walk_kernels((mw_walk_kind)walk, top)->run[true][true](&w);
    if (verdict == MW_VERDICT_UNSURE && !has_coordinates(walk))
        mw__walk_finish(&w, MW_WALK_REMEMBERING, 100000, top, true, true);
    if (descent == MW_DESCENT_COORDINATE && !has_coordinates(walk))
        expected.orient[MW_STAGE_WALK] += 2;
    bool heavy = descent == MW_DESCENT_COORDINATE;

    mw_work work = {.comparisons = 7};
    mw_layer_walk how = {(mw_walk_kind)walk, MW_WALK_REMEMBERING, true, true, NULL};
    layers->descent = descent;
    uint32_t first = mw__layers_first(layers, q, &how, &same, &work);
    assert_true(same == seed);
    assert_int_equal(first,
                     layers->layer[0].below[heavy ? heaviest(top, w.t, q) : nearest(top, w.t, q)]);
    assert_memory_equal(&work, &expected, sizeof work);
}

static void test_descent(void **state)
{
    (void)state;
    uint64_t random = 26;
    mw_mesh *mesh = points_mesh(5000, random_unit, &random);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    mw_layers layers;
    assert_int_equal(
        mw__layers_create(&tiling, &(mw_layers_options){.layers = 2}, MW_ALONE, &layers, NULL),
        MW_OK);
    for (int i = 0; i < 300; i++) {
        mw_point q = {1.2 * random_unit(&random) - 0.1, 1.2 * random_unit(&random) - 0.1};
        for (int walk = MW_WALK_AUTO + 1; walk < MW_WALK_COUNT; walk++)
            for (int descent = MW_DESCENT_AUTO; descent < DESCENTS; descent++)
                try_descent(&layers, walk, (mw_descent)descent, q, mw__random(&random));
    }
    mw__layers_release(&layers);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

static void test_seed(void **state)
{
    (void)state;
    uint64_t random = 27;
    mw_mesh *mesh = points_mesh(5000, random_unit, &random);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    mw_layers layers[3];
    for (uint64_t i = 0; i < 3; i++)
        assert_int_equal(mw__layers_create(&tiling, &(mw_layers_options){.seed = i / 2}, MW_ALONE,
                                           &layers[i], NULL),
                         MW_OK);
    const mw_tiling *one = &layers[0].layer[0].tiling, *same = &layers[1].layer[0].tiling;
    const mw_tiling *other = &layers[2].layer[0].tiling;
    assert_int_equal(one->point_count, same->point_count);
    assert_memory_equal(one->point, same->point, one->point_count * sizeof *one->point);
    assert_true(one->point_count != other->point_count ||
                memcmp(one->point, other->point, one->point_count * sizeof *one->point) != 0);
    for (int i = 0; i < 3; i++) mw__layers_release(&layers[i]);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

/* Every vertex has the same chance to be in the next layer. */
static void test_chance(void **state)
{
    (void)state;
    enum { POINTS = 12, SEEDS = 4000 };
    uint64_t random = 33;
    mw_mesh *mesh = points_mesh(POINTS, random_unit, &random);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    int times[POINTS] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        mw_layers layers;
        mw_layers_options options = {.layers = 2, .ratio = 0.25, .seed = seed};
        assert_int_equal(mw__layers_create(&tiling, &options, MW_ALONE, &layers, NULL), MW_OK);
        assert_int_equal(layers.layer[0].tiling.point_count, POINTS / 4);
        for (int v = 0; v < POINTS; v++)
            times[v] += has_point(&layers.layer[0].tiling, 0, tiling.point[v]);
        mw__layers_release(&layers);
    }
    /* 6 sigma */
    for (int v = 0; v < POINTS; v++) assert_in_range(times[v], SEEDS / 4 - 160, SEEDS / 4 + 160);
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

static void test_options(void **state)
{
    (void)state;
    uint64_t random = 28;
    mw_mesh *mesh = grid(4, 0, 0, &random);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    const mw_layers_options wrong[] = {{.layers = MW_MAX_LAYERS + 1},
                                       {.ratio = -0.1},
                                       {.ratio = 1},
                                       {.ratio = INFINITY},
                                       {.ratio = NAN},
                                       {.descent = (mw_descent)-1},
                                       {.descent = (mw_descent)DESCENTS}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        mw_layers layers;
        mw_error error;
        assert_int_equal(mw__layers_create(&tiling, &wrong[i], MW_ALONE, &layers, &error),
                         MW_ERROR_ARGUMENT);
        assert_int_equal(error.status, MW_ERROR_ARGUMENT);
        mw__layers_release(&layers);
    }
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

static mw_index *index_of(const mw_locator *locator, const mw_index_options *options)
{
    mw_index *index;
    assert_int_equal(mw_index_create(locator, MW_START_LAYERS, options, &index, NULL), MW_OK);
    return index;
}

static double *queries_in(const mw_mesh *mesh, size_t n, uint64_t *random)
{
    double *q = malloc(n * 2 * sizeof *q);
    for (size_t i = 0; i < n; i++) {
        double *at = q + 2 * i;
        mw_mesh_vertex(mesh, mw__random_below(random, mw_mesh_vertex_count(mesh)), at);
        if (i % 4 == 1) at[0] = nextafter(at[0], INFINITY);
        if (i % 4 > 1) at[0] += random_unit(random) - 0.5;
        if (i % 4 > 1) at[1] += random_unit(random) - 0.5;
        if (i % 64 == 3) at[1] *= 1e12;
    }
    return q;
}

/* An index of one mesh, or of another, gives the answers that are given without it. */
static void test_answers(void **state)
{
    (void)state;
    enum { N = 400 };
    uint64_t seed = 30, random = seed;
    printf("seed %llu\n", (unsigned long long)seed);
    static mw_location want[N], have[N];
    mw_mesh *other = points_mesh(5000, random_unit, &random);
    mw_locator *elsewhere = mesh_locator(other, (mw_locator_options){0});
    for (int i = 0; i < MESHES; i++) {
        mw_mesh *mesh = mesh_number(i, &random);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_index *index[] = {index_of(locator, NULL),
                             index_of(locator, &(mw_index_options){.layers = 4, .ratio = 0.3}),
                             index_of(elsewhere, NULL)};
        double *q = queries_in(mesh, N, &random);
        mw_query_options plain = {.start = MW_START_RANDOM};
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &plain, want, NULL, NULL), MW_OK);
        for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++)
            for (int k = 0; k < 6; k++) {
                mw_query_options options = {.walk = (mw_walk_kind)walk,
                                            .start = k % 2 ? MW_START_LAYERS : MW_START_AUTO,
                                            .arithmetic = k % 2 ? MW_EXACT : MW_DOUBLE,
                                            .lanes = 1 + 7 * (uint32_t)(k % 3),
                                            .seed = mw__random(&random),
                                            .index = index[k / 2]};
                assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, have, NULL, NULL),
                                 MW_OK);
                assert_memory_equal(want, have, sizeof want);
            }
        free(q);
        for (int k = 0; k < 3; k++) mw_index_destroy(index[k]);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
    mw_locator_destroy(elsewhere);
    mw_mesh_destroy(other);
}

/* What the index tells of itself. */
static void test_describe(void **state)
{
    (void)state;
    uint64_t random = 31;
    mw_mesh *mesh = points_mesh(20000, random_unit, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    mw_index *few = index_of(locator, NULL),
             *many = index_of(locator, &(mw_index_options){.layers = 8, .ratio = 0.5});
    mw_index_info info[2];
    mw_index_describe(few, &info[0]);
    mw_index_describe(many, &info[1]);
    assert_int_equal(info[0].start, MW_START_LAYERS);
    assert_int_equal(info[0].layers, 3);
    assert_int_equal(info[0].vertices[0], 20000);
    assert_int_equal(info[0].vertices[1], 500);
    assert_int_equal(info[0].vertices[3], 0);
    assert_int_equal(info[1].layers, 8);
    assert_int_equal(info[1].vertices[7], 157);
    assert_true(info[0].bytes > 100 * info[0].vertices[1] && info[1].bytes > 30 * info[0].bytes);
    assert_true(info[0].seconds >= 0 && info[0].cells == 0);
    mw_index_options wrong[] = {{.layers = 9}, {.ratio = 1.5}, {.descent = (mw_descent)DESCENTS}};
    for (int i = 0; i < 3; i++) {
        mw_index *index;
        assert_int_equal(mw_index_create(locator, MW_START_LAYERS, &wrong[i], &index, NULL),
                         MW_ERROR_ARGUMENT);
        assert_null(index);
    }
    mw_index_destroy(few);
    mw_index_destroy(many);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* The counters of a query contain the layers: with one layer as with the mesh alone, with more
 * some tiles in each. */
static void test_counters(void **state)
{
    (void)state;
    enum { N = 2000 };
    uint64_t random = 32;
    static double q[2 * N];
    static mw_location at[N];
    mw_mesh *mesh = points_mesh(50000, random_unit, &random);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    for (int i = 0; i < 2 * N; i++) q[i] = random_unit(&random);
    double before = INFINITY;
    for (uint32_t layers = 1; layers <= 3; layers++) {
        mw_index *index = index_of(locator, &(mw_index_options){.layers = layers});
        mw_query_options options = {.walk = MW_WALK_STOCHASTIC, .counters = 1, .index = index};
        mw_counters sum, threads;
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &sum, NULL), MW_OK);
        double mean = (double)sum.triangles_visited / N;
        assert_int_equal(sum.triangles, sum.triangles_visited); /* it has one stage */
        assert_true(sum.orient > sum.triangles && mean >= layers && sum.triangles_max >= layers);
        assert_true(mean < before / 1.5);
        if (layers == 1) assert_true(mean > 150);
        before = mean;
        options.threads = 3;
        options.lanes = 5;
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &threads, NULL), MW_OK);
        assert_memory_equal(&sum, &threads, sizeof sum);
        mw_index_destroy(index);
        if (layers == 1) continue;
        options.index = index = index_of(locator, &(mw_index_options){.layers = layers, .seed = 1});
        assert_int_equal(mw_locate_batch(locator, q, N, 2, &options, at, &sum, NULL), MW_OK);
        assert_int_not_equal(sum.orient, threads.orient); /* other vertices */
        mw_index_destroy(index);
    }
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
}

/* Let allocation 0, 1, 2, ... fail until none does. */
static void test_memory(void **state)
{
    (void)state;
    uint64_t random = 29;
    mw_mesh *mesh = points_mesh(300, random_unit, &random);
    mw_tiling tiling;
    assert_int_equal(mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, NULL),
                     MW_OK);
    bool failed = true;
    for (long after = 0; failed; after++) {
        mw_layers layers;
        mw_error error = {0};
        allocations_left = after;
        mw_status status = mw__layers_create(
            &tiling, &(mw_layers_options){.layers = 3, .ratio = 0.3}, MW_ALONE, &layers, &error);
        failed = allocations_left < 0;
        allocations_left = -1;
        assert_int_equal(status, failed ? MW_ERROR_MEMORY : MW_OK);
        assert_int_equal(error.status, status);
        mw__layers_release(&layers);
        assert_true(failed || after > 20);
    }
    mw__tiling_release(&tiling);
    mw_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_structure), cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_no_layer),  cmocka_unit_test(test_any),
        cmocka_unit_test(test_near),      cmocka_unit_test(test_descent),
        cmocka_unit_test(test_seed),      cmocka_unit_test(test_chance),
        cmocka_unit_test(test_options),   cmocka_unit_test(test_memory),
        cmocka_unit_test(test_answers),   cmocka_unit_test(test_describe),
        cmocka_unit_test(test_counters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
