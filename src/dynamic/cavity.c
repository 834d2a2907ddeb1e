/* cavity.c - digging the cavity of a new vertex.
 *
 * The boundary is followed counter-clockwise. If the tile beyond a step belongs to the cavity, its
 * two other edges replace the step. No tile is met twice: then all tiles of some vertex would be in
 * the cavity, which happens only to a vertex that coincides with q.
 *
 * Each tile brings two steps, so circles are tested in pairs, in the two halves of a vector. A
 * processor cannot predict the outcome of these tests and restarts after each wrong guess. So the
 * neighbours of the first tile (two in three belong to the cavity) are tested together with the
 * tiles beyond them, before anything depends on the results. */
#include "dynamic/cavity.h"

#include "dynamic/dynamic_tiling_memory.h"
#include "dynamic/tile_links.h"

/* --- room ------------------------------------------------------------------------------------- */

/* Where the next entry of each list goes. There is room for tiles up to `full`: each brings one
 * step, one pending step and two lifted vertices. */
typedef struct cavity_writer {
    mw_boundary_step *boundary;
    mw_pending_step *pending;
    mw_lifted_vertex *lifted; /* dynamic->lifted itself, of which lifted_count are in use */
    uint32_t lifted_count;
    uint32_t *pool, *full;
} cavity_writer;

enum {
    SPARE = 8, /* steps of a cavity without tiles     */
    FEW = 56   /* tiles for which there always is room */
};

/* Entries of the lists that are not for tiles. `steps`: how many are pending at first. */
static size_t room_besides(const mw_cavity *cavity, size_t steps)
{
    return cavity->first + cavity->pool + steps + SPARE;
}

/* The second cavity is written after the first, and has other tiles. */
bool mw__cavity_room(mw_dynamic_tiling *dynamic, size_t tiles)
{
    const mw_cavity first = {.first = tiles + 3, .pool = tiles};
    return mw__boundary_room(dynamic, room_besides(&first, 3) + FEW);
}

static cavity_writer cavity_writer_begin(const mw_dynamic_tiling *dynamic, const mw_cavity *cavity,
                                         size_t steps, uint32_t lifted_count)
{
    uint32_t *pool = dynamic->pool + cavity->pool;
    return (cavity_writer){dynamic->boundary + cavity->first,
                           dynamic->pending + steps,
                           dynamic->lifted,
                           lifted_count,
                           pool + cavity->tiles,
                           pool + (dynamic->boundary_room - room_besides(cavity, steps))};
}

/* Make room for twice as many tiles. When out of memory the pool remains full. */
static __attribute__((noinline)) cavity_writer cavity_writer_widen(mw_dynamic_tiling *dynamic,
                                                                   const mw_cavity *cavity,
                                                                   size_t steps, cavity_writer at)
{
    const size_t boundary = (size_t)(at.boundary - dynamic->boundary),
                 pending = (size_t)(at.pending - dynamic->pending);
    const size_t pool = (size_t)(at.pool - dynamic->pool);
    if (!mw__boundary_room(dynamic, 2 * dynamic->boundary_room)) return at;
    return (cavity_writer){dynamic->boundary + boundary,
                           dynamic->pending + pending,
                           dynamic->lifted,
                           at.lifted_count,
                           dynamic->pool + pool,
                           dynamic->pool + cavity->pool +
                               (dynamic->boundary_room - room_besides(cavity, steps))};
}

/* --- circles ---------------------------------------------------------------------------------- */

/* Two numbers, one for each of two steps. */
typedef double double_pair __attribute__((vector_size(16)));

/* Does the tile beyond a step stay, whatever its circle? `unconstrained`: no edge is fixed, and the
 * mesh is kept Delaunay. */
static MW_INLINE bool step_is_closed(const mw_dynamic_tiling *dynamic, const mw_pending_step *step,
                                     bool unconstrained)
{
    return step->beyond == MW_NONE || (!unconstrained && (step->fixed || !dynamic->delaunay));
}

/* The vertex of the tile beyond a step that is opposite of the step. */
static MW_INLINE uint32_t apex_beyond(const mw_triangle *tri, uint32_t beyond)
{
    return tri[mw__link_triangle(beyond)].v[mw__prev(mw__link_edge(beyond))];
}

