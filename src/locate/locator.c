/* locator.c - preparing a mesh for queries. */
#include "locate/locator.h"
#include "locate/guide_walks.h"
#include "base/options.h"

#include "base/clock.h"
#include "tiling/tiling_create.h"
#include "mesh/mesh_order.h"
#include "start/start.h"

#include <stdio.h>
#include <stdlib.h>

/* Does the vertex across the link lie in the tile's circle? Rounded. */
static bool edge_fails_circle(const mw_tiling *tiling, const mw_triangle *tile, uint32_t link)
{
    const mw_point *p = tiling->point;
    uint32_t across = tiling->tri[mw__link_triangle(link)].v[mw__prev(mw__link_edge(link))];
    double bound,
        in = mw__incircle_rounded(p[tile->v[0]], p[tile->v[1]], p[tile->v[2]], p[across], &bound);
    return in > bound;
}

/* The remembering walk is the cheapest, but may go round in cycles where edges are not Delaunay,
 * and hands over only when its fuel is used up. The celestial walk costs more on long walks, little
 * more on short ones. The edges of a few tiles are tested to choose between them. To end the cheap
 * walks, the remembering walk is taken only if every edge tested was Delaunay; otherwise the
 * stochastic walk, which costs hardly more. */
static void locator_choose_walks(mw_locator *locator)
{
    enum { PROBES = 1024, FEW = 50 }; /* one edge in FEW may fail */
    const mw_tiling *tiling = &locator->tiling;
    uint32_t edges = 0, failing = 0, stride = tiling->tri_count / PROBES + 1;
    for (uint32_t t = 0; t < tiling->tri_count; t += stride)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tiling->tri[t].link[k];
            if (link == MW_NONE) continue;
            edges++;
            failing += edge_fails_circle(tiling, &tiling->tri[t], link);
        }
    locator->auto_walk = failing * FEW > edges ? MW_WALK_CELESTIAL : MW_WALK_REMEMBERING;
    locator->finish = failing == 0 ? MW_WALK_REMEMBERING : MW_WALK_STOCHASTIC;
    if (tiling->border_loops) locator->auto_walk = MW_WALK_BORDER;
}

/* How many edges a line crosses, for each unit of its length: the Delaunay triangulation of random
 * points, one per unit of area, has 3 edges per unit of area, of mean length 32 / (9 pi) [Miles
 * 1970]; a line crosses 2 / pi edges for each unit of their length. That makes 64 / (3 pi^2). */
static double expected_crossings(uint32_t tiles, double width, double height)
{
    static const double crossings = 2.1615;
    return crossings * sqrt(tiles / 2.0) / sqrt(width) / sqrt(height);
}

/* Filling took 36 ns a triangle; it saved 0.45 us of a query inside the mesh, and 20 us of one
 * outside, by going round the border (domains of 5,000 to 80,000 vertices, from a sample). If one
 * query in ten is outside, filling pays as soon as there is one query for this many triangles. */
static bool locator_wants_ghosts(const mw_mesh *mesh, const mw_locator_options *options)
{
    enum { TRIANGLES_PER_QUERY = 64 };
    if (options->fill != MW_FILL_AUTO) return options->fill == MW_FILL_YES;
    return options->queries == 0 || options->queries > mesh->tri_count / TRIANGLES_PER_QUERY;
}

static mw_status locator_make_tiling(mw_locator *locator, const mw_locator_options *options,
                                     mw_job *job, mw_error *error)
{
    mw_tiling_options how = {.any = options->any,
                             .without_ghosts = !locator_wants_ghosts(locator->mesh, options)};
    return mw__tiling_create(locator->mesh, how, job, &locator->tiling, error);
}

/* Where vertices are too crowded for a grid alone, a sample along the curve serves the crowded
 * cells, if the tiles lie along a curve. Edited tiles do not stay in such an order; there, crowded
 * cells are grids themselves. Returns false when out of memory. */
