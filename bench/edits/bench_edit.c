/* bench edit: what changes of a mesh take, and location in between, beside
 * CGAL, and beside trees that are built anew. */
#include "bench/core/bench.h"
#include "bench/edits/editings.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <stdlib.h>
#include <string.h>

#define DEFAULT_STEPS 50000

typedef struct run {
    const bench_settings *settings;
    editing_plan plan;
    size_list sizes;
    editing_table table;
} run;

/* Cocircular points have several Delaunay triangulations, and results could not
 * be compared. */
static const dataset_kind sets[] = {DATASET_UNIFORM, DATASET_CLUSTERS, DATASET_GAUSSIAN, DATASET_ARCS,
                                    DATASET_RECTANGLE};
#define SETS (sizeof sets / sizeof *sets)

/* Returns SETS if there is none of that name. */
static size_t set_named(const char *name)
{
    size_t i = 0;
    while (i < SETS && strcmp(dataset_name((int)sets[i]), name) != 0) i++;
    return i;
}

static int check_set(const char *name, void *self)
{
    (void)self;
    if (set_named(name) < SETS) return 0;
    spelling s = spelling_of(name);
    for (size_t i = 0; i < SETS; i++) spelling_try(&s, dataset_name((int)sets[i]));
    spelling_complain(&s, "set", "");
    return END_USAGE;
}

static int check_settings(const bench_settings *s)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->format == FORMAT_JSON) {
        complain("bench edit makes its own points, takes times, and prints them "
                 "with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

/* Scripts want one that follows edits; the rest has ours in any case. */
static int check_plan(const editing_plan *plan)
{
    if (plan->tasks >> EDITING_REBUILD) return 0;
    for (editor_id id = 0; id < EDITORS; id++)
        if (plan->editors >> id & 1 && editors[id].edits) return 0;
    complain("none of these engines takes any of these tasks");
    return END_USAGE;
}

static int take_engines(const char *list, uint32_t *set)
{
    int end = engines_choose(list, &editor_choices, set);
    for (editor_id id = 0; id < EDITORS && end == 0; id++)
        if (*set >> id & 1 && !editings_there(id)) {
            engines_missing(UINT32_C(1) << editors[id].engine);
            end = END_USAGE;
        }
    return end;
}

static int take_settings(run *r, const char *names)
{
    const bench_settings *s = r->settings;
    r->sizes = (size_list){{10000, 100000, 1000000}, 3};
    r->plan = (editing_plan){
        .editors = (UINT32_C(1) << EDITORS) - 1,
        .tasks = (UINT32_C(1) << EDITING_TASKS) - 1,
        .rounds = s->rounds ? s->rounds : 5,
        .seed = s->common.seed,
    };
    int end = check_settings(s);
    if (end == 0 && s->sizes) end = bench_sizes(s->sizes, &r->sizes);
    if (end == 0 && s->engines) end = take_engines(s->engines, &r->plan.editors);
    if (end == 0 && s->tasks) end = engines_choose(s->tasks, &editing_choices, &r->plan.tasks);
    if (end == 0) end = bench_each_word(names, check_set, NULL);
    if (end == 0) end = check_plan(&r->plan);
    return end ? end : files_try_output(s->common.output, NULL);
}

/* Peers that are not to be had are named, and passed over. */
static void leave_out_missing(run *r)
{
    if (!r->settings->common.quiet) engines_missing(editings_engines(r->plan.editors));
    for (editor_id id = 0; id < EDITORS; id++)
        if (!editings_there(id)) r->plan.editors &= ~(UINT32_C(1) << id);
}

static int run_task(run *r, editing_task task)
{
    if (task == EDITING_REBUILD) return editings_rebuild(&r->plan, &r->table);
    if (task == EDITING_SESSION) return editings_session(&r->plan, &r->table);
    return editings_hold(&r->plan, task, &r->table);
}

static int run_set(const char *name, void *self)
{
    run *r = self;
    int end = 0;
    r->plan.kind = sets[set_named(name)];
    r->plan.name = dataset_name((int)r->plan.kind);
    for (size_t i = 0; i < r->sizes.count; i++) {
        size_t most = r->sizes.size[i] / 2, steps = r->settings->queries ? r->settings->queries : DEFAULT_STEPS;
        r->plan.vertices = r->sizes.size[i];
        r->plan.steps = steps < most ? steps : most;
        for (editing_task task = 0; task < EDITING_TASKS && end == 0; task++)
            if (r->plan.tasks >> task & 1) end = run_task(r, task);
    }
    return end;
}

int bench_edit(const bench_settings *s, const char *set)
{
    run r = {.settings = s};
    const char *names = set ? set : "uniform,clusters";
    int end = take_settings(&r, names);
    if (end) return end;
    leave_out_missing(&r);
    end = bench_each_word(names, run_set, &r);
    if (end == 0) {
        text t = {0};
        editings_print(&r.table, &r.plan, s->format, &t);
        end = files_write_text(s->common.output, &t);
    }
    free(r.table.rows);
    return end;
}
