/* edit_table.h - what 'bench edit' is to measure, and the rows that come of it. */
#ifndef MW_BENCH_EDITS_EDIT_TABLE_H
#define MW_BENCH_EDITS_EDIT_TABLE_H

#include "bench/edits/edit_script.h"
#include "cli/frame/text.h"

/* What is measured, and how. */
typedef struct edit_plan {
    const char *name; /* of the set of points */
    dataset_kind kind;
    size_t vertices, steps, rounds;
    uint32_t engines, tasks; /* sets: bits of edit_engine_id, and of edit_task */
    uint64_t seed;
} edit_plan;

/* A figure; NaN where there is none. */
typedef struct edit_row {
    edit_task task;
    const char *dataset, *name; /* name: of an engine, or of a start */
    size_t vertices;
    double edits, ns, triangles, bytes, wrong;
    double ratio; /* ns over that of the one that it is compared with */
} edit_row;

typedef struct edit_table {
    edit_row *rows;
    size_t count;
} edit_table;

/* A row without figures. */
edit_row edit_row_of(const edit_plan *p, edit_task task, const char *name);
/* Returns 0 or an exit code after a complaint. */
int edit_table_add(edit_table *table, const edit_row *row);
/* `format`: one of settings.h, JSON excepted. */
void edit_table_print(const edit_table *table, const edit_plan *plan, int format, text *t);
void edit_table_release(edit_table *table);

#endif
