/* clip.h - the part that a triangle P and a convex polygon Q have in common: its corners, its area
 * and the integrals of linear functions over it. Private.
 *
 *          q_2                  Which corners of P lie in Q, which of Q in P, and which edges cross
 *        .                      is decided by orient2d alone, exactly: no point is computed for it.
 *      .   p_2 .                Then the corners of the common part follow from each other along
 *    q_0 - x---\ - x - - q_1    the edges: on an edge of P as long as that is inside Q, and on the
 *         /     \               edge of Q where it leaves.
 *       p_0-----p_1
 *
 * If corners lie on edges, P counts as moved by (e, e^2) with an infinitely small e > 0. So no
 * corner lies on an edge, and two cells that share an edge follow the same rule: if cells tile the
 * plane, their parts of one triangle are disjoint and cover it. A common part without area does not
 * count, decided exactly.
 *
 * A corner of the common part is given by its weights: those of the corners of P, and those of q_0,
 * q_1 and the last corner of Q. A weight is a quotient of areas of one sign, so no digits cancel:
 * its relative error is below 2^-43, nearly always a few 2^-53. The area is computed from weights
 * in the smaller of P and Q. So its error is that fraction of the smaller area, however far from
 * the origin both are, and sums over cells conserve areas up to rounding.
 *
 * P and Q must be counter-clockwise, P must have an area, and Q must be convex without equal
 * consecutive corners. If areas are not between 2^-900 and 2^900, or their ratio is not, corners
 * are right but areas are not. Cost: 6 m orient2d for m corners of Q. */
#ifndef MW_SRC_CLIP_CLIP_H
#define MW_SRC_CLIP_CLIP_H

#include "predicates/predicates.h"

#define MW_CLIP_SIDES 8 /* the most that Q has */

typedef struct mw_clip_corner {
    double p[3]; /* weights of the corners of P: none negative, sum 1 up to rounding */
    /* weights of corners 0, 1 and m - 1 of Q; some are negative if Q has more than three corners */
    double q[3];
} mw_clip_corner;

typedef struct mw_clip {
    uint32_t count; /* corners, counter-clockwise; 0: no area in common */
    mw_clip_corner corner[MW_CLIP_SIDES + 3];
    uint32_t over;             /* bit j: a part of edge j of Q lies inside P after P has moved */
    double double_p, double_q; /* twice the areas of P and of the triangle of those corners of Q */
} mw_clip;

/* Clip P by Q, which has m corners, at most MW_CLIP_SIDES. Returns the number of corners of the
 * common part, at most m + 3; 0 if they have no common area. */
uint32_t mw__clip(const mw_point p[3], const mw_point *q, uint32_t m, mw_clip *clip);

/* Do P and Q have a point in common? Exact. */
bool mw__clip_touches(const mw_point p[3], const mw_point *q, uint32_t m);

/* The area of the triangle of corners 0, k and k + 1. The triangles for k from 1 to count - 2 make
 * up the common part. Never negative. */
double mw__clip_part(const mw_clip *clip, uint32_t k);

/* Integrals over the common part. */
typedef struct mw_clip_integral {
    double area;
    /* The integral of each weight. The integral of a linear function with the values f[] at the
     * corners of P is the sum of p[i] * f[i]; the centroid is the sum of p[i] / area * (corner i).
     */
    double p[3], q[3];
} mw_clip_integral;

/* All 0 if there is no common part. */
mw_clip_integral mw__clip_integral(const mw_clip *clip);

#endif
