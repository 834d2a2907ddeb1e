/* long_calls.h - each public function that can take long, called on inputs of any size: for tests
 * that watch, cancel, share or repeat such calls. */
#ifndef MW_TESTS_SUPPORT_LONG_CALLS_H
#define MW_TESTS_SUPPORT_LONG_CALLS_H

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

typedef struct call_setting {
    uint32_t threads;
    const mw_progress *progress;
} call_setting;

/* A call makes its result, adds what it holds to *sum, and releases it. If it fails, it checks that
 * nothing was handed out and what existed before is as it was, and ends the program otherwise. */
typedef struct long_call {
    const char *name;
    mw_status (*run)(const call_inputs *in, const call_setting *how, uint64_t *sum,
                     mw_error *error);
} long_call;

extern const long_call long_calls[];
extern const size_t long_call_count;

#endif
