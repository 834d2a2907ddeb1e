#include "bench/peers/workload.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int workload_fail(const workload *w, const mw_error *error)
{
    return fail_mesh(w->name, error);
}

/* --- the mesh --------------------------------------------------------------------------------- */

static int workload_prepare(workload *w)
{
    mw_error error;
    mw_locator_options options = {.threads = w->threads, .progress = progress_of_call()};
    if (mw_locator_create(w->drawn_in, &options, &w->locator, &error) != MW_OK)
        return workload_fail(w, &error);
    w->mesh.points = w->points;
    w->mesh.triangles = w->triangles;
    return 0;
}

static int workload_take_triangles(workload *w)
{
    size_t count = mw_mesh_triangle_count(w->drawn_in);
    w->triangles = malloc(3 * count * sizeof *w->triangles);
    if (!w->triangles) return fail_memory();
    for (size_t t = 0; t < count; t++)
        mw_mesh_triangle(w->drawn_in, (uint32_t)t, w->triangles + 3 * t);
    w->mesh.triangle_count = count;
    return workload_prepare(w);
}

int workload_from_points(workload *w, const char *name, dataset *data,
                         const common_settings *common)
{
    mw_error error;
    mw_delaunay_options options = {.threads = common->threads, .progress = progress_of_call()};
    *w = (workload){.threads = common->threads,
                    .name = name,
                    .points = data->points,
                    .region = *data,
                    .seed = common->seed};
    w->mesh.point_count = data->count;
    data->points = w->region.points = NULL;
    progress_phase("triangulating", name);
    if (mw_delaunay(w->points, data->count, 2, &options, NULL, NULL, &w->drawn_in, &error) != MW_OK)
        return workload_fail(w, &error);
    return workload_take_triangles(w);
}

int workload_from_mesh(workload *w, const char *name, const mw_mesh_file *file,
                       const common_settings *common)
{
    mw_error error;
    mw_mesh_options options = {.threads = common->threads, .progress = progress_of_call()};
    mw_arrays arrays = mw_mesh_file_arrays(file);
    *w = (workload){.threads = common->threads, .name = name, .seed = common->seed};
    w->points = malloc(2 * (file->point_count + 1) * sizeof *w->points);
    if (!w->points) return fail_memory();
    for (size_t i = 0; i < file->point_count; i++)
        memcpy(w->points + 2 * i, file->points + 3 * i, 2 * sizeof(double));
    w->mesh.point_count = file->point_count;
    w->region = (dataset){.points = w->points, .count = file->point_count};
    bool fits = dataset_bound(&w->region, file->point_count);
    w->region.points = NULL;
    if (!fits) {
        complain("%s: the extent of the points is too large for a double", name);
        return END_INPUT;
    }
    progress_phase("linking", name);
    if (mw_mesh_create(&arrays, &options, &w->drawn_in, &error) != MW_OK)
        return workload_fail(w, &error);
    return workload_take_triangles(w);
}

static void workload_forget_drawing(workload *w)
{
    mw_locator_destroy(w->locator);
    mw_mesh_destroy(w->drawn_in);
    w->locator = NULL;
    w->drawn_in = NULL;
}

void workload_release(workload *w)
{
    workload_forget_drawing(w);
    for (engine_task task = 0; task < TASKS; task++) {
        free(w->query_sets[task].queries);
        free(w->query_sets[task].inside);
    }
    free(w->points);
    free(w->triangles);
    *w = (workload){0};
}

/* --- queries ---------------------------------------------------------------------------------- */

#define BLOCK ((size_t)1 << 16)

static int workload_locate(const workload *w, const double *queries, size_t n, mw_location *found)
{
    mw_error error;
    mw_query_options options = {.seed = w->seed, .threads = w->threads};
    return mw_locate_batch(w->locator, queries, n, 2, &options, found, NULL, &error) == MW_OK
               ? 0
               : workload_fail(w, &error);
}

/* A point of a random triangle, uniform in it up to rounding. */
static void workload_draw_dense(workload *w, double *query)
{
    const uint32_t *v =
        w->triangles + 3 * (size_t)(dataset_unit(&w->random) * (double)w->mesh.triangle_count);
    double s = dataset_unit(&w->random), t = dataset_unit(&w->random);
    if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
    }
    const double *a = w->points + 2 * (size_t)v[0], *b = w->points + 2 * (size_t)v[1],
                 *c = w->points + 2 * (size_t)v[2];
    for (size_t k = 0; k < 2; k++) query[k] = a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]);
}

