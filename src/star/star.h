/* star.h - the records of a star-shaped polyhedron, and its walks. Private.
 *
 * Facets are stored counter-clockwise as seen from outside, whatever the user's orientation. So the
 * ray through q lies in the cone of a facet over the centre c if det(v[k] - c, v[k+1] - c, q - c) >
 * 0 for its three edges. It lies beyond an edge if that determinant is negative. Walks ask the same
 * questions of an edge as planar walks do; the great circle through an edge stands for its line. */
#ifndef MW_SRC_STAR_STAR_H
#define MW_SRC_STAR_STAR_H

#include "base/hilbert.h"
#include "base/job.h"
#include "surface/surface.h"

#include <meshwalk/star.h>

/* Mark in `user` of a facet: the orthogonal walk ends here. The facet lies across the seam at
 * longitude 180, or contains a pole. So in the plane of longitude and polar angle it is not
 * oriented as seen from outside. */
#define MW_SEAM MW_GHOST

/* Mark in `user` of a facet: its vertices differ, in themselves or in order, from those of the
 * user's facet with this number. */
#define MW_FACET_ALTERED (UINT32_C(1) << 31)

/* A facet as walks read it: one cache line. Links as in mesh.h. */
typedef struct mw_star_facet {
    /* Of the plane through edge k and the centre, into the cone: see MW_STAR_SURE. */
    float normal[3][3];
    uint32_t v[3], link[3];
    /* The user's number, and marks; after flips several facets may have one number. */
    uint32_t user;
} mw_star_facet;

/* Let n be a normal above and f the direction of a ray, both of length 1 and rounded to floats. If
 * |n . f| is larger than this, its sign is certain. n is off by 2^-26 (star_layout.c) and f by
 * 2^-50, both by 2^-24 more for rounding. So n . f is off by 2.3 2^-24, and its evaluation by 3.1
 * 2^-24, as the sum of |n_k f_k| is at most 1. */
#define MW_STAR_SURE 0x1p-21f

/* A vertex of many facets: see star_hubs.h. */
typedef struct mw_star_hub {
    uint32_t *ring;       /* half-edges that start at the hub, counter-clockwise */
    uint32_t count, room; /* of the ring */
    uint32_t vertex;      /* its representative */
    uint32_t half;        /* the first of its half-edges to the right of its first one */
    bool stale;           /* the ring is to be found anew before a walk uses it */
} mw_star_hub;

typedef struct mw_star_hubs {
    mw_star_hub *hub; /* by vertex */
    uint32_t count, room;
    uint32_t stale; /* how many are */
} mw_star_hubs;

/* What a star knows of each facet by itself, so that it can follow single ones: star_track.h. */
typedef struct mw_star_track {
    uint8_t *state;   /* of each of the user's facets */
    uint32_t *place;  /* of each of the user's facets: where it is in star->facet, or MW_NONE */
    uint32_t *degree; /* of each vertex, in its representative: corners of facets */
    uint32_t flat;    /* facets without area */
    uint32_t unsound; /* facets through the centre, or with a corner that is not finite */
    uint32_t wrong;   /* half-edges without a neighbour, or with one of another orientation */
    uint32_t met;     /* facets that one ray meets */
    uint32_t tended_section; /* the next one of the guide to be looked at */
    uint32_t dropped;        /* how many facets went */
    bool on;                 /* all this holds */
} mw_star_track;

