/* service_answer.h - what rank 0 asks of all ranks, and what they answer. Private. */
#ifndef MWP_PROGRAM_SERVICE_ANSWER_H
#define MWP_PROGRAM_SERVICE_ANSWER_H

#include "mpi/wire/wire.h"

typedef struct service {
    mwp_wire wire;
    mwp_mesh *mesh; /* NULL: not there yet */
} service;

/* The answer to a point. */
typedef struct service_answer {
    mwp_location at;
    int64_t from; /* the triangle that the value comes from, or -1 */
    double value; /* of the only field of the mesh, for SERVICE_VALUES */
    bool missing; /* there is a triangle, but a corner has no value; for SERVICE_VALUES */
    /* For SERVICE_CORNERS: the vertices whose weights are not 0, then -1; and their weights. */
    int64_t corner[3];
    double weight[3];
} service_answer;

/* What is asked beside the location. */
enum { SERVICE_NOTHING, SERVICE_VALUES, SERVICE_CORNERS };

typedef struct service_options {
    double tolerance;
    uint32_t threads;
    uint32_t more;            /* SERVICE_... */
    int32_t outside, missing; /* what points outside, or without a value, get: as `sample` has it */
} service_options;

#endif
