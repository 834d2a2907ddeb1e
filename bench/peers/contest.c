#include "bench/peers/contest.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "bench/core/rounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What takes so many seconds is not repeated: a structure is built once, a run takes fewer queries. */
#define SLOW 3.0

/* A structure that is built. */
typedef struct built {
    const engine_structure *structure;
    unsigned threads;
    void *self; /* NULL: not built, or dropped */
    bool failed;
    double seconds, bytes;
} built;

/* An engine on so many threads, and what was measured of it in one task. */
typedef struct contestant {
    engine_id id;
    const engine_code *code;
    unsigned threads;
    bool out;            /* it failed                         */
    size_t queries;      /* that it takes                     */
    double *build, *run; /* seconds of each round             */
    double bytes;
    size_t wrong;
    bool judged;
    uint64_t sum; /* of the answers that were judged */
} contestant;

#define MOST_CONTESTANTS (2 * ENGINES)

typedef struct contest {
    const contest_plan *plan;
    const ground *ground;
    engine_task task;
    const course *course;
    built built[MOST_CONTESTANTS];
    size_t built_count;
    contestant contestants[MOST_CONTESTANTS];
    size_t count;
    uint64_t *answers;
    double *times;
} contest;

/* --- structures -------------------------------------------------------------------------------------------------- */

static void drop(built *b)
{
    if (b->self) b->structure->destroy(b->self);
    b->self = NULL;
}

/* Whose it is: the library of the first engine that has it. */
static engine_library library_of(const contest *c, const built *b)
{
    for (size_t k = 0; k < c->count; k++)
        if (c->contestants[k].code->structure == b->structure) return engines[c->contestants[k].id].library;
    return LIBRARY_MESHWALK;
}

static void build(const contest *c, built *b)
{
    if (!engines_have_room(library_of(c, b), c->ground->mesh.point_count)) {
        b->failed = true;
        return;
    }
    b->seconds = b->structure->build(&c->ground->mesh, b->threads, &b->self);
    b->failed = !b->self;
    b->bytes = b->self ? (double)b->structure->bytes(b->self) : NAN;
    if (b->failed) complain("%s: %s cannot take it", c->ground->name, b->structure->version());
}

/* What a contestant needs, built if it is not. */
static built *built_for(contest *c, const contestant *e)
{
    built *b = c->built;
    while (b < c->built + c->built_count && (b->structure != e->code->structure || b->threads != e->threads)) b++;
    if (b == c->built + c->built_count) {
        *b = (built){.structure = e->code->structure, .threads = e->threads};
        c->built_count++;
    }
    if (!b->self && !b->failed) build(c, b);
    return b;
}

/* Where building is measured it is repeated, unless it is slow. */
static bool is_built_anew(const contest *c, const built *b)
{
    return (c->task == TASK_TOTAL || c->task == TASK_CONNECTIVITY) && b->seconds < SLOW;
}

/* --- the judge --------------------------------------------------------------------------------------------------- */

static bool is_right(const contest *c, const built *b, size_t i)
{
    double own[6];
    uint64_t answer = c->answers[i];
    const double *corner[3], *q = c->course->queries + 2 * i;
    if (answer == ENGINE_NONE) return !c->course->inside[i];
    if (b->structure->corners) {
        b->structure->corners(b->self, answer, own);
        for (size_t k = 0; k < 3; k++) corner[k] = own + 2 * k;
    } else {
        if (answer >= c->ground->mesh.triangle_count) return false;
        const uint32_t *v = c->ground->mesh.triangles + 3 * answer;
        for (size_t k = 0; k < 3; k++) corner[k] = c->ground->mesh.points + 2 * (size_t)v[k];
    }
    return engine_contains(corner[0], corner[1], corner[2], q);
}

/* FNV-1a of whole words [Fowler, Noll, Vo]: has anything changed since the last round? */
static uint64_t sum_of(const uint64_t *answers, size_t n)
{
    uint64_t sum = UINT64_C(14695981039346656037);
    for (size_t i = 0; i < n; i++) sum = (sum ^ answers[i]) * UINT64_C(1099511628211);
    return sum;
}

