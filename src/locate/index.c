/* index.c - building, describing and asking the index of a start. */
#include "locate/index.h"
#include "base/options.h"

#include <stdlib.h>

/* The starts that have no index. Every switch below lists all starts and has no default, so that
 * the compiler names the places where a new one is missing. */
#define WITHOUT_INDEX                                                                              \
    MW_START_AUTO:                                                                                 \
    case MW_START_RANDOM:                                                                          \
    case MW_START_SAMPLE:                                                                          \
    case MW_START_CENTRE:                                                                          \
    case MW_START_LAST:                                                                            \
    case MW_START_SORTED:                                                                          \
    case MW_START_COUNT

static mw_status index_build_layers(mw_layers *layers, const mw_tiling *tiling,
                                    const mw_index_options *options, mw_job *job, mw_error *error)
{
    mw_layers_options own = {.layers = options->layers,
                             .ratio = options->ratio,
                             .descent = options->descent,
                             .seed = options->seed};
    return mw__layers_create(tiling, &own, job, layers, error);
}

mw_status mw__index_build(mw_index *index, const mw_tiling *tiling, const double low[2],
                          const double high[2], const mw_index_options *options, mw_job *job,
                          mw_error *error)
{
    mw_status status = MW_RESERVED_CHECK(mw_index_options, options, error);
    if (status) return status;
    if (options->cells > MW_MAX_CELLS)
        return mw__fail(error, MW_ERROR_LIMIT, "a grid has at most 2^30 cells");
    uint32_t cells = mw__cells_bound(options->cells, tiling->tri_count);
    bool done = false;
    switch (index->start) {
    case MW_START_GRID:
        done =
            mw__grid_create(&index->grid, tiling, low, high, cells, job) &&
            (!options->corners || tiling->tile_of || mw__grid_keep_corners(&index->grid, tiling));
        break;
    case MW_START_TWO_LEVEL_GRID:
        done = mw__two_level_grid_create(&index->two_level_grid, tiling, low, high, cells, job);
        break;
    case MW_START_CURVE:
        done = mw__curve_create(&index->curve, tiling, low, high, cells, job);
        break;
    case MW_START_BUCKETS:
        done = mw__vertex_buckets_create(&index->vertex_buckets, tiling, low, high, cells, job);
        break;
    case MW_START_TRIANGLE_BUCKETS:
        done = mw__triangle_buckets_create(&index->triangle_buckets, tiling, low, high, cells, job);
        break;
    case MW_START_KD_TREE: done = mw__kd_tree_create(&index->kd_tree, tiling, job); break;
    case MW_START_CHAINS: done = mw__chains_create(&index->chains, tiling, job); break;
    case MW_START_LAYERS: return index_build_layers(&index->layers, tiling, options, job, error);
    case WITHOUT_INDEX: break;
    }
    return done ? MW_OK : mw__fail_memory(error);
}

void mw__index_release(mw_index *index)
{
    switch (index->start) {
    case MW_START_GRID: mw__grid_release(&index->grid); break;
    case MW_START_TWO_LEVEL_GRID: mw__two_level_grid_release(&index->two_level_grid); break;
    case MW_START_CURVE: mw__curve_release(&index->curve); break;
    case MW_START_BUCKETS: mw__vertex_buckets_release(&index->vertex_buckets); break;
    case MW_START_TRIANGLE_BUCKETS: mw__triangle_buckets_release(&index->triangle_buckets); break;
    case MW_START_KD_TREE: mw__kd_tree_release(&index->kd_tree); break;
    case MW_START_CHAINS: mw__chains_release(&index->chains); break;
    case MW_START_LAYERS: mw__layers_release(&index->layers); break;
    case WITHOUT_INDEX: break;
    }
}

void mw_index_destroy(mw_index *index)
{
    if (!index) return;
    mw__index_release(index);
    free(index);
}

size_t mw__index_bytes(const mw_index *index)
{
    switch (index->start) {
    case MW_START_GRID: return mw__grid_bytes(&index->grid);
    case MW_START_TWO_LEVEL_GRID: return mw__two_level_grid_bytes(&index->two_level_grid);
    case MW_START_CURVE: return mw__curve_bytes(&index->curve);
    case MW_START_BUCKETS: return mw__vertex_buckets_bytes(&index->vertex_buckets);
    case MW_START_TRIANGLE_BUCKETS: return mw__triangle_buckets_bytes(&index->triangle_buckets);
    case MW_START_KD_TREE: return mw__kd_tree_bytes(&index->kd_tree);
    case MW_START_CHAINS: return mw__chains_bytes(&index->chains);
    case MW_START_LAYERS: return mw__layers_bytes(&index->layers);
    case WITHOUT_INDEX: break;
    }
    return 0;
}

