#include "bench/edits/edit_script.h"
#include "bench/edits/triangle_hash.h"
#include "cli/frame/message.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *edit_task_name(edit_task task)
{
    static const char *const names[EDIT_TASKS] = {
        [EDIT_TASK_INSERT] = "insert",
        [EDIT_TASK_INSERT_SORTED] = "insert-sorted",
        [EDIT_TASK_INSERT_MANY] = "insert-many",
        [EDIT_TASK_INSERT_MANY_SORTED] = "insert-many-sorted",
        [EDIT_TASK_REMOVE] = "remove",
        [EDIT_TASK_MOVE_NEAR] = "move-near",
        [EDIT_TASK_MOVE_FAR] = "move-far",
        [EDIT_TASK_MIXED] = "mixed",
        [EDIT_TASK_REBUILD] = "rebuild",
        [EDIT_TASK_AGING] = "session",
    };
    return names[task];
}

/* --- the parts of a script -------------------------------------------------------------------- */

/* Points and random numbers to make a script of. */
typedef struct script_maker {
    edit_script *s;
    dataset data;    /* the points, then as many as there are steps */
    uint32_t *alive; /* numbers of the vertices that are there      */
    size_t alive_count;
    double *reach; /* per point: the mean length of its edges     */
    uint64_t random;
} script_maker;

static int script_fail(const mw_error *error)
{
    return fail_mesh("the points of a script", error);
}

static size_t script_maker_below(script_maker *m, size_t n)
{
    return (size_t)(dataset_unit(&m->random) * (double)n);
}

static void script_maker_add(script_maker *m, edit_step_kind kind, uint32_t vertex,
                             const double *point)
{
    edit_step *step = &m->s->steps[m->s->count++];
    *step = (edit_step){.kind = kind, .vertex = vertex};
    if (point) memcpy(step->point, point, sizeof step->point);
    if (kind == EDIT_STEP_INSERT)
        m->alive[m->alive_count++] = (uint32_t)(m->s->point_count + m->s->inserted++);
    if (kind == EDIT_STEP_LOCATE) m->s->located++;
}

/* A point that is not there yet. */
static const double *script_maker_point(const script_maker *m, size_t i)
{
    return m->data.points + 2 * (m->s->point_count + i);
}

static void script_maker_add_removal(script_maker *m)
{
    size_t i = script_maker_below(m, m->alive_count);
    script_maker_add(m, EDIT_STEP_REMOVE, m->alive[i], NULL);
    m->alive[i] = m->alive[--m->alive_count];
}

static void script_maker_add_move(script_maker *m, size_t i, bool near)
{
    uint32_t v = (uint32_t)script_maker_below(m, m->s->point_count);
    if (!near) {
        script_maker_add(m, EDIT_STEP_MOVE, v, script_maker_point(m, i));
        return;
    }
    double angle = 4 * acos(0) * dataset_unit(&m->random), *p = m->data.points + 2 * (size_t)v;
    p[0] += m->reach[v] / 10 * cos(angle);
    p[1] += m->reach[v] / 10 * sin(angle);
    script_maker_add(m, EDIT_STEP_MOVE, v, p);
}

static void script_maker_add_mixed(script_maker *m, size_t i)
{
    double point[2];
    if (i % 3 == 0) script_maker_add(m, EDIT_STEP_INSERT, 0, script_maker_point(m, i));
    if (i % 3 == 1) script_maker_add_removal(m);
    if (i % 3 == 2) {
        dataset_draw(&m->data, point, 1, &m->random);
        script_maker_add(m, EDIT_STEP_LOCATE, 0, point);
    }
}

/* --- what only some tasks need ---------------------------------------------------------------- */

/* Put the points to be inserted in order: that of the vertices of their own
 * triangulation along a Hilbert curve. */
static int script_maker_sort_points(script_maker *m, size_t count)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    double *points = m->data.points + 2 * m->s->point_count,
           *sorted = malloc(2 * count * sizeof *sorted);
    uint32_t *order = malloc(count * sizeof *order);
    int end = sorted && order ? 0 : fail_memory();
    if (end == 0 && (mw_delaunay(points, count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK ||
                     mw_mesh_hilbert_order(mesh, NULL, order, &error) != MW_OK))
        end = script_fail(&error);
    for (size_t i = 0; i < count && end == 0; i++)
        memcpy(sorted + 2 * i, points + 2 * (size_t)order[i], 2 * sizeof *sorted);
    if (end == 0) memcpy(points, sorted, 2 * count * sizeof *sorted);
    mw_mesh_destroy(mesh);
    free(order);
    free(sorted);
    return end;
}

static void script_maker_measure_edges(script_maker *m, const mw_mesh *mesh, uint32_t *edges)
{
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) {
            const double *a = m->data.points + 2 * (size_t)v[k],
                         *b = m->data.points + 2 * (size_t)v[(k + 1) % 3];
            double length = hypot(b[0] - a[0], b[1] - a[1]);
            m->reach[v[k]] += length;
            m->reach[v[(k + 1) % 3]] += length;
            edges[v[k]]++;
            edges[v[(k + 1) % 3]]++;
        }
    }
    for (size_t i = 0; i < m->s->point_count; i++) m->reach[i] /= edges[i] ? edges[i] : 1;
}

