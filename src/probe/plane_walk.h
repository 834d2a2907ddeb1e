/* plane_walk.h - the walks of one probe over the surface, their first triangles, and their
 * repetition. Private [thesis App. G].
 *
 * plane_walk.c is the walk, probe_first_triangle.c chooses first triangles, probe_race.c repeats
 * walks. A walk is a small state. A step looks at one triangle and ends there, or crosses one of
 * its edges. */
#ifndef MW_SRC_PROBE_PLANE_WALK_H
#define MW_SRC_PROBE_PLANE_WALK_H

#include "probe/prober.h"

#include <stdatomic.h>

/* One probe and its options. Const during the search. */
typedef struct mw_probe_search {
    const mw_surface *surface;
    mw_line line;
    double reach;        /* largest distance of a touch; may be infinite */
    uint32_t first;      /* the first walk starts there if m points at its front; or MW_NONE */
    uint32_t samples;    /* k of Alg. 1 */
    bool nearest;        /* take the nearest of the samples that m points at, or the first one */
    uint32_t iterations; /* maximal number of walks */
    uint32_t race;       /* walks at the same time */
    uint32_t steps;      /* most triangles of a walk, > 0; their number in the mesh is no limit */
    uint64_t random;     /* with i, seeds the random numbers of walk i, in any thread */
    bool count;
} mw_probe_search;

/* The triangles that the walks visit, in order. */
typedef struct mw_probe_trace {
    uint32_t *triangles, *iteration; /* room for `capacity` each; iteration may be NULL */
    size_t capacity, count;
    uint32_t walk; /* number of the current walk */
} mw_probe_trace;

typedef enum mw_plane_walk_verdict {
    MW_PLANE_WALK_GO,    /* crossed into another triangle */
    MW_PLANE_WALK_TOUCH, /* triangle t is touched, in reach */
    /* Back at the start, at both borders, out of steps, or another walk has found one. */
    MW_PLANE_WALK_END
} mw_plane_walk_verdict;

/* The state of a walk. */
typedef struct mw_plane_walk {
    const mw_probe_search *search;
    const double *point;
    const mw_triangle *tri;
    const uint32_t *coincident;
    double o[3];    /* a point of the first triangle; with the line it spans the plane */
    double n[3];    /* the normal of the plane, m x (o - q), rounded */
    double sum[3];  /* sums of the magnitudes of the products in n */
    uint32_t first; /* first triangle */
    uint32_t t, e;  /* current triangle, and its entry edge; MW_PLANE_WALK_FIRST at first */
    uint32_t r, l;  /* the ends of that edge: r not above the plane, l above it */
    uint32_t back;  /* the other edge of the first triangle that the plane crosses */
    int side;       /* the line is ahead of rl (1), behind it (-1), or meets it (0) */
    bool turned;    /* has gone back to the first triangle and over its edge `back` */
    uint32_t fuel;  /* triangles that may still be entered */
    /* Of a race: the triangle that another walk has found, or MW_NONE. */
    const _Atomic uint32_t *found;
    mw_probe_counters *work; /* counters; NULL: none */
} mw_plane_walk;

#define MW_PLANE_WALK_FIRST 3u

/* --- plane_walk.c --- */

/* A walk from triangle t. Counts in *work, unless that is NULL. `found`: see mw_plane_walk; NULL
 * for a single walk. Touches no memory of the mesh. */
mw_plane_walk mw__plane_walk_begin(const mw_probe_search *search, uint32_t t,
                                   const _Atomic uint32_t *found, mw_probe_counters *work);

/* Run a walk to its end. Returns the triangle that is touched, or MW_NONE. */
uint32_t mw__plane_walk_run(mw_plane_walk *walk);

/* The same with a trace, for a single walk that counts. */
uint32_t mw__plane_walk_trace(mw_plane_walk *walk, mw_probe_trace *trace);

/* --- probe_first_triangle.c --- */

/* Does m point at the front of the triangle? Counts in *work, unless that is NULL. */
bool mw__probe_faces(const mw_probe_search *search, uint32_t triangle, mw_probe_counters *work);

/* Alg. 1. Returns MW_NONE if m points at the front of no triangle in the sample. */
uint32_t mw__probe_first_triangle(const mw_probe_search *search, uint64_t *random,
                                  mw_probe_counters *work);

/* --- probe_race.c --- */

/* Run walk i of a search from triangle `first`. Returns the triangle that is touched, or MW_NONE.
 * `found`, `work`: as for mw__plane_walk_begin. `trace`: NULL, or for a single walk that counts. */
uint32_t mw__probe_search_from(const mw_probe_search *search, uint64_t i, uint32_t first,
                               const _Atomic uint32_t *found, mw_probe_counters *work,
                               mw_probe_trace *trace);

/* Run walks until one touches a triangle. Returns that, or MW_NONE. Adds the work of all walks,
 * without maxima, to *work, unless that is NULL. With a trace the walks run one after the other. */
uint32_t mw__probe_search_all(const mw_probe_search *search, mw_probe_counters *work,
                              mw_probe_trace *trace);

#endif