void mw_index_describe(const mw_index *index, mw_index_info *info)
{
    *info = (mw_index_info){.start = index->start,
                            .bytes = sizeof *index + mw__index_bytes(index),
                            .seconds = index->seconds};
    switch (index->start) {
    case MW_START_GRID: info->cells = mw__lattice_cells(&index->grid.lattice); break;
    case MW_START_TWO_LEVEL_GRID:
        info->cells =
            mw__lattice_cells(&index->two_level_grid.lattice) + index->two_level_grid.fine_count;
        break;
    case MW_START_CURVE:
        info->cells = index->curve.count - 2; /* the ends are no tiles */
        break;
    case MW_START_BUCKETS: info->cells = mw__lattice_cells(&index->vertex_buckets.lattice); break;
    case MW_START_TRIANGLE_BUCKETS:
        info->cells = mw__lattice_cells(&index->triangle_buckets.lattice);
        break;
    case MW_START_KD_TREE: info->vertices[0] = index->kd_tree.count; break;
    case MW_START_CHAINS: info->vertices[0] = index->chains.points; break;
    case MW_START_LAYERS:
        info->layers = index->layers.count;
        mw__layers_describe(&index->layers, info->vertices);
        break;
    case WITHOUT_INDEX: break;
    }
}

/* A curve holds slots of tiles. If the curve was made from another tiling, or this one has changed
 * since, the slot may not exist: reduce it to one that does. */
static MW_INLINE uint32_t tile_within(const mw_tiling *tiling, uint32_t t)
{
    return MW_LIKELY(t < tiling->tri_count) ? t : t % tiling->tri_count;
}

/* The tile by chains, or by one of the starts that serve only to compare. In a function of its own,
 * to keep the common ones small. */
static __attribute__((noinline)) uint32_t index_first_rare(const mw_index *index, mw_point q)
{
    if (index->start == MW_START_BUCKETS)
        return mw__vertex_buckets_first(&index->vertex_buckets, q);
    if (index->start == MW_START_CHAINS) return mw__chains_first(&index->chains, q);
    return index->start == MW_START_KD_TREE ? mw__kd_tree_first(&index->kd_tree, q) : 0;
}

/* The name of the first tile; for a curve, the slot of the first tile. */
static MW_INLINE uint32_t index_first_name(const mw_index *index, mw_point q)
{
    if (MW_LIKELY(index->start == MW_START_GRID)) return mw__grid_first(&index->grid, q);
    switch (index->start) {
    case MW_START_TWO_LEVEL_GRID: return mw__two_level_grid_first(&index->two_level_grid, q);
    case MW_START_CURVE: return mw__curve_first(&index->curve, q);
    default: return index_first_rare(index, q);
    }
}

uint32_t mw__index_tile_ahead(const mw_tiling *tiling, const mw_index *index, mw_point q)
{
    const uint32_t name = index_first_name(index, q);
    return index->start == MW_START_CURVE ? tile_within(tiling, name)
                                          : mw__tile_of_name(tiling, name);
}

/* The tile for q by a grid that keeps corners. The corners and the tile are read from memory at the
 * same time. */
static uint32_t grid_tile_with_corners(const mw_tiling *tiling, const mw_grid *grid, mw_point q)
{
    const uint32_t cell = mw__lattice_cell(&grid->lattice, q), *corner = grid->corner[cell];
    const uint32_t t = mw__tile_of_name(tiling, grid->tile[cell]);
    __builtin_prefetch(&tiling->tri[t]);
    for (uint32_t k = 0; k < 3; k++)
        if (corner[k] < tiling->point_count) __builtin_prefetch(&tiling->point[corner[k]]);
    return t;
}

/* In most tilings the slot of a tile is its number. The tile itself tells whether that is so. It is
 * needed next anyway, so nothing else has to be read from memory. */
uint32_t mw__index_tile(const mw_tiling *tiling, const mw_index *index, mw_point q)
{
    if (MW_UNLIKELY(index->start == MW_START_GRID && index->grid.corner))
        return grid_tile_with_corners(tiling, &index->grid, q);
    const uint32_t name = index_first_name(index, q);
    if (index->start == MW_START_CURVE) return tile_within(tiling, name);
    if (tiling->slots_are_numbers && mw__slot_is_number(tiling, name)) return name;
    return mw__tile_of_name(tiling, name);
}

