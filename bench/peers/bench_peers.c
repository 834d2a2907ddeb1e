/* bench peers, bench scale: our engines beside those of others, on made sets of points and on
 * files. */
#include "bench/peers/bench_peers.h"
#include "bench/core/word_list.h"
#include "bench/data/dataset_file.h"
#include "bench/peers/comparison.h"
#include "bench/peers/comparison_plot.h"
#include "bench/peers/comparison_print.h"
#include "cli/draw/plot.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <string.h>

/* What is measured where nothing is said. */
typedef struct peers_defaults {
    const char *name, *sets;
    size_list sizes;
    uint32_t engines, tasks;
} peers_defaults;

static const peers_defaults beside_peers = {
    .name = "peers",
    .sets = "uniform,clusters,gaussian,rectangle,slivers",
    .sizes = {{10000, 100000, 1000000}, 3},
    .engines = (1u << ENGINES) - 1,
    .tasks = ENGINE_IN(RANDOM) | ENGINE_IN(SORTED) | ENGINE_IN(COHERENT) | ENGINE_IN(HALF_OUTSIDE) |
             ENGINE_IN(TOTAL),
};
static const peers_defaults over_sizes = {
    .name = "scale",
    .sets = "uniform,clusters",
    .sizes = {{10000, 100000, 1000000, 10000000}, 4},
    .engines = 1u << ENGINE_MESHWALK,
    .tasks = ENGINE_IN(RANDOM) | ENGINE_IN(DELAUNAY) | ENGINE_IN(CONNECTIVITY),
};

typedef struct peers_run {
    const bench_settings *settings;
    comparison_plan plan;
    size_list sizes;
    comparison_table table;
} peers_run;

/* --- workloads -------------------------------------------------------------------------------- */

static int peers_run_workload(peers_run *r, workload *w)
{
    int end = workload_draw_queries(w, r->plan.tasks, r->plan.queries);
    return end ? end : comparison_measure(&r->plan, w, &r->table);
}

static int peers_run_points(peers_run *r, const char *name, dataset *data)
{
    workload w;
    int end = workload_from_points(&w, name, data, &r->settings->common);
    if (end == 0) end = peers_run_workload(r, &w);
    workload_release(&w);
    return end;
}

