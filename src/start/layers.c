/* layers.c - the layered hierarchy [Mulmuley 1991; Devillers 2002, "The Delaunay hierarchy"; thesis
 * App. C, sec. 2, 3].
 *
 * A small share of the vertices of a layer, chosen at random, is triangulated and makes the next
 * layer. A search walks in the highest layer from any tile to q, goes down at a vertex near q of
 * the tile found, walks in the layer below from a tile at that vertex, and so on to the mesh. Every
 * walk but the first is expected to be short, whatever the distribution of the vertices.
 *
 * The vertex to go down at is the nearest one, which takes three distances. On request it is the
 * one with the largest orientation coordinate of q, which the direct and the barycentric walk know
 * already and other walks compute [thesis App. C, sec. 3]. Then walks are longer
 * (docs/measurements/published-tables.md, C2). */
#include "start/layers.h"

#include "base/random.h"
#include "start/start.h"
#include "triangulate/delaunay/delaunay.h"
#include "walk/value.h"

#include <stdlib.h>
#include <string.h>

/* The number of layers by default. A mesh gets a layer if walks in it can be long. A layer of n
 * vertices gets another one above it if that is expected to save tiles: with it, a walk in the
 * layer visits about 9 tiles, without it 1.1 sqrt(n). That pays from 100 vertices on, but little up
 * to 200. A limit of 200, with a ratio of 0.025, gives the layers of the thesis' measurements: 2,
 * 2, 3, 3, 4, 4 for 10^2 to 10^7 vertices. */
enum { LARGE_MESH = 64, LARGE_LAYER = 200 };

/* --- building --- */

/* How many of `vertices` vertices the layer above has. */
static uint32_t layer_size_above(uint32_t vertices, double ratio)
{
    double size = round(ratio * vertices);
    return size > 3 ? (uint32_t)size : 3;
}

/* Fill point and below of *layer with `size` of the `vertices` vertices that have a tile, every set
 * of them with the same chance [Fan, Muller, Rezucha 1962]. Returns false when out of memory. */
static bool layer_choose(const mw_tiling *tiling, const uint32_t *at, uint32_t vertices,
                         uint32_t size, uint64_t random, mw_layer *layer)
{
    layer->tiling.point = mw__alloc_lines(size, sizeof *layer->tiling.point);
    layer->below = mw__alloc(size, sizeof *layer->below);
    if (!layer->tiling.point || !layer->below) return false;
    for (uint32_t v = 0, i = 0; i < size; v++) {
        if (at[v] == MW_NONE || mw__random_below(&random, vertices--) >= size - i) continue;
        layer->tiling.point[i] = tiling->point[v];
        layer->below[i++] = at[v];
    }
    layer->tiling.point_count = size;
    return true;
}

/* Number the vertices in the order in which the tiles use them; one that merged with another is
 * dropped. */
static mw_status layer_order_vertices(mw_layer *layer, mw_error *error)
{
    mw_tiling *tiling = &layer->tiling;
    uint32_t n = tiling->point_count, next = 0;
    uint32_t *slot = mw__alloc(n, sizeof *slot), *below = mw__alloc(n, sizeof *below);
    mw_point *point = mw__alloc_lines(n, sizeof *point);
    if (!slot || !below || !point) {
        free(slot);
        free(below);
        free(point);
        return mw__fail_memory(error);
    }
    memset(slot, 0xff, n * sizeof *slot); /* MW_NONE */
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        for (int k = 0; k < 4; k++) {
            uint32_t v = tiling->tri[t].v[k];
            if (slot[v] == MW_NONE) {
                slot[v] = next;
                point[next] = tiling->point[v];
                below[next++] = layer->below[v];
            }
            tiling->tri[t].v[k] = slot[v];
        }
    free(slot);
    free(tiling->point);
    free(layer->below);
    tiling->point = point;
    tiling->point_count = next;
    layer->below = below;
    return MW_OK;
}

/* Triangulate the points of a layer. MW_ERROR_INPUT where they lie on one line. */
static mw_status layer_triangulate(mw_layer *layer, mw_job *job, mw_error *error)
{
    mw_tiling *tiling = &layer->tiling;
    mw_status status = mw__delaunay_triangles(tiling->point, tiling->point_count, job, NULL, NULL,
                                              &tiling->tri, &tiling->tri_count, error);
    if (!status) status = layer_order_vertices(layer, error);
    if (!status) status = mw__tiling_areas(tiling, error);
    return status;
}

