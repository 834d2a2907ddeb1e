/* barycentric.c - Wu's barycentric walk [Wu et al. 2007; thesis App. F, sec. 2].
 *
 * The ray meets the facet's plane at a point whose barycentric coordinates are to each other as the three determinants
 * of the edges opposite to the corners; they have the sign that the cone gives them, also where the plane is met behind
 * the centre or not at all. Leave over the edge of the least one, while that is negative. On spheres that are Delaunay
 * this ends; on others it may cycle, and hands over when its fuel is used up. */
#include "star/walk.h"

static MW_INLINE mw_star_verdict barycentric_step(mw_star_walk *w, mw_star_policy P)
{
    double least = edge_turn(w, 0, P), one = edge_turn(w, 1, P), two = edge_turn(w, 2, P);
    uint32_t e = 0;
    if (one < least) {
        least = one;
        e = 1;
    }
    if (two < least) {
        least = two;
        e = 2;
    }
    return least < 0 ? cross(w, e, P) : MW_STAR_FOUND;
}

MW_STAR_STAMP(barycentric)
