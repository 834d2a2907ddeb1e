/* walk.c - the exact side of an edge, where filters do not tell. */
#include "star/walk.h"

bool mw__star_beyond(const mw_star *star, const mw_star_facet *facet, uint32_t e, const double q[3])
{
    const double *c = star->centre, d[3] = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    const double *a = mw__surface_point(star->surface, facet->v[e]);
    return mw__star_turn(a, mw__surface_point(star->surface, facet->v[mw__next(e)]), q, d, c) < 0;
}
