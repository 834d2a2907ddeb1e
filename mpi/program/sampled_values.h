/* sampled_values.h - the values at points, in triangles and outside, where the values live.
 * Private. */
#ifndef MWP_PROGRAM_SAMPLED_VALUES_H
#define MWP_PROGRAM_SAMPLED_VALUES_H

#include "mpi/program/service_answer.h"

/* Collective. Fill in `from`, `value` and `missing` of the answers to n points, x and y side by
 * side, at the locations `at`. */
mw_status sampled_values(const service *ranks, const double *points, size_t n,
                         const service_options *options, const mwp_location *at,
                         service_answer *answers, mwp_error *error);

#endif
