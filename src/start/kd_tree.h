/* kd_tree.h - a k-d tree of the vertices. Private. */
#ifndef MW_SRC_START_KD_TREE_H
#define MW_SRC_START_KD_TREE_H

#include "tiling/tiling.h"

/* A vertex, and the name of a tile that has it. */
typedef struct mw_kd_vertex {
    mw_point at;
    uint32_t tile;
} mw_kd_vertex;

typedef struct mw_kd_tree {
    mw_kd_vertex *vertex; /* the middle one parts the others, by x, on each side by y, and so on */
    uint32_t count;
} mw_kd_tree;

/* Of the vertices of a tiling that have a tile. A stage that takes the present part of
 * the job. Returns false when out of memory, or cancelled. */
bool mw__kd_tree_create(mw_kd_tree *tree, const mw_tiling *tiling, mw_job *job);
void mw__kd_tree_release(mw_kd_tree *tree);
size_t mw__kd_tree_bytes(const mw_kd_tree *tree);

/* The name of a tile at the vertex nearest to q, by rounded distances. */
uint32_t mw__kd_tree_first(const mw_kd_tree *tree, mw_point q);

#endif
