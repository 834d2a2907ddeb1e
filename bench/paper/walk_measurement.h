/* walk_measurement.h - what walks do and take, one beside the other, on one set of points or one
 * mesh.
 *
 * All algorithms locate the same queries, drawn uniform in the domain of the points; one that falls
 * outside the mesh, or outside another region where one is given, is replaced. What they do is
 * counted in batches. How long they take is measured apart, in single queries on one thread, so
 * that counting and interleaving cost it nothing. */
#ifndef MW_BENCH_PAPER_WALK_MEASUREMENT_H
#define MW_BENCH_PAPER_WALK_MEASUREMENT_H

#include "bench/data/dataset.h"
#include "bench/paper/quantity.h"

#include <meshwalk/meshwalk.h>

/* How a mesh is made ready for a walk. */
typedef enum preparation {
    FILLED,            /* pockets and holes, if it has any, hold ghost triangles    */
    FILLED_WITH_AREAS, /* the same, with stored areas                               */
    UNFILLED,          /* nothing is built: for the walk that goes round the border */
    PREPARATIONS
} preparation;

/* A walk as a table of the thesis calls it. */
typedef struct algorithm {
    const char *name;         /* the walk's; or another, where one walk has several forms */
    const char *abbreviation; /* as in the thesis                                        */
    const char *walk;
    preparation preparation;
    mw_triangulation_kind kind; /* of the points; those of a kind stand together */
    mw_descent descent;         /* through the layers, where the trial has them  */
} algorithm;

#define MOST_ALGORITHMS 8

typedef struct walk_trial {
    const char *name; /* for messages */
    const dataset *data;
    /* a mesh to be taken as it is; NULL: the points are triangulated */
    mw_mesh *mesh;
    /* queries are uniform in this mesh; NULL: in that of the trial */
    const mw_mesh *region;
    const algorithm *const *algorithms; /* NULL ends them */
    const char *walk;                   /* NULL, or the walk that all take instead of their own */
    const char *finish;                 /* walk that ends the cheap ones */
    const char *start;                  /* "random", "sample" or "layers" */
    uint32_t sample, layers;            /* that many; 0: by the size      */
    uint64_t queries, seed;
    uint32_t threads;
    bool times;
} walk_trial;

typedef struct walk_outcome {
    size_t vertices; /* of the triangulation, equal points counted once */
    double value[MOST_ALGORITHMS][QUANTITIES];
    double whole[QUANTITIES]; /* MESH_TRIANGLES and so on, filled by whoever knows */
} walk_outcome;

/* Complains about what went wrong; returns 0 or an exit code. */
int walk_measurement_run(const walk_trial *t, walk_outcome *o);

#endif
