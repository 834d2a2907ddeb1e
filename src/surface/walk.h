/* walk.h - one probe: its walks over the surface, how they begin, and how they are repeated. Private [thesis App. G].
 *
 * walk.c is the walk, first.c the choice of first triangles, race.c the repetition. A walk is a small state; a step
 * looks at one triangle, and ends there or crosses one of its edges. */
#ifndef MW_SRC_SURFACE_WALK_H
#define MW_SRC_SURFACE_WALK_H

#include "surface/prober.h"

#include <stdatomic.h>

/* One probe, and how it is to be answered. Const during the search. */
typedef struct mw_search {
    const mw_surface *surface;
    mw_line line;
    double reach;        /* the farthest touch that counts; may be infinite                                   */
    uint32_t last;       /* the first walk begins there, if m points at its front; or MW_NONE                 */
    uint32_t samples;    /* k of Alg. 1                                                                       */
    bool nearest;        /* of the samples that m points at, the nearest; or the first one                    */
    uint32_t iterations; /* walks at most                                                                     */
    uint32_t race;       /* of them at a time                                                                 */
    uint32_t steps;      /* triangles of one walk at most, > 0; the number of all of them does not limit it   */
    uint64_t random;     /* walk number i has its random numbers from this and i, whatever thread it runs in  */
    bool count;
} mw_search;

/* The triangles that walks visit, in order. */
typedef struct mw_trace {
    uint32_t *triangles, *iteration; /* room for `capacity` each; iteration may be NULL */
    size_t capacity, count;
    uint32_t walk; /* number of the walk that is on its way */
} mw_trace;

typedef enum mw_course {
    MW_COURSE_GO,    /* crossed into another triangle                                */
    MW_COURSE_TOUCH, /* triangle t is touched, in reach                              */
    MW_COURSE_END    /* round, or at its borders, or out of steps; or others found   */
} mw_course;

/* Everything one walk remembers. */
typedef struct mw_slice {
    const mw_search *search;
    const double *point;
    const mw_triangle *tri;
    const uint32_t *place;
    double o[3];    /* a point of the first triangle; it and the line span the plane                     */
    double n[3];    /* the normal of the plane, m x (o - q), rounded                                     */
    double sum[3];  /* of the magnitudes of its products                                                 */
    uint32_t first; /* triangle                                                                          */
    uint32_t t, e;  /* current triangle, and its edge by which it was entered; MW_SLICE_FIRST at first   */
    uint32_t r, l;  /* the ends of that edge: r not above the plane, l above it                          */
    uint32_t back;  /* the edge of the first triangle that the plane crosses and the walk did not        */
    int side;       /* of the line against rl: the walk has it ahead (1) or behind (-1), or meets it (0) */
    bool turned;    /* went back to the first triangle, and on over its edge `back`                      */
    uint32_t fuel;  /* triangles that may still be entered                                               */
    const _Atomic uint32_t *found; /* of a race: another walk's triangle, or MW_NONE                      */
    mw_probe_counters *work;       /* of counting kernels                                                 */
} mw_slice;

#define MW_SLICE_FIRST 3u

/* --- walk.c ------------------------------------------------------------------------------------------------------- */

/* A walk from triangle t, which is counted in *work, unless that is NULL. `found`: see mw_slice; NULL if it runs alone.
 * Touches no mesh memory. */
mw_slice mw__slice_begin(const mw_search *search, uint32_t t, const _Atomic uint32_t *found, mw_probe_counters *work);

/* To its end: the triangle that is touched, or MW_NONE. */
uint32_t mw__slice_run(mw_slice *walk);

/* The same, written down; of a walk that counts and runs alone. */
uint32_t mw__slice_trace(mw_slice *walk, mw_trace *trace);

/* --- first.c ------------------------------------------------------------------------------------------------------ */

/* Does m point at the front of the triangle? Counted in *work, unless that is NULL. */
bool mw__faces(const mw_search *search, uint32_t triangle, mw_probe_counters *work);

/* Alg. 1; MW_NONE where m points at the front of no triangle that was looked at. */
uint32_t mw__first_triangle(const mw_search *search, uint64_t *random, mw_probe_counters *work);

/* --- race.c ------------------------------------------------------------------------------------------------------- */

/* Walk number i of a search, from triangle `first`: the triangle that is touched, or MW_NONE. `found`, `work`: as for
 * mw__slice_begin; `trace`: NULL, or of a walk that counts and runs alone. */
uint32_t mw__search_from(const mw_search *search, uint64_t i, uint32_t first, const _Atomic uint32_t *found,
                         mw_probe_counters *work, mw_trace *trace);

/* Walks until one finds: the triangle that is touched, or MW_NONE. What they all did is added to *work, unless that is
 * NULL; maxima excepted. With a trace they run one after the other. */
uint32_t mw__search_all(const mw_search *search, mw_probe_counters *work, mw_trace *trace);

#endif
