/* trap_making.c - making a mesh: triangulations of points and of segments. */
#include "bench/data/dataset.h"
#include "bench/worst/trap_entry.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"

#include <stdlib.h>

int trap_of_delaunay(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    mw_mesh *mesh = NULL;
    mw_error error;
    trap_mesh m;
    mw_delaunay_options options = {.threads = 1};
    int end = trap->make(&m, plan->vertices, plan->seed) ? 0 : fail_memory();
    double begin = monotonic_seconds();
    if (end == 0 && mw_delaunay(m.points, m.point_count, 2, &options, NULL, NULL, &mesh, &error))
        end = fail_mesh(trap->name, &error);
    f->build = monotonic_seconds() - begin;
    if (end == 0) trap_peers_triangulate(plan->engines, m.points, m.point_count, f->peers);
    mw_mesh_destroy(mesh);
    trap_mesh_release(&m);
    return end;
}

/* Segments of random lengths along the x axis, a point above and one below. */
int trap_of_segments(const trap_entry *trap, const trap_plan *plan, trap_figures *f)
{
    size_t n = plan->vertices / 2, count = 2 * n + 2;
    uint64_t random = plan->seed;
    mw_error error;
    mw_mesh *mesh = NULL;
    double *points = malloc(2 * count * sizeof *points);
    uint32_t *segments = malloc(2 * n * sizeof *segments);
    int end = points && segments ? 0 : fail_memory();
    for (size_t i = 0; i < 2 * n && end == 0; i++) {
        points[2 * i] = dataset_unit(&random);
        points[2 * i + 1] = 0;
        segments[i] = (uint32_t)i;
    }
    if (end == 0) {
        const double ends[4] = {0.5, 1, 0.5, -1};
        for (size_t k = 0; k < 4; k++) points[4 * n + k] = ends[k];
        mw_constraints constraints = {
            .points = points, .point_count = count, .segments = segments, .segment_count = n};
        mw_constrain_options options = {.threads = 1};
        double begin = monotonic_seconds();
        if (mw_constrained_delaunay(&constraints, &options, NULL, NULL, NULL, &mesh, &error))
            end = fail_mesh(trap->name, &error);
        f->build = monotonic_seconds() - begin;
    }
    mw_mesh_destroy(mesh);
    free(points);
    free(segments);
    return end;
}
