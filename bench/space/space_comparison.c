#include "bench/space/space_comparison.h"
#include "bench/core/rounds.h"
#include "bench/space/space_judge.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ENGINES = 16, MOST_ENTRIES = MOST_ENGINES * SPACE_WAYS };

/* Tests of triangles that the exact answers of a set of rays are checked by. */
#define TRUTH_TESTS 2e7

const char *space_task_name(int task)
{
    if (task == SPACE_TASK_BUILD) return "build";
    if (task < 0 || task >= SPACE_TASKS) return NULL;
    return task < SPACE_TASK_MOVES ? space_rays_name(task - SPACE_TASK_RAYS)
                                   : space_move_name(task - SPACE_TASK_MOVES);
}

const char *space_engine_name(int engine)
{
    for (int i = 0; space_engines[i]; i++)
        if (i == engine) return space_engines[i]->name;
    return NULL;
}

/* One engine in one way. */
typedef struct space_entry {
    const space_engine *engine;
    unsigned number, way;
    space_verdict verdict;
} space_entry;

typedef struct space_run {
    const space_plan *plan;
    space_model *model;
    text *table;
    void *scene[MOST_ENGINES];
    size_t bytes[MOST_ENGINES];
    space_entry entry[MOST_ENTRIES];
    size_t entries;
    space_task task;
    space_rays rays;
    uint32_t *found;
    space_truth truth;
    space_move move;
    bool away;       /* where the vertices are */
    double farthest; /* that any moved last */
    size_t ours_wrong;
} space_run;

static bool run_has(const space_run *r, unsigned number)
{
    const space_engine *e = space_engines[number];
    const space_model *m = r->model;
    return (r->plan->engines >> number & 1) && e->version() && (m->is_star || !e->needs_star) &&
           (!e->most_triangles || m->triangle_count <= e->most_triangles);
}

static size_t entry_rays(const space_run *r, const space_engine *e)
{
    return e->most_rays && e->most_rays < r->rays.count ? e->most_rays : r->rays.count;
}

/* Enter the engines with the ways in which they do the task. */
static void run_enter(space_run *r, const char *const *(*ways)(const space_engine *))
{
    r->entries = 0;
    for (unsigned i = 0; space_engines[i]; i++) {
        const char *const *names = ways(space_engines[i]);
        for (unsigned way = 0; r->scene[i] && names[way]; way++)
            r->entry[r->entries++] =
                (space_entry){.engine = space_engines[i], .number = i, .way = way};
    }
}

static const char *const *ways_to_cast(const space_engine *e)
{
    return e->casts;
}
static const char *const *ways_to_follow(const space_engine *e)
{
    return e->follows;
}
static const char *const *ways_to_build(const space_engine *e)
{
    static const char *const one[] = {"build", NULL};
    (void)e;
    return one;
}

/* --- rows ------------------------------------------------------------------------------------- */

void space_header(text *table, bool tsv)
{
    text_printf(table,
                tsv ? "%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n"
                    : "%-14s %9s %-10s %-13s %-8s %10s %7s %7s %8s %8s %8s\n",
                "model", "triangles", "task", "engine", "way", "ns", "ratio", "bytes", "other",
                "missed", "invented");
}

static void run_format_number(char cell[32], double value, const char *format)
{
    cell[0] = 0;
    if (isfinite(value)) snprintf(cell, 32, format, value);
}

static void run_print_row(space_run *r, const space_entry *e, const char *way, double ns,
                          double base, double bytes, bool judged)
{
    bool tsv = r->plan->settings->format == FORMAT_TSV;
    char cell[6][32];
    run_format_number(cell[0], ns, ns < 10 ? "%.2f" : "%.0f");
    run_format_number(cell[1], ns / base, "%.2f");
    run_format_number(cell[2], bytes, "%.1f");
    run_format_number(cell[3], judged ? (double)e->verdict.other : NAN, "%.0f");
    run_format_number(cell[4], judged ? (double)e->verdict.missed : NAN, "%.0f");
    run_format_number(cell[5], judged ? (double)e->verdict.invented : NAN, "%.0f");
    text_printf(r->table,
                tsv ? "%s\t%zu\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n"
                    : "%-14s %9zu %-10s %-13s %-8s %10s %7s %7s %8s %8s %8s\n",
                r->model->name, r->model->triangle_count, space_task_name((int)r->task),
                e->engine->name, way, cell[0], cell[1], cell[2], cell[3], cell[4], cell[5]);
}

