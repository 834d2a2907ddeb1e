/* prepared_format.h - the prepared file: its header and its parts (docs/prepared.md). Private.
 *
 * A part is an array as it stands in memory. Parts follow the header in the order of
 * mw_prepared_kind, each from a multiple of 64 bytes on; the bytes between them are zero. The
 * length of each part follows from the facts (mw_prepared_facts): writer and mapper take it from
 * one table.
 */
#ifndef MW_SRC_PREPARED_PREPARED_FORMAT_H
#define MW_SRC_PREPARED_PREPARED_FORMAT_H

#include "start/chains.h"
#include "start/lattice.h"

#include <meshwalk/prepared.h>

#define MW_PREPARED_MARK "\x89MWM\r\n\x1a\n" /* as PNG's: shows transfers that change line ends */
#define MW_PREPARED_ORDER UINT32_C(0x01020304)
#define MW_PREPARED_ALIGN 64

typedef enum mw_prepared_kind {
    MW_PART_POINTS,
    MW_PART_TRIANGLES,
    MW_PART_TRIANGLE_SLOTS,
    MW_PART_VERTEX_SLOTS,
    MW_PART_VERTEX_NUMBERS,
    MW_PART_TILES,
    MW_PART_OWNERS,
    MW_PART_CELLS,
    MW_PART_SAMPLES,
    MW_PART_BUCKETS,
    MW_PART_CHAIN_EDGES,
    MW_PART_CHAIN_STARTS,
    MW_PART_CHAIN_TILES,
    MW_PART_BORDER_EDGES,
    MW_PART_BORDER_BOXES,
    MW_PART_FIELDS,
    MW_PART_TRIANGLE_FIELDS,
    MW_PART_FACES,
    MW_PART_MARKED_EDGES,
    MW_PART_NAMES,
    MW_PART_COUNT
} mw_prepared_kind;

/* Bits of mw_prepared_facts.flags. */
enum {
    MW_PREPARED_OPPOSITE = 1,        /* mw_mesh.opposite                                   */
    MW_PREPARED_LAID_OUT = 2,        /* vertices have other slots than numbers             */
    MW_PREPARED_TRIANGLES_LAID = 4,  /* triangles, too                                     */
    MW_PREPARED_OWN_TILES = 8,       /* the tiling has tiles of its own                    */
    MW_PREPARED_CUT = 16,            /* mw_tiling.cut                                      */
    MW_PREPARED_BORDER = 32,         /* with the index of the border                       */
    MW_PREPARED_SORTED = 64,         /* mw_index.sort_batches                              */
    MW_PREPARED_FACES = 128,         /* with the faces of the triangles                    */
    MW_PREPARED_CRS = 256,           /* the last of the names is the coordinate system     */
    MW_PREPARED_CELESTIAL = 512,     /* the default walk is celestial, else remembering    */
    MW_PREPARED_STOCHASTIC = 1024,   /* cheap walks are ended so, else by the remembering  */
    MW_PREPARED_FLAGS = 2 * 1024 - 1 /* all of them                                        */
};

/* The kind of guide, which leads queries to their first tile. */
typedef enum mw_prepared_guide {
    MW_GUIDE_NONE,
    MW_GUIDE_GRID,
    MW_GUIDE_CURVE, /* with a grid whose crowded cells ask it */
    MW_GUIDE_CHAINS,
    MW_GUIDE_COUNT
} mw_prepared_guide;

typedef struct mw_prepared_facts {
    uint32_t flags, guide;
    /* of the mesh */
    uint32_t points, triangles, flat, reversed, border;
    /* of the tiling; `centre` is the tile in the middle */
    uint32_t tiles, ghosts, holes, centre;
    /* of the guide, and of the index of the border */
    uint32_t samples, sample_shift, sample_near;
    uint32_t chain_points, chain_edges, border_edges;
    /* of the values kept beside the mesh */
    uint32_t fields, triangle_fields, faces, first_number, marked_edges, marks, steps, name_bytes;
    uint32_t chain_tiles; /* of the tiling; or of the few that chains are for, ghosts with them */
    double low[2], high[2];
    mw_lattice lattice;
    mw_chains_edge chain_bottom[2], chain_top[2];
} mw_prepared_facts;

typedef struct mw_prepared_part {
    uint64_t offset, bytes, checksum; /* all 0 for a part that is not there */
} mw_prepared_part;

typedef struct mw_prepared_header {
    char mark[8];
    uint32_t version, order;
    uint64_t bytes;    /* of the file */
    uint64_t checksum; /* of the header, with 0 here */
    mw_prepared_facts facts;
    mw_prepared_part part[MW_PART_COUNT];
} mw_prepared_header;

/* The name of a part, for messages. */
const char *mw__prepared_part_name(mw_prepared_kind kind);

/* How many records a part has; 0: it is not there. */
uint64_t mw__prepared_part_count(const mw_prepared_facts *facts, mw_prepared_kind kind);

/* Fill in where each part stands, and the size of the file, from the facts. */
void mw__prepared_lay_out(mw_prepared_header *header);

/* The checksum of a header. */
uint64_t mw__prepared_header_checksum(const mw_prepared_header *header);

/* Can the facts be those of a file? Then no size overflows, and every array has the records that
 * the others count on. */
bool mw__prepared_facts_fit(const mw_prepared_facts *facts);

#endif
