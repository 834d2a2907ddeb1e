/* guide_walks.c - how far a guide leads: walks to a sample of points, measured, and chains for the
 * few tiles to which it leads far.
 *
 * A walk of L tiles passes by L - FAR tiles that are themselves far from where it began. So one
 * walk for each 256 tiles finds nearly every place with walks of several hundred. From each such
 * tile, all connected tiles that are far are gathered; only these get chains. The sample also has
 * points near corners of tiles, since walks round a vertex of many tiles are long only near it. */
#include "locate/guide_walks.h"
#include "base/random.h"
#include "tiling/tiling_create.h"

#include <stdatomic.h>
#include <stdlib.h>

enum {
    TILES_PER_LOOK = 256,
    LONG = 128, /* tiles: a walk that is looked for */
    FAR = 64,   /* tiles: where chains end walks; those that are gathered */
    GAP = 8,    /* tiles: so many that are not far may lie between far ones */
    SHARE = 16  /* if more than one tile in so many is gathered, all get chains */
};

/* How many tiles a walk from t to q visits, but at most `most`. */
static uint32_t walk_length(const mw_guided *guided, uint32_t t, mw_point q, uint32_t most,
                            uint64_t random)
{
    const mw_tiling *tiling = guided->tiling;
    mw_walk walk = mw__walk_begin(tiling, q, t, most, random, NULL);
    mw__walk_kernels(guided->walk, tiling)->run[true][false](&walk);
    return most - walk.fuel;
}

/* The same from the guide. */
static uint32_t guide_walk(const mw_guided *guided, mw_point q, uint32_t most, uint64_t random)
{
    if (!isfinite(q.x) || !isfinite(q.y)) return 0;
    return walk_length(guided, mw__index_tile(guided->tiling, guided->guide, q), q, most, random);
}

double mw__guide_mean_walk(const mw_guided *guided)
{
    enum { TILES_PER_WALK = 256, WALKS = 256, MOST = LONG + MW_CHAINS_WALK };
    const mw_tiling *tiling = guided->tiling;
    uint32_t n = tiling->tri_count, walks = n / TILES_PER_WALK < WALKS ? n / TILES_PER_WALK : WALKS;
    uint64_t visited = 0;
    for (uint32_t i = 0; i < walks; i++) {
        mw_point q = mw__tile_middle(tiling, (uint32_t)((uint64_t)n * i / walks));
        visited += guide_walk(guided, q, MOST, i);
    }
    return walks ? (double)visited / walks : 0;
}

/* --- looking for long walks --- */

/* The point of a tile that is 2^-exponent of the way from a corner to the middle. */
static mw_point tile_point(const mw_tiling *tiling, uint32_t t, uint32_t corner, int exponent)
{
    const mw_point p = tiling->point[tiling->tri[t].v[corner]], m = mw__tile_middle(tiling, t);
    const double share = ldexp(1, -exponent);
    return (mw_point){p.x + (m.x - p.x) * share, p.y + (m.y - p.y) * share};
}

enum { BLOCK = MW_INDEX_MANY };

/* Some looks: which tiles, to which point of each, and from where. */
typedef struct look_block {
    uint32_t count, tile[BLOCK], first[BLOCK];
    mw_point q[BLOCK];
} look_block;

/* The tile of a look: of each few one at random, so that no order of tiles escapes. */
static uint32_t look_tile(const mw_tiling *tiling, uint64_t look, uint64_t random)
{
    const uint64_t t = look * TILES_PER_LOOK + (random >> 32) % TILES_PER_LOOK;
    return t < tiling->tri_count ? (uint32_t)t : tiling->tri_count - 1;
}

/* Looks from .. to - 1. Every other point is in the middle of its tile. All wait for memory at the
 * same time. */
