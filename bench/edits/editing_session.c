/* bench edit, session: what location takes while a mesh is edited for long,
 * without a structure (from the triangle found last, from the nearest of a
 * sample, by what a locator has of itself), and with indices that follow the
 * edits; beside them a grid that does not. The thesis prefers walking for
 * meshes that change, for there is nothing to keep up. */
#include "bench/edits/editings.h"
#include "bench/core/measure.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "bench/core/rounds.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A way to begin, with its index. */
typedef struct beginning {
    const char *name;
    mw_start_kind start;
    bool kept; /* the index is the editor's, and follows edits */
    const mw_index *index;
} beginning;

#define BEGINNINGS 7

typedef struct session {
    const editing_plan *plan;
    dataset data; /* first the points, then those to come */
    size_t fresh;
    mw_editor *editor;
    const mw_locator *locator;
    mw_index *stale;
    uint32_t *alive;
    size_t alive_count;
    uint64_t random;
    double *queries;
    mw_location *found, *expected;
    beginning beginnings[BEGINNINGS];
    double edits; /* so far */
    double ns;    /* of each of the last ones; or of compacting */
} session;

static int fail(const session *s, const mw_error *error)
{
    return fail_mesh(s->plan->name, error);
}

/* --- edits
 * -------------------------------------------------------------------------------------------------------
 */

/* In turn a point comes, a vertex goes, and one is moved to the place of a new
 * point. */
static mw_edit next_edit(session *s, size_t i)
{
    mw_edit edit = {.kind = i % 3 == 0 ? MW_EDIT_INSERT : i % 3 == 1 ? MW_EDIT_REMOVE : MW_EDIT_MOVE};
    if (edit.kind != MW_EDIT_INSERT) {
        size_t k = (size_t)(dataset_unit(&s->random) * (double)s->alive_count);
        edit.vertex = s->alive[k];
        if (edit.kind == MW_EDIT_REMOVE) s->alive[k] = s->alive[--s->alive_count];
    }
    if (edit.kind != MW_EDIT_REMOVE) {
        edit.x = s->data.points[2 * s->fresh];
        edit.y = s->data.points[2 * s->fresh++ + 1];
    }
    return edit;
}

static int edit_until(session *s, double edits)
{
    double clock = monotonic_seconds(), before = s->edits;
    for (; s->edits < edits; s->edits++) {
        mw_error error;
        mw_change change;
        mw_edit edit = next_edit(s, (size_t)s->edits);
        if (mw_edit_apply(s->editor, &edit, &change, &error) != MW_OK) return fail(s, &error);
        if (edit.kind == MW_EDIT_INSERT) s->alive[s->alive_count++] = change.vertex;
    }
    s->ns = 1e9 * (monotonic_seconds() - clock) / fmax(1, edits - before);
    return 0;
}

/* --- location
 * ----------------------------------------------------------------------------------------------------
 */

static int locate(session *s, const beginning *b, size_t begin, size_t n, mw_counters *counters, double *seconds)
{
    mw_error error;
    mw_cursor cursor;
    mw_query_options options = {
        .start = b->start, .index = b->index, .seed = s->plan->seed + begin, .counters = counters != NULL};
    if (mw_cursor_init(s->locator, &options, &cursor, &error) != MW_OK) return fail(s, &error);
    const double *q = s->queries + 2 * begin;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++) s->found[i] = mw_locate(s->locator, &cursor, q[2 * i], q[2 * i + 1]);
    *seconds = monotonic_seconds() - clock;
    if (counters) *counters = cursor.counters;
    return 0;
}

static int time_one(void *self, size_t entry, size_t begin, size_t n, double *time)
{
    session *s = self;
    int end = locate(s, &s->beginnings[entry], begin, n, NULL, time);
    *time *= 1e6 / (double)n;
    return end;
}

/* The triangles that were found hold the places. */
static int check(const session *s)
{
    for (size_t i = 0; i < TIMED_QUERIES; i++) {
        uint32_t v[3];
        double c[6];
        if (!mw_editor_triangle(s->editor, s->found[i].triangle, v)) continue;
        for (int k = 0; k < 3; k++) mw_editor_vertex(s->editor, v[k], c + 2 * k);
        if (engine_contains(c, c + 2, c + 4, s->queries + 2 * i)) continue;
        complain("%s: %.17g %.17g was found in a triangle that does not hold it", s->plan->name, s->queries[2 * i],
                 s->queries[2 * i + 1]);
        return END_RESOURCE;
    }
    return 0;
}

static int count(session *s, double triangles[BEGINNINGS])
{
    int end = 0;
    for (size_t k = 0; k < BEGINNINGS && end == 0; k++) {
        double seconds;
        mw_counters counters = {0};
        end = locate(s, &s->beginnings[k], 0, TIMED_QUERIES, &counters, &seconds);
        if (end) return end;
        triangles[k] = (double)counters.triangles_visited / TIMED_QUERIES;
        if (k == 0) end = check(s);
        if (k == 0) memcpy(s->expected, s->found, TIMED_QUERIES * sizeof *s->found);
        if (end == 0)
            end = measure_compare(s->plan->name, s->queries, TIMED_QUERIES, s->beginnings[k].name, s->found,
                                  s->beginnings[0].name, s->expected);
    }
    return end;
}

