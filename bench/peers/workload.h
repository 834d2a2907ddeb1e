/* workload.h - what engines are measured on: a mesh, and queries for each task. */
#ifndef MW_BENCH_PEERS_WORKLOAD_H
#define MW_BENCH_PEERS_WORKLOAD_H

#include "bench/data/dataset.h"
#include "bench/peers/engine.h"
#include "cli/frame/options.h"

#include <meshwalk/meshwalk.h>

/* The queries of a task. */
typedef struct query_set {
    double *queries; /* x0 y0 x1 y1 ... */
    uint8_t *inside; /* is it in a triangle? */
    size_t count;
} query_set;

typedef struct workload {
    const char *name;
    engine_mesh mesh;
    double *points; /* of the mesh */
    uint32_t *triangles;
    query_set query_sets[TASKS]; /* of a task without queries it is empty */
    /* To draw queries; gone when they are drawn. */
    dataset region; /* that they are drawn from; without points of its own */
    uint64_t seed, random;
    uint32_t threads; /* that prepare it */
    mw_mesh *drawn_in;
    mw_locator *locator;
} workload;

/* The points are triangulated, and become those of the workload. Each of these returns 0 or an exit
 * code after a complaint. */
int workload_from_points(workload *w, const char *name, dataset *data,
                         const common_settings *common);
/* The mesh is taken as it is. */
int workload_from_mesh(workload *w, const char *name, const mw_mesh_file *file,
                       const common_settings *common);
/* Draw n queries for each of the tasks (ENGINE_IN), and give back what only drawing needs: beside a
 * large mesh there is no room for it. */
int workload_draw_queries(workload *w, uint32_t tasks, size_t n);
void workload_release(workload *w);

#endif
