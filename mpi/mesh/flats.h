/* flats.h - triangles without area near cuts. Private.
 *
 * A triangle without area contains no point, but it may join the edge of a triangle to vertices
 * inside that edge: without it a piece would be no embedding. So each piece gets those of other
 * ranks that hang together with it, directly or through others, by common places. */
#ifndef MWP_MESH_FLATS_H
#define MWP_MESH_FLATS_H

#include "mpi/mesh/piece.h"

/* Collective. Adds to `own` what it needs. */
mw_status mwp__flats_add(mwp_own *own, const mwp_wire *wire, mwp_error *error);

#endif
