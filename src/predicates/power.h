/* power.h - exact tests of weighted points. Private.
 *
 * A point x with weight w is lifted to the height |x|^2 - w. Three points that turn left lift to a
 * plane; a fourth is below it where it lies deeper in their power circle than its own weight. With
 * equal weights that is the circumcircle, and the test is incircle. Signs are right for all finite
 * doubles. */
#ifndef MW_SRC_PREDICATES_POWER_H
#define MW_SRC_PREDICATES_POWER_H

#include "predicates/predicates.h"

typedef struct mw_weighted_point {
    mw_point at;
    double weight;
} mw_weighted_point;

/* Bound for the power test in terms of its permanent. As for incircle, but a lift is the sum of
 * two squares and a difference of weights: off by the factor (1 + u)^5 of the sum of their
 * magnitudes. Its product with a minor, rounded, is off by (10u + 41u^2 + ...) of the product of
 * the permanents, which is (10u + 60u^2 + ...) of the computed one. The sums make it 11u + 90u^2 +
 * .... (11u + 160u^2)(1 - u)^2 is more. Underflow as for incircle: the difference of weights has
 * none. */
#define MW_POWER_ERROR ((11.0 + 160.0 * 0x1p-53) * 0x1p-53)

double mw__power_exact(const mw_weighted_point p[4]);

/* For a, b, c counter-clockwise: > 0: d lies below the plane of a, b, c, each lifted; < 0: above;
 * 0: on it. */
static MW_INLINE double mw__power(const mw_weighted_point p[4])
{
    double x[3], y[3], lift[3], size[3], det = 0, permanent = 0, lifts = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = p[i].at.x - p[3].at.x;
        y[i] = p[i].at.y - p[3].at.y;
        double square = x[i] * x[i] + y[i] * y[i], weight = p[3].weight - p[i].weight;
        lift[i] = square + weight;
        size[i] = square + fabs(weight);
        lifts += size[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double left = x[j] * y[k], right = x[k] * y[j];
        det += lift[i] * (left - right);
        permanent += size[i] * (fabs(left) + fabs(right));
    }
    if (MW_LIKELY(lifts < MW_INCIRCLE_LIFTS &&
                  fabs(det) > MW_POWER_ERROR * permanent + MW_UNDERFLOW_ERROR))
        return det;
    return mw__power_exact(p);
}

/* For a and b at different points, and d on the line through them: 1: d lies below the line
 * through the lifted a and b; -1: above; 0: on it. Always exact. p: a, b, d. */
int mw__power_on_line(const mw_weighted_point p[3]);

#endif
