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

/* In `user` of a facet: its vertices are not those of the user's facet of that number, or in another order. */
#define MW_RECAST (UINT32_C(1) << 31)

/* A facet as walks read it: one line of a cache. Links as in mesh.h. */
typedef struct mw_star_facet {
    float normal[3][3]; /* of the plane through edge k and the centre, to the inside of the cone: see MW_STAR_SURE */
    uint32_t v[3], link[3];
    uint32_t user; /* the user's number, and marks; where flat facets were flipped away, several have the same */
} mw_star_facet;

/* With n a normal above and f the direction of a ray, both of length 1 and rounded to floats, |n . f| beyond this is
 * sure of its sign. n is off by 2^-26, as layout.c sees to, and f by 2^-50, both by 2^-24 for the rounding; so n . f by
 * 2.3 2^-24, and its evaluation, the sum of |n_k f_k| being 1 at most, by 3.1 2^-24. */
#define MW_STAR_SURE 0x1p-21f

struct mw_star {
    const mw_surface *surface;
    mw_triangle *tri;     /* while it is prepared: the facets in the user's order, oriented; else NULL */
    mw_star_facet *facet; /* in the order of layout.c */
    uint32_t *guide;      /* for the upper bits of a key of the curve, a facet about there; see mw__star_by_curve */
    uint32_t guide_bits;
    const uint32_t *place; /* per vertex the lowest at its place: the surface's, or its own; NULL: no two are at one */
    uint32_t *own_place;
    uint32_t *owner; /* per vertex the lowest facet that the ray through it meets; MW_NONE: of no facet */
    double *angle;   /* NULL, or longitude phi (-pi to pi) and polar angle theta (0 to pi) of each vertex */
    double centre[3];
    double reach; /* the largest difference of a coordinate from the centre's, about */
    uint32_t tri_count, point_count;
    uint32_t area_count; /* facets of the user's with an area */
    uint32_t front;      /* the facet at phi = 0, theta = pi/2 */
    uint32_t fuel;       /* steps of a walk that need not end */
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
    const mw_star_facet *facet;
    double c[3], q[3], d[3]; /* centre, the point looked for, and q - c as rounded                             */
    float f[3];              /* d made 1 long, as floats; 0 where that is out of their range                   */
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

/* Where the lanes of a ring get their walks. `deliver` takes the finished walk of a lane (verdict MW_STAR_GO: there is
 * none yet) and puts the next one in its place; false: no more for this lane. */
typedef struct mw_star_feed {
    bool (*deliver)(struct mw_star_feed *feed, uint32_t lane, mw_star_walk *walk, mw_star_verdict verdict);
} mw_star_feed;

#define MW_STAR_LANES 16

/* The kernels of a walk. */
typedef struct mw_star_kernels {
    mw_star_verdict (*run[2])(mw_star_walk *walk);         /* by [count]: one walk, from its t to its end */
    void (*ring)(mw_star_feed *feed, uint32_t lane_count); /* up to MW_STAR_LANES walks in turn           */
    mw_star_verdict (*step)(mw_star_walk *walk);           /* one step, counting: for those who look at each facet */
} mw_star_kernels;

#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help) extern const mw_star_kernels mw__star_##symbol;
#include <meshwalk/star_walks.def>

/* --- layout.c ----------------------------------------------------------------------------------------------------- */

/* The direction d, not zero, on the regular octahedron, whose lower half is folded out: a square from -1 to 1. */
static MW_INLINE void mw__star_unfold(const double d[3], double *x, double *y)
{
    double sum = fabs(d[0]) + fabs(d[1]) + fabs(d[2]), u = d[0] / sum, v = d[1] / sum;
    bool below = d[2] < 0;
    *x = below ? copysign(1 - fabs(v), u) : u;
    *y = below ? copysign(1 - fabs(u), v) : v;
}

/* Fill in star->facet and star->guide from star->tri. Returns false when out of memory. */
bool mw__star_lay_out(mw_star *star);

/* Bits of the guide of so many facets: an entry for 2 to 4 of them. */
static MW_INLINE uint32_t mw__star_guide_bits(uint32_t facets)
{
    uint32_t bits = 1;
    while (bits < 30 && facets >> bits >= 4) bits++;
    return bits;
}

/* A facet about where a key of the curve over the sphere is. */
static MW_INLINE uint32_t mw__star_by_curve(const mw_star *star, uint32_t key)
{
    return star->guide[key >> (32 - star->guide_bits)];
}

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
