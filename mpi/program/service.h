/* service.h - what rank 0, which reads and writes, orders of the other ranks. Private. */
#ifndef MWP_PROGRAM_SERVICE_H
#define MWP_PROGRAM_SERVICE_H

#include "mpi/wire/wire.h"

typedef struct service {
    mwp_wire wire;
    mwp_mesh *mesh; /* NULL: not there yet */
} service;

/* The answer to a point. */
typedef struct service_answer {
    mwp_location at;
    double value; /* of the first field of the mesh, for SERVICE_VALUES */
    /* For SERVICE_CORNERS: the vertices whose weights are not 0, then -1; and their weights. */
    int64_t corner[3];
    double weight[3];
} service_answer;

/* What is asked beside the location. */
enum { SERVICE_NOTHING, SERVICE_VALUES, SERVICE_CORNERS };

typedef struct service_options {
    double tolerance;
    uint32_t threads;
    uint32_t more; /* SERVICE_... */
} service_options;

/* All ranks call these two, first and last. */
mw_status service_open(service *s, mwp_error *error);
void service_close(service *s);

/* The ranks other than 0: do what rank 0 orders. Returns the exit code that it ends with. */
int service_run(service *s);

/* On rank 0:
 *   scatter  distribute a mesh
 *   locate   answer n points, `stride` doubles apart
 *   end      the last order: let the others end with this exit code */
mw_status service_scatter(service *s, const mw_mesh_file *file, uint32_t threads, mwp_error *error);
mw_status service_locate(service *s, const double *points, size_t stride, size_t n,
                         const service_options *options, service_answer *answers, mwp_error *error);
void service_end(service *s, int end);

#endif
