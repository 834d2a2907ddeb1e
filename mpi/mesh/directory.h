/* directory.h - every number of the whole mesh has a home, a rank that learns who has it. Private.
 */
#ifndef MWP_MESH_DIRECTORY_H
#define MWP_MESH_DIRECTORY_H

#include "mpi/mesh/piece.h"

/* The rank that answers for a number. */
static inline int mwp__home(const mwp_wire *wire, int64_t number)
{
    /* the golden ratio spreads ranges of numbers evenly */
    const uint64_t mixed = (uint64_t)number * UINT64_C(0x9e3779b97f4a7c15);
    return (int)((mixed >> 32) % (uint64_t)wire->size);
}

/* What the directory tells a rank. */
typedef struct mwp_directory {
    uint8_t *shared;             /* per own vertex: other ranks have it, too */
    int64_t vertices, triangles; /* of the whole mesh */
} mwp_directory;

/* Collective. Refuses triangles that two ranks have, and vertices with different coordinates.
 * Release in either case. */
mw_status mwp__directory_create(mwp_directory *directory, const mwp_wire *wire, const mwp_own *own,
                                mwp_error *error);
void mwp__directory_release(mwp_directory *directory);

#endif
