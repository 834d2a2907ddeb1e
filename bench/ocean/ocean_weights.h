/* ocean_weights.h - weights that are applied to the steps of a model, beside copying. */
#ifndef MW_BENCH_OCEAN_OCEAN_WEIGHTS_H
#define MW_BENCH_OCEAN_OCEAN_WEIGHTS_H

#include <meshwalk/meshwalk.h>

enum { OCEAN_STEPS = 240, OCEAN_WEIGHTS_WAYS = 9 };

extern const char *const ocean_weights_ways[OCEAN_WEIGHTS_WAYS];

typedef struct ocean_weights {
    size_t points;
    mw_operator *ordered, *scattered; /* points and vertices are in rows, or at random */
    double *values, *results;         /* of a block of steps */
} ocean_weights;

/* As many points as vertices, which `mesh` has in random order. Returns 0, or an exit code after a
 * complaint; release in both cases. */
int ocean_weights_make(ocean_weights *w, const mw_mesh *mesh, uint64_t seed);
void ocean_weights_release(ocean_weights *w);

/* The bytes that all steps have to touch by a way: values once, results once, and the weights once
 * for each block of steps. */
double ocean_weights_bytes(const ocean_weights *w, size_t way);

/* Figure 0: seconds of all steps, by the way of that number. `self` is an ocean_weights. */
int ocean_weights_time(void *self, size_t way, size_t round, double *figures);

#endif
