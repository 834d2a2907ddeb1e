/* service.h - what rank 0, which reads and writes, orders of the other ranks. Private. */
#ifndef MWP_PROGRAM_SERVICE_H
#define MWP_PROGRAM_SERVICE_H

#include "mpi/program/service_answer.h"

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
