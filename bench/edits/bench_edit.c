/* bench edit: what changes of a mesh take, and location in between, beside
 * CGAL, and beside trees that are built anew. */
#include "bench/edits/bench_edit.h"
#include "bench/core/word_list.h"
#include "bench/edits/edit_comparison.h"
#include "bench/edits/edit_engine_list.h"
#include "bench/edits/edit_rebuild.h"
#include "bench/edits/edit_aging.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <string.h>

#define DEFAULT_STEPS 50000

typedef struct edit_run {
    const bench_settings *settings;
    edit_plan plan;
    size_list sizes;
    edit_table table;
} edit_run;

/* Cocircular points have several Delaunay triangulations, and results could not
 * be compared. */
static const dataset_kind sets[] = {DATASET_UNIFORM, DATASET_CLUSTERS, DATASET_GAUSSIAN,
                                    DATASET_ARCS, DATASET_RECTANGLE};
#define SETS (sizeof sets / sizeof *sets)

/* Returns SETS if there is none of that name. */
static size_t edit_set_named(const char *name)
{
    size_t i = 0;
    while (i < SETS && strcmp(dataset_name((int)sets[i]), name) != 0) i++;
    return i;
}

static int edit_check_set(const char *name, void *self)
{
    (void)self;
    if (edit_set_named(name) < SETS) return 0;
    spelling s = spelling_of(name);
    for (size_t i = 0; i < SETS; i++) spelling_try(&s, dataset_name((int)sets[i]));
    spelling_complain(&s, "set", "");
    return END_USAGE;
}

static int edits_check_settings(const bench_settings *s)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot ||
        s->format == FORMAT_JSON) {
        complain("bench edit makes its own points, takes times, and prints them "
                 "with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

/* Scripts want one that follows edits; the rest has ours in any case. */
static int edit_check_plan(const edit_plan *plan)
{
    if (plan->tasks >> EDIT_TASK_REBUILD) return 0;
    for (edit_engine_id id = 0; id < EDIT_ENGINES; id++)
        if (edit_engine_is_in(plan->engines, id) && edit_engines[id].follows) return 0;
    complain("none of these engines takes any of these tasks");
    return END_USAGE;
}

static int edit_take_engines(const char *list, uint32_t *set)
{
    int end = word_list_names(list, &edit_engine_choices, set);
    for (edit_engine_id id = 0; id < EDIT_ENGINES && end == 0; id++)
        if (edit_engine_is_in(*set, id) && !edit_engine_is_there(id)) {
            engine_list_complain_missing(UINT32_C(1) << edit_engines[id].engine);
            end = END_USAGE;
        }
    return end;
}

static int edit_take_settings(edit_run *r, const char *names)
{
    const bench_settings *s = r->settings;
    r->sizes = (size_list){{10000, 100000, 1000000}, 3};
    r->plan = (edit_plan){
        .engines = (UINT32_C(1) << EDIT_ENGINES) - 1,
        .tasks = (UINT32_C(1) << EDIT_TASKS) - 1,
        .rounds = s->rounds ? s->rounds : 5,
        .seed = s->common.seed,
    };
    int end = edits_check_settings(s);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &r->sizes);
    if (end == 0 && s->engines) end = edit_take_engines(s->engines, &r->plan.engines);
    if (end == 0 && s->tasks) end = word_list_names(s->tasks, &edit_task_choices, &r->plan.tasks);
    if (end == 0) end = word_list_each(names, edit_check_set, NULL);
    if (end == 0) end = edit_check_plan(&r->plan);
    return end ? end : files_try_output(s->common.output, NULL);
}

/* Peers that are not to be had are named, and passed over. */
static void edit_leave_out_missing(edit_run *r)
{
    if (!r->settings->common.quiet)
        engine_list_complain_missing(edit_engine_libraries(r->plan.engines));
    for (edit_engine_id id = 0; id < EDIT_ENGINES; id++)
        if (!edit_engine_is_there(id)) r->plan.engines &= ~(UINT32_C(1) << id);
}

static int edit_run_task(edit_run *r, edit_task task)
{
    if (task == EDIT_TASK_REBUILD) return edit_rebuild_measure(&r->plan, &r->table);
    if (task == EDIT_TASK_AGING) return edit_aging_measure(&r->plan, &r->table);
    return edit_comparison_measure(&r->plan, task, &r->table);
}

static int edit_run_set(const char *name, void *self)
{
    edit_run *r = self;
    int end = 0;
    r->plan.kind = sets[edit_set_named(name)];
    r->plan.name = dataset_name((int)r->plan.kind);
    for (size_t i = 0; i < r->sizes.count; i++) {
        size_t most = r->sizes.size[i] / 2,
               steps = r->settings->queries ? r->settings->queries : DEFAULT_STEPS;
        r->plan.vertices = r->sizes.size[i];
        r->plan.steps = steps < most ? steps : most;
        for (edit_task task = 0; task < EDIT_TASKS && end == 0; task++)
            if (r->plan.tasks >> task & 1) end = edit_run_task(r, task);
    }
    return end;
}

int bench_edit(const bench_settings *s, const char *set)
{
    edit_run r = {.settings = s};
    const char *names = set ? set : "uniform,clusters";
    int end = edit_take_settings(&r, names);
    if (end) return end;
    edit_leave_out_missing(&r);
    end = word_list_each(names, edit_run_set, &r);
    if (end == 0) {
        text t = {0};
        edit_table_print(&r.table, &r.plan, s->format, &t);
        end = files_write_text(s->common.output, &t);
    }
    edit_table_release(&r.table);
    return end;
}
