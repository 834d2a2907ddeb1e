/* quantity.h - what is measured of walks, meshes and triangulations: a row of the tables each. */
#ifndef MW_BENCH_PAPER_QUANTITY_H
#define MW_BENCH_PAPER_QUANTITY_H

#include <stdbool.h>

/* Means per query; but of those with `max` the most of one query, and of those below LAYERS what is
 * said there. */
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
    WALK_RUNS,
    TRIANGLES_WALK_MAX,
    BORDER_RUNS,
    TRIANGLES_BORDER,
    ORIENT_BORDER,
    TRIANGLES_BORDER_MAX,
    BORDER_EDGES, /* that were tested */
    BORDER_EDGES_MAX,
    TRIANGLES_TOTAL, /* of all stages, and those looked at to find the first */
    SAMPLE,          /* so many were looked at, the first included           */
    INSIDE_PERCENT,  /* of the queries, in the mesh                          */
    ORIENT_MAX,
    INTERSECTIONS, /* triangles that a line met and whose distance was computed */
    ITERATIONS,    /* walks of one search, from different first triangles       */
    ITERATIONS_MAX,
    FOUND_PER_MILLION, /* queries that found a triangle                         */
    LAYERS,
    LOCATOR_BYTES,         /* what the locator has built beside the mesh       */
    LOCATOR_SECONDS,       /* that it took to make                             */
    EDGE_LENGTH,           /* sum over the edges of the triangulation          */
    SIDE_LENGTH,           /* sum over the sides of triangles: inner edges twice */
    LARGEST_ANGLE,         /* degrees                                          */
    OPTIMAL,               /* 1; 0: a local optimum only                       */
    TRIANGULATION_SECONDS, /* that it took to make                             */
    TIME_US,               /* a query in plain doubles, microseconds           */
    TIME_EXACT_US,         /* in exact arithmetic                              */
    MESH_TRIANGLES,
    MESH_BORDER_EDGES,
    MESH_HOLES,
    HULL_PERCENT, /* of the convex hull, in the mesh                       */
    CORRELATION,  /* of triangles and side length, over triangulations     */
    QUANTITIES
} quantity;

const char *quantity_name(quantity q); /* "triangles_init", ... */
bool quantity_is_time(quantity q);

#endif
