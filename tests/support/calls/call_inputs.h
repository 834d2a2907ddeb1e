/* call_inputs.h - meshes, points, surfaces and files of any size, for the calls of long_calls.h. */
#ifndef MW_TESTS_SUPPORT_CALLS_CALL_INPUTS_H
#define MW_TESTS_SUPPORT_CALLS_CALL_INPUTS_H

#include "support/meshes.h"
#include "support/star_shapes.h"

/* What the calls work on. */
typedef struct call_inputs {
    double *points; /* x y each */
    uint32_t point_count;
    arrays plain, damaged; /* a mesh with holes; the same with a triangle that lies over others */
    uint32_t *segments;    /* two points each; they cross nowhere */
    uint32_t segment_count;
    arrays whole; /* the whole mesh, as arrays */
    uint32_t *neighbours;
    star_shape ball;
    mw_mesh *mesh, *holed, *crowded; /* crowded: most vertices lie near one point */
    mw_locator *locator;
    mw_surface *surface;
    mw_star *star;
    mw_prober *prober;
    char *path, *lines; /* of a mesh and of constraints in files, in the working directory */
} call_inputs;

/* About n points, and as many triangles twice. Release with call_inputs_release. */
call_inputs call_inputs_make(uint32_t n, uint64_t seed);
void call_inputs_release(call_inputs *in);

#endif
