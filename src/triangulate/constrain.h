/* constrain.h - segments forced into a triangulation. Private.
 *
 * The triangulation fills the convex hull of its points; its triangles are counter-clockwise and linked. A segment
 * between two of its vertices is forced in piece by piece; pieces end at the vertices that lie on the segment, so a
 * piece has none inside, and two segments on one line share pieces. Where the triangulation was constrained Delaunay
 * before a piece it is so after it: no vertex visible from a triangle lies in its circle. Two segments that cross
 * are reported, the later one is left out from the crossing on. */
#ifndef MW_SRC_CONSTRAIN_H
#define MW_SRC_CONSTRAIN_H

#include "mesh/mesh.h"

/* A step of the border of the channel that a piece opens, see constrain.c. */
typedef struct mw_rim mw_rim;
/* Those of its places where a triangle may be cut off. */
typedef struct mw_ears mw_ears;

typedef struct mw_constrained {
    const mw_point *point;
    mw_triangle *tri; /* changed in place; `user` is used as scratch */
    uint32_t point_count, tri_count;
    uint32_t *piece;             /* per edge, at 3 * triangle + edge: the number of the piece that it is, or MW_NONE */
    uint32_t piece_count;        /* never more than the edges of the triangulation: tri_count + point_count - 1      */
    uint32_t *at;                /* per vertex: a triangle that has it                                               */
    mw_rim *right, *left, *ring; /* scratch */
    mw_ears *ears;
    uint32_t *channel, *flip;
    size_t rim_capacity, flip_capacity;
    size_t reach;  /* a segment may look through this many triangles for the end of a piece: SIZE_MAX unless changed */
    size_t wasted; /* triangles that segments have looked through without making a piece                             */
    uint64_t crossed; /* triangles that the pieces made so far crossed */
} mw_constrained;

/* Prepare; `point` and `tri` stay the caller's and must outlive *c. Returns false when out of memory. Release *c in
 * either case. */
bool mw__constrained_create(mw_constrained *c, const mw_point *point, uint32_t point_count, mw_triangle *tri,
                            uint32_t tri_count);
void mw__constrained_release(mw_constrained *c);

typedef enum mw_constrain_result {
    MW_CONSTRAIN_DONE,    /* the piece is an edge now             */
    MW_CONSTRAIN_CROSSES, /* piece->number is a piece in its way  */
    MW_CONSTRAIN_FAR,     /* neither is found within `reach`      */
    MW_CONSTRAIN_MEMORY,
} mw_constrain_result;

typedef struct mw_piece {
    uint32_t from, to, number; /* from -> to points as the segment does */
} mw_piece;

/* Force in one piece at either end of the segment, and shorten the segment by it: the segment is in when *from and *to
 * have become equal. Time: about the lower degree of the two ends, plus O(m) for the m edges that the piece
 * crosses, plus the flips that restore the Delaunay property, in practice about m. A segment may cross as many edges as
 * there are; but segments that do not cross each other, forced in in random rounds, are expected to cross
 * O(n log n + b log^2 b) edges in all, for n vertices and b segments [Agarwal, Arge, Yi 2005; Shewchuk, Brown 2015]. */
mw_constrain_result mw__constrain(mw_constrained *c, uint32_t *from, uint32_t *to, mw_piece *piece);

/* Met by a segment: a piece that it crosses, or, piece being MW_NONE, a vertex that lies on it. Returns whether to go
 * on. */
typedef bool mw_meet(void *context, uint32_t piece, uint32_t vertex);

/* Tell all that a segment meets between its ends, in order; the triangulation stays as it is. Returns false if `meet`
 * did. */
bool mw__constrained_follow(const mw_constrained *c, uint32_t from, uint32_t to, mw_meet *meet, void *context);

#endif
