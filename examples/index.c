/* index.c - a grid that leads to the first triangle, used again after the mesh was changed:
 * answers stay exact. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 20000, QUERIES = 5000 };

static _Noreturn void fail(const mw_error *error)
{
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

/* Points spread over the unit square; `moved` shifts them all a little. */
static void make_points(double *points, size_t n, double moved)
{
    for (size_t i = 0; i < n; i++) {
        points[2 * i] = ((double)(i * 7919 % n) + 0.5) / (double)n + moved;
        points[2 * i + 1] = ((double)(i * 104729 % n * 31 % n) + 0.5) / (double)n;
    }
}

/* Mean number of triangles visited from the first triangle that the index gives. */
static double visited(const mw_locator *locator, const mw_index *index, mw_location *found)
{
    static double queries[2 * QUERIES];
    mw_error error;
    mw_counters counters;
    mw_query_options options = {.start = MW_START_GRID, .index = index, .counters = 1};
    make_points(queries, QUERIES, 0.001);
    if (mw_locate_batch(locator, queries, QUERIES, 2, &options, found, &counters, &error))
        fail(&error);
    return (double)counters.triangles_visited / QUERIES;
}

static mw_locator *make_locator(double moved, mw_mesh **mesh)
{
    static double points[2 * POINTS];
    mw_error error;
    mw_locator *locator = NULL;
    make_points(points, POINTS, moved);
    if (mw_delaunay(points, POINTS, 2, NULL, NULL, NULL, mesh, &error) ||
        mw_locator_create(*mesh, NULL, &locator, &error))
        fail(&error);
    return locator;
}

int main(void)
{
    static mw_location with_old[QUERIES], with_new[QUERIES];
    mw_error error;
    mw_mesh *before, *after;
    mw_index *old_index, *new_index;
    mw_index_info info;
    mw_locator *locator = make_locator(0, &before), *changed = make_locator(0.05, &after);
    if (mw_index_create(locator, MW_START_GRID, NULL, &old_index, &error) ||
        mw_index_create(changed, MW_START_GRID, NULL, &new_index, &error))
        fail(&error);

    mw_index_describe(old_index, &info);
    printf("a grid of about %u thousand cells, %zu bytes for each\n", (info.cells + 500) / 1000,
           info.bytes / info.cells);
    double near = visited(locator, old_index, with_old);
    double far = visited(changed, old_index, with_old);
    double again = visited(changed, new_index, with_new);
    uint32_t differing = 0;
    for (int i = 0; i < QUERIES; i++) differing += with_old[i].triangle != with_new[i].triangle;
    printf("few triangles a search: %s\n", near < 10 ? "yes" : "no");
    printf("more with the old grid in the changed mesh: %s; fewer with a new one: %s\n",
           far > near ? "yes" : "no", again < far ? "yes" : "no");
    printf("answers that differ: %u\n", differing);

    mw_index_destroy(new_index);
    mw_index_destroy(old_index);
    mw_locator_destroy(changed);
    mw_locator_destroy(locator);
    mw_mesh_destroy(after);
    mw_mesh_destroy(before);
    return 0;
}
