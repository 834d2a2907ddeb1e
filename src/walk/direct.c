/* direct.c - the direct walk [thesis App. C, Alg. 1], with stored areas (DW1) or without (DW2).
 *
 *          t2
 *         /  `
 *        /    `   * q
 *      t0------t1
 *
 * The barycentric walk without division: the orientation coordinate c_i of q is twice the area that
 * it makes with the edge opposite to t_i, and c0 + c1 + c2 = 2A. Of these three, that of the edge
 * just crossed is known from the tile before, with the opposite sign; the next one is computed by a
 * test, and the last is 2A less both. So a tile takes one test if 2A is stored, else two; the first
 * tile takes one more.
 *
 * The walk of the paper also takes clockwise tiles, but its printed pseudocode fails there, because
 * it passes on coordinates that it has flipped (slip 5). It has to keep all of them normalised: the
 * known one always -c, the tested one sgn(A) times the test, and the last one |2A| less both. Here
 * sgn(A) is 1: the mesh turns clockwise triangles when it is created, so that all tiles are
 * counter-clockwise. borrow/borrowed_coordinates.c has the walk over triangles as they are. Another
 * departure: coordinates are rounded, and those derived from others inherit their errors, tile
 * after tile. In exact arithmetic an edge is crossed only if its coordinate is surely negative, and
 * its error bound is added before it is passed on. So the known coordinate of the next tile is a
 * lower bound, the one derived from it an upper bound, and if that is negative, it surely is. If no
 * coordinate is surely negative, q is in the tile or very near it, and the exact final location
 * ends the walk. Ends and cycles as the barycentric walk does. */
#include "walk/drive.h"
#include "walk/value.h"

static MW_INLINE double direct_side(mw_walk *w, uint32_t e, double *off, mw_policy P)
{
    return area_value(w, corner(w, e), corner(w, e + 1), w->q, off, P);
}

/* Twice the area of the tile. */
static MW_INLINE double direct_double_area(mw_walk *w, bool stored, double *off, mw_policy P)
{
    if (!stored) return area_value(w, corner(w, 0), corner(w, 1), corner(w, 2), off, P);
    double area = w->tiling->area[w->t];
    if (P.exact) *off += MW_AREA_ERROR * area;
    return area;
}

/* The walk ends: keep the corner of the largest coordinate, of those of edge e, of the next and of
 * the one before. The layers go down there [thesis App. C, sec. 3]. */
static MW_INLINE mw_verdict direct_end(mw_walk *w, uint32_t e, const double at[3],
                                       mw_verdict verdict)
{
    uint32_t corner_of[3] = {mw__prev(e), e, mw__next(e)}; /* opposite to these edges */
    w->heaviest = corner_of[heaviest_corner(at[0], at[1], at[2])];
    return verdict;
}

static MW_INLINE mw_verdict direct_step_with(mw_walk *w, bool stored, mw_policy P)
{
    double off = 0;
    bool first = w->e == MW_NO_EDGE;
    uint32_t e = first ? 0 : w->e, next = mw__next(e);
    double known = first ? direct_side(w, 0, &off, P) : w->c;
    double tested = direct_side(w, next, &off, P);
    double area = direct_double_area(w, stored, &off, P);
    double last = area - known - tested;
    off += sum_rounding(area, known, tested, P);
    bool turn = last < tested;
    double least = turn ? last : tested;
    uint32_t out = turn ? mw__prev(e) : next;
    if (MW_UNLIKELY(known < least)) { /* in the first tile; later what is known is positive */
        least = known;
        out = e;
    }
    least += off;
    if (!(least < 0)) return direct_end(w, e, (double[3]){known, tested, last}, MW_VERDICT_UNSURE);
    w->c = -least;
    mw_verdict verdict = cross(w, out, P);
    if (MW_LIKELY(verdict == MW_VERDICT_GO_ON)) return MW_VERDICT_GO_ON;
    return direct_end(w, e, (double[3]){known, tested, last}, verdict);
}

static MW_INLINE mw_verdict direct_step(mw_walk *w, mw_policy P)
{
    return direct_step_with(w, false, P);
}

static MW_INLINE mw_verdict direct_stored_step(mw_walk *w, mw_policy P)
{
    return direct_step_with(w, true, P);
}

MW_STAMP_WALK(direct, false)
MW_STAMP_WALK(direct_stored, false)