/* How queries are proposed, and which of them are taken. */
typedef struct drawn_source {
    const dataset *region; /* uniform in it; NULL: dense */
    bool outside;
} drawn_source;

static void workload_propose(workload *w, const drawn_source *from, double *queries, size_t n)
{
    if (from->region)
        dataset_draw(from->region, queries, n, &w->random);
    else
        for (size_t i = 0; i < n; i++) workload_draw_dense(w, queries + 2 * i);
}

/* So many drawn in vain, beyond a thousand for each found, are no accident. */
#define DRAWN_IN_VAIN 1000000

static int workload_draw_from(workload *w, const drawn_source *from, double *queries, size_t n)
{
    size_t found = 0, drawn = 0;
    mw_location *locations = malloc(BLOCK * sizeof *locations);
    int end = locations ? 0 : fail_memory();
    while (end == 0 && found < n) {
        size_t more = n - found < BLOCK ? n - found : BLOCK;
        double *new = queries + 2 * found;
        workload_propose(w, from, new, more);
        end = workload_locate(w, new, more, locations);
        for (size_t i = 0; i < more && end == 0; i++)
            if ((locations[i].triangle == MW_NONE) == from->outside)
                memmove(queries + 2 * found++, new + 2 * i, 2 * sizeof *new);
        drawn += more;
        if (end == 0 && drawn > 1000 * found + DRAWN_IN_VAIN) {
            complain("%s: the mesh fills less than a thousandth of the extent of its points",
                     w->name);
            end = END_INPUT;
        }
    }
    free(locations);
    return end;
}

static int workload_draw_inside(workload *w, double *queries, size_t n)
{
    return workload_draw_from(w, &(drawn_source){.region = &w->region}, queries, n);
}

/* Outside is what a domain twice as wide and high, about the same middle, has beside the mesh, its
 * holes too. */
static int workload_draw_half_outside(workload *w, double *queries, size_t n)
{
    dataset wide = w->region;
    for (size_t k = 0; k < 2; k++) {
        wide.origin[k] -= w->region.u[k] / 2 + w->region.v[k] / 2;
        wide.u[k] *= 2;
        wide.v[k] *= 2;
    }
    int end = workload_draw_inside(w, queries, n / 2);
    if (end == 0)
        end = workload_draw_from(w, &(drawn_source){.region = &wide, .outside = true},
                                 queries + 2 * (n / 2), n - n / 2);
    for (size_t i = n; i > 1 && end == 0; i--) {
        double other[2], *a = queries + 2 * (i - 1);
        double *b = queries + 2 * (size_t)(dataset_unit(&w->random) * (double)i);
        memcpy(other, a, sizeof other);
        memcpy(a, b, sizeof other);
        memcpy(b, other, sizeof other);
    }
    return end;
}

/* A query and the rank of its triangle along a Hilbert curve. */
typedef struct ranked_query {
    double query[2];
    uint32_t rank;
} ranked_query;

static int ranked_query_compare(const void *one, const void *other)
{
    uint32_t a = ((const ranked_query *)one)->rank, b = ((const ranked_query *)other)->rank;
    return (a > b) - (a < b);
}

/* The rank of each triangle along the curve; NULL after a complaint. */
static uint32_t *workload_triangle_ranks(const workload *w)
{
    mw_error error;
    size_t count = w->mesh.triangle_count;
    uint32_t *order = malloc(count * sizeof *order), *rank = malloc(count * sizeof *rank);
    if (!order || !rank)
        fail_memory();
    else if (mw_mesh_hilbert_order(w->drawn_in, order, NULL, &error) != MW_OK)
        workload_fail(w, &error);
    else {
        for (size_t i = 0; i < count; i++) rank[order[i]] = (uint32_t)i;
        free(order);
        return rank;
    }
    free(order);
    free(rank);
    return NULL;
}

