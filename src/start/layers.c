/* layers.c - the layered hierarchy [Mulmuley 1991; Devillers 2002, "The Delaunay hierarchy"; thesis App. C, sec. 2, 3].
 *
 * Vertices of a layer are kept with a small probability for the next, which is triangulated. A search walks in the
 * highest layer from any tile to q, goes down at a vertex near q of the tile found, walks in the layer below from a tile
 * at that vertex, and so on to the mesh. Every walk but the first is expected to be short, whatever the distribution of
 * the vertices.
 *
 * The vertex to go down at is the nearest one. Where the walk has the orientation coordinates of q, as the direct and the
 * barycentric walk have, it is the one with the largest, which costs no further test [thesis App. C, sec. 3].
 *
 * Beyond the papers, each layer also keeps the four corners of the one below, so that the smallest hold a triangle and
 * cover nearly all of the mesh, as in the thesis' measurements, where the corners of a rectangle do that. */
#include "start/layers.h"

#include "base/random.h"
#include "start/start.h"
#include "triangulate/delaunay.h"

#include <stdlib.h>
#include <string.h>

#define RATIO 0.025 /* the best exchange of time for memory on random vertices [Devillers 2002] */

/* By size: a mesh gets a layer where walks in it can be long, a layer another where walks in it are longer than what a
 * further layer costs, about 10 tiles. For a ratio of 0.025 these give the layers of the thesis' measurements: 2, 2, 3, 3,
 * 4, 4 for 10^2 to 10^7 vertices. */
enum { LARGE_MESH = 64, LARGE_LAYER = 200 };

enum { CORNERS = 4 };

/* --- building ---------------------------------------------------------------------------------------------------- */

/* Per vertex a tile that has it, MW_NONE where there is none; only for finite vertices. Returns NULL when out of memory. */
static uint32_t *tiles_at(const mw_tiling *tiling)
{
    uint32_t *at = mw__alloc(tiling->point_count, sizeof *at);
    if (!at) return NULL;
    for (uint32_t v = 0; v < tiling->point_count; v++) at[v] = MW_NONE;
    for (uint32_t t = tiling->tri_count; t-- > 0;)
        for (int k = 0; k < 3; k++)
            if (mw__is_finite(tiling->point[tiling->tri[t].v[k]])) at[tiling->tri[t].v[k]] = t;
    return at;
}

/* The vertices to choose from, and how. */
typedef struct choice {
    const mw_tiling *tiling;
    const uint32_t *at;
    uint64_t seed;
    double ratio;
    uint32_t corner[CORNERS];
} choice;

/* Find the vertices farthest along the four diagonals: the corners, where the hull is a rectangle. */
static void find_corners(choice *c)
{
    double far[CORNERS] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < c->tiling->point_count; v++) {
        if (c->at[v] == MW_NONE) continue;
        double x = c->tiling->point[v].x / 2, y = c->tiling->point[v].y / 2; /* halves: sums do not overflow */
        double along[CORNERS] = {x + y, x - y, -x + y, -x - y};
        for (int i = 0; i < CORNERS; i++)
            if (along[i] > far[i]) {
                far[i] = along[i];
                c->corner[i] = v;
            }
    }
}

static bool is_kept(const choice *c, uint32_t v)
{
    if (c->at[v] == MW_NONE) return false;
    for (int i = 0; i < CORNERS; i++)
        if (v == c->corner[i]) return true;
    return (double)(mw__random_seed(c->seed, v) >> 11) * 0x1p-53 < c->ratio;
}

/* Fill point and below of *layer with the vertices kept. Returns false when out of memory. */
static bool keep(const choice *c, mw_layer *layer)
{
    uint32_t n = 0;
    for (uint32_t v = 0; v < c->tiling->point_count; v++) n += is_kept(c, v);
    layer->tiling.point = mw__alloc_lines(n, sizeof *layer->tiling.point);
    layer->below = mw__alloc(n, sizeof *layer->below);
    if (!layer->tiling.point || !layer->below) return false;
    for (uint32_t v = 0; v < c->tiling->point_count; v++) {
        if (!is_kept(c, v)) continue;
        layer->tiling.point[layer->tiling.point_count] = c->tiling->point[v];
        layer->below[layer->tiling.point_count++] = c->at[v];
    }
    return true;
}