static bool guide_make_crowded(const mw_locator *locator, mw_index *guide, mw_grid_plan *plan,
                               bool even, uint32_t cells)
{
    mw_job *job = plan->job;
    const mw_tiling *tiling = &locator->tiling;
    mw_curve curve = {0};
    mw_job_span outer = mw__job_part(job, 0.2);
    bool done =
        tiling->tile_of || mw__curve_create(&curve, tiling, locator->low, locator->high, 0, job);
    mw__job_part_end(job, outer);
    if (curve.regular) {
        done = mw__grid_end(&guide->grid, plan, true);
        curve.sparse = guide->grid;
        *guide = (mw_index){.start = MW_START_CURVE, .curve = curve};
        return done;
    }
    mw__curve_release(&curve);
    if (even) return mw__grid_end(&guide->grid, plan, false) && done;
    free(plan->site);
    mw__index_release(guide);
    *guide = (mw_index){.start = tiling->tile_of ? MW_START_TWO_LEVEL_GRID : MW_START_AUTO};
    if (!tiling->tile_of) return done;
    outer = mw__job_part(job, 0.4);
    done = mw__two_level_grid_create(&guide->two_level_grid, tiling, locator->low, locator->high,
                                     cells, job);
    mw__job_part_end(job, outer);
    return done;
}

/* How queries begin by default: by a grid and, where vertices are crowded, by a sample of the tiles
 * along a Hilbert curve, if they lie along one. The grid is small, half a byte a triangle, and
 * quickly built: a larger one makes queries up to a quarter faster (start/grid.c), but takes longer
 * to build than a million queries gain. In a mesh that is edited it has twice as many cells: an
 * insertion waits for each tile on its way, since the way cannot be predicted, and so takes a
 * twentieth less time. */
static uint32_t guide_cells(const mw_tiling *tiling)
{
    enum { TRIANGLES_PER_CELL = 8, FINER = 2 };
    return tiling->tri_count / (tiling->tile_of ? TRIANGLES_PER_CELL / FINER : TRIANGLES_PER_CELL) +
           1;
}

static bool locator_lay_guide(const mw_locator *locator, mw_job *job, mw_index *guide)
{
    /* Vertices are crowded if the cells that have tiles have more than UNEVEN of them on average.
     * In a mesh that is edited, each cell is cut into four if fewer than one cell in SPARSE has
     * tiles: an insertion in clusters then takes a tenth less time. For evenly spread tiles of a
     * large mesh it would take a sixth more time, since so many cells have to come from memory. */
    enum { STRIDE = 2, UNEVEN = 32, SPARSE = 3 };
    const mw_tiling *tiling = &locator->tiling;
    *guide = (mw_index){0};
    if (tiling->border_loops || !tiling->embedding) return true;
    uint32_t cells = guide_cells(tiling);
    mw_grid_plan plan = {.tiling = tiling, .stride = STRIDE, .job = job};
    guide->start = MW_START_GRID;
    if (!mw__grid_begin(&guide->grid, &plan, locator->low, locator->high, cells)) return false;
    bool even = plan.taken >= tiling->tri_count / UNEVEN;
    if (plan.crowded || !even) return guide_make_crowded(locator, guide, &plan, even, cells);
    if (!mw__grid_end(&guide->grid, &plan, false)) return false;
    if (tiling->tile_of && plan.taken < mw__lattice_cells(&guide->grid.lattice) / SPARSE)
        /* if it is not refined, it stays as it is */
        mw__grid_refine(&guide->grid, tiling, STRIDE, job);
    return !mw__job_stopped(job);
}

static bool guide_make_chains(const mw_locator *locator, mw_job *job, mw_index *guide)
{
    mw_index chains = {.start = MW_START_CHAINS, .sort_batches = guide->start == MW_START_AUTO};
    mw_job_span outer = mw__job_part(job, 0.4);
    bool done = mw__chains_create(&chains.chains, &locator->tiling, job);
    mw__job_part_end(job, outer);
    mw__index_release(done ? guide : &chains);
    if (done) *guide = chains;
    return done;
}

/* Replace a guide by chains if walks from it are long. Chains take 68 to 88 bytes a tile, and
 * cannot follow edits. */
