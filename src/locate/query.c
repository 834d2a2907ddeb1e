/* query.c - one query: first tile, walk, conclusion. This file decides ties.
 *
 * The rule of ties: a point on an edge or a vertex belongs to the lowest-numbered of the user's
 * triangles that contain it. mw__query_conclude applies it, by exact tests of the last tile of a
 * walk (query_answer, lowest_at_boundary). Every answer comes from there, except those of the fast
 * path (fast_path.h): they are strictly inside a triangle or outside, where there is no tie. So the
 * answer depends on neither walk, start, seed nor threads. */
#include "locate/query.h"
#include "base/options.h"

#include "base/random.h"
#include "locate/fast_path.h"
#include "locate/index.h"
#include "locate/location.h"
#include "locate/components.h"
#include "start/start.h"

/* --- the conclusion and the rule of ties --- */

/* q is on the boundary of tile t, which contains it: the areas of two or one of its edges vanish.
 * The lowest of the user's triangles that contain q, or MW_NONE where only ghosts do. */
static uint32_t lowest_at_boundary(const mw_tiling *tiling, const mw_triangle *tile,
                                   const double area[3])
{
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++)
        if (area[k] == 0) {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        } else {
            at = k;
        }
    if (zeros == 2)
        return mw__lowest_at_vertex(tiling, (uint32_t)(tile - tiling->tri), tile->v[at]);
    /* such a flat triangle occurs only in a mesh that is not an embedding */
    if (zeros == 3) return MW_NONE;
    uint32_t best = tile->user & MW_GHOST ? MW_NONE : tile->user & MW_USER_MASK;
    if (tile->link[on] == MW_NONE) return best;
    const mw_triangle *across = &tiling->tri[mw__link_triangle(tile->link[on])];
    uint32_t other = across->user & MW_USER_MASK;
    if (across->user & MW_GHOST || other >= best) return best;
    /* a flat triangle owns no point */
    return tiling->embedding || mw__has_area(tiling->point, across) ? other : best;
}

/* The answer if no triangle contains q. It is near if the border is within the tolerance; else in a
 * hole, if the mark of its tile says so; else outside. */
static mw_location query_outside(const mw_locator *locator, uint32_t mark, mw_point q,
                                 double tolerance)
{
    mw_location location;
    mw__location_write_outside(&location, mark);
    if (tolerance > 0)
        mw__border_tree_apply_tolerance(&locator->border_tree, locator->mesh, q, tolerance,
                                        &location);
    return location;
}

/* q is at vertex v. Write its answer in a triangle that has this vertex: the answer that areas
 * would give there, without reading the corners. Returns false if the triangle may have another
 * vertex at this place. */
static bool query_answer_at_vertex(const mw_locator *locator, uint32_t v, uint32_t triangle,
                                   mw_location *location)
{
    const mw_mesh *mesh = locator->mesh;
    const mw_triangle *tile = &mesh->tri[mw__triangle_slot(mesh, triangle)];
    for (uint32_t k = 0; k < 3 && locator->tiling.borrowed; k++) {
        if (tile->v[k] != v) continue;
        uint32_t local = mw__user_local_vertex(tile->user, k);
        *location = (mw_location){
            .triangle = triangle, .hole = MW_NONE, .where = MW_ON_VERTEX, .local = (uint8_t)local};
        location->weight[local] = 1;
        return true;
    }
    return false;
}

/* The vertex of a tile at which q lies, if two areas vanish; else MW_NONE. */
static uint32_t vertex_by_areas(const mw_triangle *tile, const double area[3])
{
    uint32_t at = area[0] != 0 ? 0 : area[1] != 0 ? 1 : 2;
    return area[mw__next(at)] != 0 || area[mw__prev(at)] != 0 ? MW_NONE : tile->v[at];
}

/* Answer if q has the coordinates of a corner of tile t. Returns false if it has not, and where
 * only areas can tell. */
static bool query_answer_at_corner(const mw_locator *locator, uint32_t t, mw_point q,
                                   mw_location *location)
{
    const mw_tiling *tiling = &locator->tiling;
    const mw_triangle *tile = &tiling->tri[t];
    if (!tiling->embedding || !tiling->borrowed) return false;
    for (uint32_t k = 0; k < 3; k++) {
        const mw_point p = tiling->point[tile->v[k]];
        if (p.x == q.x && p.y == q.y)
            return query_answer_at_vertex(locator, tile->v[k],
                                          mw__lowest_at_vertex(tiling, t, tile->v[k]), location);
    }
    return false;
}

