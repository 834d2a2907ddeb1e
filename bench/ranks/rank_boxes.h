/* rank_boxes.h - a mesh cut among ranks as libmeshwalk-mpi cuts and routes: equal runs of triangles
 * along a Hilbert curve, several boxes of each, in a tree of eight children (mpi/mesh/router.c). */
#ifndef MW_BENCH_RANKS_RANK_BOXES_H
#define MW_BENCH_RANKS_RANK_BOXES_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct rank_box {
    double low[2], high[2];
    uint32_t rank;
} rank_box;

typedef struct rank_boxes {
    uint32_t ranks, triangles;
    uint32_t *order;  /* triangles along the curve */
    uint32_t *place;  /* of each triangle along the curve */
    rank_box *box;    /* level by level, the lowest first */
    size_t level[16]; /* where each level begins, and the end */
    uint32_t levels;
} rank_boxes;

/* The triangles of a mesh along the curve; false when memory runs out. Release in either case. */
bool rank_boxes_create(rank_boxes *b, const mw_mesh *mesh);
void rank_boxes_release(rank_boxes *b);

/* Cut among so many ranks, at most one a triangle. False when memory runs out. */
bool rank_boxes_cut(rank_boxes *b, const mw_mesh *mesh, uint32_t ranks);

/* The rank that has a triangle. */
uint32_t rank_boxes_owner(const rank_boxes *b, uint32_t triangle);

/* The ranks in whose boxes a point lies, each once. `ranks` has room for all. Returns how many. */
uint32_t rank_boxes_find(const rank_boxes *b, const double point[2], uint32_t *ranks);

/* Bytes of the boxes, which each rank holds, as the library keeps them. */
size_t rank_boxes_bytes(const rank_boxes *b);

#endif