/* The least time of each entry, divided by what it did; `base` is that of Embree's first way. */
static void run_print(space_run *r, const rounds_results *results, size_t leaders,
                      const char *const *(*ways)(const space_engine *), bool judged)
{
    double base = NAN, ns[MOST_ENTRIES];
    for (size_t i = r->entries; i-- > 0;) {
        const space_entry *e = &r->entry[i];
        size_t each = ways == ways_to_cast ? entry_rays(r, e->engine) : r->model->triangle_count;
        ns[i] = 1e9 * rounds_minimum(results, leaders + i, 0) / (double)each;
        if (strcmp(e->engine->name, "Embree") == 0) base = ns[i];
    }
    for (size_t i = 0; i < r->entries; i++) {
        const space_entry *e = &r->entry[i];
        bool builds = ways == ways_to_build;
        double bytes = (double)r->bytes[e->number] / (double)r->model->triangle_count;
        if (!builds || bytes == 0) bytes = NAN; /* not known */
        run_print_row(r, e, ways(e->engine)[e->way], ns[i], base, bytes, judged);
    }
}

/* --- building --------------------------------------------------------------------------------- */

static void run_release_scene(space_run *r, unsigned i)
{
    if (r->scene[i] && r->scene[i] != r) space_engines[i]->destroy(r->scene[i]);
    r->scene[i] = NULL;
}

static int run_build_one(void *self, size_t entry, size_t round, double *figures)
{
    space_run *r = self;
    unsigned i = r->entry[entry].number;
    (void)round;
    run_release_scene(r, i);
    uint32_t threads = r->plan->settings->common.threads;
    r->scene[i] = space_engines[i]->build(r->model, threads ? threads : 1, figures, &r->bytes[i]);
    return r->scene[i] ? 0 : END_RESOURCE;
}

static int run_build(space_run *r)
{
    for (unsigned i = 0; space_engines[i]; i++)
        if (run_has(r, i)) r->scene[i] = r; /* to be entered; replaced by its scene */
    run_enter(r, ways_to_build);
    rounds_plan plan = {.entries = r->entries, .figures = 1, .rounds = 1};
    if (r->model->triangle_count < 3000000) plan.rounds = r->plan->rounds;
    rounds_results results = {0};
    r->task = SPACE_TASK_BUILD;
    int end = rounds_measure(&plan, run_build_one, r, &results);
    if (end == 0 && (r->plan->tasks >> SPACE_TASK_BUILD & 1))
        run_print(r, &results, 0, ways_to_build, false);
    rounds_release(&results);
    return end;
}

/* --- rays ------------------------------------------------------------------------------------- */

/* The exact answers: those of the certain engine, the first of the list, as far as they can be
 * checked by all triangles. */
static int run_find_truth(space_run *r)
{
    const space_engine *e = space_engines[0];
    r->truth.count = r->rays.count;
    if (e->cast(r->scene[0], 1, &r->rays, SPACE_RANDOM, 0, r->truth.nearest) < 0)
        return END_RESOURCE;
    r->ours_wrong += space_truth_check(&r->truth, r->model, &r->rays, TRUTH_TESTS);
    return 0;
}

static void entry_judge(space_run *r, space_entry *e)
{
    size_t count = entry_rays(r, e->engine);
    e->verdict = space_judge(&r->truth, r->model, &r->rays, r->found, count, e->engine->is_first);
    if (e->number == 0) r->ours_wrong += e->verdict.other + e->verdict.missed + e->verdict.invented;
}

static double entry_cast(space_run *r, const space_entry *e, unsigned way, space_rays_kind kind)
{
    space_rays rays = {r->rays.ray, entry_rays(r, e->engine)};
    uint32_t threads = r->plan->settings->common.threads;
    return e->engine->cast(r->scene[e->number], way, &rays, kind, threads ? threads : 1, r->found);
}

static int run_cast_one(void *self, size_t entry, size_t round, double *figures)
{
    space_run *r = self;
    space_entry *e = &r->entry[entry];
    figures[0] = entry_cast(r, e, e->way, (space_rays_kind)(r->task - SPACE_TASK_RAYS));
    if (figures[0] < 0) return END_RESOURCE;
    if (round == 0) entry_judge(r, e);
    return 0;
}

/* Stars cast from the centre only. */
static void run_drop_stars(space_run *r, space_rays_kind kind)
{
    size_t kept = 0;
    for (size_t i = 0; i < r->entries; i++)
        if (space_rays_need_star((int)kind) || !r->entry[i].engine->needs_star)
            r->entry[kept++] = r->entry[i];
    r->entries = kept;
}

