/* measure.h - what walks do and take, one beside the other, on one set of points or one mesh.
 *
 * All algorithms locate the same queries, drawn uniform in the domain of the points; one that falls outside the mesh, or
 * outside another place where such is given, is replaced. What they do is counted in batches. How long they take is
 * measured apart, in single queries on one thread, so that counting and interleaving cost it nothing. */
#ifndef CLI_MEASURE_H
#define CLI_MEASURE_H

#include "bench/data/datasets.h"
#include "bench/core/quantity.h"

#include <meshwalk/meshwalk.h>

/* How a mesh is made ready for a walk. */
typedef enum preparation {
    FILLED, /* pockets and holes, if it has any, hold ghost triangles    */
    AREAS,  /* so, and with stored areas                                 */
    OPEN,   /* nothing is built: for the walk that goes round the border */
    PREPARATIONS
} preparation;

/* A walk as a table of the thesis calls it. */
typedef struct algorithm {
    const char *name;         /* the walk's; or another, where one walk has several forms */
    const char *abbreviation; /* as in the thesis                                        */
    const char *walk;
    preparation preparation;
    mw_triangulation_kind kind; /* of the points; those of a kind stand together */
} algorithm;

#define MOST_ALGORITHMS 8

typedef struct trial {
    const char *name; /* for messages */
    const dataset *data;
    mw_mesh *mesh;                      /* a mesh to be taken as it is; NULL: the points are triangulated */
    const mw_mesh *place;               /* queries are uniform in this mesh; NULL: in that of the trial   */
    const algorithm *const *algorithms; /* NULL ends them */
    const char *finish;                 /* walk that ends the cheap ones */
    const char *start;                  /* "random", "sample" or "layers" */
    uint32_t sample, layers;            /* that many; 0: by the size      */
    uint64_t queries, seed;
    uint32_t threads;
    bool times;
} trial;

typedef struct outcome {
    size_t vertices; /* of the triangulation, equal points counted once */
    double value[MOST_ALGORITHMS][QUANTITIES];
    double whole[QUANTITIES]; /* MESH_TRIANGLES and so on, filled by whoever knows */
} outcome;

/* Complains about what went wrong; returns 0 or an exit code. */
int measure(const trial *t, outcome *o);

/* Whatever the walk, the answer is the same: complains where two found different ones for n queries. Returns 0 or an exit
 * code. name: of the set of points. */
int measure_compare(const char *name, const double *queries, size_t n, const char *walk, const mw_location *found,
                    const char *other, const mw_location *expected);

#endif
