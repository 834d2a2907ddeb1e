/* star_follow.h - a star that follows the editor of its surface. Private. */
#ifndef MW_SRC_STAR_PREPARE_STAR_FOLLOW_H
#define MW_SRC_STAR_PREPARE_STAR_FOLLOW_H

#include "star/star.h"

/* Follow the edits of the surface from now on: track all facets, if none lacks an area. A star that
 * was out of date is up to date afterwards if the surface is star-shaped. False when out of memory:
 * the star does not follow. O(n), O(n log n) for a star that is out of date. */
bool mw__star_attach(mw_star *star);
void mw__star_detach(mw_star *star);

/* Can the next edit be followed? `shape` is the surface's before the edit. */
bool mw__star_follows(const mw_star *star, uint64_t shape);

/* An edit has been followed (star_track.h), and no owner is lost: is the surface star-shaped now?
 * The star is ready then, but of the version that it was of. */
void mw__star_edit_end(mw_star *star);

#endif
