/* orthogonal.c - the orthogonal walk in spherical coordinates [thesis App. F, Alg. 1].
 *
 *      north   l               Longitude and polar angle are taken for coordinates of a plane, facets for triangles
 *        |    /|\              there. From a point a inside the first facet along its parallel to the meridian of q,
 *    a --+---/-|-\---> east    then along that meridian to the parallel of q. In each facet two comparisons: is s, the
 *        |   \ | / s           vertex off the entry edge, past the end of the leg? If not, on which side of the line is
 *              \|/             it? To its left: leave over rs; else over sl. The facet where that ends is not tested:
 *               r              the ray is there or near, and the stochastic walk ends the search.
 * The walk does not know that longitudes -pi and pi are one. It ends, too, in a facet of the seam: one that lies across
 * longitude pi or holds a pole, and any other that is no triangle with the right orientation in the plane.
 * a is the centroid. The printed case, q to the north-east of a (or the south-east, as one draws it), and the three
 * others are the same code in turned coordinates: along the heading, and to its left. Left stays left, so l and r are
 * the ends of the entry edge in the order in which the facet has them.
 * Departure from the printed pseudocode. In the first facet of a leg, s, the vertex farthest along the heading, tells
 * whether the facet is past the end, as printed; but not the edge to leave over, which need not be one at s: that runs
 * from a vertex on the right to one on the left.
 * Edge cases. q on the meridian or the parallel of a: that leg ends where it begins. A vertex on the parallel counts as
 * right of it; one on the meridian as beyond it, seen from a, as the first leg counts it. So a leg follows a line moved
 * by next to nothing, which meets no vertex.
 * Counts the comparisons in which the printed loops consist, 2 a facet; not those that choose a heading or a vertex in
 * the first facet of a leg, as the published counts leave them out.
 * Ends on every star-shaped polyhedron: there are two legs; each goes on from triangles of the plane with the right
 * orientation only; so the point where its line leaves the triangle comes on with each step, and no facet comes twice
 * in a leg. This needs no more of the plane than that: its triangles may overlap, as some do near the poles. */
#include "star/walk.h"

enum { FOLLOW = 1, UPRIGHT = 2, WEST = 4, NORTH = 8 }; /* marks in the phase */

static MW_INLINE double longitude(const mw_star_walk *w, uint32_t k)
{
    return w->star->angle[2 * (size_t)w->facet[w->t].v[k]];
}

static MW_INLINE double polar_angle(const mw_star_walk *w, uint32_t k)
{
    return w->star->angle[2 * (size_t)w->facet[w->t].v[k] + 1];
}

static MW_INLINE void count_comparison(mw_star_walk *w, mw_star_policy P)
{
    if (P.count) w->work->comparisons++;
}

/* How far corner k lies past the end of the leg; negative before it. */
static MW_INLINE double past(const mw_star_walk *w, uint32_t k)
{
    if (w->phase & UPRIGHT) return w->phase & NORTH ? w->theta - polar_angle(w, k) : polar_angle(w, k) - w->theta;
    return w->phase & WEST ? w->phi - longitude(w, k) : longitude(w, k) - w->phi;
}

/* Does corner k lie to the left of the line of the leg? Beyond the meridian is left of it after a turn to the right. */
static MW_INLINE bool is_left(const mw_star_walk *w, uint32_t k)
{
    bool west = w->phase & WEST, north = w->phase & NORTH;
    if (!(w->phase & UPRIGHT)) return west ? polar_angle(w, k) > w->height : polar_angle(w, k) < w->height;
    bool is_beyond = west ? longitude(w, k) <= w->phi : longitude(w, k) >= w->phi;
    return is_beyond == (west == north);
}

/* Does the leg end in this facet, of which corner s is the farthest along the heading? */
static MW_INLINE bool ends(mw_star_walk *w, uint32_t s, mw_star_policy P)
{
    count_comparison(w, P);
    return past(w, s) >= 0 || w->facet[w->t].user & MW_SEAM;
}

/* The edge over which the line leaves the facet: it runs from right to left. MW_STAR_NO_EDGE: the line misses it. */
static MW_INLINE uint32_t exit_edge(const mw_star_walk *w)
{
    bool left[3] = {is_left(w, 0), is_left(w, 1), is_left(w, 2)};
    for (uint32_t e = 0; e < 3; e++)
        if (!left[e] && left[mw__next(e)]) return e;
    return MW_STAR_NO_EDGE;
}

/* In the first facet of a leg: the edge to leave over, MW_STAR_NO_EDGE where the leg ends. */
static MW_INLINE uint32_t set_out(mw_star_walk *w, mw_star_policy P)
{
    uint32_t s = past(w, 1) > past(w, 0) ? 1 : 0;
    if (past(w, 2) > past(w, s)) s = 2;
    if (ends(w, s, P)) return MW_STAR_NO_EDGE;
    count_comparison(w, P);
    return exit_edge(w);
}

/* At the end of the first leg, in the first facet of the second. */
static MW_INLINE mw_star_verdict turn_upright(mw_star_walk *w, mw_star_policy P)
{
    w->phase |= UPRIGHT;
    uint32_t e = set_out(w, P);
    return e == MW_STAR_NO_EDGE ? MW_STAR_CLOSE : cross(w, e, P);
}

static MW_INLINE mw_star_verdict start(mw_star_walk *w, mw_star_policy P)
{
    double d[3] = {w->d[0], w->d[1], w->d[2]}; /* by value: a walk whose address is known leaves the registers */
    double phi, theta;
    mw__star_angles(d, &phi, &theta);
    w->phi = phi;
    w->theta = theta;
    w->height = (polar_angle(w, 0) + polar_angle(w, 1) + polar_angle(w, 2)) / 3;
    bool west = w->phi < (longitude(w, 0) + longitude(w, 1) + longitude(w, 2)) / 3, north = w->theta < w->height;
    w->phase = FOLLOW | (west ? WEST : 0) | (north ? NORTH : 0);
    uint32_t e = set_out(w, P);
    return e == MW_STAR_NO_EDGE ? turn_upright(w, P) : cross(w, e, P);
}

static MW_INLINE mw_star_verdict orthogonal_step(mw_star_walk *w, mw_star_policy P)
{
    if (MW_UNLIKELY(w->phase == 0)) return start(w, P);
    uint32_t s = mw__prev(w->e); /* entered over edge e = lr */
    if (MW_UNLIKELY(ends(w, s, P))) return w->phase & UPRIGHT ? MW_STAR_CLOSE : turn_upright(w, P);
    count_comparison(w, P);
    if (is_left(w, s)) return cross(w, mw__next(w->e), P);
    return cross(w, s, P);
}

MW_STAR_STAMP(orthogonal)
