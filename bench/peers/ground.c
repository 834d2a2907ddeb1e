#include "bench/peers/ground.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int fail(const ground *g, const mw_error *error)
{
    return fail_mesh(g->name, error);
}

/* --- the mesh ---------------------------------------------------------------------------------------------------- */

static int prepare(ground *g)
{
    mw_error error;
    if (mw_locator_create(g->drawn_in, NULL, &g->locator, &error) != MW_OK) return fail(g, &error);
    g->mesh.points = g->points;
    g->mesh.triangles = g->triangles;
    return 0;
}

static int take_triangles(ground *g)
{
    size_t count = mw_mesh_triangle_count(g->drawn_in);
    g->triangles = malloc(3 * count * sizeof *g->triangles);
    if (!g->triangles) return fail_memory();
    for (size_t t = 0; t < count; t++) mw_mesh_triangle(g->drawn_in, (uint32_t)t, g->triangles + 3 * t);
    g->mesh.triangle_count = count;
    return prepare(g);
}

int ground_of_points(ground *g, const char *name, dataset *data, uint64_t seed)
{
    mw_error error;
    *g = (ground){.name = name, .points = data->points, .domain = *data, .seed = seed};
    g->mesh.point_count = data->count;
    data->points = g->domain.points = NULL;
    progress_phase("triangulating", name);
    if (mw_delaunay(g->points, data->count, 2, NULL, NULL, NULL, &g->drawn_in, &error) != MW_OK) return fail(g, &error);
    return take_triangles(g);
}

int ground_of_mesh(ground *g, const char *name, const mw_mesh_file *file, uint64_t seed)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    *g = (ground){.name = name, .seed = seed};
    g->points = malloc(2 * (file->point_count + 1) * sizeof *g->points);
    if (!g->points) return fail_memory();
    for (size_t i = 0; i < file->point_count; i++) memcpy(g->points + 2 * i, file->points + 3 * i, 2 * sizeof(double));
    g->mesh.point_count = file->point_count;
    g->domain = (dataset){.points = g->points, .count = file->point_count};
    bool fits = dataset_bound(&g->domain, file->point_count);
    g->domain.points = NULL;
    if (!fits) {
        complain("%s: the extent of the points is too large for a double", name);
        return END_INPUT;
    }
    progress_phase("linking", name);
    if (mw_mesh_create(&arrays, NULL, &g->drawn_in, &error) != MW_OK) return fail(g, &error);
    return take_triangles(g);
}

static void forget_drawing(ground *g)
{
    mw_locator_destroy(g->locator);
    mw_mesh_destroy(g->drawn_in);
    g->locator = NULL;
    g->drawn_in = NULL;
}

void ground_release(ground *g)
{
    forget_drawing(g);
    for (engine_task task = 0; task < TASKS; task++) {
        free(g->courses[task].queries);
        free(g->courses[task].inside);
    }
    free(g->points);
    free(g->triangles);
    *g = (ground){0};
}

/* --- queries ----------------------------------------------------------------------------------------------------- */

#define BLOCK ((size_t)1 << 16)

static int locate(const ground *g, const double *queries, size_t n, mw_location *found)
{
    mw_error error;
    mw_query_options options = {.seed = g->seed};
    return mw_locate_batch(g->locator, queries, n, 2, &options, found, NULL, &error) == MW_OK ? 0 : fail(g, &error);
}

/* A point of a random triangle, uniform in it up to rounding. */
static void draw_dense(ground *g, double *query)
{
    const uint32_t *v = g->triangles + 3 * (size_t)(dataset_unit(&g->random) * (double)g->mesh.triangle_count);
    double s = dataset_unit(&g->random), t = dataset_unit(&g->random);
    if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
    }
    const double *a = g->points + 2 * (size_t)v[0], *b = g->points + 2 * (size_t)v[1],
                 *c = g->points + 2 * (size_t)v[2];
    for (size_t k = 0; k < 2; k++) query[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]);
}

