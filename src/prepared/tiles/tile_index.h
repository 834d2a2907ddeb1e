/* tile_index.h - the index of a mesh in tiles, as JSON (docs/prepared.md). Private. */
#ifndef MW_SRC_PREPARED_TILES_TILE_INDEX_H
#define MW_SRC_PREPARED_TILES_TILE_INDEX_H

#include "prepared/tiles/tile_cuts.h"

typedef struct mw_tile_index {
    uint32_t vertices, triangles; /* of the whole mesh */
    const int64_t *holes; /* per hole of the overview: its number in the whole mesh, -1: none */
    size_t hole_count;
    const uint64_t *checksums; /* of the overview, then of each tile */
    const mw_tile_cuts *cuts;
} mw_tile_index;

/* Write the index to a file. MW_ERROR_SYSTEM, MW_ERROR_MEMORY. */
mw_status mw__tile_index_write(const mw_tile_index *index, const char *path, mw_error *error);

/* A finite number as Python's repr() and JSON write it: with the fewest digits that read back as
 * the same number. `text` has room for 32 bytes. */
void mw__tile_number_write(double value, char *text);

#endif
