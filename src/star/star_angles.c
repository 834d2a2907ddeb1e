/* star_angles.c - longitude and polar angle of directions and vertices, and the seam [thesis App.
 * F, sec. 4]. */
#include "star/star.h"

#define HALF_TURN 3.14159265358979323846

/* Eq. 3, with an arc tangent instead of the arc cosine, which loses digits near the poles. Zeros
 * become +0, so that the seam has one longitude, pi, and a pole has 0. */
void mw__star_angles(const double d[3], double *phi, double *theta)
{
    *phi = atan2(d[1] + 0.0, d[0] + 0.0);
    *theta = atan2(hypot(d[0], d[1]), d[2]);
}

/* The angles of a vertex as a point of the plane. */
static mw_point vertex_angles(const mw_star *star, uint32_t vertex)
{
    return (mw_point){star->angle[2 * (size_t)vertex], star->angle[2 * (size_t)vertex + 1]};
}

/* Longitude grows eastward and the polar angle southward. So a facet that is counter-clockwise as
 * seen from outside is clockwise in their plane. If it is not, it lies across the seam or contains
 * a pole; or it is so thin that arcs and their chords differ, and the orthogonal walk could not
 * pass it, either. Departure from the thesis: a facet across the seam may be clockwise, too, if its
 * vertex on the other side is farther north, or south, than both others. So the longitudes are also
 * compared: in all other facets they differ by less than a half turn. */
static bool facet_is_seam(const mw_star *star, const mw_star_facet *t)
{
    mw_point a = vertex_angles(star, t->v[0]), b = vertex_angles(star, t->v[1]),
             c = vertex_angles(star, t->v[2]);
    double span = fmax(a.x, fmax(b.x, c.x)) - fmin(a.x, fmin(b.x, c.x));
    return !(mw__orient2d(a, b, c) < 0) || span > HALF_TURN;
}

static void vertex_set_angles(mw_star *star, uint32_t v)
{
    const double *p = mw__surface_point(star->surface, v);
    double d[3] = {p[0] - star->centre[0], p[1] - star->centre[1], p[2] - star->centre[2]};
    mw__star_angles(d, &star->angle[2 * (size_t)v], &star->angle[2 * (size_t)v + 1]);
}

void mw__star_renew_angles(mw_star *star, mw_star_facet *facet)
{
    for (uint32_t k = 0; k < 3; k++) vertex_set_angles(star, facet->v[k]);
    facet->user &= ~MW_SEAM;
    if (facet_is_seam(star, facet)) facet->user |= MW_SEAM;
}

void mw__star_fill_angles(mw_star *star)
{
    for (uint32_t v = 0; v < star->point_count; v++) vertex_set_angles(star, v);
    for (uint32_t t = 0; t < star->facet_count; t++)
        if (facet_is_seam(star, &star->facet[t])) star->facet[t].user |= MW_SEAM;
}
