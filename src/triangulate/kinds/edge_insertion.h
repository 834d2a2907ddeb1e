/* edge_insertion.h - a triangle with a bad angle is replaced, together with triangles beyond it, by
 * better ones. Private. */
#ifndef MW_SRC_TRIANGULATE_KINDS_EDGE_INSERTION_H
#define MW_SRC_TRIANGULATE_KINDS_EDGE_INSERTION_H

#include "mesh/mesh.h"

typedef struct mw_visible_triangle mw_visible_triangle; /* see edge_insertion.c */
typedef struct mw_chain mw_chain;
typedef struct mw_chain_edge mw_chain_edge;

/* The `user` of triangles. Fixed ones stay; those that were tried are free, too. */
enum { MW_INSERTION_FREE, MW_INSERTION_TRIED, MW_INSERTION_FIXED };

typedef struct mw_insertion {
    const mw_point *point;
    mw_triangle *tri; /* fills the convex hull, counter-clockwise and linked; changed in place */
    uint32_t reach;   /* edges that an inserted one may cross at most */
    uint64_t work;    /* in tests of ears: grows */
    uint64_t most_work;
    size_t most_seen; /* of one search; 40 bytes each, and what room is made ahead */
    uint32_t *made;   /* the triangles written by the last success */
    uint32_t made_count;
    /* scratch: */
    mw_visible_triangle *seen;
    mw_chain *chain;
    mw_chain_edge *edge_list;
    uint32_t *placed;
    size_t seen_count, chain_count, seen_room, chain_room, made_room, placed_room, edge_room;
} mw_insertion;

typedef enum mw_insertion_result {
    MW_INSERTION_NONE,
    MW_INSERTION_DONE,
    /* not decided: most_work or most_seen is reached; no triangle has changed */
    MW_INSERTION_SPENT,
    MW_INSERTION_MEMORY
} mw_insertion_result;

/* Visible triangles and what is on the chains have numbers of 32 bits. */
#define MW_INSERTION_MOST_SEEN (UINT32_MAX - 4)

/* Try to replace triangle t, whose largest angle is at its vertex k, and free triangles beyond its
 * opposite edge, by triangles with smaller angles only. With no limit of reach the answer "none" is
 * final: no triangulation of what the free triangles cover has only angles smaller than that one,
 * if it is the largest among them. */
mw_insertion_result mw__insert_edge(mw_insertion *in, uint32_t t, uint32_t k);

void mw__insertion_release(mw_insertion *in);

#endif