static int take_rows(const session *s, const char *what, const double *microseconds, const double *triangles,
                     editing_table *table)
{
    mw_editor_info info;
    mw_editor_describe(s->editor, &info);
    editing_row row = editings_row(s->plan, EDITING_SESSION, what);
    row.edits = s->edits;
    row.ns = s->edits > 0 ? s->ns : NAN;
    row.bytes = (double)info.bytes;
    int end = editings_add(table, &row);
    for (size_t k = 0; k < BEGINNINGS && end == 0; k++) {
        mw_index_info index = {0};
        row.name = s->beginnings[k].name;
        row.ns = 1000 * microseconds[k];
        row.triangles = triangles[k];
        if (s->beginnings[k].index) mw_index_describe(s->beginnings[k].index, &index);
        row.bytes = s->beginnings[k].index ? (double)index.bytes : NAN;
        end = editings_add(table, &row);
    }
    return end;
}

/* what: was done before. */
static int look(session *s, const char *what, editing_table *table)
{
    double microseconds[BEGINNINGS], triangles[BEGINNINGS];
    dataset_draw(&s->data, s->queries, TIMED_QUERIES, &s->random);
    int end = count(s, triangles);
    if (end == 0) end = rounds_time(BEGINNINGS, rounds_share(TIMED_QUERIES), time_one, s, microseconds);
    return end ? end : take_rows(s, what, microseconds, triangles, table);
}

/* --- the session
 * -------------------------------------------------------------------------------------------------
 */

static int make_indices(session *s)
{
    mw_error error;
    static const beginning all[BEGINNINGS] = {
        {"last", MW_START_LAST, false, NULL},
        {"sample", MW_START_SAMPLE, false, NULL},
        {"auto", MW_START_AUTO, false, NULL},
        {"layers", MW_START_LAYERS, true, NULL},
        {"grid", MW_START_GRID, true, NULL},
        {"two-level-grid", MW_START_TWO_LEVEL_GRID, true, NULL},
        {"grid-not-kept-up", MW_START_GRID, false, NULL},
    };
    memcpy(s->beginnings, all, sizeof all);
    for (size_t k = 0; k < BEGINNINGS; k++) {
        beginning *b = &s->beginnings[k];
        if (b->kept && mw_editor_index(s->editor, b->start, NULL, &b->index, &error) != MW_OK) return fail(s, &error);
    }
    if (mw_index_create(s->locator, MW_START_GRID, NULL, &s->stale, &error) != MW_OK) return fail(s, &error);
    s->beginnings[BEGINNINGS - 1].index = s->stale;
    return 0;
}

static int prepare(session *s, size_t edits)
{
    mw_error error;
    mw_mesh *mesh;
    const editing_plan *p = s->plan;
    if (!dataset_make(&s->data, p->kind, p->vertices + edits, false, p->seed)) return fail_memory();
    s->fresh = p->vertices;
    s->alive = malloc((p->vertices + edits) * sizeof *s->alive);
    s->queries = malloc(2 * TIMED_QUERIES * sizeof *s->queries);
    s->found = malloc(TIMED_QUERIES * sizeof *s->found);
    s->expected = malloc(TIMED_QUERIES * sizeof *s->expected);
    if (!s->alive || !s->queries || !s->found || !s->expected) return fail_memory();
    mw_delaunay_options one_thread = {.threads = 1};
    if (mw_delaunay(s->data.points, p->vertices, 2, &one_thread, NULL, NULL, &mesh, &error) != MW_OK)
        return fail(s, &error);
    mw_status status = mw_editor_create(mesh, &(mw_editor_options){.threads = 1}, &s->editor, &error);
    mw_mesh_destroy(mesh);
    if (status != MW_OK) return fail(s, &error);
    for (; s->alive_count < p->vertices; s->alive_count++) s->alive[s->alive_count] = (uint32_t)s->alive_count;
    s->locator = mw_editor_locator(s->editor);
    return make_indices(s);
}

/* What edits have scattered in memory is put in order again. */
static int compact(session *s)
{
    mw_error error;
    double clock = monotonic_seconds();
    if (mw_editor_compact(s->editor, NULL, NULL, &error) != MW_OK) return fail(s, &error);
    s->ns = 1e9 * (monotonic_seconds() - clock);
    return 0;
}

/* Ten edits for each vertex; a look at first, and each time that there are ten times as many as at the one before; and one when all has
 * been compacted. */
int editings_session(const editing_plan *p, editing_table *table)
{
    size_t all = 10 * p->vertices;
    session s = {.plan = p, .random = ~p->seed};
    progress_phase("editing for long", p->name);
    int end = prepare(&s, all);
    if (end == 0) end = look(&s, "edits", table);
    for (size_t edits = all / 1000 ? all / 1000 : 1; end == 0 && edits <= all; edits *= 10) {
        end = edit_until(&s, (double)edits);
        if (end == 0) end = look(&s, "edits", table);
    }
    if (end == 0) end = compact(&s);
    if (end == 0) end = look(&s, "compact", table);
    mw_editor_destroy(s.editor);
    mw_index_destroy(s.stale);
    dataset_release(&s.data);
    free(s.alive);
    free(s.queries);
    free(s.found);
    free(s.expected);
    return end;
}
