#include "bench/edits/script.h"
#include "cli/frame/message.h"

#include <meshwalk/meshwalk.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- the parts of a script
 * ---------------------------------------------------------------------------------------
 */

/* Points and random numbers to make a script of. */
typedef struct maker {
    script *s;
    dataset data;    /* the points, then as many as there are steps */
    uint32_t *alive; /* numbers of the vertices that are there      */
    size_t alive_count;
    double *reach; /* per point: the mean length of its edges     */
    uint64_t random;
} maker;

static int fail(const mw_error *error)
{
    return fail_mesh("the points of a script", error);
}

static size_t below(maker *m, size_t n)
{
    return (size_t)(dataset_unit(&m->random) * (double)n);
}

static void add(maker *m, script_kind kind, uint32_t vertex, const double *point)
{
    script_step *step = &m->s->steps[m->s->count++];
    *step = (script_step){.kind = kind, .vertex = vertex};
    if (point) memcpy(step->point, point, sizeof step->point);
    if (kind == SCRIPT_INSERT) m->alive[m->alive_count++] = (uint32_t)(m->s->point_count + m->s->inserted++);
    if (kind == SCRIPT_LOCATE) m->s->located++;
}

/* A point that is not there yet. */
static const double *fresh(const maker *m, size_t i)
{
    return m->data.points + 2 * (m->s->point_count + i);
}

static void add_removal(maker *m)
{
    size_t i = below(m, m->alive_count);
    add(m, SCRIPT_REMOVE, m->alive[i], NULL);
    m->alive[i] = m->alive[--m->alive_count];
}

static void add_move(maker *m, size_t i, bool near)
{
    uint32_t v = (uint32_t)below(m, m->s->point_count);
    if (!near) {
        add(m, SCRIPT_MOVE, v, fresh(m, i));
        return;
    }
    double angle = 4 * acos(0) * dataset_unit(&m->random), *p = m->data.points + 2 * (size_t)v;
    p[0] += m->reach[v] / 10 * cos(angle);
    p[1] += m->reach[v] / 10 * sin(angle);
    add(m, SCRIPT_MOVE, v, p);
}

static void add_mixed(maker *m, size_t i)
{
    double place[2];
    if (i % 3 == 0) add(m, SCRIPT_INSERT, 0, fresh(m, i));
    if (i % 3 == 1) add_removal(m);
    if (i % 3 == 2) {
        dataset_draw(&m->data, place, 1, &m->random);
        add(m, SCRIPT_LOCATE, 0, place);
    }
}

/* --- what only some tasks need
 * -----------------------------------------------------------------------------------
 */

/* Put the points to be inserted in order: that of the vertices of their own
 * triangulation along a Hilbert curve. */
static int sort_fresh(maker *m, size_t count)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    double *points = m->data.points + 2 * m->s->point_count, *sorted = malloc(2 * count * sizeof *sorted);
    uint32_t *order = malloc(count * sizeof *order);
    int end = sorted && order ? 0 : fail_memory();
    if (end == 0 && (mw_delaunay(points, count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK ||
                     mw_mesh_hilbert_order(mesh, NULL, order, &error) != MW_OK))
        end = fail(&error);
    for (size_t i = 0; i < count && end == 0; i++)
        memcpy(sorted + 2 * i, points + 2 * (size_t)order[i], 2 * sizeof *sorted);
    if (end == 0) memcpy(points, sorted, 2 * count * sizeof *sorted);
    mw_mesh_destroy(mesh);
    free(order);
    free(sorted);
    return end;
}

static void reach_of_mesh(maker *m, const mw_mesh *mesh, uint32_t *edges)
{
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) {
            const double *a = m->data.points + 2 * (size_t)v[k], *b = m->data.points + 2 * (size_t)v[(k + 1) % 3];
            double length = hypot(b[0] - a[0], b[1] - a[1]);
            m->reach[v[k]] += length;
            m->reach[v[(k + 1) % 3]] += length;
            edges[v[k]]++;
            edges[v[(k + 1) % 3]]++;
        }
    }
    for (size_t i = 0; i < m->s->point_count; i++) m->reach[i] /= edges[i] ? edges[i] : 1;
}