static int script_maker_find_reach(script_maker *m)
{
    mw_error error;
    mw_mesh *mesh;
    if (mw_delaunay(m->data.points, m->s->point_count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK)
        return script_fail(&error);
    uint32_t *edges = calloc(m->s->point_count, sizeof *edges);
    m->reach = calloc(m->s->point_count, sizeof *m->reach);
    if (edges && m->reach) script_maker_measure_edges(m, mesh, edges);
    mw_mesh_destroy(mesh);
    free(edges);
    return edges && m->reach ? 0 : fail_memory();
}

/* --- scripts ---------------------------------------------------------------------------------- */

static void script_maker_add_steps(script_maker *m, edit_task task, size_t steps)
{
    for (size_t i = 0; i < steps; i++) {
        switch (task) {
        case EDIT_TASK_REMOVE: script_maker_add_removal(m); break;
        case EDIT_TASK_MOVE_NEAR: script_maker_add_move(m, i, true); break;
        case EDIT_TASK_MOVE_FAR: script_maker_add_move(m, i, false); break;
        case EDIT_TASK_MIXED: script_maker_add_mixed(m, i); break;
        default: script_maker_add(m, EDIT_STEP_INSERT, 0, script_maker_point(m, i));
        }
    }
}

static int script_maker_make(script_maker *m, edit_task task, size_t steps)
{
    edit_script *s = m->s;
    s->points = malloc(2 * s->point_count * sizeof *s->points);
    s->steps = malloc(steps * sizeof *s->steps);
    m->alive = malloc((s->point_count + steps) * sizeof *m->alive);
    if (!s->points || !s->steps || !m->alive) return fail_memory();
    memcpy(s->points, m->data.points, 2 * s->point_count * sizeof *s->points);
    for (; m->alive_count < s->point_count; m->alive_count++)
        m->alive[m->alive_count] = (uint32_t)m->alive_count;
    s->hinted = task == EDIT_TASK_INSERT_SORTED || task == EDIT_TASK_INSERT_MANY_SORTED;
    s->at_once = task == EDIT_TASK_INSERT_MANY || task == EDIT_TASK_INSERT_MANY_SORTED;
    int end = s->hinted                     ? script_maker_sort_points(m, steps)
              : task == EDIT_TASK_MOVE_NEAR ? script_maker_find_reach(m)
                                            : 0;
    if (end == 0) script_maker_add_steps(m, task, steps);
    return end;
}

int edit_script_make(edit_script *s, edit_task task, dataset_kind kind, size_t n, size_t steps,
                     uint64_t seed)
{
    script_maker m = {.s = s, .random = ~seed};
    *s = (edit_script){.point_count = n};
    int end = dataset_make(&m.data, kind, n + steps, false, seed)
                  ? script_maker_make(&m, task, steps)
                  : fail_memory();
    dataset_release(&m.data);
    free(m.alive);
    free(m.reach);
    return end;
}

void edit_script_release(edit_script *s)
{
    free(s->points);
    free(s->steps);
    *s = (edit_script){0};
}

/* --- what has to come of it ------------------------------------------------------------------- */

/* The points that are there at the end: coordinates of all that ever were, and
 * which of them are gone. Returns how many are left. */
static size_t edit_script_play(const edit_script *s, double *points, bool *gone)
{
    size_t count = s->point_count, left = 0;
    memcpy(points, s->points, 2 * count * sizeof *points);
    for (size_t i = 0; i < s->count; i++) {
        const edit_step *step = &s->steps[i];
        if (step->kind == EDIT_STEP_INSERT)
            memcpy(points + 2 * count++, step->point, sizeof step->point);
        if (step->kind == EDIT_STEP_MOVE)
            memcpy(points + 2 * (size_t)step->vertex, step->point, sizeof step->point);
        if (step->kind == EDIT_STEP_REMOVE) gone[step->vertex] = true;
    }
    for (size_t i = 0; i < count; i++)
        if (!gone[i]) memmove(points + 2 * left++, points + 2 * i, 2 * sizeof *points);
    return left;
}

int edit_script_expect(const edit_script *s, uint64_t *hash)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    size_t most = s->point_count + s->inserted;
    double *points = malloc(2 * most * sizeof *points);
    bool *gone = calloc(most, sizeof *gone);
    int end = points && gone ? 0 : fail_memory();
    if (end == 0 && mw_delaunay(points, edit_script_play(s, points, gone), 2, NULL, NULL, NULL,
                                &mesh, &error) != MW_OK)
        end = script_fail(&error);
    *hash = 0;
    for (uint32_t t = 0; end == 0 && t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3];
        double corners[6];
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], corners + 2 * k);
        *hash += triangle_hash(corners);
    }
    mw_mesh_destroy(mesh);
    free(gone);
    free(points);
    return end;
}