/* How queries are proposed, and which of them are taken. */
typedef struct wish {
    const dataset *domain; /* uniform in it; NULL: dense */
    bool outside;
} wish;

static void propose(ground *g, const wish *w, double *queries, size_t n)
{
    if (w->domain)
        dataset_draw(w->domain, queries, n, &g->random);
    else
        for (size_t i = 0; i < n; i++) draw_dense(g, queries + 2 * i);
}

/* So many drawn in vain, beyond a thousand for each found, are no accident. */
#define DRAWN_IN_VAIN 1000000

static int draw_wish(ground *g, const wish *w, double *queries, size_t n)
{
    size_t found = 0, drawn = 0;
    mw_location *locations = malloc(BLOCK * sizeof *locations);
    int end = locations ? 0 : fail_memory();
    while (end == 0 && found < n) {
        size_t more = n - found < BLOCK ? n - found : BLOCK;
        double *new = queries + 2 * found;
        propose(g, w, new, more);
        end = locate(g, new, more, locations);
        for (size_t i = 0; i < more && end == 0; i++)
            if ((locations[i].triangle == MW_NONE) == w->outside)
                memmove(queries + 2 * found++, new + 2 * i, 2 * sizeof *new);
        drawn += more;
        if (end == 0 && drawn > 1000 * found + DRAWN_IN_VAIN) {
            complain("%s: the mesh fills less than a thousandth of the extent of its points", g->name);
            end = END_INPUT;
        }
    }
    free(locations);
    return end;
}

static int draw_inside(ground *g, double *queries, size_t n)
{
    return draw_wish(g, &(wish){.domain = &g->domain}, queries, n);
}

/* Outside is what a domain twice as wide and high, about the same middle, has beside the mesh, its holes too. */
static int draw_half_outside(ground *g, double *queries, size_t n)
{
    dataset wide = g->domain;
    for (size_t k = 0; k < 2; k++) {
        wide.origin[k] -= g->domain.u[k] / 2 + g->domain.v[k] / 2;
        wide.u[k] *= 2;
        wide.v[k] *= 2;
    }
    int end = draw_inside(g, queries, n / 2);
    if (end == 0) end = draw_wish(g, &(wish){.domain = &wide, .outside = true}, queries + 2 * (n / 2), n - n / 2);
    for (size_t i = n; i > 1 && end == 0; i--) {
        double other[2], *a = queries + 2 * (i - 1);
        double *b = queries + 2 * (size_t)(dataset_unit(&g->random) * (double)i);
        memcpy(other, a, sizeof other);
        memcpy(a, b, sizeof other);
        memcpy(b, other, sizeof other);
    }
    return end;
}

/* A query and the place of its triangle along a Hilbert curve. */
typedef struct placed {
    double query[2];
    uint32_t place;
} placed;

static int compare_places(const void *one, const void *other)
{
    uint32_t a = ((const placed *)one)->place, b = ((const placed *)other)->place;
    return (a > b) - (a < b);
}

/* The place of each triangle along the curve; NULL after a complaint. */
static uint32_t *places(const ground *g)
{
    mw_error error;
    size_t count = g->mesh.triangle_count;
    uint32_t *order = malloc(count * sizeof *order), *place = malloc(count * sizeof *place);
    if (!order || !place)
        fail_memory();
    else if (mw_mesh_hilbert_order(g->drawn_in, order, NULL, &error) != MW_OK)
        fail(g, &error);
    else {
        for (size_t i = 0; i < count; i++) place[order[i]] = (uint32_t)i;
        free(order);
        return place;
    }
    free(order);
    free(place);
    return NULL;
}

static int draw_sorted(ground *g, double *queries, size_t n)
{
    uint32_t *place = places(g);
    mw_location *found = malloc(n * sizeof *found);
    placed *all = malloc(n * sizeof *all);
    int end = !place ? END_RESOURCE : found && all ? draw_inside(g, queries, n) : fail_memory();
    if (end == 0) end = locate(g, queries, n, found);
    for (size_t i = 0; i < n && end == 0; i++)
        all[i] = (placed){{queries[2 * i], queries[2 * i + 1]}, place[found[i].triangle]};
    if (end == 0) {
        qsort(all, n, sizeof *all, compare_places);
        for (size_t i = 0; i < n; i++) memcpy(queries + 2 * i, all[i].query, 2 * sizeof *queries);
    }
    free(place);
    free(found);
    free(all);
    return end;
}

