/* star_renew.h - all facets of a star decided where they stand. Private. */
#ifndef MW_SRC_STAR_PREPARE_STAR_RENEW_H
#define MW_SRC_STAR_PREPARE_STAR_RENEW_H

#include "base/job.h"
#include "star/star.h"

/* Can that be: was the star ready, with no facet without area, have only vertices moved since, and
 * does its guide still lead well? */
bool mw__star_can_renew(const mw_star *star);

/* Decide them, and set what depends on coordinates. False: the surface is not star-shaped any more,
 * memory is short, or the job is to stop; the star is not ready then, and to be prepared anew. A
 * stage that takes the present part of the job. O(n), without a sort. */
bool mw__star_renew(mw_star *star, mw_job *job);

#endif
