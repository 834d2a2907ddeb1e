#include "bench/edits/edit_comparison.h"
#include "bench/core/rounds.h"
#include "bench/edits/edit_engine_list.h"
#include "bench/edits/triangle_hash.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct edit_comparison {
    const edit_plan *plan;
    edit_task task;
    edit_script script;
    uint64_t expected; /* of the triangulation */
    uint64_t answers;  /* of the triangles that were found, 0: not known yet */
    double *corners;
    edit_engine_id engines[EDIT_ENGINES];
    size_t count;
} edit_comparison;

/* Were points located in triangles that hold them? Sets *hash, which is that of all the same
 * triangles. */
static bool answers_are_right(const edit_comparison *c, uint64_t *hash)
{
    const double *corners = c->corners;
    *hash = 1;
    for (size_t i = 0; i < c->script.count; i++) {
        const edit_step *step = &c->script.steps[i];
        if (step->kind != EDIT_STEP_LOCATE) continue;
        bool outside = corners[0] == 0 && corners[1] == 0 && corners[2] == 0 && corners[3] == 0;
        if (!outside && !engine_contains(corners, corners + 2, corners + 4, step->point))
            return false;
        *hash = *hash * 31 + triangle_hash(corners);
        corners += 6;
    }
    return true;
}

static int edit_comparison_check(edit_comparison *c, edit_engine_id id, const void *self)
{
    uint64_t answers;
    bool right =
        edit_engine_code_of(id)->hash(self) == c->expected && answers_are_right(c, &answers);
    if (right && c->answers == 0) c->answers = answers;
    if (right && answers == c->answers) return 0;
    complain("%s: %s is wrong after '%s'", c->plan->name, edit_engines[id].name,
             edit_task_name(c->task));
    return END_RESOURCE;
}

/* A run of a round. Memory for the answers is touched before the clock runs. */
static int edit_comparison_run(void *self, size_t entry, size_t round, double *nanoseconds)
{
    (void)round;
    edit_comparison *c = self;
    edit_engine_id id = c->engines[entry];
    const edit_engine_code *code = edit_engine_code_of(id);
    void *editing = code->build(&c->script);
    if (!editing) return fail_memory();
    memset(c->corners, 0, (6 * c->script.located + 1) * sizeof *c->corners);
    double seconds = code->run(editing, &c->script, c->corners);
    int end = seconds < 0 ? END_RESOURCE : edit_comparison_check(c, id, editing);
    if (seconds < 0) complain("%s: %s has failed", c->plan->name, edit_engines[id].name);
    code->destroy(editing);
    *nanoseconds = 1e9 * seconds / (double)c->script.count;
    return end;
}

/* Ratios are to the fastest of CGAL's. */
static int edit_comparison_add_rows(const edit_comparison *c, const rounds_results *results,
                                    edit_table *table)
{
    double peer = NAN;
    int end = 0;
    for (size_t k = 0; k < c->count; k++)
        if (edit_engines[c->engines[k]].engine != ENGINE_MESHWALK)
            peer = fmin(peer, rounds_median(results, k, 0));
    for (size_t k = 0; k < c->count && end == 0; k++) {
        edit_row row = edit_row_of(c->plan, c->task, edit_engines[c->engines[k]].name);
        row.edits = (double)c->script.count;
        row.ns = rounds_median(results, k, 0);
        row.ratio = row.ns / peer;
        end = edit_table_add(table, &row);
    }
    return end;
}

static int edit_comparison_hold_rounds(edit_comparison *c, edit_table *table)
{
    rounds_results results;
    rounds_plan plan = {.entries = c->count, .figures = 1, .rounds = c->plan->rounds};
    progress_phase(edit_task_name(c->task), c->plan->name);
    int end = rounds_measure(&plan, edit_comparison_run, c, &results);
    if (end == 0) end = edit_comparison_add_rows(c, &results, table);
    rounds_release(&results);
    return end;
}

int edit_comparison_measure(const edit_plan *p, edit_task task, edit_table *table)
{
    edit_comparison c = {.plan = p, .task = task};
    int end = edit_script_make(&c.script, task, p->kind, p->vertices, p->steps, p->seed);
    for (edit_engine_id id = 0; id < EDIT_ENGINES; id++)
        if (edit_engine_is_in(p->engines, id) && edit_engines[id].follows)
            c.engines[c.count++] = id;
    if (end == 0) end = edit_script_expect(&c.script, &c.expected);
    c.corners = end == 0 ? malloc((6 * c.script.located + 1) * sizeof *c.corners) : NULL;
    if (end == 0 && !c.corners) end = fail_memory();
    if (end == 0) end = edit_comparison_hold_rounds(&c, table);
    edit_script_release(&c.script);
    free(c.corners);
    return end;
}
