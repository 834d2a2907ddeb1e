/* weld.h - one vertex for all corners with equal coordinates. Private. */
#ifndef MW_SRC_IO_MESH_WELD_H
#define MW_SRC_IO_MESH_WELD_H

#include "io/mesh/mesh_builder.h"

/* An open hash table of the vertices of a builder. -0.0 equals 0.0, a NaN equals a NaN of the
 * same bits. */
typedef struct mw_weld {
    uint32_t *slots; /* vertex or MW_NONE; a power of two of them, at most three quarters in use */
    size_t slot_count;
    /* A random seed, so that no file can provoke collisions; results do not depend on it. */
    uint64_t seed;
} mw_weld;

mw_status mw__weld_start(mw_weld *weld, mw_error *error);
void mw__weld_release(mw_weld *weld);

/* The vertex at x, y, z, which is added where there is none yet. */
mw_status mw__weld_vertex(mw_weld *weld, mw_mesh_builder *builder, const double xyz[3],
                          uint32_t *vertex, mw_error *error);

#endif