/* A triangle that contains the point while we said that none does would be our mistake. */
static int contradicted(const contest *c, size_t i)
{
    const double *q = c->course->queries + 2 * i;
    complain("%s: nothing was found at %.17g %.17g, where there is a triangle", c->ground->name, q[0], q[1]);
    return END_RESOURCE;
}

static int judge(const contest *c, const built *b, contestant *e)
{
    size_t wrong = 0;
    uint64_t sum = sum_of(c->answers, e->queries);
    if (e->judged && sum == e->sum) return 0;
    for (size_t i = 0; i < e->queries; i++) {
        bool right = is_right(c, b, i);
        wrong += !right;
        if (right && !b->structure->corners && c->answers[i] != ENGINE_NONE && !c->course->inside[i])
            return contradicted(c, i);
    }
    e->judged = true;
    e->sum = sum;
    if (wrong > e->wrong) e->wrong = wrong;
    if (wrong == 0 || engines[e->id].library != LIBRARY_MESHWALK) return 0;
    complain("%s: %zu answers of %s are wrong", c->ground->name, wrong, engines[e->id].name);
    return END_RESOURCE;
}

/* --- rounds ------------------------------------------------------------------------------------------------------ */

/* Of ours that is the end, a peer goes on without. */
static int leave_out(contestant *e)
{
    e->out = true;
    return engines[e->id].library == LIBRARY_MESHWALK ? END_RESOURCE : 0;
}

static int fail_engine(const contest *c, contestant *e)
{
    complain("%s: %s has failed", c->ground->name, engines[e->id].name);
    return leave_out(e);
}

/* One run. `build_time` and `run_time` are set to seconds. */
static int run_once(contest *c, contestant *e, size_t queries, double *build_time, double *run_time)
{
    if (c->task == TASK_DELAUNAY) {
        size_t bytes = 0;
        *run_time = 0;
        *build_time = e->code->triangulate(c->ground->mesh.points, c->ground->mesh.point_count, e->threads, &bytes);
        e->bytes = (double)bytes;
        return *build_time >= 0 ? 0 : fail_engine(c, e);
    }
    built *b = built_for(c, e);
    if (!b->self) return leave_out(e);
    *build_time = b->seconds;
    *run_time = 0;
    e->bytes = b->bytes;
    if (c->task != TASK_CONNECTIVITY)
        *run_time = e->code->locate(b->self, c->course->queries, queries, e->threads, c->answers);
    if (*run_time < 0) return fail_engine(c, e);
    return queries == e->queries && c->course ? judge(c, b, e) : 0;
}

static void drop_built(contest *c, const contestant *e)
{
    for (size_t k = 0; k < c->built_count; k++) {
        built *b = &c->built[k];
        if (b->structure == e->code->structure && b->threads == e->threads && is_built_anew(c, b)) drop(b);
    }
}

/* How many queries are not slow? It is tried with more and more, which also warms up. */
static int try_out(contest *c, contestant *e)
{
    size_t most = c->course ? c->course->count : 0, n = most < 1000 ? most : 1000;
    double build_time = 0, seconds = 0;
    for (;;) {
        int end = run_once(c, e, n, &build_time, &seconds);
        if (end || e->out) return end;
        double next = n < most / 8 ? (double)n * 8 : (double)most;
        if (n == most || seconds * next / (double)n > SLOW) break;
        n = (size_t)next;
    }
    drop_built(c, e);
    e->queries = n == most || seconds > SLOW ? n : (size_t)((double)n * SLOW / seconds);
    return 0;
}

static bool is_slow(contest *c, const contestant *e)
{
    if (c->task == TASK_DELAUNAY) return e->build[0] > SLOW;
    return c->task == TASK_CONNECTIVITY && built_for(c, e)->seconds > SLOW;
}

static int hold_rounds(contest *c)
{
    int end = 0;
    for (size_t round = 0; round < c->plan->rounds; round++)
        for (size_t k = 0; k < c->count && end == 0; k++) {
            contestant *e = &c->contestants[(k + round) % c->count];
            if (e->out) continue;
            e->build[round] = e->build[0];
            e->run[round] = e->run[0];
            if (round > 0 && is_slow(c, e)) continue;
            end = run_once(c, e, e->queries, &e->build[round], &e->run[round]);
            drop_built(c, e);
        }
    return end;
}