static void looks_prepare(const mw_guided *guided, uint64_t from, uint64_t to, look_block *b)
{
    const mw_tiling *tiling = guided->tiling;
    b->count = 0;
    for (uint64_t look = from; look < to; look++)
        __builtin_prefetch(&tiling->tri[look_tile(tiling, look, mw__random_seed(0, look))]);
    for (uint64_t look = from; look < to; look++) {
        const uint32_t t = look_tile(tiling, look, mw__random_seed(0, look));
        for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(&tiling->point[tiling->tri[t].v[k]]);
    }
    for (uint64_t look = from; look < to; look++) {
        const uint64_t seed = mw__random_seed(0, look);
        const uint32_t random = (uint32_t)seed, t = look_tile(tiling, look, seed);
        const mw_point q =
            tile_point(tiling, t, (random >> 8) % 3, random & 1 ? 0 : (int)(random >> 1 & 31));
        if (!isfinite(q.x) || !isfinite(q.y)) continue;
        b->tile[b->count] = t;
        b->q[b->count++] = q;
    }
    mw__index_first_many(tiling, guided->guide, b->q, b->count, b->first);
}

/* Keep the looks whose walk is long. */
static void looks_walk(const mw_guided *guided, look_block *b)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < b->count; i++)
        if (walk_length(guided, b->first[i], b->q[i], LONG, i) == LONG)
            b->tile[kept++] = b->tile[i];
    b->count = kept;
}

static uint64_t looks_of(const mw_guided *guided)
{
    return guided->tiling->tri_count / TILES_PER_LOOK + 1;
}

typedef struct guide_looking {
    const mw_guided *guided;
    atomic_bool found;
} guide_looking;

static void guide_look(void *work, uint64_t from, uint64_t to)
{
    guide_looking *l = work;
    look_block block;
    for (; from < to && !atomic_load_explicit(&l->found, memory_order_relaxed); from += BLOCK) {
        looks_prepare(l->guided, from, to < from + BLOCK ? to : from + BLOCK, &block);
        looks_walk(l->guided, &block);
        if (block.count) atomic_store_explicit(&l->found, true, memory_order_relaxed);
    }
}

/* --- far tiles --- */

typedef struct far_tiles {
    const mw_guided *guided;
    uint32_t *tile;
    uint32_t count, most;
    uint8_t *gap; /* of each tile that was looked at: 1 + how many tiles off a far one it is */
} far_tiles;

static bool tile_is_far(const mw_guided *guided, uint32_t t)
{
    static const int exponents[] = {0, 1, 2, 4, 10, 28};
    for (uint32_t i = 0; i < sizeof exponents / sizeof *exponents; i++)
        for (uint32_t corner = 0; corner < (i ? 3 : 1); corner++) {
            mw_point q = tile_point(guided->tiling, t, corner, exponents[i]);
            if (guide_walk(guided, q, FAR, t) == FAR) return true;
        }
    return false;
}

/* Look at the tile over a link of a tile that was gathered. False: there are too many. */
static bool far_tiles_look(far_tiles *far, uint32_t from, uint32_t link)
{
    const uint32_t t = mw__link_triangle(link);
    if (link == MW_NONE || far->gap[t]) return true;
    far->gap[t] = tile_is_far(far->guided, t) ? 1 : (uint8_t)(far->gap[from] + 1);
    if (far->gap[t] > GAP) return true;
    if (far->count == far->most) return false;
    far->tile[far->count++] = t;
    return true;
}

/* Take a far tile and all far tiles connected to it, across small gaps: the test may miss that a
 * tile is far. False: there are too many. */
static bool far_tiles_gather(far_tiles *far, uint32_t t)
{
    const mw_tiling *tiling = far->guided->tiling;
    if (far->gap[t] && far->gap[t] <= GAP) return true;
    if (far->count == far->most) return false;
    far->gap[t] = 1;
    uint32_t next = far->count;
    far->tile[far->count++] = t;
    for (; next < far->count; next++)
        for (uint32_t k = 0; k < 3; k++)
            if (!far_tiles_look(far, far->tile[next], tiling->tri[far->tile[next]].link[k]))
                return false;
    return true;
}

