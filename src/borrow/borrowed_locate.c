/* borrowed_locate.c - one query: first triangle, walk, conclusion, and the rule of ties.
 *
 * No answer rests on a link alone. Whether a triangle contains q is decided by its own three
 * corners. Whether it is the lowest one is decided by the triangles round the edge or vertex that q
 * is on; each of them is tested for q itself. That no triangle contains q follows from the mesh
 * being convex. If the links do not lead all round, or the mesh is not known to be convex, all
 * triangles are tested.
 */
#include "borrow/borrowed_locate.h"

#include "base/options.h"
#include "base/random.h"
#include "borrow/borrowed_walk.h"
#include "locate/location.h"
#include "start/start.h"

/* --- a triangle and q --- */

/* A triangle's corners counter-clockwise, its mark, and the areas that q makes with its sides. */
typedef struct borrowed_view {
    mw_point corner[3];
    uint32_t v[3], k[3]; /* numbers of the vertices; of the corners as given */
    uint32_t user;
    double area[3];
} borrowed_view;

/* False: the triangle has no area, or cannot be read. */
static bool borrowed_view_read(const mw_borrowed *mesh, uint32_t t, borrowed_view *view)
{
    mw_borrowed_tile tile;
    if (!mw__borrowed_read(mesh, t, &tile) || !mw__borrowed_is_finite(&tile)) return false;
    double area = mw__orient2d(tile.p[0], tile.p[1], tile.p[2]);
    if (area == 0) return false;
    for (uint32_t k = 0; k < 3; k++) {
        view->k[k] = area < 0 ? (3 - k) % 3 : k;
        view->corner[k] = tile.p[view->k[k]];
        view->v[k] = tile.v[view->k[k]];
    }
    view->user = area < 0 ? t | MW_REVERSED : t;
    return true;
}

/* Do all corners lie on one side of q, along x or y? No jumps: they would be guessed wrong. */
static MW_INLINE bool borrowed_box_misses(const mw_borrowed_tile *tile, mw_point q)
{
    const mw_point *p = tile->p;
    int left = (p[0].x < q.x) & (p[1].x < q.x) & (p[2].x < q.x),
        right = (p[0].x > q.x) & (p[1].x > q.x) & (p[2].x > q.x);
    int below = (p[0].y < q.y) & (p[1].y < q.y) & (p[2].y < q.y),
        above = (p[0].y > q.y) & (p[1].y > q.y) & (p[2].y > q.y);
    return left | right | below | above;
}

/* Does the triangle contain q? Fills in the view if so. */
static bool borrowed_contains(const mw_borrowed *mesh, uint32_t t, mw_point q, borrowed_view *view)
{
    if (!borrowed_view_read(mesh, t, view)) return false;
    mw__location_areas(view->corner, q, view->area);
    return view->area[0] >= 0 && view->area[1] >= 0 && view->area[2] >= 0;
}

/* --- the conclusion --- */

/* Look at all triangles; the first one that contains q is the lowest. */
static mw_location borrowed_scan(const mw_borrowed *mesh, mw_point q, mw_counters *counters,
                                 uint32_t *last)
{
    counters->handovers++;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        mw_borrowed_tile tile;
        borrowed_view view;
        if (!mw__borrowed_read(mesh, t, &tile) || borrowed_box_misses(&tile, q)) continue;
        if (!borrowed_contains(mesh, t, q, &view)) continue;
        *last = t;
        return mw__location_of(view.corner, view.user, q, view.area);
    }
    return mw__location_nowhere(MW_OUTSIDE);
}

/* Go from triangle *t over its edge opposite to vertex number `off` to the neighbour, which has
 * vertex `at`, too. Returns the neighbour's third vertex. Returns MW_NONE if there is no such
 * neighbour: *broken tells a wrong link (true) from a border (false). */
static uint32_t borrowed_turn(const mw_borrowed *mesh, uint32_t at, uint32_t off, uint32_t *t,
                              bool *broken)
{
    mw_borrowed_tile tile;
    uint32_t k = 0;
    *broken = true;
    if (!mw__borrowed_read(mesh, *t, &tile)) return MW_NONE;
    while (k < 3 && tile.v[k] != off) k++;
    if (k == 3) return MW_NONE;
    uint32_t a = tile.v[mw__next(k)], b = tile.v[mw__prev(k)],
             across = mw__borrowed_across(mesh, *t, k);
    *broken = across != MW_NONE;
    if (across == MW_NONE || !mw__borrowed_read(mesh, across, &tile)) return MW_NONE;
    uint32_t apex = mw__borrowed_apex(&tile, a, b);
    if (apex == 3 || (a != at && b != at)) return MW_NONE;
    borrowed_view view;
    /* beyond one without area there may be another */
    if (!borrowed_view_read(mesh, across, &view)) return MW_NONE;
    *t = across;
    return tile.v[apex];
}

/* Turn one way round the vertex `at` of triangle `first`, whose other vertices are `off` and `to`;
 * begin over the edge opposite to `off`. Lowers *best to the lowest triangle met. Returns 1 if the
 * turn came all round, 0 if it met the border, -1 if links are wrong. */
