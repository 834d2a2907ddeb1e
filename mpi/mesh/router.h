/* router.h - which ranks may have the triangle of a point: those in whose boxes it lies. Private.
 */
#ifndef MWP_MESH_ROUTER_H
#define MWP_MESH_ROUTER_H

#include "mpi/wire/wire.h"

#include <meshwalk/mesh.h>
#include <stdbool.h>

typedef struct mwp_box {
    double low[2], high[2];
    int32_t rank;
    int32_t reserved;
} mwp_box;

/* The boxes of all ranks, and above them boxes of eight each, up to one. */
typedef struct mwp_router {
    mwp_box *box;  /* level by level, the lowest first */
    size_t *level; /* where each level begins, and the end */
    uint32_t levels;
    uint32_t count; /* boxes of the lowest level */
    /* A grid over all boxes: per cell the rank of all boxes that touch it, or MWP_CELL_EMPTY, or
     * MWP_CELL_SEVERAL. NULL for many boxes. */
    int32_t *cell;
    mwp_box all;     /* what the grid covers */
    double scale[2]; /* cells per unit */
} mwp_router;

enum { MWP_CELL_EMPTY = -1, MWP_CELL_SEVERAL = -2, MWP_GRID_SIDE = 128 };

/* Collective. `mesh` is that of the rank's piece, or NULL; its first `triangles` count, in boxes of
 * runs along a Hilbert curve. Release in either case. */
mw_status mwp__router_create(mwp_router *router, const mwp_wire *wire, const mw_mesh *mesh,
                             uint32_t triangles, mwp_error *error);
void mwp__router_release(mwp_router *router);
size_t mwp__router_bytes(const mwp_router *router);

static inline bool mwp__box_has(const mwp_box *box, const double p[2])
{
    return p[0] >= box->low[0] && p[0] <= box->high[0] && p[1] >= box->low[1] &&
           p[1] <= box->high[1];
}

/* The column or row of a coordinate within the box of all. It does not fall where the coordinate
 * rises, so the cells of a box's ends enclose those of its points. */
static inline uint32_t mwp__grid_place(const mwp_router *r, double x, int axis)
{
    const double at = (x - r->all.low[axis]) * r->scale[axis];
    return at < MWP_GRID_SIDE - 1 ? (uint32_t)at : MWP_GRID_SIDE - 1;
}

/* What the grid tells of a point: the only rank that has boxes near it, or MWP_CELL_EMPTY. It tells
 * nothing, MWP_CELL_SEVERAL, of other points, nor of those outside of all boxes or not finite. */
static inline int mwp__router_cell(const mwp_router *r, const double p[2])
{
    if (!r->cell || !mwp__box_has(&r->all, p)) return MWP_CELL_SEVERAL;
    return r->cell[mwp__grid_place(r, p[1], 1) * MWP_GRID_SIDE + mwp__grid_place(r, p[0], 0)];
}

/* The ranks in whose boxes a finite point lies, each once, in ascending order; or the only rank
 * that has boxes near it. `ranks` has room for all. Returns how many. */
int mwp__router_find(const mwp_router *router, const double point[2], int *ranks);

#endif