static int peers_run_set(const char *name, void *self)
{
    peers_run *r = self;
    int kind = dataset_named(name), end = 0;
    for (size_t i = 0; i < r->sizes.count && end == 0; i++) {
        dataset data;
        if (!dataset_make(&data, (dataset_kind)kind, r->sizes.size[i], false,
                          r->settings->common.seed))
            return fail_memory();
        end = peers_run_points(r, dataset_name(kind), &data);
        dataset_release(&data);
    }
    return end;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

static int peers_run_mesh(peers_run *r, const char *name, const mw_mesh_file *file)
{
    workload w;
    int end = workload_from_mesh(&w, name, file, &r->settings->common);
    if (end == 0) end = peers_run_workload(r, &w);
    workload_release(&w);
    return end;
}

static int peers_run_file(const char *path, void *self)
{
    peers_run *r = self;
    dataset data;
    mw_mesh_file mesh;
    int end = dataset_read_mesh(&data, &mesh, path);
    if (end) return end;
    end = mesh.triangle_count ? peers_run_mesh(r, base_name(path), &mesh)
                              : peers_run_points(r, base_name(path), &data);
    mw_mesh_file_release(&mesh);
    dataset_release(&data);
    return end;
}

/* --- the command ------------------------------------------------------------------------------ */

static int peers_check_set(const char *name, void *self)
{
    (void)self;
    if (dataset_named(name) < DATASET_KINDS) return 0;
    spelling s = spelling_of(name);
    for (int kind = 0; kind < DATASET_KINDS; kind++) spelling_try(&s, dataset_name(kind));
    spelling_complain(&s, "set", "");
    return END_USAGE;
}

static int peers_check_file(const char *path, void *self)
{
    const peers_run *r = self;
    if (*path) return files_check_output(r->settings->common.output, &path, 1);
    complain("option '--data' must be files separated by commas, not '%s'", r->settings->data);
    return END_USAGE;
}

static int peers_check_settings(const bench_settings *s, const peers_defaults *d)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times) {
        complain("bench %s takes times of sets as they are: leave out --enclose and --no-times",
                 d->name);
        return END_USAGE;
    }
    if (s->plot && d == &beside_peers) {
        complain("bench peers draws nothing: --plot is for 'meshwalk bench scale'");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

/* A plot is over sizes. */
static int peers_check_plot(const peers_run *r)
{
    const bench_settings *s = r->settings;
    if (!s->plot) return 0;
    if (s->data || r->sizes.count < 2) {
        complain("bench scale: a plot needs made sets of at least two sizes");
        return END_USAGE;
    }
    if (files_same_output(s->common.output, s->plot)) {
        complain("%s: the figures and the plot must go to different files", s->plot);
        return END_USAGE;
    }
    int end = plot_check(s->plot);
    return end ? end : files_try_output(s->plot, NULL);
}

static int peers_check_plan(const comparison_plan *plan)
{
    for (engine_id id = 0; id < ENGINES; id++)
        if (engine_is_in(plan->engines, id) && engines[id].tasks & plan->tasks) return 0;
    complain("none of these engines takes any of these tasks");
    return END_USAGE;
}

static int peers_take_settings(peers_run *r, const peers_defaults *d, const char *sets)
{
    const bench_settings *s = r->settings;
    r->sizes = d->sizes;
    r->plan = (comparison_plan){
        .engines = d->engines,
        .tasks = d->tasks,
        .queries = s->queries ? s->queries : 1000000,
        .rounds = s->rounds ? s->rounds : 5,
        .threads = s->common.threads ? s->common.threads : 1,
    };
    int end = peers_check_settings(s, d);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &r->sizes);
    if (end == 0 && s->engines) end = engine_list_named(s->engines, &r->plan.engines);
    if (end == 0 && s->tasks) end = word_list_names(s->tasks, &engine_task_choices, &r->plan.tasks);
    if (end == 0)
        end = s->data ? word_list_each(s->data, peers_check_file, r)
                      : word_list_each(sets, peers_check_set, NULL);
    if (end == 0) end = peers_check_plan(&r->plan);
    if (end == 0) end = peers_check_plot(r);
    return end ? end : files_try_output(s->common.output, NULL);
}

/* Peers that are not to be had are named, and passed over. */
static void peers_leave_out_missing(peers_run *r)
{
    if (!r->settings->common.quiet) engine_list_complain_missing(r->plan.engines);
    for (engine_id id = 0; id < ENGINES; id++)
        if (!engine_code_of(id)) r->plan.engines &= ~(UINT32_C(1) << id);
}

static int peers_run_all(const bench_settings *s, const char *set, const peers_defaults *d)
{
    peers_run r = {.settings = s};
    const char *sets = set ? set : d->sets;
    int end = peers_take_settings(&r, d, sets);
    if (end) return end;
    peers_leave_out_missing(&r);
    end = s->data ? word_list_each(s->data, peers_run_file, &r)
                  : word_list_each(sets, peers_run_set, &r);
    if (end == 0 && s->plot) end = comparison_plot(&r.table, s->plot);
    if (end == 0) {
        text t = {0};
        comparison_print(&r.table, &r.plan, s->format, &t);
        end = files_write_text(s->common.output, &t);
    }
    comparison_table_release(&r.table);
    return end;
}

int bench_peers(const bench_settings *s, const char *set)
{
    return peers_run_all(s, set, &beside_peers);
}

int bench_scale(const bench_settings *s, const char *set)
{
    return peers_run_all(s, set, &over_sizes);
}
