/* star_meeting.c - the point where a ray meets the polyhedron. */
#include "predicates/line_plane.h"
#include "star/query/star_locate.h"

void mw__star_meeting(const mw_star *star, const mw_location *location, const double q[3],
                      double meeting[3])
{
    if (location->triangle == MW_NONE) {
        for (int k = 0; k < 3; k++) meeting[k] = NAN;
        return;
    }
    const uint32_t *v = star->surface->tri[location->triangle].v;
    mw__line_meets_plane(mw__star_corner_point(star, v, 0), mw__star_corner_point(star, v, 1),
                         mw__star_corner_point(star, v, 2), star->centre, q, meeting);
}