static int workload_draw_sorted(workload *w, double *queries, size_t n)
{
    uint32_t *rank = workload_triangle_ranks(w);
    mw_location *found = malloc(n * sizeof *found);
    ranked_query *all = malloc(n * sizeof *all);
    int end = !rank          ? END_RESOURCE
              : found && all ? workload_draw_inside(w, queries, n)
                             : fail_memory();
    if (end == 0) end = workload_locate(w, queries, n, found);
    for (size_t i = 0; i < n && end == 0; i++)
        all[i] = (ranked_query){{queries[2 * i], queries[2 * i + 1]}, rank[found[i].triangle]};
    if (end == 0) {
        qsort(all, n, sizeof *all, ranked_query_compare);
        for (size_t i = 0; i < n; i++) memcpy(queries + 2 * i, all[i].query, 2 * sizeof *queries);
    }
    free(rank);
    free(found);
    free(all);
    return end;
}

/* The mean length of a triangle's edges. */
static double workload_edge_length(const workload *w, uint32_t triangle)
{
    double sum = 0;
    const uint32_t *v = w->triangles + 3 * (size_t)triangle;
    for (size_t k = 0; k < 3; k++) {
        const double *a = w->points + 2 * (size_t)v[k], *b = w->points + 2 * (size_t)v[(k + 1) % 3];
        sum += hypot(b[0] - a[0], b[1] - a[1]);
    }
    return sum / 3;
}

#define HEADINGS 16

/* The next point, an edge's length on, in about the same direction; false: all ways lead out of the
 * mesh. */
static bool workload_step(workload *w, mw_cursor *cursor, uint32_t *triangle, double *heading,
                          const double *from, double *to)
{
    double length = workload_edge_length(w, *triangle);
    for (int tries = 0; tries < HEADINGS; tries++) {
        double turn = tries ? 4 * acos(0) : 1;
        *heading += turn * (dataset_unit(&w->random) - 0.5);
        to[0] = from[0] + length * cos(*heading);
        to[1] = from[1] + length * sin(*heading);
        mw_location at = mw_locate(w->locator, cursor, to[0], to[1]);
        if (at.triangle == MW_NONE) continue;
        *triangle = at.triangle;
        return true;
    }
    return false;
}

static int workload_draw_coherent(workload *w, double *queries, size_t n)
{
    mw_error error;
    mw_cursor cursor;
    mw_query_options options = {.start = MW_START_LAST};
    uint32_t triangle = 0;
    double heading = 0;
    if (mw_cursor_init(w->locator, &options, &cursor, &error) != MW_OK)
        return workload_fail(w, &error);
    for (size_t i = 0; i < n; i++) {
        double *q = queries + 2 * i;
        if (i > 0 && workload_step(w, &cursor, &triangle, &heading, q - 2, q)) continue;
        int end = workload_draw_inside(w, q, 1);
        if (end) return end;
        triangle = mw_locate(w->locator, &cursor, q[0], q[1]).triangle;
    }
    return 0;
}

static int workload_draw_task(workload *w, engine_task task, double *queries, size_t n)
{
    switch (task) {
    case TASK_SORTED: return workload_draw_sorted(w, queries, n);
    case TASK_COHERENT: return workload_draw_coherent(w, queries, n);
    case TASK_HALF_OUTSIDE: return workload_draw_half_outside(w, queries, n);
    case TASK_DENSE: return workload_draw_from(w, &(drawn_source){.region = NULL}, queries, n);
    default: return workload_draw_inside(w, queries, n);
    }
}

static int query_set_note_inside(const workload *w, query_set *c)
{
    mw_location *found = malloc(c->count * sizeof *found);
    int end = found ? workload_locate(w, c->queries, c->count, found) : fail_memory();
    for (size_t i = 0; i < c->count && end == 0; i++) c->inside[i] = found[i].triangle != MW_NONE;
    free(found);
    return end;
}

static int workload_draw_query_set(workload *w, engine_task task, size_t n)
{
    query_set *c = &w->query_sets[task];
    *c = (query_set){malloc(2 * n * sizeof *c->queries), malloc(n), n};
    w->random = ~w->seed;
    int end = c->queries && c->inside ? workload_draw_task(w, task, c->queries, n) : fail_memory();
    return end ? end : query_set_note_inside(w, c);
}

int workload_draw_queries(workload *w, uint32_t tasks, size_t n)
{
    int end = 0;
    progress_phase("drawing queries", w->name);
    for (engine_task task = 0; task < TASKS && end == 0; task++)
        if (tasks >> task & 1 && task != TASK_DELAUNAY && task != TASK_CONNECTIVITY)
            end = workload_draw_query_set(w, task, n);
    workload_forget_drawing(w);
    return end;
}
