/* ground.h - what engines are measured on: a mesh, and queries for each task. */
#ifndef CLI_GROUND_H
#define CLI_GROUND_H

#include "bench/data/datasets.h"
#include "bench/peers/engine.h"

#include <meshwalk/meshwalk.h>

/* The queries of a task. */
typedef struct course {
    double *queries; /* x0 y0 x1 y1 ... */
    uint8_t *inside; /* is it in a triangle? */
    size_t count;
} course;

typedef struct ground {
    const char *name;
    engine_mesh mesh;
    double *points; /* of the mesh */
    uint32_t *triangles;
    course courses[TASKS];
    /* To draw queries; gone when they are drawn. */
    dataset domain; /* without points of its own */
    uint64_t seed, random;
    mw_mesh *drawn_in;
    mw_locator *locator;
} ground;

/* The points are triangulated, and become those of the ground. Each of these returns 0 or an exit code after a complaint. */
int ground_of_points(ground *g, const char *name, dataset *data, uint64_t seed);
/* The mesh is taken as it is. */
int ground_of_mesh(ground *g, const char *name, const mw_mesh_file *file, uint64_t seed);
/* Draw n queries for each of the tasks (ENGINE_IN), and give back what only drawing needs: beside a large mesh there is no
 * room for it. */
int ground_draw(ground *g, uint32_t tasks, size_t n);
void ground_release(ground *g);

#endif
