/* border_walk.c - the straight walk that goes round borders [thesis App. D, Alg. 1].
 *
 *            :  q
 *       l----:---r  in
 *        `   :  /
 *   .     \  :  |
 *    `-----\ : /
 *      r----:----l  out
 *           p
 *
 * Walk along the line from a point p on an edge of the first tile to q, as the straight walk does.
 * Where the line leaves the mesh ("out"), follow the border, turning round its vertices through
 * tiles, to an edge over which the line comes back ("in") after the point where it left, but not
 * after q: there the walk goes on. If the border, followed all round, has no such edge, q lies on
 * the other side of it: outside, or in the hole that it bounds. Departures from the printed
 * pseudocode (slip 6). A vertex on the line counts as right of it, both where the line leaves and
 * where it comes back: the walk follows a line that is moved a little to the left, and meets no
 * vertex. Whether an edge comes after the way out is decided by the ends of both edges, which do
 * not cross; no point of intersection is computed. p is the middle of the edge, but any point will
 * do from which the line to q has the edge's ends on different sides. If rounding has moved the
 * middle so far that it has not, p is the right end. A vertex of the border on the line is compared
 * with q, and so is an edge along the line: such a q may lie on the border where the line passes
 * outside. Where several fans of tiles meet in a vertex, the border goes on round the face beyond
 * it (tiling/border_loops.h). If tiles fill their hull, there is nothing beyond the border, and q
 * is outside as soon as the line leaves. Ends on every embedding: each time the line comes back it
 * does so farther along than it left. But it may come back very often, and the walk may follow the
 * same border each time. So its steps are limited. If they do not suffice, a second form takes
 * over: it follows a border all round, and continues where the line comes back for the last time.
 * If the line leaves over that border again, it does not come back. Proof: docs/proofs/walks.md. */
#include "walk/drive.h"

/* phases; round: where the border's last vertex lies */
enum { FIRST, FOLLOW, ROUND_LEFT, ROUND_RIGHT, ROUND_ON };

/* > 0: s lies to the left of the line from p to q; < 0: to the right. */
static MW_INLINE double border_side(mw_walk *w, mw_point s, mw_policy P)
{
    return orient(w, w->p, w->q, s, P);
}

static MW_INLINE void border_begin_run(mw_walk *w, uint32_t phase, uint32_t stage, mw_policy P)
{
    w->phase = phase;
    if (!P.count) return;
    w->stage = stage;
    w->work->walk_runs += stage == MW_STAGE_WALK;
    w->work->border_runs += stage == MW_STAGE_BORDER;
}

/* From border edge e on along the border: to the edge that begins at its end, or to a tile beyond a
 * turn. */
static MW_INLINE mw_verdict border_turn_corner(mw_walk *w, uint32_t e, mw_policy P)
{
    const mw_border_loops *loops = w->tiling->border_loops;
    uint32_t turn = loops && MW_UNLIKELY(loops->jump_count > 0)
                        ? mw__border_loops_jump(loops, mw__link(w->t, e))
                        : MW_NONE;
    w->e = mw__next(e);
    if (MW_LIKELY(turn == MW_NONE)) return MW_VERDICT_GO_ON;
    w->t = mw__link_triangle(turn);
    w->e = mw__link_edge(turn);
    if (P.count) {
        w->work->visited++;
        w->work->triangles[MW_STAGE_BORDER]++;
    }
    return MW_VERDICT_GO_ON;
}

/* Leave over edge e, whose end lies strictly to the left: into the next tile, or along the
 * border. */
static MW_INLINE mw_verdict border_go_on(mw_walk *w, uint32_t e, mw_policy P)
{
    if (MW_LIKELY(w->tri[w->t].link[e] != MW_NONE)) return cross(w, e, P);
    if (!w->tiling->border_loops && w->tiling->embedding) return MW_VERDICT_LEFT;
    w->exit = w->lowest = mw__link(w->t, e);
    w->farthest = MW_NONE;
    border_begin_run(w, ROUND_LEFT, MW_STAGE_BORDER, P);
    return border_turn_corner(w, e, P);
}

/* The first tile: the first edge that q lies beyond, and p on it. */
static MW_INLINE mw_verdict border_aim(mw_walk *w, mw_policy P)
{
    uint32_t e = 0;
    border_begin_run(w, FOLLOW, MW_STAGE_WALK, P);
    while (!beyond(w, e, P))
        if (++e == 3) return MW_VERDICT_FOUND;
    mw_point r = corner(w, e), l = corner(w, e + 1);
    w->p = (mw_point){r.x / 2 + l.x / 2, r.y / 2 + l.y / 2};
    if (border_side(w, r, P) > 0 || border_side(w, l, P) <= 0) w->p = r;
    return border_go_on(w, e, P);
}

/* Entered over edge e = lr. */
static MW_INLINE mw_verdict border_follow(mw_walk *w, mw_policy P)
{
    uint32_t out = border_side(w, apex(w, w->e), P) > 0 ? mw__next(w->e) : mw__prev(w->e);
    return beyond(w, out, P) ? border_go_on(w, out, P) : MW_VERDICT_FOUND;
}

