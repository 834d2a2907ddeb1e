/* borrowed_coordinates.c - the barycentric walk [Sundareswara, Schrater 2003; thesis App. E, Alg.
 * 3] and the direct walk [thesis App. C, Alg. 1] over triangles of mixed orientation, none of
 * which is turned.
 *
 *          t2            The coordinate b_i of q is the area that q makes with the edge opposite to
 *         /  `           t_i, over the area of the triangle. Clockwise triangles have both areas
 *        /    `   * q    negative: the quotient is the same. The direct walk does not divide. It
 *      t0------t1        needs the sign of the area, 2A, to know which way an orientation
 *                        coordinate points: with sgn(A) it keeps all of them normalised (slip 5 of
 *                        its pseudocode is that it passes on values that it has flipped). The one
 *                        of the edge just crossed is then known, -c, whatever the orientation of
 *                        the two triangles; one is tested, sgn(A) times the test; and the last one
 *                        is |2A| less both.
 * Rounding is taken care of as in walk/barycentric.c and walk/direct.c: an edge is crossed only
 * where its coordinate is surely negative. Triangles without an area have no coordinates: there
 * both walks end. */
#include "borrow/borrowed_walk.h"
#include "walk/value.h"

/* Twice the area that q makes with the edge opposite to corner k, positive if they turn left. */
static MW_INLINE double coordinate_of(mw_borrowed_walk *w, const mw_borrowed_tile *tile, uint32_t k,
                                      double *off)
{
    return area_value(&w->counts, tile->p[mw__next(k)], tile->p[mw__prev(k)], w->q, off,
                      mw__borrowed_policy);
}

static MW_INLINE double coordinate_sum(mw_borrowed_walk *w, const mw_borrowed_tile *tile,
                                       double *off)
{
    return area_value(&w->counts, tile->p[0], tile->p[1], tile->p[2], off, mw__borrowed_policy);
}

/* Cross the edge opposite to corner k. MW_VERDICT_UNSURE if there is no neighbour: q certainly lies
 * beyond the edge, and the remembering walk then decides whether it is outside. */
static MW_INLINE mw_verdict coordinate_cross(mw_borrowed_walk *w, uint32_t k)
{
    uint32_t next = mw__borrowed_across(w->mesh, w->t, k);
    if (MW_UNLIKELY(next == MW_NONE)) return MW_VERDICT_UNSURE;
    mw__borrowed_enter(w, next);
    return MW_VERDICT_GO_ON;
}

static mw_verdict barycentric_go(mw_borrowed_walk *w)
{
    mw_borrowed_tile tile;
    if (!mw__borrowed_read(w->mesh, w->t, &tile)) return MW_VERDICT_OUT_OF_FUEL;
    double off = 0, area = coordinate_sum(w, &tile, &off);
    double b0 = coordinate_of(w, &tile, 0, &off) / area;
    double b1 = coordinate_of(w, &tile, 1, &off) / area;
    double b2 = 1 - b0 - b1;
    off = off / fabs(area) + sum_rounding(1, b0, b1, mw__borrowed_policy);
    uint32_t k = b1 < b0 ? 1 : 0;
    double least = k ? b1 : b0;
    if (b2 < least) {
        least = b2;
        k = 2;
    }
    return least < -off ? coordinate_cross(w, k) : MW_VERDICT_UNSURE;
}

mw_verdict mw__borrowed_barycentric(mw_borrowed_walk *w)
{
    mw_verdict verdict = MW_VERDICT_GO_ON;
    for (; verdict == MW_VERDICT_GO_ON && w->fuel > 0; w->fuel--) verdict = barycentric_go(w);
    return verdict == MW_VERDICT_GO_ON ? MW_VERDICT_UNSURE : verdict;
}

/* --- direct --- */

/* What is passed on: `known` is the coordinate of the edge that was crossed, opposite to corner
 * `entry`; 3 in the first tile. */
typedef struct direct_state {
    double known;
    uint32_t entry;
} direct_state;

/* Over the edge opposite to corner k, whose coordinate is surely below `least`. */
static mw_verdict direct_cross(mw_borrowed_walk *w, direct_state *state, uint32_t k, double least)
{
    uint32_t from = w->t;
    mw_verdict verdict = coordinate_cross(w, k);
    if (verdict != MW_VERDICT_GO_ON) return verdict;
    state->known = -least;
    for (state->entry = 0; state->entry < 3; state->entry++)
        if (mw__borrowed_across(w->mesh, w->t, state->entry) == from) return MW_VERDICT_GO_ON;
    return MW_VERDICT_OUT_OF_FUEL; /* the neighbour does not know of the triangle */
}

static mw_verdict direct_go(mw_borrowed_walk *w, direct_state *state)
{
    mw_borrowed_tile tile;
    if (!mw__borrowed_read(w->mesh, w->t, &tile)) return MW_VERDICT_OUT_OF_FUEL;
    double off = 0, area = coordinate_sum(w, &tile, &off), sign = area < 0 ? -1 : 1;
    if (area == 0) return MW_VERDICT_UNSURE;
    bool first = state->entry == 3;
    uint32_t entry = first ? 2 : state->entry, next = mw__next(entry), prev = mw__prev(entry);
    double known = first ? sign * coordinate_of(w, &tile, entry, &off) : state->known;
    double tested = sign * coordinate_of(w, &tile, next, &off);
    double last = fabs(area) - known - tested;
    off += sum_rounding(area, known, tested, mw__borrowed_policy);
    uint32_t out = last < tested ? prev : next;
    double least = last < tested ? last : tested;
    if (known < least) { /* in the first tile; later what is known is positive */
        least = known;
        out = entry;
    }
    least += off;
    return least < 0 ? direct_cross(w, state, out, least) : MW_VERDICT_UNSURE;
}

mw_verdict mw__borrowed_direct(mw_borrowed_walk *w)
{
    direct_state state = {0, 3};
    mw_verdict verdict = MW_VERDICT_GO_ON;
    for (; verdict == MW_VERDICT_GO_ON && w->fuel > 0; w->fuel--) verdict = direct_go(w, &state);
    return verdict == MW_VERDICT_GO_ON ? MW_VERDICT_UNSURE : verdict;
}