static __attribute__((noinline)) bool in_circle_exact(const mw_dynamic_tiling *dynamic, uint32_t a,
                                                      uint32_t b, uint32_t c, mw_point q)
{
    const mw_point *p = dynamic->tiling->point;
    const mw_lifted_vertex *lifted = dynamic->lifted;
    return mw__incircle_sign(p[lifted[a].vertex], p[lifted[b].vertex], p[lifted[c].vertex], q) > 0;
}

/* `which` ? yes : no. By arithmetic, since a branch would be mispredicted. */
static MW_INLINE uint32_t select_number(bool which, uint32_t yes, uint32_t no)
{
    return no ^ ((no ^ yes) & (0 - (uint32_t)which));
}

/* Does the tile beyond a step conflict with q, so that it belongs to the cavity? The step begins at
 * dynamic->lifted[from]. Sets dynamic->lifted[apex] to the apex of the tile. */
static MW_INLINE bool tile_conflicts(const mw_dynamic_tiling *dynamic, mw_point q, uint32_t from,
                                     const mw_pending_step *step, uint32_t apex, bool unconstrained)
{
    if (MW_UNLIKELY(step_is_closed(dynamic, step, unconstrained))) return false;
    const uint32_t v = apex_beyond(dynamic->tiling->tri, step->beyond);
    const mw_lifted_vertex *a = &dynamic->lifted[from], *b = &dynamic->lifted[step->end],
                           c = mw__lift_vertex(dynamic->tiling, v, q);
    double bound, det = mw__lifted_incircle(b, a, &c, &bound);
    dynamic->lifted[apex] = c;
    if (MW_UNLIKELY(!(fabs(det) > bound)))
        return in_circle_exact(dynamic, step->end, from, apex, q);
    return det > 0;
}

typedef struct conflict_pair {
    bool one, two;
} conflict_pair;

static __attribute__((noinline)) conflict_pair
pair_conflicts_scalar(const mw_dynamic_tiling *dynamic, mw_point q, uint32_t from,
                      mw_pending_step one, mw_pending_step two, uint32_t apex, bool unconstrained)
{
    conflict_pair conflict = {.one = tile_conflicts(dynamic, q, from, &one, apex, unconstrained)};
    conflict.two = tile_conflicts(dynamic, q, one.end, &two, apex + 1, unconstrained);
    return conflict;
}

/* The same for two consecutive steps and two apices. If not `wanted`, the result may be wrong. */
static MW_INLINE conflict_pair pair_conflicts(const mw_dynamic_tiling *dynamic, mw_point q,
                                              uint32_t from, const mw_pending_step *one,
                                              const mw_pending_step *two, uint32_t apex,
                                              bool wanted, bool unconstrained)
{
    const conflict_pair neither = {false, false};
    if (MW_UNLIKELY(step_is_closed(dynamic, one, unconstrained) ||
                    step_is_closed(dynamic, two, unconstrained)))
        return wanted ? pair_conflicts_scalar(dynamic, q, from, *one, *two, apex, unconstrained)
                      : neither;
    const mw_triangle *tri = dynamic->tiling->tri;
    mw_lifted_vertex *lifted = dynamic->lifted;
    const uint32_t v1 = apex_beyond(tri, one->beyond), v2 = apex_beyond(tri, two->beyond);
    const mw_point *p1 = &dynamic->tiling->point[v1], *p2 = &dynamic->tiling->point[v2];
    const mw_lifted_vertex *a = &lifted[from], *b = &lifted[one->end], *c = &lifted[two->end];
    const double_pair here = {q.x, q.y}, to1 = (double_pair){p1->x, p1->y} - here,
                      to2 = (double_pair){p2->x, p2->y} - here;
    const double_pair x = {to1[0], to2[0]}, y = {to1[1], to2[1]}, lift = x * x + y * y;
    const double_pair from_x = {a->x, b->x}, from_y = {a->y, b->y}, from_lift = {a->lift, b->lift};
    const double_pair end_x = {b->x, c->x}, end_y = {b->y, c->y}, end_lift = {b->lift, c->lift};
    const double_pair lifts = from_lift + end_lift + lift;
    const double_pair det = end_lift * (from_x * y - from_y * x) +
                            from_lift * (x * end_y - y * end_x) +
                            lift * (end_x * from_y - end_y * from_x);
    lifted[apex] = (mw_lifted_vertex){to1[0], to1[1], lift[0], v1};
    lifted[apex + 1] = (mw_lifted_vertex){to2[0], to2[1], lift[1], v2};
    const double both = lifts[0] + lifts[1],
                 bound = both * both * MW_LIFTED_ERROR + MW_UNDERFLOW_ERROR;
    const double first = fabs(det[0]), second = fabs(det[1]);
    if (MW_UNLIKELY(!((first < second ? first : second) > bound)))
        return wanted ? pair_conflicts_scalar(dynamic, q, from, *one, *two, apex, unconstrained)
                      : neither;
    return (conflict_pair){det[0] > 0, det[1] > 0};
}

