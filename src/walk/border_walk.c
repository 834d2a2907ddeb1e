/* border_walk.c - the straight walk that goes round borders [thesis App. D, Alg. 1].
 *
 *            :  q           Walk along the line from a point p of the first tile's edge to q, as the straight walk does.
 *       l----:---r  in      Where the line leaves the mesh, go along the border, turning round its vertices through tiles, until
 *        `   :  /           an edge is met by which the line comes back ("in") behind the place where it left ("out") and not
 *   .     \  :  |           behind q: there the walk goes on. If all the border from the way out round to itself has no such
 *    `-----\ : /            edge, q lies on the far side of it: outside, or in the hole that it bounds.
 *      r----:----l  out
 *           p
 * Departures from the printed pseudocode (slip 6). A vertex on the line counts as one to its right, on both ways: the walk
 * follows a line that is moved a little to the left, and meets no vertex. Whether an edge is met behind the way out is
 * decided by the ends of both edges, which do not cross; no point of intersection is computed. p is the middle of the edge, or
 * rather any point from which the line to q has the edge's ends on different sides; where rounding has moved the middle so
 * far that it has not, p is the right end. A vertex of the border on the line is compared with q, and so is an edge along the
 * line: such a q may lie on the border where the line passes outside. Where several fans of tiles meet in a vertex, the
 * border goes on round the face beyond it (open.h).
 * Ends on every embedding: each time the line comes back it does so farther on than it left. docs/guarantees.md has the
 * proof, and what it costs. */
#include "walk/drive.h"

enum { FIRST, FOLLOW, ROUND_LEFT, ROUND_RIGHT, ROUND_ON }; /* phases; round: where the border's last vertex lies */

/* > 0: s lies to the left of the line from p to q; < 0: to the right. */
static MW_INLINE double side(mw_walk *w, mw_point s, mw_policy P)
{
    return orient(w, w->p, w->q, s, P);
}

static MW_INLINE void begin_run(mw_walk *w, uint32_t phase, uint32_t stage, mw_policy P)
{
    w->phase = phase;
    if (!P.count) return;
    w->stage = stage;
    w->work->walk_runs += stage == MW_STAGE_WALK;
    w->work->border_runs += stage == MW_STAGE_BORDER;
}

/* From border edge e on along the border: to the edge that begins at its end, or to a tile beyond a turn. */
static MW_INLINE mw_verdict turn_corner(mw_walk *w, uint32_t e, mw_policy P)
{
    const mw_open *open = w->tiling->open;
    uint32_t turn = open && MW_UNLIKELY(open->turn_count > 0) ? mw__open_turn(open, mw__link(w->t, e)) : MW_NONE;
    w->e = mw__next(e);
    if (MW_LIKELY(turn == MW_NONE)) return MW_GO;
    w->t = mw__link_triangle(turn);
    w->e = mw__link_edge(turn);
    if (P.count) {
        w->work->visited++;
        w->work->triangles[MW_STAGE_BORDER]++;
    }
    return MW_GO;
}

/* Leave over edge e, whose end lies strictly to the left: into the next tile, or along the border. */
static MW_INLINE mw_verdict go_on(mw_walk *w, uint32_t e, mw_policy P)
{
    if (MW_LIKELY(w->tri[w->t].link[e] != MW_NONE)) return cross(w, e, P);
    w->exit = w->lowest = mw__link(w->t, e);
    begin_run(w, ROUND_LEFT, MW_STAGE_BORDER, P);
    return turn_corner(w, e, P);
}

/* The first tile: the first edge that q lies beyond, and p on it. */
static MW_INLINE mw_verdict aim(mw_walk *w, mw_policy P)
{
    uint32_t e = 0;
    begin_run(w, FOLLOW, MW_STAGE_WALK, P);
    while (!beyond(w, e, P))
        if (++e == 3) return MW_FOUND;
    mw_point r = corner(w, e), l = corner(w, e + 1);
    w->p = (mw_point){r.x / 2 + l.x / 2, r.y / 2 + l.y / 2};
    if (side(w, r, P) > 0 || side(w, l, P) <= 0) w->p = r;
    return go_on(w, e, P);
}

/* Entered over edge e = lr. */
static MW_INLINE mw_verdict follow(mw_walk *w, mw_policy P)
{
    uint32_t out = side(w, apex(w, w->e), P) > 0 ? mw__next(w->e) : mw__prev(w->e);
    return beyond(w, out, P) ? go_on(w, out, P) : MW_FOUND;
}

/* Does the line meet edge lr, by which it comes in, behind the edge by which it left? One of the two edges lies on one side
 * of the other, as they do not cross. */
static MW_INLINE bool is_behind_exit(mw_walk *w, mw_point l, mw_point r, mw_policy P)
{
    const uint32_t *v = w->tri[mw__link_triangle(w->exit)].v + mw__link_edge(w->exit);
    mw_point out_r = w->point[v[0]], out_l = w->point[v[1]];
    double at_r = orient(w, out_r, out_l, r, P), at_l = orient(w, out_r, out_l, l, P);
    if (at_r <= 0 && at_l <= 0) return true;
    if (at_r >= 0 && at_l >= 0) return false;
    double out_at_r = orient(w, l, r, out_r, P);
    return out_at_r != 0 ? out_at_r < 0 : orient(w, l, r, out_l, P) < 0;
}

static MW_INLINE bool is_between(mw_point a, mw_point q, mw_point b)
{
    return fmin(a.x, b.x) <= q.x && q.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= q.y && q.y <= fmax(a.y, b.y);
}

/* Along border edge e to its end: is q there, or does the line come back over it? */
static MW_INLINE mw_verdict pass_border(mw_walk *w, uint32_t e, mw_policy P)
{
    mw_point a = corner(w, e), b = corner(w, e + 1);
    double s = side(w, b, P);
    uint32_t half = mw__link(w->t, e);
    if (P.count) w->work->border_edges++;
    if (half < w->lowest) w->lowest = half;
    if (MW_UNLIKELY(s == 0 && is_between(w->phase == ROUND_ON ? a : b, w->q, b))) return MW_FOUND;
    if (w->phase == ROUND_LEFT && s <= 0 && orient(w, a, b, w->q, P) >= 0 && is_behind_exit(w, a, b, P)) {
        begin_run(w, FOLLOW, MW_STAGE_WALK, P);
        if (P.count) w->work->triangles[MW_STAGE_WALK]++;
        return MW_GO;
    }
    w->phase = s > 0 ? ROUND_LEFT : s < 0 ? ROUND_RIGHT : ROUND_ON;
    return turn_corner(w, e, P);
}

/* Edge e begins at the border's last vertex: turn round that through tiles to the border's next edge. Ends: the turn began at
 * a border edge, and no tile has two tiles before it. */
static MW_INLINE mw_verdict go_round(mw_walk *w, mw_policy P)
{
    while (w->tri[w->t].link[w->e] != MW_NONE) {
        cross(w, w->e, P);
        w->e = mw__next(w->e);
    }
    return mw__link(w->t, w->e) == w->exit ? MW_LEFT : pass_border(w, w->e, P);
}

static MW_INLINE mw_verdict border_walk_step(mw_walk *w, mw_policy P)
{
    if (MW_LIKELY(w->phase == FOLLOW)) return follow(w, P);
    if (w->phase != FIRST) return go_round(w, P);
    return aim(w, P);
}

MW_STAMP_WALK(border_walk, true)