/* The mesh of the far tiles alone. */
static mw_status far_tiles_mesh(const far_tiles *far, mw_mesh **mesh)
{
    const mw_tiling *tiling = far->guided->tiling;
    uint32_t *number = mw__calloc(tiling->point_count, sizeof *number), points = 0,
             *triangles = mw__alloc(3 * (size_t)far->count, sizeof *triangles);
    double *point = mw__alloc(6 * (size_t)far->count, sizeof *point);
    mw_status status = number && triangles && point ? MW_OK : MW_ERROR_MEMORY;
    for (uint32_t i = 0; i < 3 * far->count && !status; i++) {
        const uint32_t v = tiling->tri[far->tile[i / 3]].v[i % 3];
        if (number[v] == 0) {
            number[v] = ++points;
            point[2 * (size_t)points - 2] = tiling->point[v].x;
            point[2 * (size_t)points - 1] = tiling->point[v].y;
        }
        triangles[i] = number[v] - 1;
    }
    const mw_arrays arrays = {.points = point,
                              .point_count = points,
                              .triangles = triangles,
                              .triangle_count = far->count};
    const mw_mesh_options options = {.threads = far->guided->threads};
    if (!status) status = mw_mesh_create(&arrays, &options, mesh, NULL);
    free(number);
    free(triangles);
    free(point);
    return status;
}

/* Chains of the far tiles' own tiling name their tiles; beside them, one that is near. */
static void far_tiles_name(const far_tiles *far, const mw_tiling *own, mw_chains *chains)
{
    uint32_t name = mw__tile_name(far->guided->tiling, far->tile[0]);
    for (uint32_t i = 0; i <= chains->tiles; i++) {
        const uint32_t user = own->tri[chains->tile[i]].user;
        if (!(user & MW_GHOST))
            name = mw__tile_name(far->guided->tiling, far->tile[user & MW_USER_MASK]);
        chains->tile[i] = name;
    }
}

/* Of a mesh that is an embedding a part is one, too. */
static bool far_tiles_make_chains(const far_tiles *far, mw_chains *chains, mw_job *job)
{
    mw_mesh *mesh = NULL;
    mw_tiling own = {0};
    const mw_tiling_options filled = {0};
    mw_status status = far_tiles_mesh(far, &mesh);
    mw_job_span outer = mw__job_part(job, 0.5);
    if (!status) status = mw__tiling_create(mesh, filled, job, &own, NULL);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.5);
    bool done = !status && mw__chains_create(chains, &own, job);
    mw__job_part_end(job, outer);
    if (done && chains->tiles) far_tiles_name(far, &own, chains);
    mw__tiling_release(&own);
    mw_mesh_destroy(mesh);
    return done;
}

/* Gather the far tiles, and make chains for them, or for all. */
static bool fallback_make(const mw_guided *guided, mw_job *job, mw_index *fallback)
{
    const uint32_t n = guided->tiling->tri_count;
    far_tiles far = {.guided = guided, .most = n / SHARE};
    mw_chains *chains = &fallback->chains;
    far.tile = mw__alloc(far.most + 1, sizeof *far.tile);
    far.gap = mw__calloc(n, sizeof *far.gap);
    bool done = far.tile && far.gap, few = true;
    look_block block;
    for (uint64_t i = 0, looks = looks_of(guided); i < looks && done && few; i += BLOCK) {
        looks_prepare(guided, i, looks < i + BLOCK ? looks : i + BLOCK, &block);
        looks_walk(guided, &block);
        for (uint32_t k = 0; k < block.count && few; k++)
            few = far_tiles_gather(&far, block.tile[k]);
    }
    fallback->start = MW_START_CHAINS;
    if (done)
        done = few ? far_tiles_make_chains(&far, chains, job)
                   : mw__chains_create(chains, guided->tiling, job);
    free(far.tile);
    free(far.gap);
    return done;
}

bool mw__guide_make_fallback(const mw_guided *guided, mw_job *job, mw_index *fallback)
{
    const mw_start_kind guide = guided->guide->start;
    guide_looking looking = {guided, false};
    if (guide == MW_START_AUTO || guide == MW_START_CHAINS) return true;
    mw__job_stage(job, "looking for long walks", 0.2);
    bool done = mw__job_ranges(job, looks_of(guided), guide_look, &looking);
    if (!done || !atomic_load_explicit(&looking.found, memory_order_relaxed)) return done;
    mw_job_span outer = mw__job_part(job, 0.8);
    done = fallback_make(guided, job, fallback);
    mw__job_part_end(job, outer);
    return done;
}
