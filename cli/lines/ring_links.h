/* ring_links.h - rings made of the segments that bound a region of the plane.
 *
 *      o--->---o        The region lies to the left of each segment. Two segments that run against
 *      |       |        each other cancel: there the region is on both sides. What is left is
 *      ^   o   v        linked at points where several segments begin so that each ring goes round
 *      |  / \  |        one part of the region, and a ring that comes back to one of its points is
 *      o--o  o-o        cut there. So no ring touches itself: a hole that touches the outline in a
 *                       point is a hole, as the OGC's polygons want it. */
#ifndef MW_CLI_LINES_RING_LINKS_H
#define MW_CLI_LINES_RING_LINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ring_segment {
    double from[2], to[2];
    uint32_t part; /* of the region */
} ring_segment;

/* Room for segments: all zero is empty. */
typedef struct ring_segments {
    ring_segment *all;
    size_t count, room;
} ring_segments;

/* Append a segment, unless its ends are equal. False: memory ran out. */
bool ring_segments_add(ring_segments *s, const double from[2], const double to[2], uint32_t part);

/* A ring of at least three points, of which no two are equal; the first is not repeated. */
typedef struct linked_ring {
    size_t first, count; /* of its points */
    uint32_t part;       /* lowest of those that hang together */
    bool outer;          /* the region is inside: counter-clockwise */
    double area;
    double box[4]; /* least x and y, greatest x and y */
} linked_ring;

typedef struct ring_set {
    double *points; /* x, y of the points of all rings */
    linked_ring *rings;
    size_t count;
} ring_set;

/* Link segments to rings. At each point as many segments must begin as end. Parts are connected if
 * segments between them cancel: they are joined in `parents` (part_sets.h). False: memory ran out.
 * Release the rings in both cases. Time: O(n log n), whatever meets where.
 */
bool ring_links_make(const ring_segments *segments, uint32_t *parents, ring_set *set);
void ring_set_release(ring_set *set);

/* Does a ring hold a point? > 0: inside, 0: on the ring, < 0: outside. Exact. */
int ring_holds(const ring_set *set, const linked_ring *r, const double p[2]);

#endif
