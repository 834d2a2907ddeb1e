/* bvh_item.h - the triangles that bvh_build.c divides, as boxes; those that no plane divides, in
 * order. Private. */
#ifndef MW_SRC_PROBE_BVH_BVH_ITEM_H
#define MW_SRC_PROBE_BVH_BVH_ITEM_H

#include "surface/surface.h"

#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

typedef float build_vector __attribute__((vector_size(16)));
typedef int32_t build_index __attribute__((vector_size(16)));

static MW_INLINE build_vector vector_min(build_vector a, build_vector b)
{
#ifdef __SSE2__
    return (build_vector)_mm_min_ps((__m128)a, (__m128)b);
#else
    build_index less = a < b;
    return (build_vector)((less & (build_index)a) | (~less & (build_index)b));
#endif
}

static MW_INLINE build_vector vector_max(build_vector a, build_vector b)
{
    return -vector_min(-a, -b);
}

/* A triangle: the sides of its box on three axes. The fourth number of `low` is the triangle; that
 * of `high` is 0, or in a range that is in order a number for its corners. */
typedef struct build_item {
    build_vector low, high;
} build_item;

/* Numbers with this bit are no denormal floats, which are slow. */
#define NORMAL_FLOAT 0x40000000u

static inline uint32_t item_triangle(const build_item *item)
{
    uint32_t bits;
    memcpy(&bits, (const char *)&item->low + 12, sizeof bits);
    return bits & ~NORMAL_FLOAT;
}

static inline void item_set_triangle(build_item *item, uint32_t triangle)
{
    triangle |= NORMAL_FLOAT;
    memcpy((char *)&item->low + 12, &triangle, sizeof triangle);
}

/* Half the surface area of a box. The share of all lines that meet a box is proportional to it. */
static MW_INLINE float area_of(build_vector low, build_vector high)
{
    build_vector d = high - low;
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/* Put items in order that all have one centre: smaller boxes first, equal triangles side by side.
 * The ranges that they are divided into are so, too. */
void mw__bvh_items_order(build_item *item, uint32_t n, const mw_surface *surface);

/* Where to cut items that are in order: in the middle, or between triangles that differ as near to
 * it as they are. Two cuts part equal triangles that are more than half of all from others, and any
 * other cut leaves a quarter on either side: so the tree is at most twice as deep as by halving. */
uint32_t mw__bvh_items_cut(const build_item *item, uint32_t n);

#endif
