/* segment_run.h - segments through many tiles at a time, where rounded areas are sure. Private.
 *
 * The pieces are those of mw__segment_next_surely. Both functions are for tilings without cut
 * triangles. */
#ifndef MW_SRC_SEGMENT_SEGMENT_RUN_H
#define MW_SRC_SEGMENT_SEGMENT_RUN_H

#include "segment/segment_walk.h"

/* Begin a segment in the tile that has its beginning inside, and append its first piece. False,
 * and nothing has changed, where that is not sure or the segment does not begin there. */
bool mw__segment_begin_inside(mw_segment *s, const mw_locator *locator, uint32_t tile,
                              const double a[2], const double b[2], mw_segment_piece *piece,
                              size_t *count);

/* Follow a segment that enters a tile over an edge (mw__segment_may_run) up to its end, and append
 * its pieces, at most `room`. Returns false where rounded areas are not sure, and at vertices.
 * There mw__segment_next_surely goes on. */
bool mw__segment_run_far(mw_segment *s, size_t room, mw_segment_piece *piece, size_t *count);

#endif
