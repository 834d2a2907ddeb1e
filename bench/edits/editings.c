#include "bench/edits/editings.h"
#include "bench/core/bench.h"
#include "bench/peers/contest.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "bench/core/rounds.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const contender editors[EDITORS] = {
#define EDITOR(id, name, engine, edits, help) {name, help, ENGINE_##engine, edits},
#include "bench/edits/editing.def"
};

const char *editings_task(editing_task task)
{
    static const char *const names[EDITING_TASKS] = {
        [EDITING_INSERT] = "insert",           [EDITING_INSERT_SORTED] = "insert-sorted",
        [EDITING_INSERT_MANY] = "insert-many", [EDITING_INSERT_MANY_SORTED] = "insert-many-sorted",
        [EDITING_REMOVE] = "remove",           [EDITING_MOVE_NEAR] = "move-near",
        [EDITING_MOVE_FAR] = "move-far",       [EDITING_MIXED] = "mixed",
        [EDITING_REBUILD] = "rebuild",         [EDITING_SESSION] = "session",
    };
    return names[task];
}

static const char *editor_name(int i)
{
    return i < EDITORS ? editors[i].name : NULL;
}
static const char *task_name(int i)
{
    return i < EDITING_TASKS ? editings_task((editing_task)i) : NULL;
}
const choices editor_choices = {"engine", editor_name, NULL};
const choices editing_choices = {"task", task_name, NULL};

#ifndef MW_PEERS
const editing_code *peers_editor(editor_id id)
{
    (void)id;
    return NULL;
}
#endif

const editing_code *editings_code(editor_id id)
{
    if (!editors[id].edits) return NULL;
    const editing_code *own = editing_own(id);
    return own ? own : peers_editor(id);
}

bool editings_there(editor_id id)
{
    return editors[id].edits ? editings_code(id) != NULL : engines_code(editors[id].engine) != NULL;
}

uint32_t editings_engines(uint32_t set)
{
    uint32_t found = 0;
    for (editor_id id = 0; id < EDITORS; id++)
        if (set >> id & 1) found |= UINT32_C(1) << editors[id].engine;
    return found;
}

/* --- scripts in rounds
 * -------------------------------------------------------------------------------------------
 */

typedef struct runner {
    editor_id id;
    const editing_code *code;
    double *times;
} runner;

typedef struct trials {
    const editing_plan *plan;
    editing_task task;
    script script;
    uint64_t expected; /* of the triangulation */
    uint64_t answers;  /* of the triangles that were found, 0: not known yet */
    double *corners;
    runner runners[EDITORS];
    size_t count;
} trials;

/* Were places located in triangles that hold them? Sets *sum, which is that of
 * all the same triangles. */
static bool judge_places(const trials *t, uint64_t *sum)
{
    const double *c = t->corners;
    *sum = 1;
    for (size_t i = 0; i < t->script.count; i++) {
        const script_step *step = &t->script.steps[i];
        if (step->kind != SCRIPT_LOCATE) continue;
        bool outside = c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0;
        if (!outside && !engine_contains(c, c + 2, c + 4, step->point)) return false;
        *sum = *sum * 31 + editing_sum(c);
        c += 6;
    }
    return true;
}

static int judge(trials *t, const runner *r, const void *self)
{
    uint64_t answers;
    bool right = r->code->sum(self) == t->expected && judge_places(t, &answers);
    if (right && t->answers == 0) t->answers = answers;
    if (right && answers == t->answers) return 0;
    complain("%s: %s is wrong after '%s'", t->plan->name, editors[r->id].name, editings_task(t->task));
    return END_RESOURCE;
}

static int run_once(trials *t, runner *r, double *time)
{
    void *self = r->code->build(&t->script);
    if (!self) return fail_memory();
    memset(t->corners, 0, (6 * t->script.located + 1) * sizeof *t->corners);
    double seconds = r->code->run(self, &t->script, t->corners);
    int end = seconds < 0 ? END_RESOURCE : judge(t, r, self);
    if (seconds < 0) complain("%s: %s has failed", t->plan->name, editors[r->id].name);
    r->code->destroy(self);
    *time = 1e9 * seconds / (double)t->script.count;
    return end;
}

static int hold_rounds(trials *t)
{
    int end = 0;
    progress_phase(editings_task(t->task), t->plan->name);
    for (size_t round = 0; round < t->plan->rounds; round++)
        for (size_t k = 0; k < t->count && end == 0; k++) {
            runner *r = &t->runners[(k + round) % t->count];
            end = run_once(t, r, &r->times[round]);
        }
    return end;
}

/* Ratios are to the fastest of CGAL's. */
static int take_rows(const trials *t, editing_table *table)
{
    double medians[EDITORS], peer = NAN;
    int end = 0;
    for (size_t k = 0; k < t->count; k++) {
        medians[k] = rounds_median(t->runners[k].times, t->plan->rounds);
        if (editors[t->runners[k].id].engine != ENGINE_OWN) peer = fmin(peer, medians[k]);
    }
    for (size_t k = 0; k < t->count && end == 0; k++) {
        editing_row row = editings_row(t->plan, t->task, editors[t->runners[k].id].name);
        row.edits = (double)t->script.count;
        row.ns = medians[k];
        row.ratio = medians[k] / peer;
        end = editings_add(table, &row);
    }
    return end;
}

