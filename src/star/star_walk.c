/* star_walk.c - the rare part of a side test: where floats are not sure. */
#include "star/star_walk.h"

bool mw__star_beyond(const mw_star *star, const mw_star_facet *facet, uint32_t e, const double q[3])
{
    const double *c = star->centre, d[3] = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    const double *a = mw__surface_point(star->surface, facet->v[e]);
    return mw__star_orient(a, mw__surface_point(star->surface, facet->v[mw__next(e)]), q, d, c) < 0;
}
