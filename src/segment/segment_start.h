/* segment_start.h - where the walk along a segment begins. Private. */
#ifndef MW_SRC_SEGMENT_SEGMENT_START_H
#define MW_SRC_SEGMENT_SEGMENT_START_H

#include "segment/segment_walk.h"

/* Find the place of a, which differs from b, from tile `near` on: sets what is reached. */
void mw__segment_start(mw_segment *s, uint32_t near);

#endif