/* The corners of a tile, and the areas that q makes with its sides. */
typedef struct query_areas {
    mw_point corner[3];
    double area[3];
} query_areas;

static query_areas query_areas_in(const mw_tiling *tiling, const mw_triangle *tile, mw_point q)
{
    query_areas of = {.corner = {tiling->point[tile->v[0]], tiling->point[tile->v[1]],
                                 tiling->point[tile->v[2]]}};
    mw__location_areas(of.corner, q, of.area);
    return of;
}

/* The answer for q in a tile that contains it, by its areas, which are overwritten. */
static mw_location query_answer_in(const mw_locator *locator, const mw_triangle *tile, mw_point q,
                                   double tolerance, query_areas *of)
{
    const mw_tiling *tiling = &locator->tiling;
    const double *area = of->area;
    bool inside = area[0] > 0 && area[1] > 0 && area[2] > 0;
    if (MW_LIKELY(inside && !(tile->user & MW_GHOST) && !tiling->cut))
        return mw__location_of(of->corner, tile->user, q, of->area);
    uint32_t triangle = !inside                 ? lowest_at_boundary(tiling, tile, area)
                        : tile->user & MW_GHOST ? MW_NONE
                                                : tile->user & MW_USER_MASK;
    if (triangle == MW_NONE) return query_outside(locator, tile->user, q, tolerance);
    if (triangle == (tile->user & ~MW_REVERSED) && tiling->borrowed)
        return mw__location_of(of->corner, tile->user, q, of->area);
    mw_location location;
    const uint32_t vertex = vertex_by_areas(tile, area);
    if (vertex != MW_NONE && query_answer_at_vertex(locator, vertex, triangle, &location))
        return location;
    return mw__location_in_triangle(locator->mesh, triangle, q);
}

/* The answer for q in tile t. The walk tested on which side of the edges q lies, but did not keep
 * the areas. The three tests made here give the weights, too. */
static mw_location query_answer(const mw_locator *locator, uint32_t t, mw_point q, double tolerance)
{
    const mw_triangle *tile = &locator->tiling.tri[t];
    query_areas of = query_areas_in(&locator->tiling, tile, q);
    /* Only if the mesh is not an embedding: the walk came over a fold, to the far side of the edge
     * it did not test. */
    if (!(of.area[0] >= 0 && of.area[1] >= 0 && of.area[2] >= 0))
        return query_outside(locator, 0, q, tolerance);
    return query_answer_in(locator, tile, q, tolerance, &of);
}

bool mw__query_answer_here(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                           mw_point q, mw_location *location)
{
    if (query_answer_at_corner(locator, t, q, location)) return true;
    const mw_triangle *tile = &locator->tiling.tri[t];
    query_areas of = query_areas_in(&locator->tiling, tile, q);
    if (!(of.area[0] >= 0 && of.area[1] >= 0 && of.area[2] >= 0)) return false;
    *location = query_answer_in(locator, tile, q, cursor->tolerance, &of);
    return true;
}

static void query_count(mw_counters *counters, const mw_work *work, bool cycle, bool handover)
{
    mw_counters_add(counters, &(mw_counters){
                                  .queries = 1,
                                  .triangles_visited = work->visited,
                                  .triangles_max = work->visited,
                                  .triangles_init = work->triangles[MW_STAGE_INIT],
                                  .triangles = work->triangles[MW_STAGE_WALK],
                                  .triangles_walk_max = work->triangles[MW_STAGE_WALK],
                                  .triangles_final = work->triangles[MW_STAGE_FINAL],
                                  .triangles_final_max = work->triangles[MW_STAGE_FINAL],
                                  .orient_init = work->orient[MW_STAGE_INIT],
                                  .orient = work->orient[MW_STAGE_WALK],
                                  .orient_final = work->orient[MW_STAGE_FINAL],
                                  .implicit = work->implicit,
                                  .comparisons = work->comparisons,
                                  .walk_runs = work->walk_runs,
                                  .border_runs = work->border_runs,
                                  .triangles_border = work->triangles[MW_STAGE_BORDER],
                                  .triangles_border_max = work->triangles[MW_STAGE_BORDER],
                                  .orient_border = work->orient[MW_STAGE_BORDER],
                                  .border_edges = work->border_edges,
                                  .border_edges_max = work->border_edges,
                                  .cycles = cycle,
                                  .handovers = handover,
                              });
}

