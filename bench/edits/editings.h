/* editings.h - who takes part in 'bench edit', and what was measured of them.
 */
#ifndef CLI_EDITINGS_H
#define CLI_EDITINGS_H

#include "bench/peers/engines.h"
#include "bench/edits/script.h"

typedef struct contender {
    const char *name, *help;
    engine_id engine; /* the engine whose library it is                */
    bool edits;       /* it follows edits; else it is built anew         */
} contender;

extern const contender editors[EDITORS];

/* "insert", ... */
const char *editings_task(editing_task task);
extern const choices editor_choices, editing_choices;

/* How to run one that follows edits; NULL: this program does not have it, or it
 * does not. */
const editing_code *editings_code(editor_id id);
/* Ours; NULL for a peer. */
const editing_code *editing_own(editor_id id);
/* Is it to be had, of either kind? */
bool editings_there(editor_id id);
/* The engines that belong to a set of editors. */
uint32_t editings_engines(uint32_t editors);

/* What is measured, and how. */
typedef struct editing_plan {
    const char *name;
    dataset_kind kind;
    size_t vertices, steps, rounds;
    uint32_t editors, tasks; /* sets */
    uint64_t seed;
} editing_plan;

/* A figure; NaN where there is none. */
typedef struct editing_row {
    editing_task task;
    const char *dataset, *name; /* name: of an editor, or of a start */
    size_t vertices;
    double edits, ns, triangles, bytes, wrong;
    double ratio; /* ns over that of the one that it is compared with */
} editing_row;

typedef struct editing_table {
    editing_row *rows;
    size_t count;
} editing_table;

editing_row editings_row(const editing_plan *p, editing_task task, const char *name);
/* Returns 0 or an exit code after a complaint. */
int editings_add(editing_table *table, const editing_row *row);
void editings_print(const editing_table *table, const editing_plan *plan, int format, text *t);

/* A script, by all that follow edits, in rounds; trees built anew after more
 * and more edits; location in a mesh that is edited for long. Each adds rows,
 * and returns 0 or an exit code after a complaint. */
int editings_hold(const editing_plan *p, editing_task task, editing_table *table);
int editings_rebuild(const editing_plan *p, editing_table *table);
int editings_session(const editing_plan *p, editing_table *table);

#endif
