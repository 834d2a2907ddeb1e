/* overlap_walk.h - the tiles of a mesh that a triangle has area in common with. Private.
 *
 * A triangle is located by a corner; from the tile there the walk crosses every edge of which a
 * part lies inside the triangle (clip.h). Tiles of a locator fill a convex region, so what they
 * share with a triangle is connected over such edges, and the walk ends with the last tile: it
 * tests only tiles with a common area and those across the triangle's edges. Where the corner's
 * tile only touches the triangle, tiles that touch it are searched for one with an area; a
 * triangle whose corners are all outside the hull is entered over its edges. */
#ifndef MW_SRC_OVERLAP_OVERLAP_WALK_H
#define MW_SRC_OVERLAP_OVERLAP_WALK_H

#include "clip/clip.h"
#include "locate/locator.h"

typedef struct mw_overlap_walk {
    const mw_locator *locator;
    mw_cursor cursor;
    mw_point p[3];
    uint32_t *seen;  /* per tile: the round that met it last */
    uint32_t *queue; /* tiles that were met and wait */
    uint32_t round;
    size_t taken, queued, room;
    bool no_memory;
} mw_overlap_walk;

/* False without memory; release it in either case. */
bool mw__overlap_walk_create(mw_overlap_walk *walk, const mw_locator *locator);
void mw__overlap_walk_release(mw_overlap_walk *walk);

/* Forget where the last triangle was, so that the order of tiles depends on what follows only. */
void mw__overlap_walk_forget(mw_overlap_walk *walk);

/* Begin with a triangle, counter-clockwise, with an area. */
void mw__overlap_walk_begin(mw_overlap_walk *walk, const mw_point p[3]);

/* The next tile, a ghost perhaps, with what it has in common with the triangle: the tile is Q.
 * False at the end, or without memory. */
bool mw__overlap_walk_next(mw_overlap_walk *walk, uint32_t *tile, mw_clip *clip);

#endif
