/* vertex_tree.h - a k-d tree of vertices: which of them lie in a box? [Bentley 1975] Private. */
#ifndef MW_SRC_MEND_VERTEX_TREE_H
#define MW_SRC_MEND_VERTEX_TREE_H

#include "mend/mend_work.h"

/* The vertex in the middle of a range parts the others of the range by one coordinate; both halves
 * are ranges again, parted by the next coordinate. */
typedef struct mw_vertex_tree {
    const mw_mend_work *work;
    uint32_t *vertex; /* owned */
    uint32_t count;
} mw_vertex_tree;

/* A list of vertices. */
typedef struct mw_vertex_list {
    uint32_t *vertex;
    uint32_t count, capacity;
} mw_vertex_list;

/* Make a tree of the vertices in the list, all finite; the list becomes empty. O(n log n) expected.
 */
mw_vertex_tree mw__vertex_tree_create(const mw_mend_work *work, mw_vertex_list *list);
void mw__vertex_tree_release(mw_vertex_tree *tree);

/* Find the vertices in the box from low to high: they replace those in the list. Returns false when
 * out of memory. */
bool mw__vertex_tree_find(const mw_vertex_tree *tree, const double low[3], const double high[3],
                          mw_vertex_list *list);

/* The box of vertices a and b, and whatever lies within the tolerance of it. */
void mw__vertex_box(const mw_mend_work *work, uint32_t a, uint32_t b, double low[3],
                    double high[3]);

bool mw__vertex_list_add(mw_vertex_list *list, uint32_t vertex);
void mw__vertex_list_release(mw_vertex_list *list);

#endif