/* --- along the boundary ----------------------------------------------------------------------- */

/* Copy member by member: a read wider than the stores before it would defeat store forwarding. */
static MW_INLINE void pending_step_copy(mw_pending_step *to, const mw_pending_step *step,
                                        bool unconstrained)
{
    to->end = step->end;
    to->beyond = step->beyond;
    to->apex = step->apex;
    if (!unconstrained) to->fixed = step->fixed;
}

/* Follow the boundary from dynamic->lifted[from] on: first `step`, then the `steps` pending ones,
 * the last one first. */
static MW_INLINE bool cavity_dig_along(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t from,
                                       mw_pending_step step, size_t steps, uint32_t lifted_count,
                                       bool unconstrained)
{
    const size_t dug = cavity->tiles;
    const mw_point q = cavity->q;
    cavity_writer at = cavity_writer_begin(dynamic, cavity, steps, lifted_count);
    for (;;) {
        while (step.apex != MW_NONE) {
            const uint32_t t = mw__link_triangle(step.beyond), e = mw__link_edge(step.beyond),
                           next = mw__next(e), prev = mw__prev(e),
                           fixed = unconstrained ? 0 : dynamic->mark[t];
            const uint32_t *link = dynamic->tiling->tri[t].link;
            if (MW_UNLIKELY(at.pool >= at.full))
                at = cavity_writer_widen(dynamic, cavity, steps, at);
            if (MW_UNLIKELY(at.pool >= at.full)) return false;
            *at.pool++ = t;
            mw_pending_step one = {.end = step.apex,
                                   .beyond = link[next],
                                   .fixed = fixed >> next & 1},
                            two = {
                                .end = step.end, .beyond = link[prev], .fixed = fixed >> prev & 1};
            const conflict_pair conflict =
                pair_conflicts(dynamic, q, from, &one, &two, at.lifted_count, true, unconstrained);
            two.apex = select_number(conflict.two, at.lifted_count + 1, MW_NONE);
            pending_step_copy(at.pending++, &two, unconstrained);
            one.apex = at.lifted_count;
            pending_step_copy(&step, &one, unconstrained);
            at.lifted_count += 2;
            if (!conflict.one) break; /* the apex is not read then */
        }
        at.boundary->vertex = at.lifted[from].vertex;
        at.boundary->beyond = step.beyond;
        if (!unconstrained) at.boundary->fixed = step.fixed;
        at.boundary++;
        from = step.end;
        if (at.pending == dynamic->pending) break;
        pending_step_copy(&step, --at.pending, unconstrained);
    }
    at.boundary->vertex = at.lifted[from].vertex;
    cavity->steps = (size_t)(at.boundary - dynamic->boundary) - cavity->first;
    cavity->tiles = (size_t)(at.pool - dynamic->pool) - cavity->pool;
    dynamic->flips += (uint32_t)(cavity->tiles - dug);
    return true;
}

/* --- where digging begins --------------------------------------------------------------------- */

/* Put tile t into the cavity, with room for its neighbours. */
static MW_INLINE bool cavity_begin_with(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t t)
{
    if (!mw__boundary_room(dynamic, room_besides(cavity, 3) + FEW)) return false;
    dynamic->pool[cavity->pool] = t;
    cavity->tiles = 1;
    return true;
}

