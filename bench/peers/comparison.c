#include "bench/peers/comparison.h"
#include "bench/core/rounds.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What takes so many seconds is not repeated: a structure is built once, a run takes fewer
 * queries. */
#define SLOW 3.0

/* The figures of a run: seconds that building took, and nanoseconds of a query, NaN in tasks
 * without queries. */
enum { BUILD_SECONDS, NS_PER_QUERY, RUN_FIGURES };

/* A structure of an engine, built or to be built. */
typedef struct comparison_structure {
    const engine_structure *structure;
    unsigned threads;
    void *self; /* NULL: not built, or dropped */
    bool failed;
    double seconds, bytes;
} comparison_structure;

/* An engine on so many threads, and what was measured of it in one task. */
typedef struct competitor {
    engine_id id;
    const engine_code *code;
    unsigned threads;
    bool out;                  /* it failed           */
    size_t queries;            /* that it takes       */
    double first[RUN_FIGURES]; /* of its first round  */
    double bytes;
    size_t wrong;
    bool checked;
    uint64_t hash; /* of the answers that were checked */
} competitor;

#define MOST_COMPETITORS (2 * ENGINES)

typedef struct comparison {
    const comparison_plan *plan;
    const workload *workload;
    engine_task task;
    const query_set *queries; /* NULL: the task has none */
    comparison_structure structures[MOST_COMPETITORS];
    size_t structure_count;
    competitor competitors[MOST_COMPETITORS];
    size_t count;
    uint64_t *answers;
} comparison;

/* --- structures ------------------------------------------------------------------------------- */

static void structure_drop(comparison_structure *b)
{
    if (b->self) b->structure->destroy(b->self);
    b->self = NULL;
}

/* Whose it is: the library of the first engine that has it. */
static engine_library structure_library(const comparison *c, const comparison_structure *b)
{
    for (size_t k = 0; k < c->count; k++)
        if (c->competitors[k].code->structure == b->structure)
            return engines[c->competitors[k].id].library;
    return LIBRARY_MESHWALK;
}

static void structure_build(const comparison *c, comparison_structure *b)
{
    const engine_mesh *mesh = &c->workload->mesh;
    if (!engine_library_has_room(structure_library(c, b), mesh->point_count)) {
        b->failed = true;
        return;
    }
    b->seconds = b->structure->build(mesh, b->threads, &b->self);
    b->failed = !b->self;
    b->bytes = b->self ? (double)b->structure->bytes(b->self) : NAN;
    if (b->failed) complain("%s: %s cannot take it", c->workload->name, b->structure->version());
}

/* What a competitor needs, built if it is not. */
static comparison_structure *structure_for(comparison *c, const competitor *e)
{
    comparison_structure *b = c->structures, *end = b + c->structure_count;
    while (b < end && (b->structure != e->code->structure || b->threads != e->threads)) b++;
    if (b == end) {
        *b = (comparison_structure){.structure = e->code->structure, .threads = e->threads};
        c->structure_count++;
    }
    if (!b->self && !b->failed) structure_build(c, b);
    return b;
}

/* Where building is measured it is repeated, unless it is slow. */
static bool structure_is_rebuilt(const comparison *c, const comparison_structure *b)
{
    return (c->task == TASK_TOTAL || c->task == TASK_CONNECTIVITY) && b->seconds < SLOW;
}

static void drop_rebuilt(comparison *c, const competitor *e)
{
    for (size_t k = 0; k < c->structure_count; k++) {
        comparison_structure *b = &c->structures[k];
        if (b->structure == e->code->structure && b->threads == e->threads &&
            structure_is_rebuilt(c, b))
            structure_drop(b);
    }
}

/* Tasks that rebuild want the memory of what is built. */
static void drop_quick(comparison *c)
{
    for (size_t k = 0; k < c->structure_count; k++)
        if (c->structures[k].seconds < SLOW) structure_drop(&c->structures[k]);
}

/* --- answers ---------------------------------------------------------------------------------- */

static bool answer_is_right(const comparison *c, const comparison_structure *b, size_t i)
{
    double own[6];
    uint64_t answer = c->answers[i];
    const engine_mesh *mesh = &c->workload->mesh;
    const double *corner[3], *q = c->queries->queries + 2 * i;
    if (answer == ENGINE_NONE) return !c->queries->inside[i];
    if (b->structure->corners) {
        b->structure->corners(b->self, answer, own);
        for (size_t k = 0; k < 3; k++) corner[k] = own + 2 * k;
    } else {
        if (answer >= mesh->triangle_count) return false;
        const uint32_t *v = mesh->triangles + 3 * answer;
        for (size_t k = 0; k < 3; k++) corner[k] = mesh->points + 2 * (size_t)v[k];
    }
    return engine_contains(corner[0], corner[1], corner[2], q);
}

