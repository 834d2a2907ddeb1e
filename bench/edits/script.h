/* script.h - what is done to a triangulation in 'bench edit', made from a seed.
 */
#ifndef CLI_SCRIPT_H
#define CLI_SCRIPT_H

#include "bench/data/datasets.h"
#include "bench/edits/editing.h"

#include <stdbool.h>

/* What is measured; the first ones are scripts. */
typedef enum editing_task {
    EDITING_INSERT,             /* points in random order        */
    EDITING_INSERT_SORTED,      /* points along a Hilbert curve */
    EDITING_INSERT_MANY,        /* points in random order, given at once */
    EDITING_INSERT_MANY_SORTED, /* points along a Hilbert curve, given at once */
    EDITING_REMOVE,             /* random vertices        */
    EDITING_MOVE_NEAR,          /* random vertices, each a tenth of the mean length of its
                        edges               */
    EDITING_MOVE_FAR,           /* random vertices, each to the place of another point  */
    EDITING_MIXED,              /* in turn: a point inserted, a vertex removed, a place
                        located, all at random */
    EDITING_REBUILD,            /* trees built anew after some edits   */
    EDITING_SESSION,            /* location during a long session   */
    EDITING_TASKS
} editing_task;

/* n points, and so many steps; at most half as many as points. Returns 0 or an
 * exit code after a complaint. */
int script_make(script *s, editing_task task, dataset_kind kind, size_t n, size_t steps, uint64_t seed);
void script_release(script *s);

/* The sum of the Delaunay triangulation of the points that are there at the
 * end, made from scratch. Returns 0 or an exit code. */
int script_expect(const script *s, uint64_t *sum);

#endif
