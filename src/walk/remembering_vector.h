/* remembering_vector.h - the remembering walk by rounded areas: four walks side by side. Private.
 *
 * Which walk: that of remembering.c, and step by step the same as remembering_fast.h.
 *
 * Why it exists: a batch has other walks to go on with while one waits, so its steps should guess
 * nothing. Here four walks, the lanes of vectors of four doubles, step together without a jump:
 * areas, signs and edges to cross are selected. Only whether a walk has ended is guessed. 10^6
 * uniform vertices and queries in random order, one thread, ns a query, from a grid: 350 by the
 * ring of single walks (drive.h) with the conclusion apart, 124 by areas but one walk at a time, 90
 * with four; 10^4 vertices: 188, 90, 53. Without AVX2 four take 1.4 and 1.9 times as long.
 *
 * Why it takes the same way, and why it ends: as remembering_fast.h, with the same areas, bound and
 * order of edges. It counts no steps: who drives it does (locate/interleaved.c). */
#ifndef MW_SRC_WALK_REMEMBERING_VECTOR_H
#define MW_SRC_WALK_REMEMBERING_VECTOR_H

#include "walk/remembering_fast.h"

#include <string.h>

/* Walks that step together; a bit for each. */
#define MW_VECTOR_LANES 4
#define MW_VECTOR_ALL ((1u << MW_VECTOR_LANES) - 1)

typedef double mw_vector __attribute__((vector_size(8 * MW_VECTOR_LANES)));
/* 0 or all bits */
typedef int64_t mw_vector_mask __attribute__((vector_size(8 * MW_VECTOR_LANES)));

/* Which lanes of a mask are set, as bits: processors have an instruction for it. */
typedef uint32_t (*mw_vector_bits)(const mw_vector_mask *mask);

static MW_INLINE uint32_t mw__vector_bits_portable(const mw_vector_mask *mask)
{
    mw_vector_mask bit = *mask & (mw_vector_mask){1, 2, 4, 8};
    return (uint32_t)(bit[0] | bit[1] | bit[2] | bit[3]);
}

#ifdef __x86_64__

#include <immintrin.h>

__attribute__((target("avx2"))) static inline uint32_t
mw__vector_bits_avx2(const mw_vector_mask *mask)
{
    return (uint32_t)_mm256_movemask_pd(*(const __m256d *)mask);
}

#endif

typedef struct mw_vector_walk {
    /* q; NaN where there is none: such a lane ends at once */
    double x[MW_VECTOR_LANES], y[MW_VECTOR_LANES];
    uint32_t t[MW_VECTOR_LANES]; /* current tile */
} mw_vector_walk;

/* mw__rounded_areas of the four tiles. */
typedef struct mw_vector_areas {
    const mw_triangle *tile[MW_VECTOR_LANES];
    mw_vector area[3], bound;
} mw_vector_areas;

typedef double mw_vector_point __attribute__((vector_size(16), aligned(8)));

/* Corner v of each tile, seen from q, scaled. */
static MW_INLINE void mw__vector_corner(const mw_vector_areas *of, const mw_vector_walk *w,
                                        const mw_point *point, double scale, uint32_t v,
                                        mw_vector *x, mw_vector *y)
{
    mw_vector_point p[MW_VECTOR_LANES];
    mw_vector qx, qy;
    for (uint32_t k = 0; k < MW_VECTOR_LANES; k++)
        p[k] = *(const mw_vector_point *)&point[of->tile[k]->v[v]];
    memcpy(&qx, w->x, sizeof qx);
    memcpy(&qy, w->y, sizeof qy);
    mw_vector even = __builtin_shufflevector(p[0], p[1], 0, 2, 1, 3),
              odd = __builtin_shufflevector(p[2], p[3], 0, 2, 1, 3);
    *x = (__builtin_shufflevector(even, odd, 0, 1, 4, 5) - qx) * scale;
    *y = (__builtin_shufflevector(even, odd, 2, 3, 6, 7) - qy) * scale;
}

#define MW_VECTOR_MAGNITUDE(a) ((mw_vector)((mw_vector_mask)(a)&INT64_MAX))

static MW_INLINE void mw__vector_areas(mw_vector_areas *of, const mw_vector_walk *w,
                                       const mw_triangle *tri, const mw_point *point, double scale)
{
    mw_vector x[3], y[3];
    for (uint32_t k = 0; k < MW_VECTOR_LANES; k++) of->tile[k] = &tri[w->t[k]];
    for (uint32_t v = 0; v < 3; v++) mw__vector_corner(of, w, point, scale, v, &x[v], &y[v]);
    mw_vector bc = x[1] * y[2], cb = y[1] * x[2], ca = x[2] * y[0], ac = y[2] * x[0],
              ab = x[0] * y[1], ba = y[0] * x[1];
    of->area[0] = bc - cb;
    of->area[1] = ca - ac;
    of->area[2] = ab - ba;
    of->bound = MW_ORIENT2D_ERROR * ((MW_VECTOR_MAGNITUDE(bc) + MW_VECTOR_MAGNITUDE(cb)) +
                                     (MW_VECTOR_MAGNITUDE(ca) + MW_VECTOR_MAGNITUDE(ac)) +
                                     (MW_VECTOR_MAGNITUDE(ab) + MW_VECTOR_MAGNITUDE(ba))) +
                MW_UNDERFLOW_ERROR;
    for (uint32_t v = 0; v < 3 && scale != 1; v++)
        of->bound += MW_SCALED_ERROR * (MW_VECTOR_MAGNITUDE(x[v]) + MW_VECTOR_MAGNITUDE(y[v]));
}

/* One step of each: cross the first edge beyond which q surely lies. Returns the lanes that ended,
 * as bits: where there is no such edge, and where it is on the hull; the latter are *left. */
static MW_INLINE uint32_t mw__vector_cross(const mw_vector_areas *of, mw_vector_walk *w,
                                           uint32_t *left, mw_vector_bits bits)
{
    mw_vector_mask beyond[3] = {of->area[2] < -of->bound, of->area[0] < -of->bound,
                                of->area[1] < -of->bound}; /* edges 0, 1, 2 */
    mw_vector_mask any = beyond[0] | beyond[1] | beyond[2], first = (2 + beyond[1]) & ~beyond[0];
    int64_t edge[MW_VECTOR_LANES];
    memcpy(edge, &first, sizeof edge);
    uint32_t hull = 0;
    for (uint32_t k = 0; k < MW_VECTOR_LANES; k++) {
        uint32_t link = of->tile[k]->link[edge[k]];
        hull |= (uint32_t)(link == MW_NONE) << k;
        w->t[k] = mw__link_triangle(link);
    }
    *left = bits(&any) & hull;
    return (bits(&any) ^ MW_VECTOR_ALL) | hull;
}

/* mw__rounded_weights of each; returns those where q is surely inside, as bits. */
static MW_INLINE uint32_t mw__vector_weights(const mw_vector_areas *of,
                                             double weight[3][MW_VECTOR_LANES], mw_vector_bits bits)
{
    mw_vector sum = of->area[0] + of->area[1] + of->area[2];
    mw_vector_mask inside = (of->area[0] > of->bound) & (of->area[1] > of->bound) &
                            (of->area[2] > of->bound) & (of->bound < MW_WEIGHT_ERROR * sum) &
                            (sum > MW_WEIGHT_SUM_LEAST) & (sum < MW_WEIGHT_SUM_MOST);
    for (uint32_t v = 0; v < 3; v++) {
        mw_vector w = of->area[v] / sum;
        memcpy(weight[v], &w, sizeof w);
    }
    return bits(&inside);
}

#endif
