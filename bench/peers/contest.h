/* contest.h - engines measured beside each other: in rounds, so that they meet the same machine, and with all their answers
 * compared with the exact one. */
#ifndef CLI_CONTEST_H
#define CLI_CONTEST_H

#include "bench/peers/engines.h"
#include "bench/peers/ground.h"

/* What is measured, and how. */
typedef struct contest_plan {
    uint32_t engines, tasks; /* sets */
    size_t queries, rounds;
    unsigned threads; /* 1, or as many for engines that may use them, too */
} contest_plan;

/* A figure; NaN where there is none. */
typedef struct contest_row {
    engine_task task;
    char *dataset;
    size_t vertices;
    engine_id engine;
    unsigned threads;
    double ns_per_query, build_seconds, bytes, wrong;
} contest_row;

typedef struct contest_table {
    contest_row *rows;
    size_t count;
} contest_table;

/* Measure on a ground whose queries are drawn; add the rows. Returns 0 or an exit code after a complaint. */
int contest_hold(const contest_plan *plan, const ground *on, contest_table *table);
void contest_release(contest_table *table);

/* Print the rows in a format of bench.h. */
void contest_print(const contest_table *table, const contest_plan *plan, int format, text *t);

/* What a figure says nothing without: processor, compiler, versions of the libraries of these engines, date. */
void contest_machine(uint32_t engines, text *t);

/* Draw the rows of a table that is not empty. Returns 0 or an exit code after a complaint. */
int contest_plot(const contest_table *table, const char *path);

#endif
