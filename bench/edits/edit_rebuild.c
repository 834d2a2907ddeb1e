#include "bench/edits/edit_rebuild.h"
#include "bench/core/rounds.h"
#include "bench/edits/edit_engine_list.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUERIES 1000
static const size_t strides[] = {1, 10, 100, 1000, 10000, 100000};
#define STRIDES (sizeof strides / sizeof *strides)

typedef struct edit_rebuild {
    const edit_plan *plan;
    size_t stride;
    dataset data;
    size_t fresh; /* the next of its points to insert */
    mw_editor *editor;
    mw_cursor cursor;
    uint32_t *alive;
    size_t alive_count;
    uint64_t random;
    double queries[2 * QUERIES];
    mw_location found[QUERIES];
    uint64_t answers[QUERIES];
    engine_mesh mesh; /* what is there now */
    double *points;
    uint32_t *triangles;
    edit_engine_id id[EDIT_ENGINES]; /* ours, which does the edits, first */
    double wrong[EDIT_ENGINES];
    size_t count;
} edit_rebuild;

/* The figures of a run: nanoseconds of all that is counted; of ours, too, of the edits among it. */
enum { ALL_NS, EDITS_NS, REBUILD_FIGURES };

/* --- ours ------------------------------------------------------------------------------------- */

static int edit_rebuild_fail(const edit_rebuild *r, const mw_error *error)
{
    return fail_mesh(r->plan->name, error);
}

static int edit_rebuild_insert(edit_rebuild *r)
{
    mw_error error;
    mw_change change;
    const double *p = r->data.points + 2 * r->fresh++;
    if (mw_edit_insert(r->editor, p[0], p[1], &change, &error) != MW_OK)
        return edit_rebuild_fail(r, &error);
    r->alive[r->alive_count++] = change.vertex;
    return 0;
}

static int edit_rebuild_remove(edit_rebuild *r)
{
    mw_error error;
    size_t i = (size_t)(dataset_unit(&r->random) * (double)r->alive_count);
    if (mw_edit_remove(r->editor, r->alive[i], NULL, &error) != MW_OK)
        return edit_rebuild_fail(r, &error);
    r->alive[i] = r->alive[--r->alive_count];
    return 0;
}

/* k edits: points inserted and vertices removed in turn; then the queries. */
static int edit_rebuild_run_leader(edit_rebuild *r, double *figures)
{
    int end = 0;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < r->stride && end == 0; i++)
        end = i % 2 ? edit_rebuild_remove(r) : edit_rebuild_insert(r);
    figures[EDITS_NS] = 1e9 * (monotonic_seconds() - clock);
    for (size_t i = 0; i < QUERIES && end == 0; i++)
        r->found[i] = mw_locate(mw_editor_locator(r->editor), &r->cursor, r->queries[2 * i],
                                r->queries[2 * i + 1]);
    figures[ALL_NS] = 1e9 * (monotonic_seconds() - clock);
    return end;
}

static int edit_rebuild_check_leader(const edit_rebuild *r)
{
    for (size_t i = 0; i < QUERIES; i++) {
        uint32_t v[3];
        double c[6];
        if (!mw_editor_triangle(r->editor, r->found[i].triangle, v)) continue;
        for (int k = 0; k < 3; k++) mw_editor_vertex(r->editor, v[k], c + 2 * k);
        if (engine_contains(c, c + 2, c + 4, r->queries + 2 * i)) continue;
        complain("%s: %.17g %.17g was found in a triangle that does not hold it", r->plan->name,
                 r->queries[2 * i], r->queries[2 * i + 1]);
        return END_RESOURCE;
    }
    return 0;
}

/* --- those that are rebuilt ------------------------------------------------------------------- */

static int edit_rebuild_take_arrays(edit_rebuild *r)
{
    mw_error error;
    mw_mesh *mesh;
    if (mw_editor_mesh(r->editor, NULL, NULL, &mesh, &error) != MW_OK)
        return edit_rebuild_fail(r, &error);
    uint32_t vertices = mw_mesh_vertex_count(mesh), triangles = mw_mesh_triangle_count(mesh);
    free(r->points);
    free(r->triangles);
    r->points = malloc(2 * (size_t)vertices * sizeof *r->points);
    r->triangles = malloc(3 * (size_t)triangles * sizeof *r->triangles);
    bool room = r->points && r->triangles;
    for (uint32_t i = 0; i < vertices && room; i++)
        mw_mesh_vertex(mesh, i, r->points + 2 * (size_t)i);
    for (uint32_t t = 0; t < triangles && room; t++)
        mw_mesh_triangle(mesh, t, r->triangles + 3 * (size_t)t);
    r->mesh = (engine_mesh){r->points, vertices, r->triangles, triangles};
    mw_mesh_destroy(mesh);
    return room ? 0 : fail_memory();
}

/* Answers that are no triangle with the point in it, or none where ours has
 * one. */
static double edit_rebuild_count_wrong(const edit_rebuild *r)
{
    double wrong = 0;
    for (size_t i = 0; i < QUERIES; i++) {
        const double *c[3];
        bool outside = r->answers[i] == ENGINE_NONE || r->answers[i] >= r->mesh.triangle_count;
        for (size_t k = 0; k < 3 && !outside; k++)
            c[k] = r->points + 2 * (size_t)r->triangles[3 * r->answers[i] + k];
        wrong += outside ? r->found[i].triangle != MW_NONE
                         : !engine_contains(c[0], c[1], c[2], r->queries + 2 * i);
    }
    return wrong;
}

