/* prober.h - what a prober holds, and what its files share. Private.
 *
 * hit.c decides what a line touches; walk.c and race.c walk over the surface [thesis App. G]; certain.c asks the boxes;
 * probe.c is the query. */
#ifndef MW_SRC_PROBER_H
#define MW_SRC_PROBER_H

#include "mesh/surface.h"
#include "predicates/line.h"
#include "surface/boxes.h"

#include <meshwalk/probe.h>

struct mw_prober {
    const mw_surface *surface;
    mw_surface_boxes boxes;
    bool has_boxes;
    double spread2;     /* mean square of the distance of vertices from their mean, about, as it was at first */
    uint64_t version;   /* of the surface that the boxes hold for */
    double slack;       /* how much larger they are taken to be than they were fitted */
    double slack_limit; /* beyond that they are fitted anew */
    uint64_t fits;
    double fit_seconds;
};

/* --- hit.c -------------------------------------------------------------------------------------------------------- */

/* Does the line touch the triangle, whatever the distance: does it meet it, with m pointing at its front? Exact. False
 * for triangles with a vertex that is not finite. */
bool mw__touches(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Does it meet it, from either side? */
bool mw__meets(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Is a triangle that is touched at most d away? Exact. d may be infinite. */
bool mw__in_reach(const mw_surface *surface, const mw_line *line, uint32_t triangle, double d);

/* Of two triangles that are touched, is s the better answer: nearer, or as near with the lower number? Exact. */
bool mw__better(const mw_surface *surface, const mw_line *line, uint32_t s, uint32_t t);

/* Of the triangles touched at the point where `triangle` is, those that are linked there, the lowest-numbered. */
uint32_t mw__lowest_touched(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* The answer for a triangle that is touched; or for none (MW_TOUCH_NONE, _LIMIT, _BAD). */
mw_touch mw__touch(const mw_surface *surface, const mw_line *line, uint32_t triangle);
mw_touch mw__no_touch(mw_touch_state state);

/* The same for the lowest-numbered of the triangles touched at the point where `triangle` is. */
mw_touch mw__touch_lowest(const mw_surface *surface, const mw_line *line, uint32_t triangle);

/* Is the triangle touched inside, at most d away, so clearly that doubles tell? Then its answer goes to *touch. */
bool mw__touch_again(const mw_surface *surface, const mw_line *line, uint32_t triangle, double d, mw_touch *touch);

/* --- certain.c ---------------------------------------------------------------------------------------------------- */

/* The best triangle that is touched at most max_distance away (0: no limit), or MW_NONE: exact and complete. `seed`: a
 * triangle known to be touched in reach, or MW_NONE. Counts into *counters unless it is NULL. The boxes are up to
 * date. */
uint32_t mw__certain(const mw_prober *prober, const mw_line *line, double max_distance, uint32_t seed,
                     mw_probe_counters *counters);

#endif