/* A walk in doubles ended beyond a hull edge of its last tile. Is q really beyond it? */
static bool walk_has_left(const mw_tiling *tiling, const mw_walk *walk)
{
    /* beyond a border there may be more tiles */
    if (tiling->border_loops) return walk->phase == MW_PHASE_AWAY;
    const mw_triangle *tile = &tiling->tri[walk->t];
    for (int k = 0; k < 3; k++)
        if (tile->link[k] == MW_NONE &&
            mw__orient2d(tiling->point[tile->v[k]], tiling->point[tile->v[k + 1]], walk->q) < 0)
            return true;
    return false;
}

/* Count what the walk that took over did as the final location. */
static void work_add_final(mw_work *sum, const mw_work *more)
{
    /* the second walk visits the tile again in which the first one ended */
    sum->visited += more->visited - 1;
    for (int stage = 0; stage < MW_STAGES; stage++) {
        sum->triangles[MW_STAGE_FINAL] += more->triangles[stage];
        sum->orient[MW_STAGE_FINAL] += more->orient[stage];
    }
}

/* End exactly a walk that ran out of fuel, or that computed in plain doubles. *changed is set if
 * the exact walk came to another result; a walk in doubles that was right does not count as handed
 * over. */
static mw_verdict walk_hand_over(const mw_tiling *tiling, mw_walk *walk, mw_verdict before,
                                 bool counted, bool *changed)
{
    mw_work more = {.trace = counted ? walk->work->trace : NULL};
    mw_walk end = mw__walk_begin(tiling, walk->q, walk->t, 0, 0, counted ? &more : NULL);
    if (!tiling->border_loops) end.stage = MW_STAGE_FINAL;
    mw_verdict verdict = mw__walk_surely(&end, counted);
    /* it may have gone round from another edge of the same border */
    bool round = tiling->border_loops && verdict == MW_VERDICT_LEFT;
    *changed = verdict != before || (end.t != walk->t && !round);
    if (*changed && counted) work_add_final(walk->work, &more);
    walk->t = end.t;
    if (tiling->border_loops) walk->lowest = end.lowest;
    return verdict;
}

/* Was the start left to choose? A batch that was left to choose may have chosen to go from query to
 * query: that counts, too. */
static bool query_is_guided(const mw_locator *locator, const mw_cursor *cursor)
{
    const mw_index *guide = &locator->guide;
    bool chained = cursor->start == MW_START_SORTED || cursor->start == MW_START_LAST;
    return cursor->index ? cursor->index == guide
                         : cursor->start == MW_START_AUTO || (chained && guide->sort_batches);
}

/* The locator's chains, which end long walks if the start was left to choose; else NULL. */
static const mw_index *query_chains(const mw_locator *locator, const mw_cursor *cursor)
{
    const mw_index *guide = &locator->guide,
                   *chains = guide->start == MW_START_CHAINS ? guide : &locator->fallback;
    return chains->start == MW_START_CHAINS && query_is_guided(locator, cursor) ? chains : NULL;
}

/* In exact arithmetic. */
static bool tile_has(const mw_tiling *tiling, uint32_t t, mw_point q)
{
    const uint32_t *v = tiling->tri[t].v;
    const mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    return mw__orient2d(a, b, q) >= 0 && mw__orient2d(b, c, q) >= 0 && mw__orient2d(c, a, q) >= 0;
}

/* End a walk that became long: go on from the tile that the chains name. Chains of few tiles may
 * not have the tile of q: then the walk goes on. If that tile is at the
 * hull and q outside, q lies beyond one of its edges. */