/* FNV-1a of whole words [Fowler, Noll, Vo]: has anything changed since the last round? */
static uint64_t answers_hash(const uint64_t *answers, size_t n)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < n; i++) hash = (hash ^ answers[i]) * UINT64_C(1099511628211);
    return hash;
}

/* A triangle that contains the point while we said that none does would be our mistake. */
static int answers_contradict(const comparison *c, size_t i)
{
    const double *q = c->queries->queries + 2 * i;
    complain("%s: nothing was found at %.17g %.17g, where there is a triangle", c->workload->name,
             q[0], q[1]);
    return END_RESOURCE;
}

static int answers_check(const comparison *c, const comparison_structure *b, competitor *e)
{
    size_t wrong = 0;
    uint64_t hash = answers_hash(c->answers, e->queries);
    if (e->checked && hash == e->hash) return 0;
    for (size_t i = 0; i < e->queries; i++) {
        bool right = answer_is_right(c, b, i);
        wrong += !right;
        if (right && !b->structure->corners && c->answers[i] != ENGINE_NONE &&
            !c->queries->inside[i])
            return answers_contradict(c, i);
    }
    e->checked = true;
    e->hash = hash;
    if (wrong > e->wrong) e->wrong = wrong;
    if (wrong == 0 || engines[e->id].library != LIBRARY_MESHWALK) return 0;
    complain("%s: %zu answers of %s are wrong", c->workload->name, wrong, engines[e->id].name);
    return END_RESOURCE;
}

/* --- runs ------------------------------------------------------------------------------------- */

/* A failure of ours ends the comparison, that of a peer does not. */
static int competitor_leave_out(competitor *e)
{
    e->out = true;
    return engines[e->id].library == LIBRARY_MESHWALK ? END_RESOURCE : 0;
}

static int competitor_fail(const comparison *c, competitor *e)
{
    complain("%s: %s has failed", c->workload->name, engines[e->id].name);
    return competitor_leave_out(e);
}

/* Seconds of a run. */
typedef struct run_seconds {
    double build, locate;
} run_seconds;

static int competitor_triangulate(const comparison *c, competitor *e, run_seconds *seconds)
{
    size_t bytes = 0;
    const engine_mesh *mesh = &c->workload->mesh;
    *seconds = (run_seconds){
        .build = e->code->triangulate(mesh->points, mesh->point_count, e->threads, &bytes)};
    e->bytes = (double)bytes;
    return seconds->build >= 0 ? 0 : competitor_fail(c, e);
}

static int competitor_run(comparison *c, competitor *e, size_t queries, run_seconds *seconds)
{
    if (c->task == TASK_DELAUNAY) return competitor_triangulate(c, e, seconds);
    comparison_structure *b = structure_for(c, e);
    if (!b->self) return competitor_leave_out(e);
    *seconds = (run_seconds){.build = b->seconds};
    e->bytes = b->bytes;
    if (c->task != TASK_CONNECTIVITY)
        seconds->locate =
            e->code->locate(b->self, c->queries->queries, queries, e->threads, c->answers);
    if (seconds->locate < 0) return competitor_fail(c, e);
    return queries == e->queries && c->queries ? answers_check(c, b, e) : 0;
}

/* How many queries are not slow? It is tried with more and more, which also warms up. */
static int competitor_choose_queries(comparison *c, competitor *e)
{
    size_t most = c->queries->count, n = most < 1000 ? most : 1000;
    run_seconds seconds = {0, 0};
    for (;;) {
        int end = competitor_run(c, e, n, &seconds);
        if (end || e->out) return end;
        double next = n < most / 8 ? (double)n * 8 : (double)most;
        if (n == most || seconds.locate * next / (double)n > SLOW) break;
        n = (size_t)next;
    }
    drop_rebuilt(c, e);
    e->queries =
        n == most || seconds.locate > SLOW ? n : (size_t)((double)n * SLOW / seconds.locate);
    return 0;
}

/* What takes all its time to build is not repeated. */
static bool competitor_is_slow(const comparison *c, const competitor *e)
{
    return (c->task == TASK_DELAUNAY || c->task == TASK_CONNECTIVITY) &&
           e->first[BUILD_SECONDS] > SLOW;
}

static double ns_per_query(const comparison *c, const competitor *e, const run_seconds *seconds)
{
    if (!c->queries) return NAN;
    double locate = 1e9 * seconds->locate / (double)e->queries;
    return c->task == TASK_TOTAL ? locate + 1e9 * seconds->build / (double)c->queries->count
                                 : locate;
}

