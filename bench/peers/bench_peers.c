/* bench peers, bench scale: our engines beside those of others, on made sets of points and on files. */
#include "bench/core/bench.h"
#include "bench/peers/contest.h"
#include "bench/data/dataset_file.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/draw/plot.h"
#include "cli/frame/spelling.h"

#include <stdlib.h>
#include <string.h>

/* What is measured where nothing is said. */
typedef struct defaults {
    const char *name, *sets;
    size_list sizes;
    uint32_t engines, tasks;
} defaults;

static const defaults beside_peers = {
    .name = "peers",
    .sets = "uniform,clusters,gaussian,rectangle,slivers",
    .sizes = {{10000, 100000, 1000000}, 3},
    .engines = (1u << ENGINES) - 1,
    .tasks = ENGINE_IN(RANDOM) | ENGINE_IN(SORTED) | ENGINE_IN(COHERENT) | ENGINE_IN(HALF_OUTSIDE) | ENGINE_IN(TOTAL),
};
static const defaults over_sizes = {
    .name = "scale",
    .sets = "uniform,clusters",
    .sizes = {{10000, 100000, 1000000, 10000000}, 4},
    .engines = 1u << ENGINE_OWN,
    .tasks = ENGINE_IN(RANDOM) | ENGINE_IN(DELAUNAY) | ENGINE_IN(CONNECTIVITY),
};

typedef struct run {
    const bench_settings *settings;
    contest_plan plan;
    size_list sizes;
    contest_table table;
} run;

/* --- grounds ----------------------------------------------------------------------------------------------------- */

static int run_ground(run *r, ground *g)
{
    int end = ground_draw(g, r->plan.tasks, r->plan.queries);
    return end ? end : contest_hold(&r->plan, g, &r->table);
}

static int run_points(run *r, const char *name, dataset *data)
{
    ground g;
    int end = ground_of_points(&g, name, data, r->settings->common.seed);
    if (end == 0) end = run_ground(r, &g);
    ground_release(&g);
    return end;
}

static int kind_named(const char *name)
{
    int kind = 0;
    while (kind < DATASET_KINDS && strcmp(dataset_name(kind), name) != 0) kind++;
    return kind;
}

static int run_set(const char *name, void *self)
{
    run *r = self;
    int kind = kind_named(name), end = 0;
    for (size_t i = 0; i < r->sizes.count && end == 0; i++) {
        dataset data;
        if (!dataset_make(&data, (dataset_kind)kind, r->sizes.size[i], false, r->settings->common.seed))
            return fail_memory();
        end = run_points(r, dataset_name(kind), &data);
        dataset_release(&data);
    }
    return end;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

static int run_mesh(run *r, const char *name, const mw_mesh_file *file)
{
    ground g;
    int end = ground_of_mesh(&g, name, file, r->settings->common.seed);
    if (end == 0) end = run_ground(r, &g);
    ground_release(&g);
    return end;
}

static int run_file(const char *path, void *self)
{
    run *r = self;
    dataset data;
    mw_mesh_file mesh;
    int end = dataset_read_mesh(&data, &mesh, path);
    if (end) return end;
    end = mesh.triangle_count ? run_mesh(r, base_name(path), &mesh) : run_points(r, base_name(path), &data);
    mw_mesh_file_release(&mesh);
    dataset_release(&data);
    return end;
}

/* --- the command ------------------------------------------------------------------------------------------------- */

static int check_set(const char *name, void *self)
{
    (void)self;
    if (kind_named(name) < DATASET_KINDS) return 0;
    spelling s = spelling_of(name);
    for (int kind = 0; kind < DATASET_KINDS; kind++) spelling_try(&s, dataset_name(kind));
    spelling_complain(&s, "set", "");
    return END_USAGE;
}

static int check_file(const char *path, void *self)
{
    const run *r = self;
    if (*path) return files_check_output(r->settings->common.output, &path, 1);
    complain("option '--data' wants files separated by commas, not '%s'", r->settings->data);
    return END_USAGE;
}

static int check_settings(const bench_settings *s, const defaults *d)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times) {
        complain("bench %s takes times of sets as they are: leave out --enclose and --no-times", d->name);
        return END_USAGE;
    }
    if (s->plot && d == &beside_peers) {
        complain("bench peers draws nothing: --plot is for 'meshwalk bench scale'");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

/* A plot is over sizes. */
static int check_plot(const run *r)
{
    const bench_settings *s = r->settings;
    if (!s->plot) return 0;
    if (s->data || r->sizes.count < 2) {
        complain("bench scale: a plot wants made sets of two sizes or more");
        return END_USAGE;
    }
    if (files_same_output(s->common.output, s->plot)) {
        complain("%s: the figures and the plot want files of their own", s->plot);
        return END_USAGE;
    }
    int end = plot_check(s->plot);
    return end ? end : files_try_output(s->plot, NULL);
}

static int check_plan(const contest_plan *plan)
{
    for (engine_id id = 0; id < ENGINES; id++)
        if (plan->engines >> id & 1 && engines[id].tasks & plan->tasks) return 0;
    complain("none of these engines takes any of these tasks");
    return END_USAGE;
}

static int take_settings(run *r, const defaults *d, const char *sets)
{
    const bench_settings *s = r->settings;
    r->sizes = d->sizes;
    r->plan = (contest_plan){
        .engines = d->engines,
        .tasks = d->tasks,
        .queries = s->queries ? s->queries : 1000000,
        .rounds = s->rounds ? s->rounds : 5,
        .threads = s->common.threads ? s->common.threads : 1,
    };
    int end = check_settings(s, d);
    if (end == 0 && s->sizes) end = bench_sizes(s->sizes, &r->sizes);
    if (end == 0 && s->engines) end = engines_named(s->engines, &r->plan.engines);
    if (end == 0 && s->tasks) end = engines_tasks_named(s->tasks, &r->plan.tasks);
    if (end == 0) end = s->data ? bench_each_word(s->data, check_file, r) : bench_each_word(sets, check_set, NULL);
    if (end == 0) end = check_plan(&r->plan);
    if (end == 0) end = check_plot(r);
    return end ? end : files_try_output(s->common.output, NULL);
}

/* Peers that are not to be had are named, and passed over. */
static void leave_out_missing(run *r)
{
    if (!r->settings->common.quiet) engines_missing(r->plan.engines);
    for (engine_id id = 0; id < ENGINES; id++)
        if (!engines_code(id)) r->plan.engines &= ~(UINT32_C(1) << id);
}

static int run_all(const bench_settings *s, const char *set, const defaults *d)
{
    run r = {.settings = s};
    const char *sets = set ? set : d->sets;
    int end = take_settings(&r, d, sets);
    if (end) return end;
    leave_out_missing(&r);
    end = s->data ? bench_each_word(s->data, run_file, &r) : bench_each_word(sets, run_set, &r);
    if (end == 0 && s->plot) end = contest_plot(&r.table, s->plot);
    if (end == 0) {
        text t = {0};
        contest_print(&r.table, &r.plan, s->format, &t);
        end = files_write_text(s->common.output, &t);
    }
    contest_release(&r.table);
    return end;
}

int bench_peers(const bench_settings *s, const char *set)
{
    return run_all(s, set, &beside_peers);
}

int bench_scale(const bench_settings *s, const char *set)
{
    return run_all(s, set, &over_sizes);
}