/* An edge that the line crosses, by the ends on its right and left. */
typedef struct crossed_edge {
    mw_point r, l;
} crossed_edge;

/* Does the line meet edge `there` behind edge `here`? One of the two lies on one side of the other,
 * as they do not cross. */
static MW_INLINE bool edge_is_behind(mw_walk *w, crossed_edge here, crossed_edge there, mw_policy P)
{
    double r = orient(w, here.r, here.l, there.r, P), l = orient(w, here.r, here.l, there.l, P);
    if (r <= 0 && l <= 0) return true;
    if (r >= 0 && l >= 0) return false;
    r = orient(w, there.r, there.l, here.r, P);
    return r != 0 ? r > 0 : orient(w, there.r, there.l, here.l, P) > 0;
}

static MW_INLINE mw_point half_end(const mw_walk *w, uint32_t half, uint32_t end)
{
    return w->point[w->tri[mw__link_triangle(half)].v[mw__link_edge(half) + end]];
}

/* Does the line come back over the border edge ab, behind the point where it left and not behind
 * q? */
static MW_INLINE bool border_comes_back(mw_walk *w, mw_point a, mw_point b, mw_policy P)
{
    crossed_edge out = {half_end(w, w->exit, 0), half_end(w, w->exit, 1)};
    return orient(w, a, b, w->q, P) >= 0 && edge_is_behind(w, out, (crossed_edge){b, a}, P);
}

/* Is it behind all others over which the line comes back? */
static MW_INLINE bool border_is_farthest(mw_walk *w, mw_point a, mw_point b, mw_policy P)
{
    if (w->farthest == MW_NONE) return true;
    crossed_edge last = {half_end(w, w->farthest, 1), half_end(w, w->farthest, 0)};
    return edge_is_behind(w, last, (crossed_edge){b, a}, P);
}

static MW_INLINE bool border_point_is_between(mw_point a, mw_point q, mw_point b)
{
    return fmin(a.x, b.x) <= q.x && q.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= q.y &&
           q.y <= fmax(a.y, b.y);
}

/* The walk goes on in the tile of a border edge, over which the line comes back. */
static MW_INLINE mw_verdict border_come_back(mw_walk *w, uint32_t half, mw_policy P)
{
    border_begin_run(w, FOLLOW, MW_STAGE_WALK, P);
    if (P.count) w->work->triangles[MW_STAGE_WALK]++;
    w->t = mw__link_triangle(half);
    w->e = mw__link_edge(half);
    return MW_VERDICT_GO_ON;
}

/* Along border edge e to its end: is q there, or does the line come back over it? */
static MW_INLINE mw_verdict border_pass(mw_walk *w, uint32_t e, bool all, mw_policy P)
{
    mw_point a = corner(w, e), b = corner(w, e + 1);
    double s = border_side(w, b, P);
    uint32_t half = mw__link(w->t, e);
    if (P.count) w->work->border_edges++;
    if (half < w->lowest) w->lowest = half;
    if (MW_UNLIKELY(s == 0 && border_point_is_between(w->phase == ROUND_ON ? a : b, w->q, b)))
        return MW_VERDICT_FOUND;
    if (w->phase == ROUND_LEFT && s <= 0 && border_comes_back(w, a, b, P)) {
        if (!all) return border_come_back(w, half, P);
        if (border_is_farthest(w, a, b, P)) w->farthest = half;
    }
    w->phase = s > 0 ? ROUND_LEFT : s < 0 ? ROUND_RIGHT : ROUND_ON;
    return border_turn_corner(w, e, P);
}

/* Edge e begins at the border's last vertex: turn round that through tiles to the border's next
 * edge. Ends: the turn began at a border edge, and no tile has two tiles before it. */
static MW_INLINE mw_verdict border_go_round(mw_walk *w, bool all, mw_policy P)
{
    while (w->tri[w->t].link[w->e] != MW_NONE) {
        cross(w, w->e, P);
        w->e = mw__next(w->e);
    }
    if (mw__link(w->t, w->e) != w->exit) return border_pass(w, w->e, all, P);
    return all && w->farthest != MW_NONE ? border_come_back(w, w->farthest, P) : MW_VERDICT_LEFT;
}

static MW_INLINE mw_verdict border_step(mw_walk *w, bool all, mw_policy P)
{
    if (MW_LIKELY(w->phase == FOLLOW)) return border_follow(w, P);
    if (w->phase == FIRST) return border_aim(w, P);
    return w->phase == MW_PHASE_AWAY ? MW_VERDICT_LEFT : border_go_round(w, all, P);
}

static MW_INLINE mw_verdict border_walk_step(mw_walk *w, mw_policy P)
{
    return border_step(w, false, P);
}

static MW_INLINE mw_verdict border_sure_step(mw_walk *w, mw_policy P)
{
    return border_step(w, true, P);
}

MW_STAMP_WALK(border_walk, false)
MW_STAMP_WALK(border_sure, true)
