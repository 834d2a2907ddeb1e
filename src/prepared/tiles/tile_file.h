/* tile_file.h - some triangles of a mesh as a prepared file of their own. Private. */
#ifndef MW_SRC_PREPARED_TILES_TILE_FILE_H
#define MW_SRC_PREPARED_TILES_TILE_FILE_H

#include "base/job.h"
#include "prepared/tiles/tile_holes.h"

#include <meshwalk/prepared.h>

/* Fields of each file: the numbers of its triangles and vertices in the whole mesh. */
#define MW_TILE_TRIANGLES "meshwalk:triangle"
#define MW_TILE_VERTICES "meshwalk:vertex"

/* What all files are made from. */
typedef struct mw_tile_source {
    const mw_locator *locator; /* of the whole mesh */
    const mw_mesh *mesh;
    const mw_mesh_file *values;
    uint32_t *place; /* per vertex: MW_NONE, but while a file is made */
    mw_job *job;
    uint64_t file, files; /* the file that is being made, and how many there are */
} mw_tile_source;

/* Prepare triangles, in ascending order, with the index of the border, and write them. *checksum
 * receives that of the file; *holes, if it is not NULL, its holes, which the caller releases. */
mw_status mw__tile_file_write(const mw_tile_source *source, const uint32_t *triangles, size_t count,
                              const char *path, uint64_t *checksum, mw_tile_holes *holes,
                              mw_error *error);

#endif
