/* star_barycentric.c - Wu's barycentric walk [Wu, He, Tian 2005; thesis App. F, sec. 2].
 *
 * The ray meets the plane of the facet at a point. Its barycentric coordinates are proportional to
 * the three determinants of the edges opposite to the corners. The determinants have the sign that
 * the cone gives them, even if the ray meets the plane behind the centre or not at all. While the
 * least determinant is negative, the walk leaves over its edge. This ends on Delaunay spheres. On
 * others it may cycle; when its fuel is used up, another walk takes over. */
#include "star/star_walk.h"

static MW_INLINE mw_star_verdict star_barycentric_step(mw_star_walk *w, mw_star_policy P)
{
    double least = star_edge_orient(w, 0, P), one = star_edge_orient(w, 1, P),
           two = star_edge_orient(w, 2, P);
    uint32_t e = 0;
    if (one < least) {
        least = one;
        e = 1;
    }
    if (two < least) {
        least = two;
        e = 2;
    }
    return least < 0 ? star_cross(w, e, P) : MW_STAR_FOUND;
}

MW_STAR_STAMP(barycentric)
