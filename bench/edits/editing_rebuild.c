/* bench edit, rebuild: a triangulation is edited, and after every k edits a
 * thousand places are located: by walks in what has been edited, or by a tree
 * that is built anew from its arrays. What the edits take is counted for those
 * who follow them only: somebody has to make them for the others, too. */
#include "bench/edits/editings.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "bench/core/rounds.h"
#include "cli/frame/monotonic_clock.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUERIES 1000
static const size_t strides[] = {1, 10, 100, 1000, 10000, 100000};
#define STRIDES (sizeof strides / sizeof *strides)

typedef struct rebuild {
    const editing_plan *plan;
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
    editor_id id[EDITORS];
    double *times[EDITORS];
    double wrong[EDITORS];
    size_t count;
    double *edit_times; /* of the edits of a round */
} rebuild;

/* --- ours
 * --------------------------------------------------------------------------------------------------------
 */

static int fail(const rebuild *r, const mw_error *error)
{
    return fail_mesh(r->plan->name, error);
}

static int insert_one(rebuild *r)
{
    mw_error error;
    mw_change change;
    const double *p = r->data.points + 2 * r->fresh++;
    if (mw_edit_insert(r->editor, p[0], p[1], &change, &error) != MW_OK) return fail(r, &error);
    r->alive[r->alive_count++] = change.vertex;
    return 0;
}

static int remove_one(rebuild *r)
{
    mw_error error;
    size_t i = (size_t)(dataset_unit(&r->random) * (double)r->alive_count);
    if (mw_edit_remove(r->editor, r->alive[i], NULL, &error) != MW_OK) return fail(r, &error);
    r->alive[i] = r->alive[--r->alive_count];
    return 0;
}

/* k edits: points inserted and vertices removed in turn; then the places. */
static int run_own(rebuild *r, double *edits, double *all)
{
    int end = 0;
    double clock = monotonic_seconds();
    for (size_t i = 0; i < r->stride && end == 0; i++) end = i % 2 ? remove_one(r) : insert_one(r);
    *edits = monotonic_seconds() - clock;
    for (size_t i = 0; i < QUERIES && end == 0; i++)
        r->found[i] = mw_locate(mw_editor_locator(r->editor), &r->cursor, r->queries[2 * i], r->queries[2 * i + 1]);
    *all = monotonic_seconds() - clock;
    return end;
}

static int check_own(const rebuild *r)
{
    for (size_t i = 0; i < QUERIES; i++) {
        uint32_t v[3];
        double c[6];
        if (!mw_editor_triangle(r->editor, r->found[i].triangle, v)) continue;
        for (int k = 0; k < 3; k++) mw_editor_vertex(r->editor, v[k], c + 2 * k);
        if (engine_contains(c, c + 2, c + 4, r->queries + 2 * i)) continue;
        complain("%s: %.17g %.17g was found in a triangle that does not hold it", r->plan->name, r->queries[2 * i],
                 r->queries[2 * i + 1]);
        return END_RESOURCE;
    }
    return 0;
}

/* --- those that are built anew
 * -----------------------------------------------------------------------------------
 */

static int take_arrays(rebuild *r)
{
    mw_error error;
    mw_mesh *mesh;
    if (mw_editor_mesh(r->editor, NULL, NULL, &mesh, &error) != MW_OK) return fail(r, &error);
    uint32_t vertices = mw_mesh_vertex_count(mesh), triangles = mw_mesh_triangle_count(mesh);
    free(r->points);
    free(r->triangles);
    r->points = malloc(2 * (size_t)vertices * sizeof *r->points);
    r->triangles = malloc(3 * (size_t)triangles * sizeof *r->triangles);
    bool room = r->points && r->triangles;
    for (uint32_t i = 0; i < vertices && room; i++) mw_mesh_vertex(mesh, i, r->points + 2 * (size_t)i);
    for (uint32_t t = 0; t < triangles && room; t++) mw_mesh_triangle(mesh, t, r->triangles + 3 * (size_t)t);
    r->mesh = (engine_mesh){r->points, vertices, r->triangles, triangles};
    mw_mesh_destroy(mesh);
    return room ? 0 : fail_memory();
}

/* Answers that are no triangle with the place in it, or none where ours has
 * one. */
static double count_wrong(const rebuild *r)
{
    double wrong = 0;
    for (size_t i = 0; i < QUERIES; i++) {
        const double *c[3];
        bool outside = r->answers[i] == ENGINE_NONE || r->answers[i] >= r->mesh.triangle_count;
        for (size_t k = 0; k < 3 && !outside; k++) c[k] = r->points + 2 * (size_t)r->triangles[3 * r->answers[i] + k];
        wrong += outside ? r->found[i].triangle != MW_NONE : !engine_contains(c[0], c[1], c[2], r->queries + 2 * i);
    }
    return wrong;
}

