/* step.h - the vocabulary of the planar walks: the only place where policy is looked at.
 * Private. */
#ifndef MW_SRC_WALK_STEP_H
#define MW_SRC_WALK_STEP_H

#include "walk/walk.h"

/* How a kernel works. Always a literal where a kernel is stamped; the compiler deletes what is
 * off. */
typedef struct mw_policy {
    bool exact, count, lanes;
} mw_policy;

/* From here on the counters of a stage count, the current tile first. */
static MW_INLINE void begin_stage(mw_walk *w, uint32_t stage, mw_policy P)
{
    if (!P.count) return;
    w->stage = stage;
    w->work->triangles[stage]++;
}

/* In the first tile: what comes belongs to the initialisation, and so does this tile. */
static MW_INLINE void initialise(mw_walk *w, mw_policy P)
{
    if (P.count) w->work->triangles[MW_STAGE_WALK]--;
    begin_stage(w, MW_STAGE_INIT, P);
}

static MW_INLINE double orient(mw_walk *w, mw_point a, mw_point b, mw_point c, mw_policy P)
{
    if (P.count) w->work->orient[w->stage]++;
    return P.exact ? mw__orient2d(a, b, c) : mw__orient2d_double(a, b, c);
}

/* Sign of (b - a) . (c - a). */
static MW_INLINE double dot(mw_walk *w, mw_point a, mw_point b, mw_point c, mw_policy P)
{
    if (P.count) w->work->orient[w->stage]++;
    return P.exact ? mw__dot2d(a, b, c) : (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
}

static MW_INLINE mw_point corner(const mw_walk *w, uint32_t k)
{
    return w->point[w->tri[w->t].v[k]];
}

/* The vertex of the current tile off edge e. */
static MW_INLINE mw_point apex(const mw_walk *w, uint32_t e)
{
    return corner(w, mw__prev(e));
}

/* Set the direction d of the line from p to q, by which the cheap walks decide in plain doubles on
 * which side of the line a vertex is. A very long or short d is scaled by a power of two, so that
 * products of d with differences of coordinates hardly over- or underflow. Returns false if there
 * is no line: q is at p, or d is too long for doubles. */
static MW_INLINE bool set_direction(mw_walk *w, double x, double y)
{
    double length = fabs(x) + fabs(y);
    if (MW_UNLIKELY(!(length > 0x1p-50 && length < 0x1p50))) {
        if (!(length > 0 && length <= DBL_MAX)) return false;
        int exponent;
        frexp(length, &exponent);
        int shift = exponent > 0 ? -exponent : exponent > -1000 ? -2 * exponent : 1000 - exponent;
        x = ldexp(x, shift);
        y = ldexp(y, shift);
    }
    w->d = (mw_point){x, y};
    return true;
}

/* How far s lies ahead of the point o, in direction d, and how far to the left of the line through
 * o: both times |d|. */
static MW_INLINE double ahead(const mw_walk *w, mw_point o, mw_point s)
{
    return w->d.x * (s.x - o.x) + w->d.y * (s.y - o.y);
}

static MW_INLINE double leftward(const mw_walk *w, mw_point o, mw_point s)
{
    return w->d.x * (s.y - o.y) - w->d.y * (s.x - o.x);
}

/* Does q lie strictly to the right of edge e, so that the edge parts it from the tile? */
static MW_INLINE bool beyond(mw_walk *w, uint32_t e, mw_policy P)
{
    return orient(w, corner(w, e), corner(w, e + 1), w->q, P) < 0;
}

/* Go to the tile across edge e. Reads nothing of it: a step ends here. */
static MW_INLINE mw_verdict cross(mw_walk *w, uint32_t e, mw_policy P)
{
    uint32_t link = w->tri[w->t].link[e];
    if (MW_UNLIKELY(link == MW_NONE)) return MW_VERDICT_LEFT;
    w->t = mw__link_triangle(link);
    w->e = mw__link_edge(link);
    if (P.count) {
        w->work->visited++;
        w->work->triangles[w->stage]++;
    }
    return MW_VERDICT_GO_ON;
}

/* The same for the cheap walks: that they would leave the hull here does not mean that q lies
 * outside. */
static MW_INLINE mw_verdict cross_unsure(mw_walk *w, uint32_t e, mw_policy P)
{
    mw_verdict verdict = cross(w, e, P);
    return MW_UNLIKELY(verdict == MW_VERDICT_LEFT) ? MW_VERDICT_UNSURE : verdict;
}

/* Cross edge e, which was computed from areas. A single walk should not wait for them: it uses a
 * jump, so that the processor predicts the edge and loads the next tile early. Many walks that take
 * turns have time, and wrong predictions would only cost it. */
static MW_INLINE mw_verdict cross_guessed(mw_walk *w, uint32_t e, mw_policy P)
{
    if (P.lanes) return cross(w, e, P);
    uint32_t next = mw__next(w->e), prev = mw__prev(w->e);
    if (e == next) return cross(w, next, P);
    if (e == prev) return cross(w, prev, P);
    return cross(w, e, P);
}

static MW_INLINE mw_verdict cross_guessed_unsure(mw_walk *w, uint32_t e, mw_policy P)
{
    mw_verdict verdict = cross_guessed(w, e, P);
    return MW_UNLIKELY(verdict == MW_VERDICT_LEFT) ? MW_VERDICT_UNSURE : verdict;
}

/* Leave through edge e if q lies beyond it; otherwise q is here. */
static MW_INLINE mw_verdict leave(mw_walk *w, uint32_t e, mw_policy P)
{
    return beyond(w, e, P) ? cross(w, e, P) : MW_VERDICT_FOUND;
}

/* Leave through `first`, or else `second`, if q lies beyond it; otherwise q is here. Many walks
 * that take turns hide the time of a second test, but not that of a wrongly predicted jump: so they
 * make both tests and select the edge. If tests are counted, only those of the algorithm are made.
 */
static MW_INLINE mw_verdict leave_either(mw_walk *w, uint32_t first, uint32_t second, mw_policy P)
{
    if (!P.lanes || P.count) {
        if (beyond(w, first, P)) return cross(w, first, P);
        return leave(w, second, P);
    }
    double one = orient(w, corner(w, first), corner(w, first + 1), w->q, P);
    double two = orient(w, corner(w, second), corner(w, second + 1), w->q, P);
    /* of `one < 0 | two < 0` compilers make two jumps again */
    double least = one < two ? one : two;
    if (!(least < 0)) return MW_VERDICT_FOUND;
    return cross(w, one < 0 ? first : second, P);
}

#endif
