/* barycentric.c - the barycentric walk [Sundareswara, Schrater 2003; thesis App. E, Alg. 3].
 *
 *          t2
 *         /  `
 *        /    `   * q
 *      t0------t1
 *
 * The barycentric coordinates of q: b_i is the area that q makes with the edge opposite to t_i,
 * over the area of the tile, negative where q lies beyond that edge. Cross the edge of the least
 * one, if it is negative: here b0. Three areas are computed in each tile: those of q with two
 * edges, and that of the tile; the third coordinate follows, since they add up to 1. Dividing by
 * the signed area makes the walk independent of the tile's orientation. (All tiles are
 * counter-clockwise here; borrow/borrowed_coordinates.c has it over triangles of mixed
 * orientation.) Departure from the printed pseudocode: the coordinates are rounded, and rounding
 * may even change the sign of b2, a difference. In exact arithmetic an edge is crossed only if its
 * coordinate is below zero by more than the rounding error of all; so q surely lies beyond it. If
 * no coordinate is, q is in the tile or very near it, and the exact final location ends the walk.
 * The same happens if a coordinate is a NaN: in flat tiles (of a mesh that is not an embedding),
 * and far outside the range of areas. Ends on Delaunay meshes as Lawson's walk does. On others it
 * may go round in a cycle, in exact arithmetic too [thesis App. E, fig. 6]; then its fuel runs out
 * and it hands over. */
#include "walk/drive.h"
#include "walk/value.h"

static MW_INLINE mw_verdict barycentric_step(mw_walk *w, mw_policy P)
{
    mw_point t0 = corner(w, 0), t1 = corner(w, 1), t2 = corner(w, 2);
    double off = 0;
    double area = area_value(w, t0, t1, t2, &off, P);
    double b0 = area_value(w, t1, t2, w->q, &off, P) / area;
    double b1 = area_value(w, t2, t0, w->q, &off, P) / area;
    double b2 = 1 - b0 - b1;
    off = off / fabs(area) + sum_rounding(1, b0, b1, P);
    double least = b0;
    uint32_t e = 1;
    if (b1 < least) {
        least = b1;
        e = 2;
    }
    if (b2 < least) {
        least = b2;
        e = 0;
    }
    mw_verdict verdict = least < -off ? cross(w, e, P) : MW_VERDICT_UNSURE;
    if (MW_UNLIKELY(verdict != MW_VERDICT_GO_ON)) w->heaviest = heaviest_corner(b0, b1, b2);
    return verdict;
}

MW_STAMP_WALK(barycentric, false)