/* A run of a round. */
static int comparison_run(void *self, size_t entry, size_t round, double *figures)
{
    comparison *c = self;
    competitor *e = &c->competitors[entry];
    run_seconds seconds = {NAN, NAN};
    int end = 0;
    if (!e->out && round > 0 && competitor_is_slow(c, e)) {
        memcpy(figures, e->first, sizeof e->first);
        return 0;
    }
    if (!e->out) {
        end = competitor_run(c, e, e->queries, &seconds);
        drop_rebuilt(c, e);
    }
    figures[BUILD_SECONDS] = seconds.build;
    figures[NS_PER_QUERY] = ns_per_query(c, e, &seconds);
    if (round == 0) memcpy(e->first, figures, sizeof e->first);
    return end;
}

/* --- rows ------------------------------------------------------------------------------------- */

static int comparison_table_add(comparison_table *table, const comparison_row *row)
{
    comparison_row *rows = realloc(table->rows, (table->count + 1) * sizeof *rows);
    char *name = strdup(row->dataset);
    if (rows) table->rows = rows;
    if (!rows || !name) {
        free(name);
        return fail_memory();
    }
    rows[table->count] = *row;
    rows[table->count++].dataset = name;
    return 0;
}

static int competitor_add_row(const comparison *c, size_t k, const rounds_results *results,
                              comparison_table *table)
{
    const competitor *e = &c->competitors[k];
    comparison_row row = {
        .task = c->task,
        .dataset = (char *)c->workload->name,
        .vertices = c->workload->mesh.point_count,
        .engine = e->id,
        .threads = e->threads,
        .ns_per_query = rounds_median(results, k, NS_PER_QUERY),
        .build_seconds = rounds_median(results, k, BUILD_SECONDS),
        .bytes = e->bytes,
        .wrong = c->queries ? (double)e->wrong : NAN,
    };
    return comparison_table_add(table, &row);
}

/* --- the comparison --------------------------------------------------------------------------- */

static void comparison_enter(comparison *c, engine_id id, unsigned threads)
{
    c->competitors[c->count++] =
        (competitor){.id = id, .code = engine_code_of(id), .threads = threads, .bytes = NAN};
}

static void comparison_begin_task(comparison *c, engine_task task)
{
    c->task = task;
    c->count = 0;
    c->queries = c->workload->query_sets[task].queries ? &c->workload->query_sets[task] : NULL;
    for (engine_id id = 0; id < ENGINES; id++) {
        if (!engine_is_in(c->plan->engines, id) || !(engines[id].tasks >> task & 1)) continue;
        comparison_enter(c, id, 1);
        if (c->plan->threads > 1 && engines[id].parallel) comparison_enter(c, id, c->plan->threads);
    }
}

static int comparison_measure_task(comparison *c, engine_task task, comparison_table *table)
{
    int end = 0;
    rounds_results results = {0};
    comparison_begin_task(c, task);
    rounds_plan plan = {.entries = c->count, .figures = RUN_FIGURES, .rounds = c->plan->rounds};
    progress_phase("measuring", c->workload->name);
    for (size_t k = 0; k < c->count && c->queries && end == 0; k++)
        end = competitor_choose_queries(c, &c->competitors[k]);
    if (end == 0) end = rounds_measure(&plan, comparison_run, c, &results);
    for (size_t k = 0; k < c->count && end == 0; k++)
        if (!c->competitors[k].out) end = competitor_add_row(c, k, &results, table);
    rounds_release(&results);
    return end;
}

static size_t most_queries(const workload *w)
{
    size_t most = 0;
    for (engine_task task = 0; task < TASKS; task++)
        if (w->query_sets[task].count > most) most = w->query_sets[task].count;
    return most;
}

int comparison_measure(const comparison_plan *plan, const workload *on, comparison_table *table)
{
    static const engine_task order[] = {TASK_DELAUNAY,     TASK_RANDOM,       TASK_SORTED,
                                        TASK_COHERENT,     TASK_HALF_OUTSIDE, TASK_DENSE,
                                        TASK_CONNECTIVITY, TASK_TOTAL};
    comparison *c = calloc(1, sizeof *c);
    if (!c) return fail_memory();
    *c = (comparison){.plan = plan, .workload = on};
    c->answers = malloc((most_queries(on) + 1) * sizeof *c->answers);
    int end = c->answers ? 0 : fail_memory();
    for (size_t i = 0; i < TASKS && end == 0; i++) {
        if (!(plan->tasks >> order[i] & 1)) continue;
        if (order[i] == TASK_TOTAL || order[i] == TASK_CONNECTIVITY) drop_quick(c);
        end = comparison_measure_task(c, order[i], table);
    }
    for (size_t k = 0; k < c->structure_count; k++) structure_drop(&c->structures[k]);
    free(c->answers);
    free(c);
    return end;
}

void comparison_table_release(comparison_table *table)
{
    for (size_t k = 0; k < table->count; k++) free(table->rows[k].dataset);
    free(table->rows);
    *table = (comparison_table){0};
}
