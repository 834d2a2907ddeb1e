/* records.h - triangles that travel: with their vertices, and where they come from. And meshes that
 * are made of them. Private. */
#ifndef MWP_MESH_RECORDS_H
#define MWP_MESH_RECORDS_H

#include "mpi/mesh/piece.h"

#include <meshwalk/mesh.h>

typedef struct mwp_record {
    int64_t triangle;
    int64_t vertex[3];
    double point[6];  /* x, y of each vertex */
    int32_t rank;     /* who has the triangle */
    uint32_t place;   /* its place there, in mwp_own */
    uint32_t given;   /* its place in the caller's arrays there */
    uint32_t outline; /* bit k: nothing, or a triangle without area, lies beyond edge k */
} mwp_record;

mwp_record mwp__record_of(const mwp_own *own, uint32_t triangle, int rank);

/* Triangles of several ranks, each once, by their numbers; vertices, too. */
typedef struct mwp_union {
    mwp_record *record;
    uint32_t triangle_count, vertex_count;
    double *points;
    uint32_t *corner;
    int64_t *vertex; /* the number of each vertex */
} mwp_union;

/* Of records in any order, which are moved there; a triangle may come several times. Not
 * collective. Release in either case. */
mw_status mwp__union_create(mwp_union *all, mwp_record *records, size_t count, mwp_error *error);
void mwp__union_release(mwp_union *all);

/* What a triangle or a vertex of arrays is called in the whole mesh, for messages. */
typedef struct mwp_names {
    mw_arrays arrays;
    const int64_t *vertex;
    const int64_t *triangle;  /* NULL: those of the records */
    const mwp_record *record; /* NULL: all triangles are of the rank */
    int rank;
} mwp_names;

mwp_names mwp__names_of_union(const mwp_union *all);
mwp_names mwp__names_of_own(const mwp_own *own, int rank);

/* The error for a defect. */
mw_status mwp__fail_defect(mwp_error *error, const mwp_names *names, const mw_defect *defect);
/* The error for arrays of which the library refused to make a mesh or a locator: that of their
 * first defect, or else the library's. */
mw_status mwp__fail_arrays(mwp_error *error, const mwp_names *names, const mw_error *from);

#endif