static mw_verdict query_end_by_chains(const mw_locator *locator, const mw_cursor *cursor,
                                      const mw_index *chains, mw_walk *walk)
{
    const mw_tiling *tiling = &locator->tiling;
    mw_walk_kind kind = (mw_walk_kind)cursor->walk;
    uint32_t t = mw__index_tile(tiling, chains, walk->q);
    if (cursor->count) mw__chains_count(&chains->chains, walk->q, walk->work);
    if (chains == &locator->fallback && !tile_has(tiling, t, walk->q)) t = walk->t;
    *walk = mw__walk_begin(tiling, walk->q, t,
                           mw__walk_fuel(kind, (mw_arithmetic)cursor->arithmetic, tiling),
                           walk->random, cursor->count ? walk->work : NULL);
    if (walk_has_left(tiling, walk)) return MW_VERDICT_LEFT;
    mw_verdict verdict =
        mw__walk_kernels(kind, tiling)->run[cursor->arithmetic == MW_EXACT][cursor->count](walk);
    return verdict != MW_VERDICT_UNSURE
               ? verdict
               : mw__walk_finish(walk, (mw_walk_kind)cursor->finish, walk->fuel, tiling,
                                 cursor->arithmetic == MW_EXACT, cursor->count);
}

mw_location mw__query_conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk,
                               mw_verdict verdict, mw_counters *counters)
{
    const mw_tiling *tiling = &locator->tiling;
    bool exact = cursor->arithmetic == MW_EXACT, changed = false;
    if (verdict == MW_VERDICT_UNSURE)
        verdict = mw__walk_finish(walk, (mw_walk_kind)cursor->finish, cursor->fuel, tiling, exact,
                                  cursor->count);
    const mw_index *chains =
        MW_UNLIKELY(verdict == MW_VERDICT_OUT_OF_FUEL) ? query_chains(locator, cursor) : NULL;
    /* a walk that is traced goes from triangle to triangle, without such a jump */
    if (MW_UNLIKELY(chains) && !(cursor->count && walk->work->trace))
        verdict = query_end_by_chains(locator, cursor, chains, walk);
    bool dry = verdict == MW_VERDICT_OUT_OF_FUEL;
    bool sure = exact || (verdict == MW_VERDICT_LEFT && walk_has_left(tiling, walk));
    if (MW_UNLIKELY(dry || !sure))
        verdict = walk_hand_over(tiling, walk, verdict, cursor->count, &changed);
    uint32_t hole = MW_NONE;
    if (tiling->border_loops && verdict == MW_VERDICT_LEFT)
        verdict = mw__components_search(tiling, walk, cursor->count, &hole);
    if (cursor->count) query_count(counters, walk->work, dry, changed);
    if (MW_UNLIKELY(verdict != MW_VERDICT_FOUND))
        return query_outside(locator, hole == MW_NONE ? 0 : MW_GHOST | hole, walk->q,
                             cursor->tolerance);
    return query_answer(locator, walk->t, walk->q, cursor->tolerance);
}

/* --- the walk of a query --- */

/* Tile t if it is nearer than a sample is likely to be, or else the nearest of the sample. */
static uint32_t tile_near_or_sampled(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                                     mw_point q, uint64_t *random)
{
    const mw_tiling *tiling = &locator->tiling;
    if (mw__distance2(tiling->point[tiling->tri[t].v[0]], q) <= locator->near2) return t;
    return mw__start_sample(tiling, q, cursor->sample, t, random);
}

static uint32_t start_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                           mw_point q, uint64_t *random)
{
    const mw_tiling *tiling = &locator->tiling;
    if (MW_UNLIKELY(last == MW_NONE))
        return mw__start_sample(tiling, q, cursor->sample, MW_NONE, random);
    switch ((mw_start_kind)cursor->start) {
    case MW_START_RANDOM: return mw__start_random(tiling, random);
    case MW_START_SAMPLE: return mw__start_sample(tiling, q, cursor->sample, MW_NONE, random);
    case MW_START_CENTRE: return mw__tile_of_name(tiling, locator->centre);
    case MW_START_AUTO:
        if (locator->guide.start == MW_START_AUTO)
            return tile_near_or_sampled(locator, cursor, last, q, random);
        return mw__locator_guided_tile(locator, last, q);
    case MW_START_GRID: /* for these, mw__index_first */
    case MW_START_TWO_LEVEL_GRID:
    case MW_START_LAYERS:
    case MW_START_CURVE:
    case MW_START_BUCKETS:
    case MW_START_TRIANGLE_BUCKETS:
    case MW_START_KD_TREE:
    case MW_START_CHAINS:
    case MW_START_LAST:
    case MW_START_SORTED:
    case MW_START_COUNT: break;
    }
    return last;
}

