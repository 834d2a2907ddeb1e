/* compensated_sum.h - sums of many doubles with little rounding error. Private. */
#ifndef MW_SRC_MESH_COMPENSATED_SUM_H
#define MW_SRC_MESH_COMPENSATED_SUM_H

#include "base/base.h"

#include <math.h>

/* A sum, and apart from it the sum of the rounding errors [Neumaier 1974]. */
typedef struct mw_sum {
    double sum, lost;
} mw_sum;

static MW_INLINE void mw__sum_add(mw_sum *s, double x)
{
    double next = s->sum + x;
    s->lost += fabs(s->sum) >= fabs(x) ? s->sum - next + x : x - next + s->sum;
    s->sum = next;
}

static MW_INLINE double mw__sum_value(const mw_sum *s)
{
    return isfinite(s->lost) ? s->sum + s->lost : s->sum;
}

#endif