static int borrowed_go_round(const mw_borrowed *mesh, uint32_t first, uint32_t at, uint32_t off,
                             uint32_t to, uint32_t *best)
{
    uint32_t t = first;
    for (uint32_t turns = 0; turns < mesh->tri_count; turns++) {
        bool broken;
        uint32_t apex = borrowed_turn(mesh, at, off, &t, &broken);
        if (apex == MW_NONE) return broken ? -1 : 0;
        if (t == first) return 1;
        if (t < *best) *best = t;
        off = to;
        to = apex;
    }
    return -1;
}

/* The lowest of the triangles round the vertex `k` of the view; MW_NONE: links do not tell. */
static uint32_t borrowed_lowest_at_vertex(const mw_borrowed *mesh, const borrowed_view *view,
                                          uint32_t k)
{
    uint32_t t = view->user & MW_USER_MASK, best = t;
    uint32_t at = view->v[k], off = view->v[mw__next(k)], to = view->v[mw__prev(k)];
    int round = borrowed_go_round(mesh, t, at, off, to, &best);
    if (round == 0 && mesh->convex) round = borrowed_go_round(mesh, t, at, to, off, &best) == 0;
    return round == 1 ? best : MW_NONE;
}

/* The same at the edge opposite to vertex `k` of the view. */
static uint32_t borrowed_lowest_at_edge(const mw_borrowed *mesh, const borrowed_view *view,
                                        uint32_t k, mw_point q)
{
    uint32_t t = view->user & MW_USER_MASK, across = mw__borrowed_across(mesh, t, view->k[k]);
    borrowed_view other;
    if (across == MW_NONE) return mesh->convex ? t : MW_NONE;
    if (!borrowed_contains(mesh, across, q, &other)) return MW_NONE;
    return across < t ? across : t;
}

/* q is in triangle t, as the walk says. */
static mw_location borrowed_answer(const mw_borrowed *mesh, uint32_t *t, mw_point q,
                                   mw_counters *counters)
{
    borrowed_view view;
    if (MW_UNLIKELY(!borrowed_contains(mesh, *t, q, &view)))
        return borrowed_scan(mesh, q, counters, t);
    uint32_t zeros = 0, zero = 0, other = 0, lowest = *t;
    for (uint32_t k = 0; k < 3; k++) {
        zeros += view.area[k] == 0;
        if (view.area[k] == 0)
            zero = k;
        else
            other = k;
    }
    if (zeros == 1) lowest = borrowed_lowest_at_edge(mesh, &view, zero, q);
    if (zeros == 2) lowest = borrowed_lowest_at_vertex(mesh, &view, other);
    if (MW_LIKELY(lowest == *t)) return mw__location_of(view.corner, view.user, q, view.area);
    if (lowest == MW_NONE || !borrowed_contains(mesh, lowest, q, &view))
        return borrowed_scan(mesh, q, counters, t);
    return mw__location_of(view.corner, view.user, q, view.area);
}

/* q lies beyond an edge of triangle t that has no neighbour, if t is what the walk took it for. */
static bool borrowed_is_outside(const mw_borrowed *mesh, uint32_t t, mw_point q)
{
    borrowed_view view;
    if (!mesh->convex) return false;
    /* a walk goes over flat triangles, too */
    if (!borrowed_view_read(mesh, t, &view)) return mesh->checked;
    for (uint32_t k = 0; k < 3; k++)
        if (mw__borrowed_across(mesh, t, view.k[k]) == MW_NONE &&
            mw__orient2d(view.corner[mw__next(k)], view.corner[mw__prev(k)], q) < 0)
            return true;
    return false;
}

/* --- the start --- */

/* Is q within a few lengths of the shortest edge of triangle t? */
static bool borrowed_is_close(const mw_borrowed_tile *tile, mw_point q)
{
    enum { LENGTHS = 3 };
    double least = INFINITY;
    for (uint32_t k = 0; k < 3; k++)
        least = fmin(least, mw__distance2(tile->p[k], tile->p[mw__next(k)]));
    return mw__distance2(tile->p[0], q) <= LENGTHS * LENGTHS * least;
}

/* The nearest to q, by its vertex 0, of a sample and of the triangle found last. */
static uint32_t borrowed_sample(const mw_borrowed *mesh, uint32_t last, mw_point q,
                                uint64_t *random)
{
    uint32_t count = (uint32_t)lround(cbrt(mesh->point_count)), best = last;
    double least = INFINITY;
    for (uint32_t i = 0; i <= count; i++) {
        uint32_t t = i == count ? last : mw__random_below(random, mesh->tri_count);
        uint32_t v = mw__borrowed_number(mesh, mesh->triangles, 3 * (size_t)t);
        if (v >= mesh->point_count) continue;
        double distance = mw__distance2(mw__borrowed_point(mesh, v), q);
        if (!(distance < least)) continue;
        least = distance;
        best = t;
    }
    return best;
}

