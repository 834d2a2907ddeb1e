/* mesh.h - a mesh in pieces: this rank's piece, the boxes of all, and the rim. Private. */
#ifndef MWP_MESH_MESH_H
#define MWP_MESH_MESH_H

#include "mpi/mesh/rim.h"
#include "mpi/wire/talk.h"

/* Points that are being located: query/locate.c. */
typedef struct mwp_block mwp_block;
struct mwp_locating {
    mwp_mesh *mesh;
    const double *points;
    size_t n, stride;
    mwp_locate_options options;
    mwp_location *locations;
    size_t begin, end; /* the present block */
    size_t next;       /* where the next block begins */
    uint32_t *asked;   /* per question of the block: its query, from `begin` */
    size_t asked_room;
    mwp_block *block; /* how its queries are sorted; NULL before the first */
    mwp_talk talk;
};

/* Values of a file at the vertices of a piece. */
enum { MWP_FIELD_NAME = 128 };
typedef struct mwp_fields {
    uint32_t count;
    char (*names)[MWP_FIELD_NAME];
    double *rows; /* a row of all fields for each vertex */
} mwp_fields;
void mwp__fields_release(mwp_fields *fields);

struct mwp_mesh {
    mwp_wire wire;
    mwp_part part;
    mwp_router router;
    mwp_rim rim;
    int64_t vertices, triangles; /* of the whole mesh */
    mwp_fields fields;
    mwp_tables tables;     /* for talks */
    mwp_locating locating; /* the batch that is under way */
};

#endif
