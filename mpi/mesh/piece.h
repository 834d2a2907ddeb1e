/* piece.h - a rank's piece of the mesh, as it is kept: triangles in the order of their numbers in
 * the whole mesh, so that the lowest of a piece is the lowest of the whole. Private. */
#ifndef MWP_MESH_PIECE_H
#define MWP_MESH_PIECE_H

#include "mpi/wire/wire.h"

/* `number` is always that in the whole mesh. Behind the rank's own vertices and triangles stand
 * those of triangles without area that other ranks have (flats.h). */
typedef struct mwp_own {
    uint32_t vertex_count, triangle_count; /* of this rank */
    uint32_t vertices, triangles;          /* with those of other ranks */
    double *points;                        /* x, y */
    int64_t *vertex;                       /* numbers of vertices */
    uint32_t *corner;                      /* three vertices of each triangle */
    int64_t *triangle;                     /* numbers of triangles; the rank's own ascend */
    uint32_t *given;                       /* per own triangle: its place in the caller's arrays */
    uint32_t *place;                       /* and back */
} mwp_own;

/* Check the arrays of a piece and copy them. Not collective. Release in either case. */
mw_status mwp__own_create(mwp_own *own, const mwp_piece *piece, mwp_error *error);
/* Have all vertices of triangles finite coordinates? Not collective. */
mw_status mwp__own_check_points(const mwp_own *own, mwp_error *error);
/* A copy with other coordinates, of the rank's own vertices and triangles only. Not collective. */
mw_status mwp__own_move(mwp_own *own, const mwp_own *from, const double *points, size_t stride,
                        mwp_error *error);
void mwp__own_release(mwp_own *own);
size_t mwp__own_bytes(const mwp_own *own);

/* Make room for more vertices and triangles behind those that are there. */
bool mwp__own_grow(mwp_own *own, size_t vertices, size_t triangles);

static inline const double *mwp__own_point(const mwp_own *own, uint32_t triangle, uint32_t k)
{
    return &own->points[2 * (size_t)own->corner[3 * (size_t)triangle + k]];
}

/* The number of a vertex of a triangle. */
static inline int64_t mwp__own_number(const mwp_own *own, uint32_t triangle, uint32_t k)
{
    return own->vertex[own->corner[3 * (size_t)triangle + k]];
}

/* Has a triangle no area? Exact. */
bool mwp__own_is_flat(const mwp_own *own, uint32_t triangle);

#endif