/* Triangles without an area know no side: begin beside them, if that helps. */
static uint32_t borrowed_with_area(const mw_borrowed *mesh, uint32_t t)
{
    borrowed_view view;
    if (MW_LIKELY(borrowed_view_read(mesh, t, &view))) return t;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t across = mw__borrowed_across(mesh, t, k);
        if (across != MW_NONE && borrowed_view_read(mesh, across, &view)) return across;
    }
    return t;
}

static uint32_t borrowed_first(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, mw_point q,
                               bool chained)
{
    uint32_t last = cursor->last < mesh->tri_count ? cursor->last : 0;
    mw_borrowed_tile tile;
    if (chained) return last;
    if (mw__borrowed_read(mesh, last, &tile) && borrowed_is_close(&tile, q)) return last;
    return borrowed_sample(mesh, last, q, &cursor->random);
}

/* --- the query --- */

static void borrowed_count(mw_counters *counters, const mw_work *work)
{
    mw_counters_add(counters, &(mw_counters){
                                  .queries = 1,
                                  .triangles_visited = work->visited,
                                  .triangles_max = work->visited,
                                  .triangles = work->triangles[MW_STAGE_WALK],
                                  .triangles_walk_max = work->triangles[MW_STAGE_WALK],
                                  .triangles_final = work->triangles[MW_STAGE_FINAL],
                                  .triangles_final_max = work->triangles[MW_STAGE_FINAL],
                                  .orient = work->orient[MW_STAGE_WALK],
                                  .orient_final = work->orient[MW_STAGE_FINAL],
                              });
}

/* As walks in tilings have it (walk.h); twice, as half is for the coin. */
static uint32_t borrowed_fuel(const mw_borrowed *mesh)
{
    return 2 * (4096 + (uint32_t)(45 * sqrt(mesh->tri_count)));
}

static mw_verdict borrowed_walk_run(mw_borrowed_walk *w, mw_walk_kind kind)
{
    mw_verdict verdict = MW_VERDICT_UNSURE;
    if (kind == MW_WALK_BARYCENTRIC) verdict = mw__borrowed_barycentric(w);
    if (kind == MW_WALK_DIRECT) verdict = mw__borrowed_direct(w);
    if (verdict != MW_VERDICT_UNSURE) return verdict;
    if (kind == MW_WALK_BARYCENTRIC || kind == MW_WALK_DIRECT)
        begin_stage(&w->counts, MW_STAGE_FINAL, mw__borrowed_policy);
    w->t = borrowed_with_area(w->mesh, w->t);
    w->fuel = borrowed_fuel(w->mesh);
    return mw__borrowed_remembering(w);
}

mw_location mw__borrowed_locate(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, mw_point q,
                                bool chained)
{
    mw_work work = {0};
    uint32_t first = borrowed_first(mesh, cursor, q, chained);
    mw_borrowed_walk w = {
        .mesh = mesh, .q = q, .fuel = borrowed_fuel(mesh), .random = mw__random(&cursor->random)};
    w.counts.work = &work;
    w.counts.stage = MW_STAGE_WALK;
    mw__borrowed_enter(&w, first);
    mw_verdict verdict = borrowed_walk_run(&w, (mw_walk_kind)cursor->walk);
    borrowed_count(&cursor->counters, &work);
    cursor->last = w.t;
    if (MW_LIKELY(verdict == MW_VERDICT_FOUND))
        return borrowed_answer(mesh, &cursor->last, q, &cursor->counters);
    if (verdict == MW_VERDICT_LEFT && borrowed_is_outside(mesh, w.t, q))
        return mw__location_nowhere(MW_OUTSIDE);
    return borrowed_scan(mesh, q, &cursor->counters, &cursor->last);
}

mw_location mw_borrowed_locate(const mw_borrowed *mesh, mw_borrowed_cursor *cursor, double x,
                               double y)
{
    if (!isfinite(x) || !isfinite(y)) return mw__location_nowhere(MW_BAD);
    if (mesh->tri_count == 0) return mw__location_nowhere(MW_OUTSIDE);
    return mw__borrowed_locate(mesh, cursor, (mw_point){x, y}, false);
}

mw_status mw_borrowed_cursor_init(const mw_borrowed_query_options *options,
                                  mw_borrowed_cursor *cursor, mw_error *error)
{
    static const mw_borrowed_query_options defaults;
    if (!cursor) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new cursor is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_borrowed_query_options, options, error);
    if (status) return status;
    mw_walk_kind walk = options->walk;
    if (walk != MW_WALK_AUTO && walk != MW_WALK_REMEMBERING && walk != MW_WALK_BARYCENTRIC &&
        walk != MW_WALK_DIRECT)
        return mw__fail(
            error, MW_ERROR_ARGUMENT,
            "the walks in borrowed arrays are remembering, barycentric and direct, not %s",
            (unsigned)walk < MW_WALK_COUNT ? mw_walk_name(walk) : "an unknown one");
    *cursor =
        (mw_borrowed_cursor){.random = mw__random_seed(options->seed, 0), .walk = (uint32_t)walk};
    return MW_OK;
}
