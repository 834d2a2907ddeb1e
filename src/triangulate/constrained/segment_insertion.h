/* segment_insertion.h - segments forced into a triangulation. Private.
 *
 * The triangulation fills the convex hull of its points; its triangles are counter-clockwise and
 * linked. A segment between two of its vertices is forced in subsegment by subsegment; subsegments
 * end at the vertices that lie on the segment, so a subsegment has none inside, and two segments on
 * one line share subsegments. Where the triangulation was constrained Delaunay before a subsegment
 * it is so after it: no vertex visible from a triangle lies in its circle. Two segments that cross
 * are reported, and the later one is forced in only up to the crossing. */
#ifndef MW_SRC_TRIANGULATE_CONSTRAINED_SEGMENT_INSERTION_H
#define MW_SRC_TRIANGULATE_CONSTRAINED_SEGMENT_INSERTION_H

#include "mesh/mesh.h"

/* A step of the border of the channel that a subsegment opens, see segment_insertion.c. */
typedef struct mw_channel_step mw_channel_step;
/* Its corners where a triangle may be cut off. */
typedef struct mw_ears mw_ears;

typedef struct mw_segment_insertion {
    const mw_point *point;
    mw_triangle *tri; /* changed in place; `user` is used as scratch */
    uint32_t point_count, tri_count;
    /* per edge, at 3 * triangle + edge: the number of the subsegment that it is, or MW_NONE */
    uint32_t *subsegment;
    /* never more than the edges of the triangulation: tri_count + point_count - 1 */
    uint32_t subsegment_count;
    /* per vertex: a triangle that has it */
    uint32_t *at;
    mw_channel_step *right, *left, *ring; /* scratch */
    mw_ears *ears;
    uint32_t *channel, *flip;
    size_t step_capacity, flip_capacity;
    size_t
        /* a segment may look through this many triangles for the end of a subsegment: SIZE_MAX
         * unless changed */
        reach;
    size_t
        /* triangles that segments have looked through without making a subsegment */
        wasted;
    uint64_t crossed; /* triangles that the subsegments made so far crossed */
} mw_segment_insertion;

/* Prepare; `point` and `tri` stay the caller's and must outlive *c. Returns false when out of
 * memory. Release *c in either case. */
bool mw__segment_insertion_create(mw_segment_insertion *c, const mw_point *point,
                                  uint32_t point_count, mw_triangle *tri, uint32_t tri_count);
void mw__segment_insertion_release(mw_segment_insertion *c);

typedef enum mw_subsegment_result {
    MW_SUBSEGMENT_DONE,    /* the subsegment is an edge now             */
    MW_SUBSEGMENT_CROSSES, /* subsegment->number is a subsegment in its way  */
    MW_SUBSEGMENT_FAR,     /* neither is found within `reach`      */
    MW_SUBSEGMENT_MEMORY,
} mw_subsegment_result;

typedef struct mw_subsegment {
    uint32_t from, to, number; /* from -> to points as the segment does */
} mw_subsegment;

/* Force in one subsegment at either end of the segment, and shorten the segment by it: the segment
 * is in when *from and *to have become equal. Time: in proportion to the lower degree of the two
 * ends, plus O(m) for the m edges that the subsegment crosses, plus the flips that restore the
 * Delaunay property, in practice about m. A single segment may cross all edges. But segments that
 * do not cross each other, forced in in random rounds, are expected to cross O(n log n + b log^2 b)
 * edges in all, for n vertices and b segments [Agarwal, Arge, Yi 2005; Shewchuk, Brown 2015]. */
mw_subsegment_result mw__insert_subsegment(mw_segment_insertion *c, uint32_t *from, uint32_t *to,
                                           mw_subsegment *subsegment);

/* Make the edge of a half-edge a subsegment. Returns its number, which is that of before if it is
 * one already. */
uint32_t mw__segment_insertion_mark(mw_segment_insertion *c, uint32_t half);

/* What a segment meets on its way. */
typedef enum mw_segment_meeting {
    MW_MEETS_SUBSEGMENT, /* crosses the subsegment of that number    */
    MW_MEETS_VERTEX,     /* a vertex that lies on it, between its ends */
    MW_MEETS_TRIANGLE,   /* passes through the triangle, inside       */
    MW_MEETS_EDGE,       /* runs along the half-edge, to or from its start */
} mw_segment_meeting;

/* A segment meets the `number` of its kind. Returns whether to go on. */
typedef bool mw_segment_visitor(void *context, mw_segment_meeting meeting, uint32_t number);

/* Tell all that a segment meets between its ends, in order; the triangulation stays as it is.
 * Returns false if `meet` did. */
bool mw__segment_insertion_trace(const mw_segment_insertion *c, uint32_t from, uint32_t to,
                                 mw_segment_visitor *meet, void *context);

#endif