/* Number the vertices in the order in which the tiles use them; one that merged with another is dropped. */
static mw_status order_vertices(mw_layer *layer, mw_error *error)
{
    mw_tiling *tiling = &layer->tiling;
    uint32_t n = tiling->point_count, next = 0;
    uint32_t *place = mw__alloc(n, sizeof *place), *below = mw__alloc(n, sizeof *below);
    mw_point *point = mw__alloc_lines(n, sizeof *point);
    if (!place || !below || !point) {
        free(place);
        free(below);
        free(point);
        return mw__fail_memory(error);
    }
    memset(place, 0xff, n * sizeof *place); /* MW_NONE */
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (int k = 0; k < 4; k++) {
            uint32_t v = tiling->tri[t].v[k];
            if (place[v] == MW_NONE) {
                place[v] = next;
                point[next] = tiling->point[v];
                below[next++] = layer->below[v];
            }
            tiling->tri[t].v[k] = place[v];
        }
    free(place);
    free(tiling->point);
    free(layer->below);
    tiling->point = point;
    tiling->point_count = next;
    layer->below = below;
    return MW_OK;
}

/* Fill in the layer above a tiling. MW_ERROR_INPUT where there is none. */
static mw_status build(choice *c, uint32_t vertices, mw_layer *layer, mw_error *error)
{
    mw_tiling *tiling = &layer->tiling;
    find_corners(c);
    if (!keep(c, layer)) return mw__fail_memory(error);
    if (tiling->point_count == vertices) return mw__fail(error, MW_ERROR_INPUT, "no fewer vertices than below");
    mw_status status =
        mw__delaunay_triangles(tiling->point, tiling->point_count, NULL, NULL, &tiling->tri, &tiling->tri_count, error);
    if (!status) status = order_vertices(layer, error);
    if (!status) status = mw__tiling_areas(tiling, error);
    return status;
}

static void release_layer(mw_layer *layer)
{
    mw__tiling_release(&layer->tiling);
    free(layer->below);
    layer->below = NULL;
}

/* Vertices of layer i, the mesh being 0. */
static uint32_t vertex_count(const mw_layers *layers, uint32_t i)
{
    return i == 0 ? layers->vertices : layers->layer[i - 1].tiling.point_count;
}

/* Put a layer above the highest, `tiling`, of which `at` has the tiles; or lower *wanted where there is none. */
static mw_status add(mw_layers *layers, const mw_tiling *tiling, const uint32_t *at, const mw_layers_options *options,
                     uint32_t *wanted, mw_error *error)
{
    mw_layer *layer = &layers->layer[layers->count - 1];
    choice c = {.tiling = tiling,
                .at = at,
                .seed = mw__random_seed(options->seed, layers->count),
                .ratio = options->ratio > 0 ? options->ratio : RATIO};
    mw_error reason;
    layer->tiling.embedding = true;
    mw_status status = build(&c, vertex_count(layers, layers->count - 1), layer, &reason);
    if (!status) {
        layers->count++;
        return MW_OK;
    }
    release_layer(layer);
    *wanted = layers->count;
    if (status == MW_ERROR_INPUT) return MW_OK;
    if (error) *error = reason;
    return status;
}

/* How many layers by the size of the mesh: by its vertices, and what is expected of them in each layer. */
static uint32_t layers_by_size(uint32_t vertices, double ratio)
{
    if (vertices <= LARGE_MESH) return 1;
    uint32_t layers = 2;
    for (double size = ratio * vertices; size > LARGE_LAYER && layers < MW_MAX_LAYERS; size *= ratio) layers++;
    return layers;
}

static uint32_t count_used(const uint32_t *at, uint32_t n)
{
    uint32_t used = 0;
    for (uint32_t v = 0; v < n; v++) used += at[v] != MW_NONE;
    return used;
}

static mw_status check(const mw_layers_options *options, mw_error *error)
{
    if (options->layers > MW_MAX_LAYERS)
        return mw__fail(error, MW_ERROR_ARGUMENT, "%u layers, at most %d are possible", options->layers, MW_MAX_LAYERS);
    if (!(options->ratio >= 0 && options->ratio < 1))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the ratio of layers is not between 0 and 1");
    if (options->descent < 0 || options->descent >= MW_DESCENTS)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown descent through layers");
    return MW_OK;
}

mw_status mw__layers_create(const mw_tiling *tiling, const mw_layers_options *options, mw_layers *out, mw_error *error)
{
    *out = (mw_layers){.count = 1, .tiles = tiling->tri_count, .descent = (mw_descent)options->descent};
    mw_status status = check(options, error);
    if (status) return status;
    uint32_t *at = tiles_at(tiling), wanted = options->layers;
    if (at) out->vertices = count_used(at, tiling->point_count);
    if (wanted == 0) wanted = layers_by_size(out->vertices, options->ratio > 0 ? options->ratio : RATIO);
    while (at && !status && out->count < wanted) {
        status = add(out, tiling, at, options, &wanted, error);
        free(at);
        if (out->count > 1) tiling = &out->layer[out->count - 2].tiling;
        at = tiles_at(tiling);
    }
    if (!at && !status) status = mw__fail_memory(error);
    free(at);
    return status;
}

