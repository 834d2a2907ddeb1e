/* border_loops.h - the borders of a tiling without ghosts, for walks along them. Private.
 *
 * A border loop is a closed chain of border edges round the part of the plane that is beyond them.
 * At a vertex where several fans of tiles meet, the loop continues at the fan that comes next on
 * the outer side. So a loop never leaves the hole or pocket that it runs round. Tiles that share a
 * vertex are connected. A connected component divides the rest of the plane into faces, and one
 * loop bounds each face. */
#ifndef MW_SRC_TILING_BORDER_LOOPS_H
#define MW_SRC_TILING_BORDER_LOOPS_H

#include "tiling/box_tree.h"

/* An edge of a border loop, 4 * tile + edge. */
typedef struct mw_loop_edge {
    uint32_t half;
    uint32_t next; /* the next edge of the loop */
    uint32_t hole; /* the hole beyond it, or MW_POCKET */
} mw_loop_edge;

/* The loop continues from edge `from` to edge `to`, and turning round the end of `from` through
 * tiles does not lead there. */
typedef struct mw_loop_jump {
    uint32_t from, to;
} mw_loop_jump;

/* The loop round a bounded face: its lowest edge, and the hole along it. */
typedef struct mw_hole_loop {
    uint32_t lowest, hole;
} mw_hole_loop;

typedef struct mw_component {
    mw_box box;
    uint32_t first; /* any of its tiles */
} mw_component;

typedef struct mw_border_loops {
    mw_loop_jump *jump;      /* sorted by `from` */
    mw_hole_loop *loop;      /* sorted by `lowest` */
    mw_component *component; /* small ones before large ones, close ones together */
    uint32_t *component_of;  /* component of a vertex; NULL if there is only one */
    mw_box_tree tree;        /* over the components */
    uint32_t edge_count, jump_count, loop_count, component_count; /* edge_count: border edges */
} mw_border_loops;

void mw__border_loops_release(mw_border_loops *loops);
/* of its tiling */
size_t mw__border_loops_bytes(const mw_border_loops *loops, uint32_t vertex_count);

/* The hole along the loop with this lowest edge; MW_NONE if the loop bounds no bounded face. */
uint32_t mw__border_loops_hole(const mw_border_loops *loops, uint32_t lowest);

/* The jump after border edge `half`: the next edge of its loop if turning round its end does not
 * find it, else MW_NONE. */
uint32_t mw__border_loops_jump(const mw_border_loops *loops, uint32_t half);

#endif
