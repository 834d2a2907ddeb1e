/* star.h - what a star-shaped polyhedron holds, and its walks. Private.
 *
 * Facets are stored counter-clockwise as seen from outside, whatever the user's orientation, so the cone of a facet
 * over the centre c has the ray through q inside where det(v[k] - c, v[k+1] - c, q - c) > 0 for its three edges.
 * `beyond` an edge: that determinant is negative. Everything planar walks ask of an edge is asked of it in the same
 * way; the great circle through an edge takes the place of its line. */
#ifndef MW_SRC_STAR_H
#define MW_SRC_STAR_H

#include "mesh/surface.h"

#include <meshwalk/star.h>

/* In `user` of a facet: the orthogonal walk ends here. Its vertices lie on both sides of the seam at longitude 180, or
 * it holds a pole: in the plane of longitude and polar angle it does not turn counter-clockwise as seen from
 * outside. */
#define MW_SEAM MW_GHOST

struct mw_star {
    const mw_surface *surface;
    mw_triangle *tri;      /* `user` is the user's number; where flat facets were flipped away, several have the same */
    const uint32_t *place; /* per vertex the lowest at its place: the surface's, or its own; NULL: no two are at one */
    uint32_t *own_place;
    uint32_t *owner; /* per vertex the lowest facet that the ray through it meets; MW_NONE: of no facet */
    double *angle;   /* NULL, or longitude phi (-pi to pi) and polar angle theta (0 to pi) of each vertex */
    double centre[3];
    double reach; /* the largest difference of a coordinate from the centre's, about */
    uint32_t tri_count, point_count;
    uint32_t area_count; /* facets of the user's with an area */
    uint32_t front;      /* the facet at phi = 0, theta = pi/2 */
    uint64_t version;    /* of the surface that all this holds for */
    bool ready;          /* it is star-shaped, as far as known */
};

/* A facet that is linked to nothing, because two of its corners are at one place, counts for nothing. */
static MW_INLINE bool mw__star_is_void(const mw_triangle *facet)
{
    return (facet->link[0] & facet->link[1] & facet->link[2]) == MW_NONE;
}

typedef enum mw_star_verdict {
    MW_STAR_GO,    /* crossed into another facet                                      */
    MW_STAR_FOUND, /* the ray meets facet t                                           */
    MW_STAR_CLOSE, /* a cheap walk ended in facet t: an exact one goes on from there  */
    MW_STAR_DRY    /* out of fuel                                                     */
} mw_star_verdict;

#define MW_STAR_NO_EDGE 3u

/* The stages of a search, counted apart: choice of the first facet by an octahedron, walk, final location. */
enum { MW_STAR_STAGE_INIT, MW_STAR_STAGE_WALK, MW_STAR_STAGE_FINAL, MW_STAR_STAGES };

typedef struct mw_star_work {
    uint64_t visited; /* facets entered, the first one included */
    uint64_t triangles[MW_STAR_STAGES], orient[MW_STAR_STAGES];
    uint64_t comparisons;
} mw_star_work;

/* Everything one walk remembers. */
typedef struct mw_star_walk {
    const mw_star *star;
    const double *point;
    const mw_triangle *tri;
    double c[3], q[3], d[3]; /* centre, the point looked for, and q - c as rounded                             */
    uint32_t t, e;           /* current facet, and its edge by which it was entered; MW_STAR_NO_EDGE at first  */
    uint32_t p;              /* straight: the vertex where the great circle to q begins                        */
    uint32_t phase;          /* of the walks that have some; 0 at first                                        */
    uint32_t fuel;           /* steps left                                                                     */
    uint32_t stage;          /* that counts                                                                    */
    uint64_t random;
    double phi, theta;  /* orthogonal: of q                                                               */
    double height;      /* orthogonal: theta of the parallel that the first leg follows                  */
    mw_star_work *work; /* of counting kernels; else NULL                                                 */
} mw_star_walk;

/* The kernel of a walk, by [count]: from its t to its end. */
typedef struct mw_star_kernels {
    mw_star_verdict (*run[2])(mw_star_walk *walk);
    mw_star_verdict (*step)(mw_star_walk *walk); /* one step, counting: for those who look at each facet */
} mw_star_kernels;

#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) extern const mw_star_kernels mw__star_##symbol;
#include <meshwalk/star_walks.def>

/* --- start.c, grid.c, octahedron.c -------------------------------------------------------------------------------- */

/* The first facet of a walk by the cursor's start; `last` is where the query before it ended, or MW_NONE. Touches the
 * walk's q, d, random, work. The walk's t is not set yet. */
uint32_t mw__star_start(const mw_star *star, const mw_star_cursor *cursor, uint32_t last, mw_star_walk *walk);

/* --- angles.c ----------------------------------------------------------------------------------------------------- */

/* Longitude and polar angle of d (not zero), as eq. 3: rounded; phi of a pole is 0. */
void mw__star_angles(const double d[3], double *phi, double *theta);

/* Fill in star->angle and mark the seam. */
void mw__star_fill_angles(mw_star *star);

/* --- locate.c ----------------------------------------------------------------------------------------------------- */

/* The facet (as stored) that the ray from the centre along d, rounded, meets, exactly for some ray about there: walks
 * from facet t. For those who build guides. */
uint32_t mw__star_facet(const mw_star *star, const double d[3], uint32_t t);

#endif
