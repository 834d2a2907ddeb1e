/* overlap_walk.h - the tiles of a mesh that a triangle overlaps. Private.
 *
 * A corner of the triangle is located. From the tile there, the walk crosses every edge that passes
 * through the triangle (clip.h). The tiles of a locator fill a convex region, so all tiles with a
 * common area are connected over such edges: the walk finds all of them, and it tests few others.
 * If the tile of the corner only touches the triangle, the search goes on among tiles that touch
 * it. If all corners lie outside the hull, the walk begins where an edge of the triangle enters the
 * hull. */
#ifndef MW_SRC_OVERLAP_OVERLAP_WALK_H
#define MW_SRC_OVERLAP_OVERLAP_WALK_H

#include "clip/clip.h"
#include "locate/locator.h"

typedef struct mw_overlap_walk {
    const mw_locator *locator;
    mw_cursor cursor;
    mw_point p[3];
    uint32_t *seen;  /* per tile: the last round that visited it */
    uint32_t *queue; /* stack of tiles to visit */
    uint32_t round;
    size_t taken, queued, room;
    bool no_memory;
} mw_overlap_walk;

/* Returns false when out of memory; release it in either case. */
bool mw__overlap_walk_create(mw_overlap_walk *walk, const mw_locator *locator);
void mw__overlap_walk_release(mw_overlap_walk *walk);

/* Forget the last triangle, so that the order of tiles depends only on the calls that follow. */
void mw__overlap_walk_forget(mw_overlap_walk *walk);

/* Begin with a triangle, counter-clockwise, with an area. */
void mw__overlap_walk_begin(mw_overlap_walk *walk, const mw_point p[3]);

/* The next tile, perhaps a ghost, and its common part with the triangle; the tile is Q of clip.h.
 * False at the end or when out of memory. */
bool mw__overlap_walk_next(mw_overlap_walk *walk, uint32_t *tile, mw_clip *clip);

#endif
