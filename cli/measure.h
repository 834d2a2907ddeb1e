/* measure.h - what walks do and take, one beside the other, on one triangulation.
 *
 * All algorithms locate the same queries, uniform in the domain of the points; a query outside the mesh is replaced. What
 * they do is counted in batches. How long they take is measured apart, in single queries on one thread, so that counting
 * and interleaving cost it nothing. */
#ifndef CLI_MEASURE_H
#define CLI_MEASURE_H

#include "datasets.h"

#include <meshwalk/meshwalk.h>

/* Means per query; but of triangles_final_max the most, and of layers the number. */
typedef enum quantity {
    TRIANGLES_INIT,
    TRIANGLES,
    TRIANGLES_FINAL,
    TRIANGLES_FINAL_MAX,
    ORIENT_INIT,
    ORIENT,
    ORIENT_FINAL,
    IMPLICIT,
    COMPARISONS,
    LAYERS,
    TIME_US,       /* plain doubles, microseconds */
    TIME_EXACT_US, /* exact arithmetic            */
    QUANTITIES
} quantity;

const char *quantity_name(quantity q); /* "triangles_init", ... */

/* A walk as a table of the thesis calls it. */
typedef struct algorithm {
    const char *name;         /* the walk's; or more, where one walk has two forms */
    const char *abbreviation; /* as in the thesis                                  */
    const char *walk;
    bool areas; /* with stored areas */
} algorithm;

#define MOST_ALGORITHMS 8

/* Most queries that are timed, and in how many rounds: each round takes its share of them. */
#define TIMED_QUERIES 20000
#define TIMED_ROUNDS 5

typedef struct trial {
    const char *name; /* for messages */
    const dataset *data;
    const algorithm *const *algorithms; /* NULL ends them */
    const char *finish;                 /* walk that ends the cheap ones        */
    bool layered;                       /* start from layers, else from random triangles */
    uint32_t layers;                    /* that many; 0: by the size            */
    uint64_t queries, seed;
    uint32_t threads;
    bool times;
} trial;

typedef struct outcome {
    size_t vertices; /* of the triangulation, equal points counted once */
    double value[MOST_ALGORITHMS][QUANTITIES];
} outcome;

/* Complains about what went wrong; returns 0 or an exit code. */
int measure(const trial *t, outcome *o);

/* Whatever the walk, the answer is the same: complains where two found different ones for n queries. Returns 0 or an exit
 * code. name: of the set of points. */
int measure_compare(const char *name, const double *queries, size_t n, const char *walk, const mw_location *found,
                    const char *other, const mw_location *expected);

#endif