/* --- rows -------------------------------------------------------------------------------------------------------- */

static int add_row(contest_table *table, const contest_row *row)
{
    contest_row *rows = realloc(table->rows, (table->count + 1) * sizeof *rows);
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

static int take_row(const contest *c, contestant *e, contest_table *table)
{
    contest_row row = {
        c->task, (char *)c->ground->name, c->ground->mesh.point_count, e->id, e->threads, NAN, 0, e->bytes, NAN};
    double each = c->course ? 1 / (double)e->queries : 0;
    for (size_t i = 0; i < c->plan->rounds && c->course; i++) {
        e->run[i] *= 1e9 * each;
        if (c->task == TASK_TOTAL) e->run[i] += 1e9 * e->build[i] / (double)c->course->count;
    }
    row.build_seconds = rounds_median(e->build, c->plan->rounds);
    if (c->course) {
        row.ns_per_query = rounds_median(e->run, c->plan->rounds);
        row.wrong = (double)e->wrong;
    }
    return add_row(table, &row);
}

/* --- the contest ------------------------------------------------------------------------------------------------- */

static void enter(contest *c, engine_id id, unsigned threads)
{
    contestant *e = &c->contestants[c->count];
    double *times = c->times + 2 * c->plan->rounds * c->count++;
    *e = (contestant){.id = id, .code = engines_code(id), .threads = threads, .build = times, .bytes = NAN};
    e->run = times + c->plan->rounds;
}

static int hold_task(contest *c, engine_task task, contest_table *table)
{
    int end = 0;
    c->task = task;
    c->count = 0;
    c->course = c->ground->courses[task].queries ? &c->ground->courses[task] : NULL;
    for (engine_id id = 0; id < ENGINES; id++) {
        if (!(c->plan->engines >> id & 1) || !(engines[id].tasks >> task & 1)) continue;
        enter(c, id, 1);
        if (c->plan->threads > 1 && engines[id].parallel) enter(c, id, c->plan->threads);
    }
    progress_phase("measuring", c->ground->name);
    for (size_t k = 0; k < c->count && c->course && end == 0; k++) end = try_out(c, &c->contestants[k]);
    if (end == 0) end = hold_rounds(c);
    for (size_t k = 0; k < c->count && end == 0; k++)
        if (!c->contestants[k].out) end = take_row(c, &c->contestants[k], table);
    return end;
}

/* Tasks that build anew want the memory of what is built. */
static void drop_quick(contest *c)
{
    for (size_t k = 0; k < c->built_count; k++)
        if (c->built[k].seconds < SLOW) drop(&c->built[k]);
}

static size_t most_queries(const ground *g)
{
    size_t most = 0;
    for (engine_task task = 0; task < TASKS; task++)
        if (g->courses[task].count > most) most = g->courses[task].count;
    return most;
}

int contest_hold(const contest_plan *plan, const ground *on, contest_table *table)
{
    static const engine_task order[] = {TASK_DELAUNAY,     TASK_RANDOM, TASK_SORTED,       TASK_COHERENT,
                                        TASK_HALF_OUTSIDE, TASK_DENSE,  TASK_CONNECTIVITY, TASK_TOTAL};
    contest *c = calloc(1, sizeof *c);
    if (!c) return fail_memory();
    *c = (contest){.plan = plan, .ground = on};
    c->answers = malloc((most_queries(on) + 1) * sizeof *c->answers);
    c->times = calloc(2 * plan->rounds * MOST_CONTESTANTS, sizeof *c->times);
    int end = c->answers && c->times ? 0 : fail_memory();
    for (size_t i = 0; i < TASKS && end == 0; i++) {
        if (!(plan->tasks >> order[i] & 1)) continue;
        if (order[i] == TASK_TOTAL || order[i] == TASK_CONNECTIVITY) drop_quick(c);
        end = hold_task(c, order[i], table);
    }
    for (size_t k = 0; k < c->built_count; k++) drop(&c->built[k]);
    free(c->answers);
    free(c->times);
    free(c);
    return end;
}

void contest_release(contest_table *table)
{
    for (size_t k = 0; k < table->count; k++) free(table->rows[k].dataset);
    free(table->rows);
    *table = (contest_table){0};
}
