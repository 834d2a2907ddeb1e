/* comparison.h - engines measured beside each other, in rounds, all their answers compared with the
 * exact one. */
#ifndef MW_BENCH_PEERS_COMPARISON_H
#define MW_BENCH_PEERS_COMPARISON_H

#include "bench/peers/engine_list.h"
#include "bench/peers/workload.h"

/* What is measured, and how. */
typedef struct comparison_plan {
    uint32_t engines, tasks; /* sets */
    size_t queries, rounds;
    unsigned threads; /* 1, or as many for engines that may use them, too */
} comparison_plan;

/* A figure; NaN where there is none. */
typedef struct comparison_row {
    engine_task task;
    char *dataset;
    size_t vertices;
    engine_id engine;
    unsigned threads;
    double ns_per_query, build_seconds, bytes, wrong;
} comparison_row;

typedef struct comparison_table {
    comparison_row *rows;
    size_t count;
} comparison_table;

/* Measure on a workload whose queries are drawn; add the rows. Returns 0 or an exit code after a
 * complaint. */
int comparison_measure(const comparison_plan *plan, const workload *on, comparison_table *table);
void comparison_table_release(comparison_table *table);

#endif