/* Edge k of tile t, which is in the cavity, as a step that ends at lifted vertex `end`. */
static MW_INLINE mw_pending_step pending_edge(const mw_dynamic_tiling *dynamic, uint32_t t,
                                              uint32_t k, uint32_t end, bool unconstrained)
{
    return (mw_pending_step){.end = end,
                             .beyond = dynamic->tiling->tri[t].link[k],
                             .fixed = !unconstrained && dynamic->mark[t] >> k & 1};
}

/* Append edge k of the first tile, `step`, to the pending steps; or, if the tile beyond
 * `conflicts`, the two steps that replace it. Returns how many steps are pending then. Lifted
 * vertices: 3 + k is the apex of the tile beyond, 6 + 2 k and 7 + 2 k are those of the tiles beyond
 * that. The writes do not depend on `conflicts`; if the tile stays, some are beyond
 * the end of their list. */
static MW_INLINE size_t cavity_put_neighbour(mw_dynamic_tiling *dynamic, mw_cavity *cavity,
                                             size_t steps, uint32_t k, const mw_pending_step *step,
                                             bool conflicts, bool unconstrained)
{
    const uint32_t t = mw__link_triangle(step->beyond), e = mw__link_edge(step->beyond),
                   apex = 3 + k, next = 6 + 2 * k;
    mw_pending_step one = pending_edge(dynamic, t, mw__next(e), apex, unconstrained),
                    two = pending_edge(dynamic, t, mw__prev(e), step->end, unconstrained);
    const conflict_pair conflict =
        pair_conflicts(dynamic, cavity->q, k, &one, &two, next, conflicts, unconstrained);
    one.apex = select_number(conflict.one, next, MW_NONE);
    two.apex = select_number(conflicts & conflict.two, next + 1, MW_NONE);
    two.beyond = select_number(conflicts, two.beyond, step->beyond);
    if (!unconstrained && !conflicts) two.fixed = step->fixed;
    pending_step_copy(&dynamic->pending[steps], &two, unconstrained);
    /* on top: it comes first */
    pending_step_copy(&dynamic->pending[steps + 1], &one, unconstrained);
    dynamic->pool[cavity->pool + cavity->tiles] = t;
    cavity->tiles += conflicts;
    return steps + 1 + conflicts;
}

static MW_INLINE bool cavity_dig_from_tile(mw_dynamic_tiling *dynamic, mw_cavity *cavity,
                                           uint32_t t, bool unconstrained)
{
    mw_pending_step one = pending_edge(dynamic, t, 0, 1, unconstrained),
                    two = pending_edge(dynamic, t, 1, 2, unconstrained),
                    three = pending_edge(dynamic, t, 2, 0, unconstrained);
    const bool all_open = !step_is_closed(dynamic, &one, unconstrained) &&
                          !step_is_closed(dynamic, &two, unconstrained) &&
                          !step_is_closed(dynamic, &three, unconstrained);
    const conflict_pair conflict =
        pair_conflicts(dynamic, cavity->q, 0, &one, &two, 3, true, unconstrained);
    const bool last = tile_conflicts(dynamic, cavity->q, 2, &three, 5, unconstrained);
    if (MW_UNLIKELY(!all_open)) {
        one.apex = select_number(conflict.one, 3, MW_NONE);
        two.apex = select_number(conflict.two, 4, MW_NONE);
        three.apex = select_number(last, 5, MW_NONE);
        pending_step_copy(&dynamic->pending[0], &three, unconstrained);
        pending_step_copy(&dynamic->pending[1], &two, unconstrained);
        return cavity_dig_along(dynamic, cavity, 0, one, 2, 6, unconstrained);
    }
    size_t steps = cavity_put_neighbour(dynamic, cavity, 0, 2, &three, last, unconstrained);
    steps = cavity_put_neighbour(dynamic, cavity, steps, 1, &two, conflict.two, unconstrained);
    steps = cavity_put_neighbour(dynamic, cavity, steps, 0, &one, conflict.one, unconstrained) - 1;
    dynamic->flips += (uint32_t)cavity->tiles - 1;
    pending_step_copy(&one, &dynamic->pending[steps], unconstrained);
    return cavity_dig_along(dynamic, cavity, 0, one, steps, 12, unconstrained);
}