uint32_t mw__index_first(const mw_tiling *tiling, const mw_cursor *cursor, mw_point q,
                         uint64_t *random, mw_work *work)
{
    const mw_index *index = cursor->index;
    if (MW_LIKELY(!mw__index_counts(index))) return mw__index_tile(tiling, index, q);
    if (index->start == MW_START_TRIANGLE_BUCKETS)
        return mw__tile_of_name(tiling, mw__triangle_buckets_first(&index->triangle_buckets, tiling,
                                                                   q, cursor->count ? work : NULL));
    mw_layer_walk how = {(mw_walk_kind)cursor->walk, (mw_walk_kind)cursor->finish,
                         cursor->arithmetic == MW_EXACT, cursor->count, tiling};
    return mw__tile_of_name(tiling, mw__layers_first(&index->layers, q, &how, random, work));
}

static void grid_first_many(const mw_grid *grid, const mw_point *q, uint32_t n, uint32_t *t)
{
    for (uint32_t i = 0; i < n; i++) {
        t[i] = mw__lattice_cell(&grid->lattice, q[i]);
        __builtin_prefetch(&grid->tile[t[i]]);
    }
    for (uint32_t i = 0; i < n; i++) t[i] = grid->tile[t[i]];
}

static void two_level_grid_first_many(const mw_two_level_grid *grid, const mw_point *q, uint32_t n,
                                      uint32_t *t)
{
    for (uint32_t i = 0; i < n; i++)
        __builtin_prefetch(&grid->coarse[mw__lattice_cell(&grid->lattice, q[i])]);
    for (uint32_t i = 0; i < n; i++) t[i] = mw__two_level_grid_first(grid, q[i]);
}

/* Crowded cells leave their points to the curve. Gather these points, look them up together, and
 * write their tiles where they belong. */
static void curve_first_many(const mw_curve *curve, const mw_point *q, uint32_t n, uint32_t *t)
{
    uint32_t left[MW_INDEX_MANY], key[MW_INDEX_MANY], count = 0;
    if (curve->sparse.tile) grid_first_many(&curve->sparse, q, n, t);
    for (uint32_t i = 0; i < n; i++)
        if (!curve->sparse.tile || t[i] == MW_NONE) left[count++] = i;
    for (uint32_t i = 0; i < count; i++) {
        key[i] = mw__hilbert_key(&curve->hilbert, q[left[i]].x, q[left[i]].y);
        __builtin_prefetch(&curve->from[key[i] >> curve->shift]);
    }
    for (uint32_t i = 0; i < count; i++)
        __builtin_prefetch(&curve->sample[curve->from[key[i] >> curve->shift] - 1]);
    for (uint32_t i = 0; i < count; i++) t[left[i]] = mw__curve_at(curve, key[i]);
}

_Static_assert(MW_INDEX_MANY <= MW_CHAINS_MANY, "as many searches as points");

/* From names to tiles. */
static void names_resolve_many(const mw_tiling *tiling, uint32_t n, uint32_t *t)
{
    for (uint32_t i = 0; i < n; i++)
        if (t[i] < tiling->number_count) __builtin_prefetch(&tiling->tile_of[t[i]]);
    for (uint32_t i = 0; i < n; i++) t[i] = mw__tile_of_name(tiling, t[i]);
}

void mw__index_first_many(const mw_tiling *tiling, const mw_index *index, const mw_point *q,
                          uint32_t n, uint32_t *t)
{
    switch (index->start) {
    case MW_START_GRID: grid_first_many(&index->grid, q, n, t); break;
    case MW_START_TWO_LEVEL_GRID: two_level_grid_first_many(&index->two_level_grid, q, n, t); break;
    case MW_START_CURVE: curve_first_many(&index->curve, q, n, t); break;
    case MW_START_CHAINS: mw__chains_first_many(&index->chains, q, n, t); break;
    case MW_START_BUCKETS:
    case MW_START_TRIANGLE_BUCKETS:
    case MW_START_KD_TREE:
    case MW_START_LAYERS:
    case WITHOUT_INDEX:
        for (uint32_t i = 0; i < n; i++) t[i] = index_first_name(index, q[i]);
        break;
    }
    if (MW_UNLIKELY(tiling->tile_of && index->start != MW_START_CURVE))
        names_resolve_many(tiling, n, t);
    for (uint32_t i = 0; i < n; i++) {
        t[i] = tile_within(tiling, t[i]);
        __builtin_prefetch(&tiling->tri[t[i]]);
    }
}
