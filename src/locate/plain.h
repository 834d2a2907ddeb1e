/* plain.h - plain queries: what they are, how they are answered, and the walk of one alone. Private. See flight.c. */
#ifndef MW_SRC_PLAIN_H
#define MW_SRC_PLAIN_H

#include "locate/locator.h"

/* Areas that may be off by less than this share of their sum are weights, of sums within these bounds. mw__areas and mw__place
 * allow no less (2^-42: here the bound is one for all three, and takes what is lost to the smallest numbers once, not three
 * times); so they would come to the very same weights. */
#define MW_PLAIN 0x1p-44
#define MW_LEAST 0x1p-900
#define MW_MOST 0x1p900
#define MW_SHORT_WAY 64 /* steps of a walk alone, after which the walk of the cursor goes on */

static MW_INLINE void mw__put_inside(mw_location *location, uint32_t user, double a, double b, double c)
{
    bool flipped = user & MW_FLIPPED;
    mw__put_location(location, a, flipped ? c : b, flipped ? b : c, user & MW_USER_MASK, MW_NONE, MW_INSIDE);
}

/* The tiles across the edges: one of them comes next, and while the corners of this one are waited for they all come. */
static MW_INLINE void mw__fetch_across(const mw_triangle *tri, const mw_triangle *tile)
{
    for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(&tri[mw__link_triangle(tile->link[k])]);
}

/* The same step for a single walk. The turn is a jump here: the processor guesses it, and does not wait for the areas before
 * it goes on. */
static MW_INLINE bool mw__fly_alone(const mw_tiling *tiling, mw_point q, bool tolerant, uint32_t *t,
                                    mw_location *location)
{
    const mw_triangle *tri = tiling->tri;
    const mw_point *point = tiling->point;
    uint32_t at = *t;
    for (uint32_t steps = 0; steps < MW_SHORT_WAY; steps++) {
        const mw_triangle *tile = &tri[at];
        mw__fetch_across(tri, tile);
        mw_point a = point[tile->v[0]], b = point[tile->v[1]], c = point[tile->v[2]];
        double ax = a.x - q.x, ay = a.y - q.y, bx = b.x - q.x, by = b.y - q.y, cx = c.x - q.x, cy = c.y - q.y;
        double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
        double off = mw__orient2d_bound(fabs(bc) + fabs(cb) + (fabs(ca) + fabs(ac)), fabs(ab) + fabs(ba));
        double area[3] = {bc - cb, ca - ac, ab - ba};
        uint32_t link;
        if (area[2] < -off) {
            link = tile->link[0];
        } else if (area[0] < -off) {
            link = tile->link[1];
        } else if (area[1] < -off) {
            link = tile->link[2];
        } else {
            double sum = area[0] + area[1] + area[2];
            *t = at;
            if (!(area[0] > off && area[1] > off && area[2] > off && off < MW_PLAIN * sum)) return false;
            if (!(sum > MW_LEAST && sum < MW_MOST) || (tile->user & MW_GHOST && tolerant)) return false;
            if (MW_LIKELY(!(tile->user & MW_GHOST)))
                mw__put_inside(location, tile->user, area[0] / sum, area[1] / sum, area[2] / sum);
            else
                mw__put_in_none(location, tile->user);
            return true;
        }
        if (MW_UNLIKELY(link == MW_NONE)) {
            *t = at;
            mw__put_in_none(location, 0);
            return !tolerant && tiling->embedding;
        }
        at = mw__link_triangle(link);
    }
    *t = at;
    return false;
}

#endif