struct mw_star {
    const mw_surface *surface;
    mw_triangle *tri;     /* while preparing: the facets in the user's order, oriented; else NULL */
    mw_star_facet *facet; /* in the order of star_layout.c */
    /* For the upper bits of a curve key, a facet near there; see mw__star_guide_facet. */
    uint32_t *guide;
    uint32_t guide_bits;
    mw_hilbert *curve; /* of keys; NULL of a borrowed star */
    float near;        /* a query this near to a facet's cone starts there: see star_start.c */
    mw_star_hubs hubs;
    /* Per vertex: its representative, from the surface or own; NULL: no two coincide. */
    const uint32_t *coincident;
    uint32_t *own_coincident;
    uint32_t *owner; /* per vertex: the lowest facet that the ray through it meets, or MW_NONE */
    mw_star_track track;
    /* NULL, or longitude phi (-pi to pi) and polar angle theta (0 to pi) of each vertex. */
    double *angle;
    double centre[3];
    double reach;                    /* about the largest coordinate relative to the centre */
    uint32_t tri_count, point_count; /* numbers of the surface */
    uint32_t tri_room, point_room;   /* and how many there is memory for */
    uint32_t facet_count;            /* stored facets: neither void nor freed */
    uint32_t area_count;             /* facets of the user with an area */
    uint32_t freed_count;            /* numbers of facets that an editor has freed */
    uint32_t front;                  /* the facet at phi = 0, theta = pi/2 */
    uint32_t fuel;                   /* step limit of walks that may not end */
    uint64_t version;                /* version of the surface that all this is valid for */
    uint64_t shape;                  /* and its shape */
    bool ready;                      /* the last check found it star-shaped */
    bool angles;                     /* `angle` is wanted */
    bool attached;                   /* it follows an editor of the surface */
    /* Rays walk on the surface's own records (star/borrow): there are no arrays here. */
    bool borrowed;
    bool unchecked; /* and nothing was decided, so that the star is always ready */
    bool has_flat;  /* or flat facets were found between others */
};

/* Is it up to date and star-shaped? Then it can be walked. */
static MW_INLINE bool mw__star_is_current(const mw_star *star)
{
    return star->unchecked || (star->ready && star->version == star->surface->version);
}

/* Corner k of a facet with vertices v. */
static MW_INLINE const double *mw__star_corner_point(const mw_star *star, const uint32_t *v,
                                                     uint32_t k)
{
    return mw__surface_point(star->surface, v[k]);
}

/* The half-edge that starts at the same vertex in the next facet, counter-clockwise. */
static MW_INLINE uint32_t mw__star_turn(const mw_star *star, uint32_t half)
{
    uint32_t before = mw__half_prev(half);
    return star->facet[mw__link_triangle(before)].link[mw__link_edge(before)];
}

/* A void facet has no links, as two of its corners coincide. It does not count. */
static MW_INLINE bool mw__star_is_void(const mw_triangle *facet)
{
    return (facet->link[0] & facet->link[1] & facet->link[2]) == MW_NONE;
}

typedef enum mw_star_verdict {
    MW_STAR_GO,    /* crossed into another facet */
    MW_STAR_FOUND, /* the ray meets facet t */
    MW_STAR_CLOSE, /* a cheap walk ended in facet t; an exact one continues there */
    MW_STAR_DRY    /* out of fuel */
} mw_star_verdict;

#define MW_STAR_NO_EDGE 3u

/* The stages of a search, which are counted separately: an octahedron chooses the first facet,
 * walk, final location. */
enum { MW_STAR_STAGE_INIT, MW_STAR_STAGE_WALK, MW_STAR_STAGE_FINAL, MW_STAR_STAGES };

typedef struct mw_star_work {
    uint64_t visited; /* facets entered, including the first */
    uint64_t triangles[MW_STAR_STAGES], orient[MW_STAR_STAGES];
    uint64_t comparisons;
} mw_star_work;

/* The state of a walk. */
typedef struct mw_star_walk {
    const mw_star *star;
    const double *point;
    const mw_star_facet *facet;
    double c[3], q[3], d[3]; /* centre, query point, and q - c, rounded */
    float f[3];              /* d scaled to length 1, as floats; 0 if out of their range */
    uint32_t t, e;           /* current facet, and its entry edge; MW_STAR_NO_EDGE at first */
    uint32_t p;              /* straight: the vertex where the great circle to q starts */
    uint32_t phase;          /* of walks with phases; 0 at first */
    uint32_t fuel;           /* steps left */
    uint32_t stage;          /* stage for the counters */
    uint64_t random;
    double phi, theta;  /* orthogonal: angles of q */
    double height;      /* orthogonal: theta of the parallel that the first leg follows */
    mw_star_work *work; /* counters; NULL: none */
} mw_star_walk;

/* Gives walks to the lanes of a ring. `deliver` takes the finished walk of a lane (verdict
 * MW_STAR_GO: none yet) and replaces it with the next one. Returns false if there is no more for
 * this lane. */
typedef struct mw_star_feed {
    bool (*deliver)(struct mw_star_feed *feed, uint32_t lane, mw_star_walk *walk,
                    mw_star_verdict verdict);
} mw_star_feed;