bool mw__locator_guide(const mw_locator *locator, mw_job *job, mw_index *guide)
{
    const mw_tiling *tiling = &locator->tiling;
    const mw_guided guided = {tiling, guide, locator->auto_walk, locator->threads};
    mw_job_span outer = mw__job_part(job, 0.6);
    bool done = locator_lay_guide(locator, job, guide);
    mw__job_part_end(job, outer);
    if (!done) return false;
    if (tiling->tile_of || tiling->border_loops || !tiling->embedding) return true;
    bool leads = guide->start != MW_START_AUTO && !(mw__guide_mean_walk(&guided) > MW_CHAINS_WALK);
    return leads || guide_make_chains(locator, job, guide);
}

bool mw__locator_allow_late_chains(mw_locator *locator)
{
    const mw_tiling *tiling = &locator->tiling;
    if (tiling->tile_of || tiling->border_loops || !tiling->embedding ||
        locator->guide.start == MW_START_CHAINS)
        return true;
    locator->late = mw__late_chains_create();
    return locator->late != NULL;
}

static bool are_slots_numbers(const mw_tiling *tiling)
{
    enum { PROBES = 64 };
    uint32_t home = 0, stride = tiling->tri_count / PROBES + 1, probes = 0;
    for (uint32_t t = 0; t < tiling->tri_count; t += stride, probes++)
        home += mw__slot_is_number(tiling, t);
    return home > probes / 2;
}

/* The power of two that makes the extent about 1; or 1, if the extent is neither too small nor too
 * large. */
static double extent_scale(const double low[2], const double high[2])
{
    enum { ORDINARY = 400, MOST = 1000 };
    int exponent;
    double width = high[0] / 2 - low[0] / 2, height = high[1] / 2 - low[1] / 2;
    (void)frexp(width > height ? width : height, &exponent);
    if (exponent > -ORDINARY && exponent < ORDINARY) return 1;
    return ldexp(1, exponent > MOST ? -MOST : exponent < -MOST ? MOST : -exponent);
}

void mw__locator_measure(mw_locator *locator, mw_job *job)
{
    static const double origin[2] = {0, 0}, axis[2][2] = {{1, 0}, {0, 1}};
    const mw_tiling *tiling = &locator->tiling;
    mw__tiling_extent(tiling, origin, axis, job, locator->low, locator->high);
    if (mw__job_stopped(job)) return;
    locator_choose_walks(locator);
    locator->tiling.slots_are_numbers = tiling->tile_of && are_slots_numbers(tiling);
    locator->centre = mw__tile_name(tiling, mw__start_centre(tiling, locator->low, locator->high));
    mw__locator_scale(locator);
}

void mw__locator_scale(mw_locator *locator)
{
    const mw_tiling *tiling = &locator->tiling;
    double width = locator->high[0] - locator->low[0], height = locator->high[1] - locator->low[1];
    locator->scale = extent_scale(locator->low, locator->high);
    locator->near2 = width / mw__sample_count(tiling, MW_SAMPLE_CUBE_ROOT_OF_VERTICES) * height;
    locator->cell2 = width / guide_cells(tiling) * height;
    locator->crossings_per_length = expected_crossings(tiling->tri_count, width, height);
}

static mw_status locator_prepare(mw_locator *locator, const mw_locator_options *options,
                                 mw_job *job, mw_error *error)
{
    mw_tiling *tiling = &locator->tiling;
    mw_job_span outer = mw__job_part(job, 0.8);
    mw_status status = locator_make_tiling(locator, options, job, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    mw__job_stage(job, "finding border loops", 0.05);
    status = mw__tiling_finish(tiling, error);
    if (status == MW_OK && options->areas) status = mw__tiling_areas(tiling, error);
    if (status) return status;
    if (!tiling->embedding) {
        char first[200];
        mw_defect_describe(&tiling->defect, first, sizeof first);
        snprintf(locator->promise, sizeof locator->promise,
                 "the mesh is not an embedding (%s): a point inside may be reported outside, and "
                 "of several triangles that contain a point any may be reported",
                 first);
    }
    mw__job_stage(job, "building a tree of the border", 0.05);
    if (options->border) {
        if (!mw__border_tree_create(&locator->border_tree, locator->mesh, tiling))
            return mw__fail_memory(error);
        locator->has_border = true;
    }
    mw__job_stage(job, "measuring the extent", 0.02);
    mw__locator_measure(locator, job);
    outer = mw__job_part(job, 0.06);
    bool done = !mw__job_stopped(job) && mw__locator_guide(locator, job, &locator->guide);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.02);
    const mw_guided guided = {tiling, &locator->guide, locator->auto_walk, locator->threads};
    done = done && mw__guide_make_fallback(&guided, job, &locator->fallback);
    mw__job_part_end(job, outer);
    if (!options->no_late_chains) done = done && mw__locator_allow_late_chains(locator);
    return done ? MW_OK : mw__fail_memory(error);
}

