/* lawson.c - Lawson's oriented walk [Lawson 1977; thesis App. E, Alg. 1].
 *
 *          c
 *         / \    * q
 *        a---b
 *
 * Leave through the first edge that has q strictly on its right; if there is none, q is in the
 * tile. Up to three tests a tile. Ends on Delaunay meshes [De Floriani, Falcidieno, Nagy, Pienovi
 * 1991], whatever the order of edges. On others it may go round in a cycle; then its fuel runs out
 * and another walk takes over. */
#include "walk/drive.h"

static MW_INLINE mw_verdict lawson_step(mw_walk *w, mw_policy P)
{
    if (beyond(w, 0, P)) return cross(w, 0, P);
    if (beyond(w, 1, P)) return cross(w, 1, P);
    return leave(w, 2, P);
}

MW_STAMP_WALK(lawson, false)