static void layer_release(mw_layer *layer)
{
    mw__tiling_release(&layer->tiling);
    free(layer->below);
    layer->below = NULL;
}

/* Vertices of layer i, the mesh being 0. */
static uint32_t layer_vertex_count(const mw_layers *layers, uint32_t i)
{
    return i == 0 ? layers->vertices
                  : layers->layer[i - 1].tiling.point_count - layers->layer[i - 1].vacant;
}

/* Put a layer of `size` vertices above the highest one, which is `tiling`; `at` has its tiles. */
static mw_status layers_add(mw_layers *layers, const mw_tiling *tiling, const uint32_t *at,
                            uint32_t size, uint64_t seed, mw_job *job, mw_error *error)
{
    mw_layer *layer = &layers->layer[layers->count - 1];
    uint32_t vertices = layer_vertex_count(layers, layers->count - 1);
    layer->tiling.embedding = true;
    bool chosen =
        layer_choose(tiling, at, vertices, size, mw__random_seed(seed, layers->count), layer);
    mw_status status = chosen ? layer_triangulate(layer, job, error) : mw__fail_memory(error);
    if (status)
        layer_release(layer);
    else
        layers->count++;
    return status;
}

/* How many layers for a mesh of that many vertices. */
static uint32_t layers_by_size(uint32_t vertices, double ratio)
{
    if (vertices <= LARGE_MESH) return 1;
    uint32_t layers = 2;
    for (uint32_t size = layer_size_above(vertices, ratio);
         size > LARGE_LAYER && layers < MW_MAX_LAYERS; layers++)
        size = layer_size_above(size, ratio);
    return layers;
}

static uint32_t layer_vertices_in_use(const uint32_t *at, uint32_t n)
{
    uint32_t used = 0;
    for (uint32_t v = 0; v < n; v++) used += at[v] != MW_NONE;
    return used;
}

static mw_status layers_check(const mw_layers_options *options, mw_error *error)
{
    if (options->layers > MW_MAX_LAYERS)
        return mw__fail(error, MW_ERROR_ARGUMENT, "%u layers are too many; at most %d are possible",
                        options->layers, MW_MAX_LAYERS);
    if (!(options->ratio >= 0 && options->ratio < 1))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the ratio of layers must lie between 0 and 1");
    if ((unsigned)options->descent > MW_DESCENT_COORDINATE)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown descent through layers");
    return MW_OK;
}

mw_status mw__layers_create(const mw_tiling *tiling, const mw_layers_options *options, mw_job *job,
                            mw_layers *out, mw_error *error)
{
    *out = (mw_layers){.count = 1, .tiles = tiling->tri_count, .descent = options->descent};
    mw_status status = layers_check(options, error);
    if (status) return status;
    double ratio = options->ratio > 0 ? options->ratio : MW_LAYER_RATIO;
    uint32_t *at = mw__tile_of_vertices(tiling),
             size = at ? layer_vertices_in_use(at, tiling->point_count) : 0;
    uint32_t wanted = options->layers ? options->layers : layers_by_size(size, ratio);
    out->vertices = size;
    mw_error reason;
    double left = 1; /* of the job; the lowest layer has most of the vertices */
    while (at && !status && out->count < wanted && layer_size_above(size, ratio) < size) {
        mw_job_span outer = mw__job_part(job, left * (1 - ratio));
        status =
            layers_add(out, tiling, at, layer_size_above(size, ratio), options->seed, job, &reason);
        mw__job_part_end(job, outer);
        if (status) break;
        left *= ratio;
        tiling = &out->layer[out->count - 2].tiling;
        size = tiling->point_count;
        free(at);
        at = mw__tile_of_vertices(tiling);
    }
    if (!at) status = mw__fail_memory(&reason);
    free(at);
    if (status == MW_ERROR_INPUT) return MW_OK; /* the vertices of a layer lie on one line */
    if (status && error) *error = reason;
    return status;
}

void mw__layers_cut(mw_layers *layers, uint32_t count)
{
    while (layers->count > count) layer_release(&layers->layer[--layers->count - 1]);
}

void mw__layers_release(mw_layers *layers)
{
    mw__layers_cut(layers, 1);
}

size_t mw__layers_bytes(const mw_layers *layers)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i + 1 < layers->count; i++) {
        const mw_tiling *t = &layers->layer[i].tiling;
        bytes += mw__tiling_bytes(t) + t->point_count * sizeof *layers->layer[i].below;
    }
    return bytes;
}

