#include "bench/edits/edit_aging.h"
#include "bench/core/answers.h"
#include "bench/core/query_rounds.h"
#include "bench/peers/engine.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A way to choose the first triangle, with its index. */
typedef struct aging_start {
    const char *name;
    mw_start_kind start;
    bool kept; /* the index is the editor's, and follows edits */
    const mw_index *index;
} aging_start;

#define AGING_STARTS 7

typedef struct edit_aging {
    const edit_plan *plan;
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
    aging_start starts[AGING_STARTS];
    double edits; /* so far */
    double ns;    /* of each of the last ones; or of compacting */
} edit_aging;

static int edit_aging_fail(const edit_aging *s, const mw_error *error)
{
    return fail_mesh(s->plan->name, error);
}

/* --- edits ------------------------------------------------------------------------------------ */

/* In turn a point comes, a vertex goes, and one is moved to the position of a new
 * point. */
static mw_edit edit_aging_next_edit(edit_aging *s, size_t i)
{
    mw_edit edit = {.kind = i % 3 == 0   ? MW_EDIT_INSERT
                            : i % 3 == 1 ? MW_EDIT_REMOVE
                                         : MW_EDIT_MOVE};
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

static int edit_aging_edit_until(edit_aging *s, double edits)
{
    double clock = monotonic_seconds(), before = s->edits;
    for (; s->edits < edits; s->edits++) {
        mw_error error;
        mw_change change;
        mw_edit edit = edit_aging_next_edit(s, (size_t)s->edits);
        if (mw_edit_apply(s->editor, &edit, &change, &error) != MW_OK)
            return edit_aging_fail(s, &error);
        if (edit.kind == MW_EDIT_INSERT) s->alive[s->alive_count++] = change.vertex;
    }
    s->ns = 1e9 * (monotonic_seconds() - clock) / fmax(1, edits - before);
    return 0;
}

/* --- location --------------------------------------------------------------------------------- */

static int edit_aging_locate(edit_aging *s, const aging_start *b, size_t begin, size_t n,
                             mw_counters *counters, double *seconds)
{
    mw_error error;
    mw_cursor cursor;
    mw_query_options options = {.start = b->start,
                                .index = b->index,
                                .seed = s->plan->seed + begin,
                                .counters = counters != NULL};
    if (mw_cursor_init(s->locator, &options, &cursor, &error) != MW_OK)
        return edit_aging_fail(s, &error);
    const double *q = s->queries + 2 * begin;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < n; i++)
        s->found[i] = mw_locate(s->locator, &cursor, q[2 * i], q[2 * i + 1]);
    *seconds = monotonic_seconds() - clock;
    if (counters) *counters = cursor.counters;
    return 0;
}

static int edit_aging_time_share(void *self, size_t entry, size_t begin, size_t n, double *time)
{
    edit_aging *s = self;
    int end = edit_aging_locate(s, &s->starts[entry], begin, n, NULL, time);
    *time *= 1e6 / (double)n;
    return end;
}

/* The triangles that were found hold the points. */
static int edit_aging_check(const edit_aging *s)
{
    for (size_t i = 0; i < TIMED_QUERIES; i++) {
        uint32_t v[3];
        double c[6];
        if (!mw_editor_triangle(s->editor, s->found[i].triangle, v)) continue;
        for (int k = 0; k < 3; k++) mw_editor_vertex(s->editor, v[k], c + 2 * k);
        if (engine_contains(c, c + 2, c + 4, s->queries + 2 * i)) continue;
        complain("%s: %.17g %.17g was found in a triangle that does not hold it", s->plan->name,
                 s->queries[2 * i], s->queries[2 * i + 1]);
        return END_RESOURCE;
    }
    return 0;
}

static int edit_aging_count(edit_aging *s, double triangles[AGING_STARTS])
{
    int end = 0;
    for (size_t k = 0; k < AGING_STARTS && end == 0; k++) {
        double seconds;
        mw_counters counters = {0};
        end = edit_aging_locate(s, &s->starts[k], 0, TIMED_QUERIES, &counters, &seconds);
        if (end) return end;
        triangles[k] = (double)counters.triangles_visited / TIMED_QUERIES;
        if (k == 0) end = edit_aging_check(s);
        if (k == 0) memcpy(s->expected, s->found, TIMED_QUERIES * sizeof *s->found);
        locations_pair pair = {s->starts[k].name, s->starts[0].name, s->found, s->expected};
        if (end == 0) end = locations_compare(s->plan->name, s->queries, TIMED_QUERIES, &pair);
    }
    return end;
}

static int edit_aging_add_rows(const edit_aging *s, const char *what, const double *microseconds,
                               const double *triangles, edit_table *table)
{
    mw_editor_info info;
    mw_editor_describe(s->editor, &info);
    edit_row row = edit_row_of(s->plan, EDIT_TASK_AGING, what);
    row.edits = s->edits;
    row.ns = s->edits > 0 ? s->ns : NAN;
    row.bytes = (double)info.bytes;
    int end = edit_table_add(table, &row);
    for (size_t k = 0; k < AGING_STARTS && end == 0; k++) {
        mw_index_info index = {0};
        row.name = s->starts[k].name;
        row.ns = 1000 * microseconds[k];
        row.triangles = triangles[k];
        if (s->starts[k].index) mw_index_describe(s->starts[k].index, &index);
        row.bytes = s->starts[k].index ? (double)index.bytes : NAN;
        end = edit_table_add(table, &row);
    }
    return end;
}

