/* lifted.h - vertices relative to a point and lifted to the paraboloid x^2 + y^2: sides and circles
 * with few operations. Private.
 *
 * Both tests are those of the predicates, with bounds that need only the lifts. */
#ifndef MW_SRC_WALK_LIFTED_H
#define MW_SRC_WALK_LIFTED_H

#include "tiling/tiling.h"
#include "predicates/predicates.h"

/* A vertex seen from a point: the way there, and its square. */
typedef struct mw_lifted_vertex {
    double x, y, lift;
    uint32_t vertex;
} mw_lifted_vertex;

static MW_INLINE mw_lifted_vertex mw__lift_vertex(const mw_tiling *tiling, uint32_t vertex,
                                                  mw_point q)
{
    double x = tiling->point[vertex].x - q.x, y = tiling->point[vertex].y - q.y;
    return (mw_lifted_vertex){x, y, x * x + y * y, vertex};
}

/* mw__orient2d of a and b, seen from q, and q. The bound is that of mw__orient2d_bound, (3 u + 16
 * u^2) times |ax by| + |ay bx|, but computed from the lifts alone. That sum is at most the product
 * of both lengths, which is at most half the sum of the lifts; their relative error is below 3 u.
 */
static MW_INLINE double mw__lifted_side(const mw_tiling *tiling, const mw_lifted_vertex *a,
                                        const mw_lifted_vertex *b, mw_point q)
{
    double det = a->x * b->y - a->y * b->x;
    if (MW_LIKELY(fabs(det) > (a->lift + b->lift) * (2.0 * 0x1p-53) + MW_UNDERFLOW_ERROR))
        return det;
    return mw__orient2d_exact(tiling->point[a->vertex], tiling->point[b->vertex], q);
}

/* mw__incircle_rounded of a, b and c, seen from q, and q, with a bound computed from the lifts
 * alone. triangulate/delaunay/delaunay_grow.c explains why 11 u (ab + bc + ca) is a bound; for
 * three numbers, ab + bc + ca is at most a third of their squared sum. If that square does not
 * overflow, nothing else does. Underflow may cost 2^-1071 times the lifts; unless the lifts are
 * small, what 4 u exceeds 11 u / 3 by covers it. */
#define MW_LIFTED_ERROR (4.0 * 0x1p-53)
static MW_INLINE double mw__lifted_incircle(const mw_lifted_vertex *a, const mw_lifted_vertex *b,
                                            const mw_lifted_vertex *c, double *bound)
{
    double lifts = a->lift + b->lift + c->lift;
    *bound = lifts * lifts * MW_LIFTED_ERROR + MW_UNDERFLOW_ERROR;
    return a->lift * (b->x * c->y - b->y * c->x) + b->lift * (c->x * a->y - c->y * a->x) +
           c->lift * (a->x * b->y - a->y * b->x);
}

#endif