void mw__layers_release(mw_layers *layers)
{
    for (uint32_t i = 0; i + 1 < layers->count; i++) release_layer(&layers->layer[i]);
    layers->count = 1;
}

size_t mw__layers_bytes(const mw_layers *layers)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i + 1 < layers->count; i++) {
        const mw_tiling *t = &layers->layer[i].tiling;
        bytes += t->tri_count * (sizeof *t->tri + sizeof *t->area) +
                 t->point_count * (sizeof *t->point + sizeof *layers->layer[i].below);
    }
    return bytes;
}

void mw__layers_describe(const mw_layers *layers, uint32_t vertices[MW_MAX_LAYERS])
{
    for (uint32_t i = 0; i < MW_MAX_LAYERS; i++) vertices[i] = i < layers->count ? vertex_count(layers, i) : 0;
}

/* --- the search -------------------------------------------------------------------------------------------------- */

/* Does the walk know the orientation coordinates of q in the tile where it ends? Such a walk goes on wherever one of
 * them is negative, so that its tile is good enough to go down from. */
static bool has_coordinates(mw_walk_kind walk)
{
    (void)walk;
    return false;
}

/* Let a walk that begins count from *work on. */
static void count_on(mw_walk *walk, const mw_work *work)
{
    walk->work = *work;
    walk->work.visited++;
    walk->work.triangles[walk->stage]++;
}

/* The tile of q in a layer, from the tile where *walk begins; in *walk. */
static void find(const mw_tiling *tiling, const mw_layer_walk *how, mw_walk *walk)
{
    const mw_kernels *kernels = mw__walk_kernels(how->walk, tiling);
    mw_verdict verdict = kernels->run[how->exact][how->count](walk);
    if (verdict != MW_CLOSE || has_coordinates(how->walk)) return;
    uint32_t fuel = mw__walk_fuel(how->finish, how->exact ? MW_EXACT : MW_DOUBLE, tiling);
    mw__walk_finish(walk, how->finish, fuel, tiling, how->exact, how->count);
}

static uint32_t nearest(const mw_walk *walk)
{
    const uint32_t *v = walk->tri[walk->t].v;
    uint32_t best = v[0];
    for (int k = 1; k < 3; k++)
        if (mw__distance2(walk->point[v[k]], walk->q) < mw__distance2(walk->point[best], walk->q)) best = v[k];
    return best;
}

/* The vertex with the largest orientation coordinate: opposite to the edge that makes the largest triangle with q. Two
 * tests, which the walks that know the coordinates have made already. */
static uint32_t most_weight(mw_walk *walk, const mw_layer_walk *how)
{
    const uint32_t *v = walk->tri[walk->t].v;
    const mw_point *p = walk->point;
    double at0 = mw__orient2d_double(p[v[1]], p[v[2]], walk->q), at1 = mw__orient2d_double(p[v[2]], p[v[0]], walk->q);
    double at2 = walk->area[walk->t] - at0 - at1;
    if (how->count && !has_coordinates(how->walk)) walk->work.orient[MW_STAGE_WALK] += 2;
    if (at0 >= at1 && at0 >= at2) return v[0];
    return at1 >= at2 ? v[1] : v[2];
}

uint32_t mw__layers_first(const mw_layers *layers, mw_point q, const mw_layer_walk *how, uint64_t *random,
                          mw_work *work)
{
    bool by_weight = layers->descent == MW_DESCENT_COORDINATE ||
                     (layers->descent == MW_DESCENT_BY_WALK && has_coordinates(how->walk));
    mw_arithmetic arithmetic = how->exact ? MW_EXACT : MW_DOUBLE;
    uint32_t top = layers->count - 1;
    uint32_t t = mw__random_below(random, top ? layers->layer[top - 1].tiling.tri_count : layers->tiles);
    for (uint32_t i = top; i-- > 0;) {
        const mw_layer *layer = &layers->layer[i];
        uint32_t fuel = mw__walk_fuel(how->walk, arithmetic, &layer->tiling);
        mw_walk walk = mw__walk_begin(&layer->tiling, q, t, fuel, mw__random(random));
        if (how->count) count_on(&walk, work);
        find(&layer->tiling, how, &walk);
        t = layer->below[by_weight ? most_weight(&walk, how) : nearest(&walk)];
        if (how->count) *work = walk.work;
    }
    return t;
}