/* The mean length of a triangle's edges. */
static double edge_length(const ground *g, uint32_t triangle)
{
    double sum = 0;
    const uint32_t *v = g->triangles + 3 * (size_t)triangle;
    for (size_t k = 0; k < 3; k++) {
        const double *a = g->points + 2 * (size_t)v[k], *b = g->points + 2 * (size_t)v[(k + 1) % 3];
        sum += hypot(b[0] - a[0], b[1] - a[1]);
    }
    return sum / 3;
}

#define HEADINGS 16

/* The next point, an edge's length on, in about the same direction; false: all ways lead out of the mesh. */
static bool step(ground *g, mw_cursor *cursor, uint32_t *triangle, double *heading, const double *from, double *to)
{
    double length = edge_length(g, *triangle);
    for (int tries = 0; tries < HEADINGS; tries++) {
        double turn = tries ? 4 * acos(0) : 1;
        *heading += turn * (dataset_unit(&g->random) - 0.5);
        to[0] = from[0] + length * cos(*heading);
        to[1] = from[1] + length * sin(*heading);
        mw_location at = mw_locate(g->locator, cursor, to[0], to[1]);
        if (at.triangle == MW_NONE) continue;
        *triangle = at.triangle;
        return true;
    }
    return false;
}

static int draw_coherent(ground *g, double *queries, size_t n)
{
    mw_error error;
    mw_cursor cursor;
    mw_query_options options = {.start = MW_START_LAST};
    uint32_t triangle = 0;
    double heading = 0;
    if (mw_cursor_init(g->locator, &options, &cursor, &error) != MW_OK) return fail(g, &error);
    for (size_t i = 0; i < n; i++) {
        double *q = queries + 2 * i;
        if (i > 0 && step(g, &cursor, &triangle, &heading, q - 2, q)) continue;
        int end = draw_inside(g, q, 1);
        if (end) return end;
        triangle = mw_locate(g->locator, &cursor, q[0], q[1]).triangle;
    }
    return 0;
}

static int draw_queries(ground *g, engine_task task, double *queries, size_t n)
{
    switch (task) {
    case TASK_SORTED: return draw_sorted(g, queries, n);
    case TASK_COHERENT: return draw_coherent(g, queries, n);
    case TASK_HALF_OUTSIDE: return draw_half_outside(g, queries, n);
    case TASK_DENSE: return draw_wish(g, &(wish){.domain = NULL}, queries, n);
    default: return draw_inside(g, queries, n);
    }
}

static int note_inside(const ground *g, course *c)
{
    mw_location *found = malloc(c->count * sizeof *found);
    int end = found ? locate(g, c->queries, c->count, found) : fail_memory();
    for (size_t i = 0; i < c->count && end == 0; i++) c->inside[i] = found[i].triangle != MW_NONE;
    free(found);
    return end;
}

static int draw_course(ground *g, engine_task task, size_t n)
{
    course *c = &g->courses[task];
    *c = (course){malloc(2 * n * sizeof *c->queries), malloc(n), n};
    g->random = ~g->seed;
    int end = c->queries && c->inside ? draw_queries(g, task, c->queries, n) : fail_memory();
    return end ? end : note_inside(g, c);
}

int ground_draw(ground *g, uint32_t tasks, size_t n)
{
    int end = 0;
    progress_phase("drawing queries", g->name);
    for (engine_task task = 0; task < TASKS && end == 0; task++)
        if (tasks >> task & 1 && task != TASK_DELAUNAY && task != TASK_CONNECTIVITY) end = draw_course(g, task, n);
    forget_drawing(g);
    return end;
}