#define MW_STAR_LANES 16

/* The kernels of a walk. */
typedef struct mw_star_kernels {
    mw_star_verdict (*run[2])(mw_star_walk *walk);         /* by [count]: one walk, to its end */
    void (*ring)(mw_star_feed *feed, uint32_t lane_count); /* up to MW_STAR_LANES walks in turn */
    mw_star_verdict (*step)(mw_star_walk *walk);           /* one counted step, for traces */
} mw_star_kernels;

#define MW_STAR_WALK_ENTRY(id, symbol, name, source, help)                                         \
    extern const mw_star_kernels mw__star_##symbol;
#include <meshwalk/star_walks.def>

/* --- star_layout.c --- */

/* The direction d, not zero, projected to the regular octahedron. Unfolding its lower half gives a
 * square from -1 to 1. */
static MW_INLINE void mw__star_unfold(const double d[3], double *x, double *y)
{
    double sum = fabs(d[0]) + fabs(d[1]) + fabs(d[2]), u = d[0] / sum, v = d[1] / sum;
    bool below = d[2] < 0;
    *x = below ? copysign(1 - fabs(v), u) : u;
    *y = below ? copysign(1 - fabs(u), v) : v;
}

/* A facet in star->tri with this mark in `user` is not stored: it is void, or an editor has freed
 * it. */
#define MW_STAR_OMITTED MW_SURFACE_FREED

/* Fill in star->facet, star->facet_count and star->guide from star->tri. Stages of the present part
 * of the job. Returns false when out of memory, or cancelled. */
bool mw__star_lay_out(mw_star *star, mw_job *job);

/* Where on the curve the facet with these corners lies: its key. */
uint32_t mw__star_facet_key(const mw_star *star, const uint32_t v[3]);

/* Set the planes of a facet by its corners. */
void mw__star_set_planes(const mw_star *star, mw_star_facet *facet);

/* The number of bits of the guide: an entry for 2 to 4 facets. */
static MW_INLINE uint32_t mw__star_guide_bits(uint32_t facets)
{
    uint32_t bits = 1;
    while (bits < 30 && facets >> bits >= 4) bits++;
    return bits;
}

/* The curve over the sphere. */
static inline mw_hilbert mw__star_curve(void)
{
    return mw__hilbert((const double[2]){-1, -1}, (const double[2]){1, 1});
}

/* The key of the direction d, not zero, on the curve over the sphere. */
static MW_INLINE uint32_t mw__star_curve_key(const mw_hilbert *curve, const double d[3])
{
    double x, y;
    mw__star_unfold(d, &x, &y);
    return mw__hilbert_key(curve, x, y);
}

/* A facet near a key of the curve over the sphere. After edits, an entry of the guide may name a
 * facet that is no more. */
static MW_INLINE uint32_t mw__star_guide_facet(const mw_star *star, uint32_t key)
{
    uint32_t facet = star->guide[key >> (32 - star->guide_bits)];
    return MW_LIKELY(facet < star->facet_count) ? facet : facet % star->facet_count;
}

/* --- star_start.c, star_grid.c, star_octahedron.c --- */

/* Choose the first facet of a walk by the cursor's start. `last`: where the previous query ended,
 * or MW_NONE. Uses q, d, random and work of the walk. The walk's t is not set yet. */
uint32_t mw__star_start(const mw_star *star, const mw_star_cursor *cursor, uint32_t last,
                        mw_star_walk *walk);

/* --- star_angles.c --- */

/* Longitude and polar angle of d, not zero, by eq. 3, rounded. phi of a pole is 0. */
void mw__star_angles(const double d[3], double *phi, double *theta);

/* Fill in star->angle and mark the facets of the seam. */
void mw__star_fill_angles(mw_star *star);

/* The same for one facet, whose corners may have moved. */
void mw__star_renew_angles(mw_star *star, mw_star_facet *facet);

/* --- star_walk_run.c --- */

/* The stored facet that the ray from the centre along d, rounded, meets; exact for some ray close
 * to d. Walks from facet t. Serves to build indices. */
uint32_t mw__star_facet_along(const mw_star *star, const double d[3], uint32_t t);

#endif