uint32_t mw__query_first_tile(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                              mw_point q, uint64_t *random, mw_work *work)
{
    return cursor->index ? mw__index_first(&locator->tiling, cursor, q, random, work)
                         : start_tile(locator, cursor, last, q, random);
}

static mw_walk query_walk(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                          mw_point q, uint64_t *random, mw_work *work)
{
    const mw_tiling *tiling = &locator->tiling;
    mw_walk walk =
        mw__walk_begin(tiling, q, t, cursor->fuel, mw__random(random), cursor->count ? work : NULL);
    if (MW_UNLIKELY(tiling->border_loops)) mw__components_begin(locator, &walk);
    return walk;
}

/* The number of steps of the fast stochastic walk that make one test: as given, or the expected
 * number of tiles that the line to q crosses, at most the fuel. These steps do not use up fuel. On
 * Delaunay meshes of 10^3 to 10^6 random points, from random tiles, the tests are within 1.1 % of
 * the fewest that any multiple of the estimate makes, and hardly a tile is visited in vain. For
 * 10^5 points, where the stochastic walk visits 383.0 tiles with 494.5 tests, multiples give
 *   times    0.5    0.8    0.9    0.95   1      1.03   1.05   1.1
 *   tiles    383.4  383.4  383.4  383.5  383.7  384.7  386.4  397.8
 *   tests    444.4  413.8  403.4  398.3  393.3  391.3  391.4  400.7 */
static void walk_allow_steps(mw_walk *walk, const mw_locator *locator, uint32_t given)
{
    mw_point p = walk->point[walk->tri[walk->t].v[0]];
    double steps =
        given ? given : locator->crossings_per_length * hypot(walk->q.x - p.x, walk->q.y - p.y);
    walk->steps = (uint32_t)fmin(steps, walk->fuel);
    walk->fuel += walk->steps; /* at most 4096 + 45 sqrt(2^30), twice */
}

/* Begin the query in tile t. *work holds zeros, or what the search for t counted. */
static mw_walk query_begin_at(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                              mw_point q, uint64_t *random, mw_work *work)
{
    mw_walk walk = query_walk(locator, cursor, t, q, random, work);
    if (MW_UNLIKELY(cursor->walk == MW_WALK_FAST_STOCHASTIC))
        walk_allow_steps(&walk, locator, cursor->steps);
    return walk;
}

mw_walk mw__query_begin(const mw_locator *locator, const mw_cursor *cursor, uint32_t last,
                        mw_point q, uint64_t *random, mw_work *work)
{
    if (cursor->count) *work = (mw_work){0};
    uint32_t t = mw__query_first_tile(locator, cursor, last, q, random, work);
    if (MW_UNLIKELY(cursor->count) && t != last) {
        /* the search in chains did not count: search once more, and count */
        const mw_index *index = cursor->index                      ? cursor->index
                                : query_is_guided(locator, cursor) ? &locator->guide
                                                                   : NULL;
        if (index && index->start == MW_START_CHAINS) mw__chains_count(&index->chains, q, work);
    }
    return query_begin_at(locator, cursor, t, q, random, work);
}

mw_walk mw__query_begin_at(const mw_locator *locator, const mw_cursor *cursor, uint32_t t,
                           mw_point q, uint64_t *random, mw_work *work)
{
    if (cursor->count) *work = (mw_work){0};
    return query_begin_at(locator, cursor, t, q, random, work);
}

/* --- the public query --- */

/* Which start do the options mean? With an index, its own; MW_START_AUTO is decided by the
 * query. */
static mw_status query_resolve_start(const mw_query_options *options, mw_start_kind *start,
                                     mw_error *error)
{
    *start = options->start;
    if ((unsigned)*start >= MW_START_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown start");
    if (!options->index) {
        if (mw_start_has_index(*start))
            return mw__fail(error, MW_ERROR_ARGUMENT, "the start %s needs its index",
                            mw_start_name(*start));
        return MW_OK;
    }
    if (*start == MW_START_AUTO) *start = options->index->start;
    if (*start != options->index->start)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the index is of the start %s, not %s",
                        mw_start_name(options->index->start), mw_start_name(*start));
    return MW_OK;
}