int editings_hold(const editing_plan *p, editing_task task, editing_table *table)
{
    trials t = {.plan = p, .task = task};
    double *times = malloc(EDITORS * p->rounds * sizeof *times);
    int end = times ? script_make(&t.script, task, p->kind, p->vertices, p->steps, p->seed) : fail_memory();
    for (editor_id id = 0; id < EDITORS && times; id++)
        if (p->editors >> id & 1 && editors[id].edits) {
            t.runners[t.count] = (runner){id, editings_code(id), times + t.count * p->rounds};
            t.count++;
        }
    if (end == 0) end = script_expect(&t.script, &t.expected);
    t.corners = end == 0 ? malloc((6 * t.script.located + 1) * sizeof *t.corners) : NULL;
    if (end == 0 && !t.corners) end = fail_memory();
    if (end == 0) end = hold_rounds(&t);
    if (end == 0) end = take_rows(&t, table);
    script_release(&t.script);
    free(t.corners);
    free(times);
    return end;
}

/* --- rows
 * --------------------------------------------------------------------------------------------------------
 */

editing_row editings_row(const editing_plan *p, editing_task task, const char *name)
{
    return (editing_row){task, p->name, name, p->vertices, NAN, NAN, NAN, NAN, NAN, NAN};
}

int editings_add(editing_table *table, const editing_row *row)
{
    editing_row *rows = realloc(table->rows, (table->count + 1) * sizeof *rows);
    if (!rows) return fail_memory();
    table->rows = rows;
    rows[table->count++] = *row;
    return 0;
}

#define COLUMNS 10
static const char *const names[COLUMNS] = {"task", "dataset",   "vertices", "edits", "engine",
                                           "ns",   "triangles", "bytes",    "wrong", "ratio"};
#define WIDEST 64

static void number(char *cell, int decimals, double value)
{
    *cell = 0;
    if (!isnan(value)) snprintf(cell, WIDEST, "%.*f", decimals, value);
}

static void cells_of(const editing_row *r, char cells[COLUMNS][WIDEST])
{
    snprintf(cells[0], WIDEST, "%s", editings_task(r->task));
    snprintf(cells[1], WIDEST, "%s", r->dataset);
    snprintf(cells[2], WIDEST, "%zu", r->vertices);
    number(cells[3], 0, r->edits);
    snprintf(cells[4], WIDEST, "%s", r->name);
    number(cells[5], r->ns < 1000 ? 1 : 0, r->ns);
    number(cells[6], 2, r->triangles);
    number(cells[7], 0, r->bytes);
    number(cells[8], 0, r->wrong);
    number(cells[9], 3, r->ratio);
}

static bool is_text(size_t column)
{
    return column < 2 || column == 4;
}

static bool is_new_block(const editing_row *rows, size_t i)
{
    const editing_row *a = &rows[i], *b = &rows[i - 1];
    return a->task != b->task || a->vertices != b->vertices || a->dataset != b->dataset || a->edits != b->edits;
}

/* Aligned, or with tabs. */
static void print_cells(const char *const cells[COLUMNS], const int width[COLUMNS], text *t)
{
    for (size_t k = 0; k < COLUMNS; k++) {
        if (!width)
            text_printf(t, "%s%s", k ? "\t" : "", cells[k]);
        else
            text_printf(t, is_text(k) ? "%s%-*s" : "%s%*s", k ? "  " : "", width[k], cells[k]);
    }
    text_string(t, "\n");
}

static void print_rows(const editing_table *table, const int *width, text *t)
{
    char cells[COLUMNS][WIDEST];
    const char *row[COLUMNS];
    print_cells(names, width, t);
    for (size_t k = 0; k < COLUMNS; k++) row[k] = cells[k];
    for (size_t i = 0; i < table->count; i++) {
        if (width && i > 0 && is_new_block(table->rows, i)) text_string(t, "\n");
        cells_of(&table->rows[i], cells);
        print_cells(row, width, t);
    }
}

static void find_widths(const editing_table *table, int width[COLUMNS])
{
    char cells[COLUMNS][WIDEST];
    for (size_t k = 0; k < COLUMNS; k++) width[k] = (int)strlen(names[k]);
    for (size_t i = 0; i < table->count; i++) {
        cells_of(&table->rows[i], cells);
        for (size_t k = 0; k < COLUMNS; k++)
            if ((int)strlen(cells[k]) > width[k]) width[k] = (int)strlen(cells[k]);
    }
}

void editings_print(const editing_table *table, const editing_plan *plan, int format, text *t)
{
    int width[COLUMNS];
    if (format == FORMAT_TSV) text_string(t, "# ");
    contest_machine(editings_engines(plan->editors), t);
    text_printf(t, "; %zu steps, %zu rounds\n", plan->steps, plan->rounds);
    find_widths(table, width);
    print_rows(table, format == FORMAT_TSV ? NULL : width, t);
}