bool mw__cavity_dig_tile(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t t)
{
    if (!cavity_begin_with(dynamic, cavity, t)) return false;
    bool unconstrained = dynamic->fixed_count == 0 && dynamic->convex && dynamic->delaunay;
    return MW_LIKELY(unconstrained) ? cavity_dig_from_tile(dynamic, cavity, t, true)
                                    : cavity_dig_from_tile(dynamic, cavity, t, false);
}

bool mw__cavity_dig_side(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t half)
{
    const uint32_t t = mw__link_triangle(half), k = mw__link_edge(half), next = mw__next(k);
    const uint32_t prev = mw__prev(k);
    mw_pending_step one = pending_edge(dynamic, t, next, prev, false),
                    two = pending_edge(dynamic, t, prev, k, false);
    if (!cavity_begin_with(dynamic, cavity, t)) return false;
    mw__lift_corners(dynamic, t, cavity->q);
    const conflict_pair conflict =
        pair_conflicts(dynamic, cavity->q, next, &one, &two, 3, true, false);
    one.apex = conflict.one ? 3 : MW_NONE;
    two.apex = conflict.two ? 4 : MW_NONE;
    dynamic->pending[0] = two;
    return cavity_dig_along(dynamic, cavity, next, one, 1, 5, false);
}

bool mw__sees_hull_edge(const mw_dynamic_tiling *dynamic, mw_point q, uint32_t half)
{
    const mw_point *p = dynamic->tiling->point;
    const uint32_t *v = dynamic->tiling->tri[mw__link_triangle(half)].v;
    return mw__orient2d(p[v[mw__link_edge(half)]], p[v[mw__link_edge(half) + 1]], q) < 0;
}

uint32_t mw__hull_after(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t at = mw__half_next(half);
    while (mw__beyond(dynamic, at) != MW_NONE) at = mw__half_next(mw__beyond(dynamic, at));
    return at;
}

uint32_t mw__hull_before(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t at = mw__half_prev(half);
    while (mw__beyond(dynamic, at) != MW_NONE) at = mw__half_prev(mw__beyond(dynamic, at));
    return at;
}

bool mw__cavity_dig_outside(mw_dynamic_tiling *dynamic, mw_cavity *cavity, uint32_t t)
{
    const mw_point q = cavity->q;
    uint32_t steps = 0, half = mw__link(t, 0), after;
    while (mw__beyond(dynamic, half) != MW_NONE || !mw__sees_hull_edge(dynamic, q, half))
        half = mw__half_next(half);
    while (mw__sees_hull_edge(dynamic, q, mw__hull_before(dynamic, half)))
        half = mw__hull_before(dynamic, half);
    for (after = half; mw__sees_hull_edge(dynamic, q, after);
         after = mw__hull_after(dynamic, after)) {
        /* this tile stays, but no other tile tells that it had no neighbour here */
        if (!mw__journal_tile(dynamic, mw__link_triangle(after)) ||
            !mw__boundary_room(dynamic, room_besides(cavity, steps + 1)))
            return false;
        dynamic->lifted[steps] = mw__lift_vertex(dynamic->tiling, mw__corner(dynamic, after), q);
        dynamic->pending[steps] =
            (mw_pending_step){.end = steps, .beyond = after, .fixed = mw__is_fixed(dynamic, after)};
        steps++;
    }
    dynamic->lifted[steps] = mw__lift_vertex(dynamic->tiling, mw__corner(dynamic, after), q);
    for (uint32_t i = 0; i < steps; i++)
        dynamic->pending[i].apex =
            tile_conflicts(dynamic, q, i + 1, &dynamic->pending[i], steps + 1 + i, false)
                ? steps + 1 + i
                : MW_NONE;
    return cavity_dig_along(dynamic, cavity, steps, dynamic->pending[steps - 1], steps - 1,
                            2 * steps + 1, false);
}
