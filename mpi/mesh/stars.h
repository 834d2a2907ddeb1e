/* stars.h - the triangles round vertices that several ranks have: is the mesh sound there, and
 * which edges of a piece continue in another? Private. */
#ifndef MWP_MESH_STARS_H
#define MWP_MESH_STARS_H

#include "mpi/mesh/piece.h"

/* Collective. `shared` as mwp_directory has it. Bit k of joined[t] is set if a triangle with an
 * area of another rank lies beyond edge k of own triangle t. Refuses what is wrong across ranks at
 * an edge or round a vertex. */
mw_status mwp__stars_join(const mwp_own *own, const mwp_wire *wire, const uint8_t *shared,
                          uint8_t *joined, mwp_error *error);

#endif
