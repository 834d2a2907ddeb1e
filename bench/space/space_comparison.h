/* space_comparison.h - all engines on one model: their times and their answers, as rows. */
#ifndef MW_BENCH_SPACE_SPACE_COMPARISON_H
#define MW_BENCH_SPACE_SPACE_COMPARISON_H

#include "bench/core/settings.h"
#include "bench/space/space_engine.h"
#include "cli/frame/text.h"

typedef enum space_task {
    SPACE_TASK_BUILD,
    SPACE_TASK_RAYS,                                       /* and the kinds of rays */
    SPACE_TASK_MOVES = SPACE_TASK_RAYS + SPACE_RAYS_KINDS, /* and the kinds of moves */
    SPACE_TASKS = SPACE_TASK_MOVES + SPACE_MOVES
} space_task;

/* "build", then the names of rays and moves; NULL for another number. */
const char *space_task_name(int task);
/* The name of an engine by its number; NULL for another one. */
const char *space_engine_name(int engine);

typedef struct space_plan {
    const bench_settings *settings;
    uint32_t engines, tasks; /* sets of their numbers */
    size_t rays, rounds;
} space_plan;

/* The first line of the table. */
void space_header(text *table, bool tsv);

/* Add the rows of a model. Returns 0 or an exit code; wrong answers of ours end with one. */
int space_compare(const space_plan *plan, space_model *m, text *table);

#endif
