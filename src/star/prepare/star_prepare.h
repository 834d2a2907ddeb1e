/* star_prepare.h - fills in what a star holds of its surface. Private. */
#ifndef MW_SRC_STAR_PREPARE_STAR_PREPARE_H
#define MW_SRC_STAR_PREPARE_STAR_PREPARE_H

#include "base/job.h"
#include "star/star.h"

/* Take over the counts of the surface, and what depends on them; also allocate all arrays. */
void mw__star_take_counts(mw_star *star);
bool mw__star_allocate(mw_star *star, bool angles);
void mw__star_release_arrays(mw_star *star);

/* Decide, and fill in everything that depends on coordinates and links. A star that is refused
 * keeps what it holds of its facets, but is not ready. Stages of the job. */
mw_status mw__star_prepare(mw_star *star, mw_job *job, mw_error *error);

/* Fill in everything of a surface that may be star-shaped or not, and track it (star_track.h). The
 * star is not ready. Returns false when out of memory. O(n log n) */
bool mw__star_track_anew(mw_star *star);

/* Find the facet at longitude 0 on the equator, of a star that is ready otherwise. */
void mw__star_find_front(mw_star *star);

/* About the largest coordinate relative to the centre, of the vertices with an owner. */
double mw__star_measure_reach(const mw_star *star);

/* Do some facets lack an area, by the last check? */
static MW_INLINE bool mw__star_has_flats(const mw_star *star)
{
    return star->area_count < star->tri_count - star->freed_count;
}

#endif
