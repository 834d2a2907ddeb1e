/* star_walk_run.h - a walk from its first facet to the one that the ray meets. Private. */
#ifndef MW_SRC_STAR_STAR_WALK_RUN_H
#define MW_SRC_STAR_STAR_WALK_RUN_H

#include "star/star_walk.h"

/* The user's numbers of the facets that a walk visits. */
typedef struct mw_star_trace {
    uint32_t *facet;
    size_t count, capacity; /* count may exceed capacity */
} mw_star_trace;

static MW_INLINE bool mw__star_point_is_centre(const mw_star *star, const double q[3])
{
    const double *c = star->centre;
    return q[0] == c[0] && q[1] == c[1] && q[2] == c[2];
}

/* The squares of lengths in between, and their significant parts, are normal doubles. */
#define MW_STAR_SHORT 0x1p-200
#define MW_STAR_LONG 0x1p200

/* Initialises the walk in place: its state is too large to return. */
static MW_INLINE void mw__star_walk_begin(mw_star_walk *walk, const mw_star *star,
                                          const double q[3], uint64_t random, mw_star_work *work)
{
    double d[3], square = 0;
    walk->star = star;
    walk->point = star->surface->point;
    walk->facet = star->facet;
    walk->random = random;
    walk->work = work;
    for (int k = 0; k < 3; k++) {
        walk->c[k] = star->centre[k];
        walk->q[k] = q[k];
        walk->d[k] = d[k] = q[k] - star->centre[k];
        square += d[k] * d[k];
    }
    double scale = square > MW_STAR_SHORT * MW_STAR_SHORT && square < MW_STAR_LONG * MW_STAR_LONG
                       ? 1 / sqrt(square)
                       : 0;
    for (int k = 0; k < 3; k++) walk->f[k] = (float)(scale * d[k]);
}

/* Start the walk in facet t, or continue there with another kernel, in another stage. */
static MW_INLINE void mw__star_walk_enter(mw_star_walk *walk, uint32_t t, uint32_t stage,
                                          uint32_t fuel)
{
    walk->t = t;
    walk->e = MW_STAR_NO_EDGE;
    walk->phase = 0;
    walk->fuel = fuel;
    walk->stage = stage;
    if (walk->work) walk->work->triangles[stage]++;
}

/* Write the current facet down. A facet that flips have cut is recorded once for each tile. */
static MW_INLINE void mw__star_trace_add(mw_star_trace *trace, const mw_star_walk *walk)
{
    if (trace->count++ < trace->capacity)
        trace->facet[trace->count - 1] = walk->facet[walk->t].user & MW_USER_MASK;
}

/* Run a walk: step by step if there is a trace, else at full speed. */
mw_star_verdict mw__star_walk_run(mw_star_walk *walk, const mw_star_kernels *kernel,
                                  mw_star_trace *trace);

/* Continue from where a walk ended to the facet that the ray meets. `finish` ends what a cheap walk
 * leaves. Returns true if the straight walk had to end what these could not. */
bool mw__star_walk_go_on(mw_star_walk *walk, mw_star_verdict verdict, const mw_star_kernels *finish,
                         mw_star_trace *trace);

#endif
