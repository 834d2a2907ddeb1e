/* edit_script.h - what is done to a triangulation in 'bench edit': a script of edits and points to
 * locate, made from a seed. */
#ifndef MW_BENCH_EDITS_EDIT_SCRIPT_H
#define MW_BENCH_EDITS_EDIT_SCRIPT_H

#include "bench/data/dataset.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum edit_step_kind {
    EDIT_STEP_INSERT,
    EDIT_STEP_REMOVE,
    EDIT_STEP_MOVE,
    EDIT_STEP_LOCATE
} edit_step_kind;

/* One thing to do. Vertices are the points in order, then those inserted, in order. */
typedef struct edit_step {
    edit_step_kind kind;
    uint32_t vertex;
    double point[2];
} edit_step;

typedef struct edit_script {
    double *points; /* that are there at first: x0 y0 x1 y1 ... */
    size_t point_count;
    edit_step *steps;
    size_t count, inserted, located; /* of all steps; of those of these kinds */
    /* each step is near the one before: to be located from there */
    int hinted;
    int at_once; /* all are insertions, known before the first */
} edit_script;

/* What 'bench edit' measures; the first ones are scripts. */
typedef enum edit_task {
    EDIT_TASK_INSERT,             /* points in random order */
    EDIT_TASK_INSERT_SORTED,      /* points along a Hilbert curve */
    EDIT_TASK_INSERT_MANY,        /* points in random order, given at once */
    EDIT_TASK_INSERT_MANY_SORTED, /* points along a Hilbert curve, given at once */
    EDIT_TASK_REMOVE,             /* random vertices */
    /* random vertices, each a tenth of the mean length of its edges */
    EDIT_TASK_MOVE_NEAR,
    EDIT_TASK_MOVE_FAR, /* random vertices, each to the position of another point */
    /* in turn: a point inserted, a vertex removed, a point located, all at random */
    EDIT_TASK_MIXED,
    EDIT_TASK_REBUILD, /* trees that are rebuilt after some edits */
    EDIT_TASK_AGING,   /* location while very many edits are made */
    EDIT_TASKS
} edit_task;

/* "insert", ... */
const char *edit_task_name(edit_task task);

/* The script of a task: n points, and so many steps, at most half as many as points. Returns 0 or
 * an exit code after a complaint. */
int edit_script_make(edit_script *s, edit_task task, dataset_kind kind, size_t n, size_t steps,
                     uint64_t seed);
void edit_script_release(edit_script *s);

/* The hash (triangle_hash.h) of the Delaunay triangulation of the points that are there at the end,
 * made from scratch. Returns 0 or an exit code. */
int edit_script_expect(const edit_script *s, uint64_t *hash);

#ifdef __cplusplus
}
#endif

#endif