static int run_anew(rebuild *r, size_t k, double *time)
{
    const contender *e = &editors[r->id[k]];
    const engine_code *code = engines_code(e->engine);
    void *self;
    double build = code->structure->build(&r->mesh, 1, &self);
    double locate = self ? code->locate(self, r->queries, QUERIES, 1, r->answers) : ENGINE_FAILED;
    if (self) code->structure->destroy(self);
    *time = build + locate;
    if (locate < 0) {
        complain("%s: %s has failed", r->plan->name, e->name);
        return END_RESOURCE;
    }
    r->wrong[k] = fmax(r->wrong[k], count_wrong(r));
    if (r->wrong[k] == 0 || !engines[e->engine].exact) return 0;
    complain("%s: %g answers of %s are wrong", r->plan->name, r->wrong[k], e->name);
    return END_RESOURCE;
}

/* --- rounds and rows
 * ---------------------------------------------------------------------------------------------
 */

/* Contestant 0 is ours, which does the edits; the others take turns. */
static int run_round(rebuild *r, size_t round)
{
    size_t others = r->count - 1;
    dataset_draw(&r->data, r->queries, QUERIES, &r->random);
    int end = run_own(r, &r->edit_times[round], &r->times[0][round]);
    if (end == 0) end = check_own(r);
    if (end == 0 && others) end = take_arrays(r);
    for (size_t k = 0; k < others && end == 0; k++) {
        size_t turn = 1 + (k + round) % others;
        end = run_anew(r, turn, &r->times[turn][round]);
    }
    return end;
}

static int add_row(const rebuild *r, size_t k, double edits, double ns, double ratio, editing_table *table)
{
    editing_row row = editings_row(r->plan, EDITING_REBUILD, editors[r->id[k]].name);
    row.edits = edits;
    row.ns = ns;
    row.ratio = ratio;
    row.wrong = r->wrong[k];
    return editings_add(table, &row);
}

/* The number of edits that take as long as building anew, by what they took
 * most of at a time: a row without a ratio. */
static int add_break_even(const rebuild *r, const double *medians, double each, editing_table *table)
{
    int end = 0;
    double queries = medians[0] - each * (double)r->stride;
    for (size_t k = 1; k < r->count && end == 0; k++)
        end = add_row(r, k, fmax(0, (medians[k] - queries) / each), NAN, NAN, table);
    return end;
}

static int run_stride(rebuild *r, editing_table *table, bool last)
{
    double medians[EDITORS];
    int end = 0;
    for (size_t round = 0; round < r->plan->rounds && end == 0; round++) end = run_round(r, round);
    for (size_t k = 0; k < r->count && end == 0; k++) {
        medians[k] = 1e9 * rounds_median(r->times[k], r->plan->rounds);
        end = add_row(r, k, (double)r->stride, medians[k], medians[k] / medians[0], table);
    }
    if (end || !last) return end;
    return add_break_even(r, medians, 1e9 * rounds_median(r->edit_times, r->plan->rounds) / (double)r->stride, table);
}

static int prepare(rebuild *r)
{
    mw_error error;
    mw_mesh *mesh;
    const editing_plan *p = r->plan;
    size_t most = 0;
    for (size_t i = 0; i < STRIDES; i++) most += p->rounds * ((strides[i] + 1) / 2);
    r->random = ~p->seed;
    if (!dataset_make(&r->data, p->kind, p->vertices + most, false, p->seed)) return fail_memory();
    r->fresh = p->vertices;
    r->alive = malloc((p->vertices + most) * sizeof *r->alive);
    r->edit_times = malloc(p->rounds * sizeof *r->edit_times);
    bool room = r->alive && r->edit_times;
    for (size_t k = 0; k < r->count; k++) room &= (r->times[k] = malloc(p->rounds * sizeof(double))) != NULL;
    if (!room) return fail_memory();
    mw_delaunay_options one_thread = {.threads = 1};
    if (mw_delaunay(r->data.points, p->vertices, 2, &one_thread, NULL, NULL, &mesh, &error) != MW_OK)
        return fail(r, &error);
    mw_status status = mw_editor_create(mesh, &(mw_editor_options){.threads = 1}, &r->editor, &error);
    mw_mesh_destroy(mesh);
    if (status != MW_OK) return fail(r, &error);
    for (; r->alive_count < p->vertices; r->alive_count++) r->alive[r->alive_count] = (uint32_t)r->alive_count;
    return mw_cursor_init(mw_editor_locator(r->editor), NULL, &r->cursor, &error) == MW_OK ? 0 : fail(r, &error);
}

int editings_rebuild(const editing_plan *p, editing_table *table)
{
    rebuild *r = calloc(1, sizeof *r);
    if (!r) return fail_memory();
    r->plan = p;
    r->id[r->count++] = EDITOR_OWN;
    for (editor_id id = 0; id < EDITORS; id++)
        if (p->editors >> id & 1 && !editors[id].edits) r->id[r->count++] = id;
    progress_phase("building anew", p->name);
    int end = prepare(r);
    for (size_t i = 0; i < STRIDES && end == 0 && strides[i] <= p->vertices; i++) {
        r->stride = strides[i];
        end = run_stride(r, table, i + 1 == STRIDES || strides[i + 1] > p->vertices);
    }
    mw_editor_destroy(r->editor);
    dataset_release(&r->data);
    for (size_t k = 0; k < r->count; k++) free(r->times[k]);
    free(r->edit_times);
    free(r->alive);
    free(r->points);
    free(r->triangles);
    free(r);
    return end;
}