static int run_cast(space_run *r, space_rays_kind kind)
{
    rounds_results results = {0};
    r->task = (space_task)(SPACE_TASK_RAYS + (int)kind);
    if (!space_rays_draw(&r->rays, r->model, kind, r->plan->rays,
                         r->plan->settings->common.seed + (unsigned)kind))
        return fail_memory();
    run_enter(r, ways_to_cast);
    run_drop_stars(r, kind);
    rounds_plan plan = {
        .entries = r->entries, .figures = 1, .warmups = 1, .rounds = r->plan->rounds};
    int end = run_find_truth(r);
    if (end == 0) end = rounds_measure(&plan, run_cast_one, r, &results);
    if (end == 0) run_print(r, &results, 0, ways_to_cast, true);
    rounds_release(&results);
    space_rays_release(&r->rays);
    return end;
}

/* --- moves ------------------------------------------------------------------------------------ */

static size_t moved_vertices(const space_run *r)
{
    size_t n = r->model->point_count;
    return r->move == SPACE_ALL ? n : r->move == SPACE_TENTH ? (n + 9) / 10 : 1;
}

static double entry_follow(space_run *r, unsigned number, unsigned way)
{
    uint32_t threads = r->plan->settings->common.threads;
    return space_engines[number]->follow(r->scene[number], way, r->model, moved_vertices(r),
                                         r->farthest, threads ? threads : 1);
}

/* The first entry moves the model, the others follow; then they answer once, to be judged. */
static int run_follow_one(void *self, size_t entry, size_t round, double *figures)
{
    space_run *r = self;
    figures[0] = 0;
    if (entry == 0) {
        r->away = !r->away;
        space_model_move(r->model, r->move, r->away, &r->farthest);
        if (round != 0) return 0;
        return entry_follow(r, 0, 1) < 0 ? END_RESOURCE : run_find_truth(r);
    }
    space_entry *e = &r->entry[entry - 1];
    figures[0] = entry_follow(r, e->number, e->way);
    if (figures[0] < 0) return END_RESOURCE;
    if (round != 0) return 0;
    unsigned last = 0;
    while (e->engine->casts[last + 1]) last++;
    if (entry_cast(r, e, last, SPACE_RANDOM) < 0) return END_RESOURCE;
    entry_judge(r, e);
    return 0;
}

static int run_move(space_run *r, space_move move)
{
    rounds_results results = {0};
    r->task = (space_task)(SPACE_TASK_MOVES + (int)move);
    r->move = move;
    if (!space_rays_draw(&r->rays, r->model, r->model->is_star ? SPACE_CENTRE : SPACE_RANDOM,
                         r->plan->rays, r->plan->settings->common.seed + SPACE_RAYS_KINDS))
        return fail_memory();
    run_enter(r, ways_to_follow);
    rounds_plan plan = {
        .entries = r->entries + 1, .leaders = 1, .figures = 1, .rounds = r->plan->rounds + 1};
    int end = rounds_measure(&plan, run_follow_one, r, &results);
    if (end == 0) run_print(r, &results, 1, ways_to_follow, true);
    rounds_release(&results);
    space_rays_release(&r->rays);
    return end;
}

/* --- a model ---------------------------------------------------------------------------------- */

static int run_tasks(space_run *r)
{
    int end = run_build(r);
    for (int kind = 0; kind < SPACE_RAYS_KINDS && end == 0; kind++) {
        bool can = !space_rays_need_star(kind) || r->model->is_star;
        if (can && (r->plan->tasks >> (SPACE_TASK_RAYS + kind) & 1))
            end = run_cast(r, (space_rays_kind)kind);
    }
    for (int move = 0; move < SPACE_MOVES && end == 0; move++)
        if (r->plan->tasks >> (SPACE_TASK_MOVES + move) & 1) end = run_move(r, (space_move)move);
    return end;
}

int space_compare(const space_plan *plan, space_model *m, text *table)
{
    space_run r = {.plan = plan, .model = m, .table = table};
    progress_phase("casting", "rays");
    r.found = calloc(plan->rays + 1, sizeof *r.found);
    r.truth.nearest = calloc(plan->rays + 1, sizeof *r.truth.nearest);
    int end = r.found && r.truth.nearest ? run_tasks(&r) : fail_memory();
    for (unsigned i = 0; space_engines[i]; i++) run_release_scene(&r, i);
    free(r.found);
    free(r.truth.nearest);
    if (end == 0 && r.ours_wrong) {
        complain("%s: %zu answers of meshwalk are wrong", m->name, r.ours_wrong);
        end = END_RESOURCE;
    }
    return end;
}