void mw__layers_describe(const mw_layers *layers, uint32_t vertices[MW_MAX_LAYERS])
{
    for (uint32_t i = 0; i < MW_MAX_LAYERS; i++)
        vertices[i] = i < layers->count ? layer_vertex_count(layers, i) : 0;
}

/* --- the search --- */

/* Does the walk know the orientation coordinates of q in the tile where it ends? If so, none of
 * them is surely negative there, so the search can go down from that tile without the final
 * location. */
static bool walk_has_coordinates(mw_walk_kind walk)
{
    return walk == MW_WALK_DIRECT || walk == MW_WALK_BARYCENTRIC;
}

/* The tile of q in a layer, from the tile where *walk begins; in *walk. */
static void layer_find(const mw_tiling *tiling, const mw_layer_walk *how, mw_walk *walk)
{
    const mw_kernels *kernels = mw__walk_kernels(how->walk, tiling);
    mw_verdict verdict = kernels->run[how->exact][how->count](walk);
    if (verdict != MW_VERDICT_UNSURE || walk_has_coordinates(how->walk)) return;
    uint32_t fuel = mw__walk_fuel(how->finish, how->exact ? MW_EXACT : MW_DOUBLE, tiling);
    mw__walk_finish(walk, how->finish, fuel, tiling, how->exact, how->count);
}

static uint32_t layer_nearest(const mw_walk *walk)
{
    const uint32_t *v = walk->tri[walk->t].v;
    uint32_t best = v[0];
    for (int k = 1; k < 3; k++)
        if (mw__distance2(walk->point[v[k]], walk->q) < mw__distance2(walk->point[best], walk->q))
            best = v[k];
    return best;
}

/* The vertex with the largest orientation coordinate: opposite to the edge that makes the largest
 * triangle with q. The walks that know the coordinates pass it on; for others two tests are made,
 * and one for the area if none is stored. */
static uint32_t layer_heaviest(mw_walk *walk, const mw_layer_walk *how)
{
    const uint32_t *v = walk->tri[walk->t].v;
    if (walk_has_coordinates(how->walk)) return v[walk->heaviest];
    const mw_point *p = walk->point;
    double at0 = mw__orient2d_double(p[v[1]], p[v[2]], walk->q),
           at1 = mw__orient2d_double(p[v[2]], p[v[0]], walk->q);
    double all = walk->tiling->area ? walk->tiling->area[walk->t]
                                    : mw__orient2d_double(p[v[0]], p[v[1]], p[v[2]]);
    if (how->count) walk->work->orient[MW_STAGE_WALK] += walk->tiling->area ? 2 : 3;
    return v[heaviest_corner(at0, at1, all - at0 - at1)];
}

/* The name of a tile to begin at in the layer `beneath`, by what the one above keeps of a
 * vertex. */
static uint32_t name_below(const mw_layers *layers, const mw_tiling *beneath, uint32_t below)
{
    if (!layers->live || below >= beneath->point_count || beneath->tile_at[below] == MW_NONE)
        return below;
    return mw__tile_name(beneath, beneath->tile_at[below]);
}

uint32_t mw__layers_descend(const mw_layers *layers, mw_point q, const mw_layer_walk *how,
                            uint64_t *random, mw_work *work, uint32_t *tile)
{
    bool by_weight = layers->descent == MW_DESCENT_COORDINATE;
    mw_arithmetic arithmetic = how->exact ? MW_EXACT : MW_DOUBLE;
    uint32_t top = layers->count - 1;
    uint32_t t =
        mw__random_below(random, top ? layers->layer[top - 1].tiling.tri_count : layers->tiles);
    for (uint32_t i = top; i-- > 0;) {
        const mw_layer *layer = &layers->layer[i];
        const mw_tiling *beneath = i > 0 ? &layers->layer[i - 1].tiling : how->mesh;
        uint32_t fuel = mw__walk_fuel(how->walk, arithmetic, &layer->tiling);
        mw_walk walk = mw__walk_begin(&layer->tiling, q, t, fuel, mw__random(random),
                                      how->count ? work : NULL);
        layer_find(&layer->tiling, how, &walk);
        if (tile) tile[i] = walk.t;
        t = name_below(layers, beneath,
                       layer->below[by_weight ? layer_heaviest(&walk, how) : layer_nearest(&walk)]);
        if (i > 0) t = mw__tile_of_name(beneath, t);
    }
    return t;
}

uint32_t mw__layers_first(const mw_layers *layers, mw_point q, const mw_layer_walk *how,
                          uint64_t *random, mw_work *work)
{
    return mw__layers_descend(layers, q, how, random, work, NULL);
}
