/* star_orthogonal.c - the orthogonal walk in spherical coordinates [thesis App. F, Alg. 1].
 *
 *      north   l               Longitude and polar angle are coordinates of a plane, and facets are
 *        |    /|\              triangles there. The first leg goes from a point a inside the first
 *    a --+---/-|-\---> east    facet along its parallel to the meridian of q. The second leg goes
 *        |   \ | / s           along that meridian to the parallel of q. Each facet takes two
 *              \|/             comparisons. Is s, the vertex opposite to the entry edge, past the
 *               r              end of the leg? If not, on which side of the line is s? If to its
 *                              left, the walk leaves over rs, else over sl. The last facet is not
 *                              tested: the ray is there or close, and the stochastic walk ends the
 *                              search.
 *
 * The walk does not know that longitudes -pi and pi are the same. So it also ends in a facet of the
 * seam: one that lies across longitude pi or contains a pole, or any other that has the wrong
 * orientation in the plane. a is the centroid. The printed case, q to the north-east of a (or
 * south-east, depending on the drawing), and the three others are the same code in rotated
 * coordinates: along the heading, and to its left. Left stays left, so l and r are the ends of the
 * entry edge in the order of the facet.
 *
 * Departure from the printed pseudocode. In the first facet of a leg, s is the vertex farthest
 * along the heading. It tells whether the facet is past the end, as printed. But the exit edge need
 * not be at s: it is the edge from a vertex on the right to one on the left.
 *
 * Edge cases. If q is on the meridian or the parallel of a, that leg ends where it starts. A vertex
 * on the parallel counts as right of it. A vertex on the meridian counts as beyond it, seen from a,
 * as in the first leg. So a leg follows a line that is moved infinitesimally and meets no vertex.
 *
 * Counters count the comparisons of the printed loops, 2 a facet. They leave out those that choose
 * a heading or a vertex in the first facet of a leg, as the published counts do.
 *
 * Why it ends, on every star-shaped polyhedron. There are two legs. A leg only continues from
 * triangles with the right orientation in the plane. So the point where its line leaves the
 * triangle moves on with each step, and no facet comes twice in a leg. Nothing else is required of
 * the plane: its triangles may overlap, as some do near the poles. */
#include "star/star_walk.h"

enum { FOLLOW = 1, UPRIGHT = 2, WEST = 4, NORTH = 8 }; /* marks in the phase */

static MW_INLINE double corner_longitude(const mw_star_walk *w, uint32_t k)
{
    return w->star->angle[2 * (size_t)w->facet[w->t].v[k]];
}

static MW_INLINE double corner_polar_angle(const mw_star_walk *w, uint32_t k)
{
    return w->star->angle[2 * (size_t)w->facet[w->t].v[k] + 1];
}

static MW_INLINE void star_count_comparison(mw_star_walk *w, mw_star_policy P)
{
    if (P.count) w->work->comparisons++;
}

/* The distance of corner k past the end of the leg; negative before it. */
static MW_INLINE double leg_past(const mw_star_walk *w, uint32_t k)
{
    if (w->phase & UPRIGHT)
        return w->phase & NORTH ? w->theta - corner_polar_angle(w, k)
                                : corner_polar_angle(w, k) - w->theta;
    return w->phase & WEST ? w->phi - corner_longitude(w, k) : corner_longitude(w, k) - w->phi;
}

/* Does corner k lie to the left of the line of the leg? After a turn to the right, beyond the
 * meridian is left of it. */
static MW_INLINE bool leg_is_left(const mw_star_walk *w, uint32_t k)
{
    bool west = w->phase & WEST, north = w->phase & NORTH;
    if (!(w->phase & UPRIGHT))
        return west ? corner_polar_angle(w, k) > w->height : corner_polar_angle(w, k) < w->height;
    bool is_beyond = west ? corner_longitude(w, k) <= w->phi : corner_longitude(w, k) >= w->phi;
    return is_beyond == (west == north);
}

/* Does the leg end in this facet? Corner s is the farthest along the heading. */
static MW_INLINE bool leg_ends(mw_star_walk *w, uint32_t s, mw_star_policy P)
{
    star_count_comparison(w, P);
    return leg_past(w, s) >= 0 || w->facet[w->t].user & MW_SEAM;
}

/* The edge over which the line leaves the facet: it runs from right to left. MW_STAR_NO_EDGE if the
 * line misses the facet. */
static MW_INLINE uint32_t leg_exit_edge(const mw_star_walk *w)
{
    bool left[3] = {leg_is_left(w, 0), leg_is_left(w, 1), leg_is_left(w, 2)};
    for (uint32_t e = 0; e < 3; e++)
        if (!left[e] && left[mw__next(e)]) return e;
    return MW_STAR_NO_EDGE;
}

/* In the first facet of a leg: the exit edge, or MW_STAR_NO_EDGE if the leg ends. */
static MW_INLINE uint32_t leg_set_out(mw_star_walk *w, mw_star_policy P)
{
    uint32_t s = leg_past(w, 1) > leg_past(w, 0) ? 1 : 0;
    if (leg_past(w, 2) > leg_past(w, s)) s = 2;
    if (leg_ends(w, s, P)) return MW_STAR_NO_EDGE;
    star_count_comparison(w, P);
    return leg_exit_edge(w);
}

/* At the end of the first leg: its last facet is the first one of the second leg. */
static MW_INLINE mw_star_verdict star_orthogonal_turn_upright(mw_star_walk *w, mw_star_policy P)
{
    w->phase |= UPRIGHT;
    uint32_t e = leg_set_out(w, P);
    return e == MW_STAR_NO_EDGE ? MW_STAR_CLOSE : star_cross(w, e, P);
}

static MW_INLINE mw_star_verdict star_orthogonal_start(mw_star_walk *w, mw_star_policy P)
{
    /* A copy: taking the address of the walk would move it out of registers. */
    double d[3] = {w->d[0], w->d[1], w->d[2]};
    double phi, theta;
    mw__star_angles(d, &phi, &theta);
    w->phi = phi;
    w->theta = theta;
    w->height =
        (corner_polar_angle(w, 0) + corner_polar_angle(w, 1) + corner_polar_angle(w, 2)) / 3;
    bool west = w->phi <
                (corner_longitude(w, 0) + corner_longitude(w, 1) + corner_longitude(w, 2)) / 3,
         north = w->theta < w->height;
    w->phase = FOLLOW | (west ? WEST : 0) | (north ? NORTH : 0);
    uint32_t e = leg_set_out(w, P);
    return e == MW_STAR_NO_EDGE ? star_orthogonal_turn_upright(w, P) : star_cross(w, e, P);
}

static MW_INLINE mw_star_verdict star_orthogonal_step(mw_star_walk *w, mw_star_policy P)
{
    if (MW_UNLIKELY(w->phase == 0)) return star_orthogonal_start(w, P);
    uint32_t s = mw__prev(w->e); /* entered over edge e = lr */
    if (MW_UNLIKELY(leg_ends(w, s, P)))
        return w->phase & UPRIGHT ? MW_STAR_CLOSE : star_orthogonal_turn_upright(w, P);
    star_count_comparison(w, P);
    if (leg_is_left(w, s)) return star_cross(w, mw__next(w->e), P);
    return star_cross(w, s, P);
}

MW_STAR_STAMP(orthogonal)
