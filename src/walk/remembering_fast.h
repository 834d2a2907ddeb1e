/* remembering_fast.h - the remembering walk by rounded areas: one query at a time. Private.
 *
 * Which walk: that of remembering.c.
 *
 * Why it exists: that walk keeps only signs, so that the answer has to compute anew the areas of
 * the triangles that q makes with the sides of the last tile; their shares are the weights. Here a
 * step computes these three areas, rounded, with one bound on the error of all. If one is surely
 * negative, q lies beyond that side. If all are surely positive, they give the weights: the walk
 * ends with the answer. No exact predicate is called, so no registers have to be saved for a call.
 *
 * Why it takes the same way: it leaves over the first edge, in the order of the tile, beyond which
 * q surely lies. The edge by which it came needs no memory: its area is made of the same products
 * as in the tile before, with the other sign, so it is positive. Where rounding leaves an edge
 * open that q lies beyond, the walk tries the next one. It then goes another way that Lawson's walk
 * may go: it never crosses an edge that q does not lie beyond.
 *
 * Why it ends: on a Delaunay mesh each step lowers the power of q with respect to the circle of the
 * tile, as for every way of Lawson's walk (docs/proofs/walks.md). Elsewhere it may go in cycles:
 * after MW_FAST_STEPS steps it gives up. What it could not decide, or not in so many steps, goes on
 * by a walk of drive.h from the tile where it stands. */
#ifndef MW_SRC_WALK_REMEMBERING_FAST_H
#define MW_SRC_WALK_REMEMBERING_FAST_H

#include "walk/prefetch.h"
#include "walk/walk.h"

#define MW_FAST_STEPS 64

/* Shares of rounded areas are weights if the bound on the error is below this part of the sum, and
 * the sum between these limits. The exact conclusion (mw__location_areas, mw__location_of in
 * locate/location.c) would then take the same rounded areas, and come to the very same weights: it
 * allows 2^-42, with a bound for each area instead of one for all, and the same sums. */
#define MW_WEIGHT_ERROR 0x1p-44
#define MW_WEIGHT_SUM_LEAST 0x1p-900
#define MW_WEIGHT_SUM_MOST 0x1p900

/* Where the products of coordinates leave the doubles, differences are multiplied by a power of two
 * first; else by 1, a literal, which costs nothing. That is exact, unless it underflows. Then each
 * difference is off by at most 2^-1075: the bound has SCALED_ERROR times all of them more. */
#define MW_SCALED_ERROR 0x1p-1000

/* Areas (twice) of the triangles that q makes with the sides of a tile, area[k] opposite to corner
 * k, as mw__location_areas has them where it need not be exact. The bound is that of orient2d, with
 * the products of all three in the place of the two of each: no less than any of theirs. */
typedef struct mw_rounded_areas {
    double area[3], bound;
} mw_rounded_areas;

static MW_INLINE mw_rounded_areas mw__rounded_areas(const mw_point *point, const mw_triangle *tile,
                                                    mw_point q, double scale)
{
    mw_point a = point[tile->v[0]], b = point[tile->v[1]], c = point[tile->v[2]];
    double ax = (a.x - q.x) * scale, ay = (a.y - q.y) * scale, bx = (b.x - q.x) * scale,
           by = (b.y - q.y) * scale, cx = (c.x - q.x) * scale, cy = (c.y - q.y) * scale;
    double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
    double bound =
        mw__orient2d_bound(fabs(bc) + fabs(cb) + (fabs(ca) + fabs(ac)), fabs(ab) + fabs(ba));
    if (scale != 1)
        bound +=
            MW_SCALED_ERROR * (fabs(ax) + fabs(ay) + (fabs(bx) + fabs(by)) + (fabs(cx) + fabs(cy)));
    return (mw_rounded_areas){{bc - cb, ca - ac, ab - ba}, bound};
}

/* Is q surely inside the tile, and are these its weights? */
static MW_INLINE bool mw__rounded_weights(const mw_rounded_areas *of, double weight[3])
{
    const double *area = of->area, bound = of->bound, sum = area[0] + area[1] + area[2];
    if (!(area[0] > bound && area[1] > bound && area[2] > bound && bound < MW_WEIGHT_ERROR * sum))
        return false;
    if (!(sum > MW_WEIGHT_SUM_LEAST && sum < MW_WEIGHT_SUM_MOST)) return false;
    weight[0] = area[0] / sum; /* no loop: gcc would make vectors of it, by way of memory */
    weight[1] = area[1] / sum;
    weight[2] = area[2] / sum;
    return true;
}

/* Walk to q from tile *t, which becomes the tile where the walk ended. MW_VERDICT_FOUND: q is
 * inside it, with these weights; MW_VERDICT_LEFT: beyond an edge of it that is on the hull;
 * MW_VERDICT_UNSURE: rounding cannot tell; MW_VERDICT_OUT_OF_FUEL: too far. Each turn is a jump, so
 * that the processor predicts where to go on: a single walk should not wait for the areas. */
static MW_INLINE mw_verdict mw__remembering_fast(const mw_tiling *tiling, mw_point q, double scale,
                                                 uint32_t *t, double weight[3])
{
    const mw_triangle *tri = tiling->tri, *tile = &tri[*t];
    mw_verdict verdict = MW_VERDICT_OUT_OF_FUEL;
    for (uint32_t steps = 0; steps < MW_FAST_STEPS; steps++) {
        mw__prefetch_across(tri, tile);
        const mw_rounded_areas of = mw__rounded_areas(tiling->point, tile, q, scale);
        uint32_t link;
        if (of.area[2] < -of.bound) {
            link = tile->link[0];
        } else if (of.area[0] < -of.bound) {
            link = tile->link[1];
        } else if (of.area[1] < -of.bound) {
            link = tile->link[2];
        } else {
            verdict = mw__rounded_weights(&of, weight) ? MW_VERDICT_FOUND : MW_VERDICT_UNSURE;
            break;
        }
        if (MW_UNLIKELY(link == MW_NONE)) {
            verdict = MW_VERDICT_LEFT;
            break;
        }
        tile = &tri[mw__link_triangle(link)];
    }
    *t = (uint32_t)(tile - tri);
    return verdict;
}

/* One step that only leads nearer to q; it does not matter if rounding makes it wrong. Returns the
 * link over an edge beyond which q seems to lie: MW_NONE if it is on the hull, a link to edge 0 of
 * t itself if there is no such edge. The edge is looked up in a table, since a processor would
 * predict a jump wrong. */
static MW_INLINE uint32_t mw__link_nearer(const mw_tiling *tiling, mw_point q, uint32_t t)
{
    /* by the edges that q lies beyond, as bits */
    static const uint8_t edge[8] = {3, 0, 1, 0, 2, 2, 1, 3};
    const mw_triangle *tile = &tiling->tri[t];
    const uint32_t way[4] = {tile->link[0], tile->link[1], tile->link[2], mw__link(t, 0)};
    const mw_rounded_areas of = mw__rounded_areas(tiling->point, tile, q, 1);
    return way[edge[(uint32_t)(of.area[2] < 0) | (uint32_t)(of.area[0] < 0) << 1 |
                    (uint32_t)(of.area[1] < 0) << 2]];
}

#endif
