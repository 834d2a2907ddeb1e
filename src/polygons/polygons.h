/* polygons.h - polygons that are ready for queries. Private.
 *
 * The rings are constraints of a triangulation. If a segment crosses another one that is an edge
 * already, it is not split: from there on it is a chord of each triangle that it passes through.
 * The chords of a triangle divide it into parts, each covered by one set of polygons. The set
 * stored is that of the points to the left of all chords, whether there are such points or not:
 *
 *          c
 *         / \ B
 *        / k .
 *       /  .  \
 *      a .-----b
 *       A
 *
 * Chord k of polygon P divides the triangle. The stored set is right for a point to the left of k.
 * For a point to the right of k, P is added to the set, or removed if it is in it. A point on k is
 * on P's border. The side of a chord is an orient2d of the segment's own points, so nothing is
 * rounded.
 */
#ifndef MW_SRC_POLYGONS_POLYGONS_H
#define MW_SRC_POLYGONS_POLYGONS_H

#include "mesh/mesh.h"
#include "polygons/polygon_sets.h"
#include "polygons/rank_lists.h"

#include <meshwalk/polygons.h>

/* A segment that is not a chain of edges. */
typedef struct mw_polygon_chord {
    mw_point a, b;
    uint32_t rank; /* of its polygon */
} mw_polygon_chord;

/* Polygons go by rank: the order of their numbers. */
struct mw_polygons {
    mw_mesh *mesh;
    uint32_t *polygon; /* per rank: the user's number                     */
    uint8_t *crossing; /* per rank: do its own segments cross each other? */
    uint32_t polygon_count;
    uint32_t *set; /* per triangle, by number */
    mw_polygon_sets sets;
    uint32_t *subsegment; /* per edge, at 3 * triangle + edge: a row of `owners`, or MW_NONE */
    uint32_t subsegment_count;
    /* per subsegment: the polygons whose segments run along it, as often as they do */
    mw_rank_lists owners;
    mw_rank_lists corners;   /* per vertex: the polygons on whose border it lies */
    mw_rank_lists chords;    /* per triangle: chords, by number */
    mw_polygon_chord *chord; /* in the order of their polygons */
    size_t chord_count;
};

/* The side of a chord on which a point lies: > 0 for the left, 0 on the chord. */
static MW_INLINE double mw__chord_side(const mw_polygon_chord *chord, mw_point q)
{
    return mw__orient2d(chord->a, chord->b, q);
}

#endif