mw_status mw_locator_create(const mw_mesh *mesh, const mw_locator_options *options,
                            mw_locator **out, mw_error *error)
{
    static const mw_locator_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new locator is NULL");
    *out = NULL;
    if (!mesh) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh");
    if (!options) options = &defaults;
    if ((unsigned)options->fill > MW_FILL_NO)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown mode of filling pockets and holes");
    if (mesh->flat_count == mesh->tri_count)
        return mw__fail(error, MW_ERROR_INPUT, "the mesh has no triangle with an area");
    mw_status status = MW_RESERVED_CHECK(mw_locator_options, options, error);
    if (status) return status;
    mw_locator *locator = mw__calloc(1, sizeof *locator);
    if (!locator) return mw__fail_memory(error);
    locator->mesh = mesh;
    mw_job job = mw__job(options->threads, options->progress);
    locator->threads = options->threads;
    status = mw__job_end(&job, locator_prepare(locator, options, &job, error), error);
    if (status)
        mw_locator_destroy(locator);
    else
        *out = locator;
    return status;
}

mw_status mw_index_create(const mw_locator *locator, mw_start_kind start,
                          const mw_index_options *options, mw_index **out, mw_error *error)
{
    static const mw_index_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new index is NULL");
    *out = NULL;
    if (!locator) return mw__fail(error, MW_ERROR_ARGUMENT, "the locator is NULL");
    if (!mw_start_has_index(start))
        return mw__fail(error, MW_ERROR_ARGUMENT, "this start has no index");
    mw_index *index = mw__calloc(1, sizeof *index);
    if (!index) return mw__fail_memory(error);
    index->start = start;
    double begin = mw__seconds();
    if (!options) options = &defaults;
    mw_job job = mw__job(locator->threads, options->progress);
    mw_status status =
        mw__index_build(index, &locator->tiling, locator->low, locator->high, options, &job, error);
    status = mw__job_end(&job, status, error);
    index->seconds = mw__seconds() - begin;
    if (status)
        mw_index_destroy(index);
    else
        *out = index;
    return status;
}

void mw_locator_destroy(mw_locator *locator)
{
    if (!locator) return;
    mw__index_release(&locator->guide);
    mw__index_release(&locator->fallback);
    mw__late_chains_destroy(locator->late);
    mw__border_tree_release(&locator->border_tree);
    mw__tiling_release(&locator->tiling);
    free(locator);
}

void mw_locator_describe(const mw_locator *locator, mw_locator_info *info)
{
    const mw_tiling *tiling = &locator->tiling;
    size_t border = mw__border_tree_bytes(&locator->border_tree),
           chains = mw__index_bytes(&locator->fallback) + mw__late_chains_bytes(locator->late),
           guide = mw__index_bytes(&locator->guide) + chains;
    *info = (mw_locator_info){
        .bytes = sizeof *locator + (locator->late ? sizeof *locator->late : 0) +
                 mw__tiling_bytes(tiling) + border + guide,
        .border_bytes = border,
        .area_bytes = tiling->area ? tiling->tri_count * sizeof(double) : 0,
        .fill_bytes = tiling->ghost_count ? mw__tiling_copy_bytes(tiling) : 0,
        .ghost_triangles = tiling->ghost_count,
        .holes = tiling->hole_count,
        .components = tiling->border_loops ? tiling->border_loops->component_count : 1,
        .copied = !tiling->borrowed,
        .embedding = tiling->embedding,
        .unfilled = tiling->border_loops != NULL,
        .guide = locator->guide.start,
        .guide_bytes = guide,
        .chain_bytes = locator->guide.start == MW_START_CHAINS ? guide : chains,
    };
}

const char *mw_locator_void_promise(const mw_locator *locator)
{
    return locator->tiling.embedding ? NULL : locator->promise;
}
