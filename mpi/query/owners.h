/* owners.h - what the owners of triangles know: for each location, one answer of fixed size from
 * the rank that has its triangle. Private. */
#ifndef MWP_QUERY_OWNERS_H
#define MWP_QUERY_OWNERS_H

#include "mpi/mesh/mesh.h"

/* Answer for n locations in this rank's piece, whose triangles are places in mwp_own: write `bytes`
 * each to `answers`. */
typedef mw_status mwp_owner_answer(void *self, const mwp_mesh *mesh, const mw_location *at,
                                   size_t n, void *answers, mwp_error *error);

/* Collective. `results` receives `bytes` for each location with a triangle, and stays as it is for
 * the others. `status` tells whether this rank has come so far; then `error` is filled in. */
mw_status mwp__ask_owners(mwp_mesh *mesh, mw_status status, const mwp_location *at, size_t n,
                          size_t bytes, mwp_owner_answer *answer, void *self, void *results,
                          mwp_error *error);

#endif