static int find_reach(maker *m)
{
    mw_error error;
    mw_mesh *mesh;
    if (mw_delaunay(m->data.points, m->s->point_count, 2, NULL, NULL, NULL, &mesh, &error) != MW_OK)
        return fail(&error);
    uint32_t *edges = calloc(m->s->point_count, sizeof *edges);
    m->reach = calloc(m->s->point_count, sizeof *m->reach);
    if (edges && m->reach) reach_of_mesh(m, mesh, edges);
    mw_mesh_destroy(mesh);
    free(edges);
    return edges && m->reach ? 0 : fail_memory();
}

/* --- scripts
 * -----------------------------------------------------------------------------------------------------
 */

static void write_steps(maker *m, editing_task task, size_t steps)
{
    for (size_t i = 0; i < steps; i++) {
        switch (task) {
        case EDITING_REMOVE: add_removal(m); break;
        case EDITING_MOVE_NEAR: add_move(m, i, true); break;
        case EDITING_MOVE_FAR: add_move(m, i, false); break;
        case EDITING_MIXED: add_mixed(m, i); break;
        default: add(m, SCRIPT_INSERT, 0, fresh(m, i));
        }
    }
}

static int make(maker *m, editing_task task, size_t steps)
{
    script *s = m->s;
    s->points = malloc(2 * s->point_count * sizeof *s->points);
    s->steps = malloc(steps * sizeof *s->steps);
    m->alive = malloc((s->point_count + steps) * sizeof *m->alive);
    if (!s->points || !s->steps || !m->alive) return fail_memory();
    memcpy(s->points, m->data.points, 2 * s->point_count * sizeof *s->points);
    for (; m->alive_count < s->point_count; m->alive_count++) m->alive[m->alive_count] = (uint32_t)m->alive_count;
    s->hinted = task == EDITING_INSERT_SORTED || task == EDITING_INSERT_MANY_SORTED;
    s->at_once = task == EDITING_INSERT_MANY || task == EDITING_INSERT_MANY_SORTED;
    int end = s->hinted ? sort_fresh(m, steps) : task == EDITING_MOVE_NEAR ? find_reach(m) : 0;
    if (end == 0) write_steps(m, task, steps);
    return end;
}

int script_make(script *s, editing_task task, dataset_kind kind, size_t n, size_t steps, uint64_t seed)
{
    maker m = {.s = s, .random = ~seed};
    *s = (script){.point_count = n};
    int end = dataset_make(&m.data, kind, n + steps, false, seed) ? make(&m, task, steps) : fail_memory();
    dataset_release(&m.data);
    free(m.alive);
    free(m.reach);
    return end;
}

void script_release(script *s)
{
    free(s->points);
    free(s->steps);
    *s = (script){0};
}

/* --- what has to come of it
 * --------------------------------------------------------------------------------------
 */

/* The points that are there at the end: coordinates of all that ever were, and
 * which of them are gone. Returns how many are left. */
static size_t play(const script *s, double *points, bool *gone)
{
    size_t count = s->point_count, left = 0;
    memcpy(points, s->points, 2 * count * sizeof *points);
    for (size_t i = 0; i < s->count; i++) {
        const script_step *step = &s->steps[i];
        if (step->kind == SCRIPT_INSERT) memcpy(points + 2 * count++, step->point, sizeof step->point);
        if (step->kind == SCRIPT_MOVE) memcpy(points + 2 * (size_t)step->vertex, step->point, sizeof step->point);
        if (step->kind == SCRIPT_REMOVE) gone[step->vertex] = true;
    }
    for (size_t i = 0; i < count; i++)
        if (!gone[i]) memmove(points + 2 * left++, points + 2 * i, 2 * sizeof *points);
    return left;
}

int script_expect(const script *s, uint64_t *sum)
{
    mw_error error;
    mw_mesh *mesh = NULL;
    size_t most = s->point_count + s->inserted;
    double *points = malloc(2 * most * sizeof *points);
    bool *gone = calloc(most, sizeof *gone);
    int end = points && gone ? 0 : fail_memory();
    if (end == 0 && mw_delaunay(points, play(s, points, gone), 2, NULL, NULL, NULL, &mesh, &error) != MW_OK)
        end = fail(&error);
    *sum = 0;
    for (uint32_t t = 0; end == 0 && t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3];
        double corners[6];
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], corners + 2 * k);
        *sum += editing_sum(corners);
    }
    mw_mesh_destroy(mesh);
    free(gone);
    free(points);
    return end;
}
