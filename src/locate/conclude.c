/* conclude.c - how a walk that has ended becomes an answer. This file decides ties.
 *
 * The rule of ties: a point on an edge or a vertex belongs to the lowest-numbered of the user's
 * triangles that contain it. mw__query_conclude applies it, by exact tests of the last tile of a
 * walk (query_answer, lowest_at_boundary). Every answer comes from there, except those of the fast
 * path (fast_path.h): they are strictly inside a triangle or outside, where there is no tie. So the
 * answer depends on neither walk, start, seed nor threads. */
#include "locate/conclude.h"

#include "locate/components.h"
#include "locate/location.h"
#include "locate/long_walks.h"

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

mw_location mw__query_conclude(const mw_locator *locator, const mw_cursor *cursor, mw_walk *walk,
                               mw_verdict verdict, mw_counters *counters)
{
    const mw_tiling *tiling = &locator->tiling;
    bool exact = cursor->arithmetic == MW_EXACT, changed = false;
    mw_walk_kind kind = (mw_walk_kind)cursor->walk;
    if (verdict == MW_VERDICT_UNSURE) {
        kind = (mw_walk_kind)cursor->finish;
        verdict = mw__walk_finish(walk, kind, cursor->fuel, tiling, exact, cursor->count);
    }
    if (MW_UNLIKELY(verdict == MW_VERDICT_OUT_OF_FUEL && cursor->fuel == MW_SHORT_WALK))
        verdict = mw__long_walk_end(locator, cursor, kind, walk);
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
