/* sight_line.h - is the terrain above a line of sight? Private.
 *
 *            P             In the plane, the line from A to B crosses the edge PQ. With b = B - A,
 *            |             p = P - A, q = Q - A, the edge is higher than the line where they cross
 *      A ----+----> B      by the sum of
 *            |                 (zP - zA) (q x b),  (zQ - zA) (b x p),  (zB - zA) (p x q),
 *            Q             over b x (p - q). Where A or B is above the ground, its height is a sum
 *                          of heights by areas over an area: multiplied by these areas, all is a
 *                          polynomial in the numbers given, of degree 7. Doubles decide where they
 *                          are sure, integers (predicates/big.h) elsewhere. */
#ifndef MW_SRC_SIGHT_SIGHT_LINE_H
#define MW_SRC_SIGHT_SIGHT_LINE_H

#include "predicates/predicates.h"

#include <meshwalk/mesh.h>

/* The height of an end of a line of sight. */
typedef struct mw_sight_level {
    mw_point at;
    double height;     /* rounded */
    double unsure;     /* bound for its error */
    double offset;     /* above the plane of `triangle` at this point ... */
    uint32_t triangle; /* ... or, for MW_NONE, above 0 */
} mw_sight_level;

typedef struct mw_sight_line {
    const mw_mesh *mesh;
    const double *heights; /* of vertices */
    mw_sight_level a, b;
} mw_sight_line;

/* A level above the ground, or, if that height is none, above 0. */
mw_sight_level mw__sight_level(const mw_mesh *mesh, const double *heights, mw_point at,
                               uint32_t triangle, double ground, double offset);

/* The sign of a level: is it above height 0? Exact. */
int mw__sight_level_sign(const mw_sight_line *line, const mw_sight_level *level);

/* The edge between vertices v and w crosses the line in the plane. Returns > 0 if the edge passes
 * above the line there, 0 if it touches the line or runs along it, < 0 if it passes below. Exact.
 */
int mw__sight_edge_sign(const mw_sight_line *line, uint32_t v, uint32_t w);

/* The same for a vertex on the line in the plane. */
int mw__sight_vertex_sign(const mw_sight_line *line, uint32_t v);

#endif