/* mw_cursor.fast: which form of the fast path is tried first */
enum { FAST_NONE, FAST_PLAIN, FAST_SCALED };

/* Does the start lead near q, so that the walk is short? */
static bool start_is_near(mw_start_kind start)
{
    return start != MW_START_RANDOM && start != MW_START_SAMPLE && start != MW_START_CENTRE;
}

mw_status mw_cursor_init(const mw_locator *locator, const mw_query_options *options,
                         mw_cursor *cursor, mw_error *error)
{
    static const mw_query_options defaults;
    if (!cursor || !locator)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the cursor or the locator is NULL");
    if (!options) options = &defaults;
    if ((unsigned)options->walk >= MW_WALK_COUNT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown walk");
    mw_start_kind start;
    mw_status status = MW_RESERVED_CHECK(mw_query_options, options, error);
    if (!status) status = query_resolve_start(options, &start, error);
    if (status) return status;
    if (options->finish && options->finish != MW_WALK_REMEMBERING &&
        options->finish != MW_WALK_STOCHASTIC)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the walk 'finish' must be remembering or stochastic");
    if ((unsigned)options->arithmetic > MW_DOUBLE)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown arithmetic");
    if (!(options->tolerance >= 0) || isinf(options->tolerance))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the tolerance must be finite and at least 0");
    if (options->tolerance > 0 && !locator->has_border)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a tolerance needs a locator with options.border");
    mw_walk_kind walk = options->walk ? options->walk : locator->auto_walk;
    if (locator->tiling.border_loops && walk != MW_WALK_BORDER)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "pockets and holes are not filled, so only the border walk works, not %s",
                        mw_walk_name(walk));
    *cursor = (mw_cursor){
        .index = options->index,
        .random = mw__random_seed(options->seed, 0),
        .tolerance = options->tolerance,
        .last = mw__tile_of_name(&locator->tiling, locator->centre),
        .sample = mw__sample_count(&locator->tiling, options->samples),
        .steps = options->steps,
        .fuel = mw__walk_fuel(walk, options->arithmetic, &locator->tiling),
        .walk = (uint8_t)walk,
        .start = (uint8_t)start,
        .finish = (uint8_t)(options->finish ? options->finish : locator->finish),
        .arithmetic = (uint8_t)options->arithmetic,
        .count = options->counters != 0,
        .fast = start_is_near(start) && mw__has_fast_path(&locator->tiling, options)
                    ? locator->scale == 1 ? FAST_PLAIN : FAST_SCALED
                    : FAST_NONE,
        .live = locator->tiling.tile_of != NULL,
        .asked = options->samples,
        .last_name = locator->centre,
        .epoch = locator->epoch,
    };
    enum { SHORT = 64 }; /* steps, where chains can end a walk */
    if (query_chains(locator, cursor) && cursor->fuel > SHORT) cursor->fuel = SHORT;
    return MW_OK;
}

void mw__cursor_follow_edits(const mw_locator *locator, mw_cursor *cursor)
{
    const mw_tiling *tiling = &locator->tiling;
    if (cursor->epoch == locator->epoch) return;
    bool renamed = cursor->epoch >> 32 != locator->epoch >> 32;
    cursor->last =
        renamed ? cursor->last % tiling->tri_count : mw__tile_of_name(tiling, cursor->last_name);
    cursor->fuel =
        mw__walk_fuel((mw_walk_kind)cursor->walk, (mw_arithmetic)cursor->arithmetic, tiling);
    cursor->sample = mw__sample_count(tiling, cursor->asked);
    cursor->epoch = locator->epoch;
}

void mw__cursor_default(const mw_locator *locator, mw_cursor *cursor)
{
    /* a cursor that was initialised has a walk; this one was zeroed */
    if (MW_UNLIKELY(cursor->walk == MW_WALK_AUTO)) mw_cursor_init(locator, NULL, cursor, NULL);
}

/* As mw__query_first_tile, for streams of queries: a query near the one before it needs no call. */
static MW_INLINE uint32_t fast_first_tile(const mw_locator *locator, mw_cursor *cursor, mw_point q)
{
    uint32_t last = cursor->last;
    if (!cursor->index && cursor->start == MW_START_LAST) return last;
    if (!cursor->index && cursor->start == MW_START_AUTO && locator->guide.start != MW_START_AUTO)
        return mw__locator_guided_tile(locator, last, q);
    return mw__query_first_tile(locator, cursor, last, q, &cursor->random, NULL);
}