static int edit_rebuild_run_rebuilt(edit_rebuild *r, size_t k, double *figures)
{
    const edit_engine *e = &edit_engines[r->id[k]];
    const engine_code *code = engine_code_of(e->engine);
    void *self;
    double build = code->structure->build(&r->mesh, 1, &self);
    double locate = self ? code->locate(self, r->queries, QUERIES, 1, r->answers) : ENGINE_FAILED;
    if (self) code->structure->destroy(self);
    figures[ALL_NS] = 1e9 * (build + locate);
    figures[EDITS_NS] = NAN;
    if (locate < 0) {
        complain("%s: %s has failed", r->plan->name, e->name);
        return END_RESOURCE;
    }
    r->wrong[k] = fmax(r->wrong[k], edit_rebuild_count_wrong(r));
    if (r->wrong[k] == 0 || !engines[e->engine].exact) return 0;
    complain("%s: %g answers of %s are wrong", r->plan->name, r->wrong[k], e->name);
    return END_RESOURCE;
}

/* --- rounds and rows -------------------------------------------------------------------------- */

/* A run of a round. Ours leads: it does the edits, and the others take the arrays that come of
 * them. */
static int edit_rebuild_run(void *self, size_t entry, size_t round, double *figures)
{
    (void)round;
    edit_rebuild *r = self;
    if (entry > 0) return edit_rebuild_run_rebuilt(r, entry, figures);
    dataset_draw(&r->data, r->queries, QUERIES, &r->random);
    int end = edit_rebuild_run_leader(r, figures);
    if (end == 0) end = edit_rebuild_check_leader(r);
    return end || r->count == 1 ? end : edit_rebuild_take_arrays(r);
}

static edit_row edit_rebuild_row(const edit_rebuild *r, size_t k)
{
    edit_row row = edit_row_of(r->plan, EDIT_TASK_REBUILD, edit_engines[r->id[k]].name);
    row.wrong = r->wrong[k];
    return row;
}

/* The number of edits that take as long as a rebuild, by what they took most of at a time: a row
 * without a ratio. */
static int edit_rebuild_add_break_even(const edit_rebuild *r, const rounds_results *results,
                                       edit_table *table)
{
    double each = rounds_median(results, 0, EDITS_NS) / (double)r->stride;
    double queries = rounds_median(results, 0, ALL_NS) - each * (double)r->stride;
    int end = 0;
    for (size_t k = 1; k < r->count && end == 0; k++) {
        edit_row row = edit_rebuild_row(r, k);
        row.edits = fmax(0, (rounds_median(results, k, ALL_NS) - queries) / each);
        end = edit_table_add(table, &row);
    }
    return end;
}

static int edit_rebuild_measure_stride(edit_rebuild *r, edit_table *table, bool last)
{
    rounds_results results;
    rounds_plan plan = {
        .entries = r->count, .leaders = 1, .figures = REBUILD_FIGURES, .rounds = r->plan->rounds};
    int end = rounds_measure(&plan, edit_rebuild_run, r, &results);
    for (size_t k = 0; k < r->count && end == 0; k++) {
        edit_row row = edit_rebuild_row(r, k);
        row.edits = (double)r->stride;
        row.ns = rounds_median(&results, k, ALL_NS);
        row.ratio = row.ns / rounds_median(&results, 0, ALL_NS);
        end = edit_table_add(table, &row);
    }
    if (end == 0 && last) end = edit_rebuild_add_break_even(r, &results, table);
    rounds_release(&results);
    return end;
}

static int edit_rebuild_prepare(edit_rebuild *r)
{
    mw_error error;
    mw_mesh *mesh;
    const edit_plan *p = r->plan;
    size_t most = 0;
    for (size_t i = 0; i < STRIDES; i++) most += p->rounds * ((strides[i] + 1) / 2);
    r->random = ~p->seed;
    if (!dataset_make(&r->data, p->kind, p->vertices + most, false, p->seed)) return fail_memory();
    r->fresh = p->vertices;
    r->alive = malloc((p->vertices + most) * sizeof *r->alive);
    if (!r->alive) return fail_memory();
    mw_delaunay_options one_thread = {.threads = 1};
    if (mw_delaunay(r->data.points, p->vertices, 2, &one_thread, NULL, NULL, &mesh, &error) !=
        MW_OK)
        return edit_rebuild_fail(r, &error);
    mw_status status =
        mw_editor_create(mesh, &(mw_editor_options){.threads = 1}, &r->editor, &error);
    mw_mesh_destroy(mesh);
    if (status != MW_OK) return edit_rebuild_fail(r, &error);
    for (; r->alive_count < p->vertices; r->alive_count++)
        r->alive[r->alive_count] = (uint32_t)r->alive_count;
    return mw_cursor_init(mw_editor_locator(r->editor), NULL, &r->cursor, &error) == MW_OK
               ? 0
               : edit_rebuild_fail(r, &error);
}

int edit_rebuild_measure(const edit_plan *p, edit_table *table)
{
    edit_rebuild *r = calloc(1, sizeof *r);
    if (!r) return fail_memory();
    r->plan = p;
    r->id[r->count++] = EDIT_ENGINE_MESHWALK;
    for (edit_engine_id id = 0; id < EDIT_ENGINES; id++)
        if (edit_engine_is_in(p->engines, id) && !edit_engines[id].follows) r->id[r->count++] = id;
    progress_phase("building anew", p->name);
    int end = edit_rebuild_prepare(r);
    for (size_t i = 0; i < STRIDES && end == 0 && strides[i] <= p->vertices; i++) {
        r->stride = strides[i];
        end =
            edit_rebuild_measure_stride(r, table, i + 1 == STRIDES || strides[i + 1] > p->vertices);
    }
    mw_editor_destroy(r->editor);
    dataset_release(&r->data);
    free(r->alive);
    free(r->points);
    free(r->triangles);
    free(r);
    return end;
}