/* what: was done before. */
static int edit_aging_look(edit_aging *s, const char *what, edit_table *table)
{
    double microseconds[AGING_STARTS], triangles[AGING_STARTS];
    dataset_draw(&s->data, s->queries, TIMED_QUERIES, &s->random);
    int end = edit_aging_count(s, triangles);
    if (end == 0)
        end = query_rounds_measure(AGING_STARTS, query_rounds_share(TIMED_QUERIES),
                                   edit_aging_time_share, s, microseconds);
    return end ? end : edit_aging_add_rows(s, what, microseconds, triangles, table);
}

/* --- the run ---------------------------------------------------------------------------------- */

static int edit_aging_make_indices(edit_aging *s)
{
    mw_error error;
    static const aging_start all[AGING_STARTS] = {
        {"last", MW_START_LAST, false, NULL},
        {"sample", MW_START_SAMPLE, false, NULL},
        {"auto", MW_START_AUTO, false, NULL},
        {"layers", MW_START_LAYERS, true, NULL},
        {"grid", MW_START_GRID, true, NULL},
        {"two-level-grid", MW_START_TWO_LEVEL_GRID, true, NULL},
        {"grid-not-kept-up", MW_START_GRID, false, NULL},
    };
    memcpy(s->starts, all, sizeof all);
    for (size_t k = 0; k < AGING_STARTS; k++) {
        aging_start *b = &s->starts[k];
        if (b->kept && mw_editor_index(s->editor, b->start, NULL, &b->index, &error) != MW_OK)
            return edit_aging_fail(s, &error);
    }
    if (mw_index_create(s->locator, MW_START_GRID, NULL, &s->stale, &error) != MW_OK)
        return edit_aging_fail(s, &error);
    s->starts[AGING_STARTS - 1].index = s->stale;
    return 0;
}

static int edit_aging_prepare(edit_aging *s, size_t edits)
{
    mw_error error;
    mw_mesh *mesh;
    const edit_plan *p = s->plan;
    if (!dataset_make(&s->data, p->kind, p->vertices + edits, false, p->seed)) return fail_memory();
    s->fresh = p->vertices;
    s->alive = malloc((p->vertices + edits) * sizeof *s->alive);
    s->queries = malloc(2 * TIMED_QUERIES * sizeof *s->queries);
    s->found = malloc(TIMED_QUERIES * sizeof *s->found);
    s->expected = malloc(TIMED_QUERIES * sizeof *s->expected);
    if (!s->alive || !s->queries || !s->found || !s->expected) return fail_memory();
    mw_delaunay_options one_thread = {.threads = 1};
    if (mw_delaunay(s->data.points, p->vertices, 2, &one_thread, NULL, NULL, &mesh, &error) !=
        MW_OK)
        return edit_aging_fail(s, &error);
    mw_status status =
        mw_editor_create(mesh, &(mw_editor_options){.threads = 1}, &s->editor, &error);
    mw_mesh_destroy(mesh);
    if (status != MW_OK) return edit_aging_fail(s, &error);
    for (; s->alive_count < p->vertices; s->alive_count++)
        s->alive[s->alive_count] = (uint32_t)s->alive_count;
    s->locator = mw_editor_locator(s->editor);
    return edit_aging_make_indices(s);
}

/* What edits have scattered in memory is put in order again. */
static int edit_aging_compact(edit_aging *s)
{
    mw_error error;
    double clock = monotonic_seconds();
    if (mw_editor_compact(s->editor, NULL, NULL, &error) != MW_OK)
        return edit_aging_fail(s, &error);
    s->ns = 1e9 * (monotonic_seconds() - clock);
    return 0;
}

/* Ten edits for each vertex; a look at first, and each time that there are ten times as many as at
 * the one before; and one when all has been compacted. */
int edit_aging_measure(const edit_plan *p, edit_table *table)
{
    size_t all = 10 * p->vertices;
    edit_aging s = {.plan = p, .random = ~p->seed};
    progress_phase("editing for long", p->name);
    int end = edit_aging_prepare(&s, all);
    if (end == 0) end = edit_aging_look(&s, "edits", table);
    for (size_t edits = all / 1000 ? all / 1000 : 1; end == 0 && edits <= all; edits *= 10) {
        end = edit_aging_edit_until(&s, (double)edits);
        if (end == 0) end = edit_aging_look(&s, "edits", table);
    }
    if (end == 0) end = edit_aging_compact(&s);
    if (end == 0) end = edit_aging_look(&s, "compact", table);
    mw_editor_destroy(s.editor);
    mw_index_destroy(s.stale);
    dataset_release(&s.data);
    free(s.alive);
    free(s.queries);
    free(s.found);
    free(s.expected);
    return end;
}