/* Locate by the fast path. Returns false if it led to tile cursor->last, but to no answer. */
static MW_INLINE bool locate_fast_by(const mw_locator *locator, mw_cursor *cursor, mw_point q,
                                     double scale, mw_location *location)
{
    const mw_tiling *tiling = &locator->tiling;
    uint32_t t = fast_first_tile(locator, cursor, q);
    double weight[3];
    const mw_verdict verdict = mw__remembering_fast(tiling, q, scale, &t, weight);
    cursor->last = t;
    const mw_triangle *tile = &tiling->tri[t];
    if (MW_LIKELY(verdict == MW_VERDICT_FOUND && !(tile->user & MW_GHOST))) {
        mw__location_write_inside(location, tile->user, weight[0], weight[1], weight[2]);
        return true;
    }
    return mw__fast_path_outside(tiling, cursor, tile, verdict == MW_VERDICT_FOUND,
                                 verdict == MW_VERDICT_LEFT, location);
}

/* By the walk of the cursor: from tile cursor->last, where the fast path has led, else from where
 * the start says. The fast path that scales is tried here. */
static __attribute__((noinline)) mw_location locate_by_walk(const mw_locator *locator,
                                                            mw_cursor *cursor, mw_point q)
{
    mw_work work;
    mw_location location;
    mw__cursor_default(locator, cursor);
    if (cursor->fast == FAST_SCALED &&
        locate_fast_by(locator, cursor, q, locator->scale, &location))
        return location;
    if (cursor->fast && mw__query_answer_here(locator, cursor, cursor->last, q, &location))
        return location;
    mw_walk walk = cursor->fast
                       ? mw__walk_begin(&locator->tiling, q, cursor->last, cursor->fuel,
                                        mw__random(&cursor->random), NULL)
                       : mw__query_begin(locator, cursor, cursor->last, q, &cursor->random, &work);
    const mw_kernels *kernels = mw__walk_kernels((mw_walk_kind)cursor->walk, &locator->tiling);
    mw_verdict verdict = kernels->run[cursor->arithmetic == MW_EXACT][cursor->count](&walk);
    location = mw__query_conclude(locator, cursor, &walk, verdict, &cursor->counters);
    cursor->last = walk.t;
    return location;
}

static MW_INLINE bool locate_fast(const mw_locator *locator, mw_cursor *cursor, mw_point q,
                                  mw_location *location)
{
    return MW_LIKELY(cursor->fast == FAST_PLAIN) && locate_fast_by(locator, cursor, q, 1, location);
}

static __attribute__((noinline)) mw_location locate_live(const mw_locator *locator,
                                                         mw_cursor *cursor, mw_point q)
{
    mw_location location;
    mw__cursor_follow_edits(locator, cursor);
    if (!locate_fast(locator, cursor, q, &location)) location = locate_by_walk(locator, cursor, q);
    mw__cursor_remember_last(locator, cursor);
    return location;
}

mw_location mw_locate(const mw_locator *locator, mw_cursor *cursor, double x, double y)
{
    mw_location location;
    mw_point q = {x, y};
    if (MW_UNLIKELY(!isfinite(x) || !isfinite(y)))
        mw__location_write_nowhere(&location, MW_BAD, MW_NONE);
    else if (MW_UNLIKELY(cursor->live))
        location = locate_live(locator, cursor, q);
    else if (MW_UNLIKELY(!locate_fast(locator, cursor, q, &location)))
        location = locate_by_walk(locator, cursor, q);
    return location;
}

mw_status mw_nearest_border(const mw_locator *locator, double x, double y,
                            mw_nearest_border_point *hit, mw_error *error)
{
    if (!locator || !hit || !isfinite(x) || !isfinite(y))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the locator or the result is NULL, or the point is not finite");
    if (!locator->has_border)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the locator was made without options.border");
    if (mw__border_tree_nearest(&locator->border_tree, locator->mesh, (mw_point){x, y}, hit))
        return MW_OK;
    /* only a mesh that is not an embedding */
    return mw__fail(error, MW_ERROR_INPUT, "the mesh has no border");
}
