/* bvh_beam.h - a line against the boxes of the eight children of a node, in floats. Private.
 *
 * What is computed must not miss a box that contains a point of the line within its limits. The
 * search then asks exact predicates about the triangles. In the frame of the BVH the line is q + t
 * m; a power of two scales m so that its largest component is 1/2 to 1. A point of the line lies in
 * a box if for each axis
 *
 *     (low - q) / m <= t <= (high - q) / m    (or the other way round, where m < 0),
 *
 * and the line meets the box within its limits if these intervals, and the limits, have a value of
 * t in common. Let u be 2^-24. The computed intervals contain the true ones for these reasons:
 *  - If q is far from the surface, floats would say little of q. So q is moved along the line to
 *    where it is nearest to the centre of the frame, by `shift`, and t counts from there. The
 *    moved q is off the line by less than 2^-51 of the largest coordinate of q: |shift m| is less
 *    than twice that, and a product and a sum are rounded. The boxes are widened by w, at least
 *    2^-50 of that coordinate (mw__bvh_aim).
 *  - A side less w is low - (q + w). The sum is rounded upwards, to a float; q - w is rounded
 *    downwards. So an end is off only by the rounding of the difference, of 1 / m and of the
 *    product: less than 3u + 3u^2 + u^3 + 2^-50 of itself. Ends are moved outwards by END_ERROR =
 *    8u of themselves, which also covers the rounding of that.
 *  - 1 / m and a difference have no error by underflow: |1 / m| >= 1, and differences of floats
 *    are exact where they are denormal. A product is off by less than 2^-149 then. All intervals
 *    are longer than needed by LEAST_WIDTH on both sides, since |1 / m| >= 1.
 *  - Components of m below SMALL_COMPONENT count as 0: then t is not limited if q lies between the
 *    sides, and the interval is empty if not. Sides reach to 2^60 at most (else the box is all of
 *    space), so t is less than 2^64 and the line moves by less than 2^-62, which is less than
 *    LEAST_WIDTH. 0 times infinity, for a line along a side, does not narrow the interval: each
 *    comparison keeps the old end where the new one is NaN.
 *  - A product that overflows says that the box is beyond 2^127, where no box is.
 *  - If q is farther than MW_BVH_FAR, or overflows, w is infinite and all boxes are met. */
#ifndef MW_SRC_PROBE_BVH_BVH_BEAM_H
#define MW_SRC_PROBE_BVH_BVH_BEAM_H

#include "predicates/line_lanes.h"
#include "probe/bvh/bvh.h"

#include <float.h>
#include <stddef.h>
#include <string.h>

/* The line in the frame of the BVH, and which part of it is searched. Axis by axis; the fourth
 * number is not used. */
typedef struct mw_bvh_beam {
    /* The line enters at the low sides, or where m < 0 at the high ones: bytes from the node to the
     * sides where it enters and leaves, and what these are compared with, q + w for low sides and q
     * - w for high ones. */
    uint32_t enter[4], leave[4];
    float add_enter[4], add_leave[4];
    float inverse[4];          /* 1 / m; infinite where m is 0 */
    float less[4], greater[4]; /* the same, made smaller and greater by END_ERROR */
    float from, to;            /* t is limited to these */
    float at_low, at_high;     /* t of the point that distances count from is between these */
    float reach;               /* and may be as far from that as this */
    bool ahead;                /* nothing behind that point counts, and its t is 0 */
    double at, per_length;     /* the same t; t for a unit of length */
} mw_bvh_beam;

#define MW_BEAM_END_ERROR 0x1p-21f
#define MW_BEAM_SMALL_COMPONENT 0x1p-126
#define MW_BEAM_NEAR 4 /* within this, q is not moved */
/* Distances are off by 2^-40 of themselves, |m| and the quotient by a few times 2^-53 more. */
#define MW_BEAM_REACH_ERROR (1 + 0x1p-38)
#define MW_BEAM_LESS (1 - 0x1p-37) /* less than 1 / MW_BEAM_REACH_ERROR */

/* A double rounded to a float that is not greater, or not less. */
#define MW_FLOAT_ROUND 0x1p-22
#define MW_FLOAT_TINY 0x1p-126

static MW_INLINE float mw__float_down(double x)
{
    return (float)(x - (fabs(x) * MW_FLOAT_ROUND + MW_FLOAT_TINY));
}
static MW_INLINE float mw__float_up(double x)
{
    return -mw__float_down(-x);
}

/* Distances from the point, in units of length, that are still of interest: up to `reach`, and from
 * `least` on ahead of it if the line is one-sided. */
static MW_INLINE void mw__beam_limit(mw_bvh_beam *b, double reach, bool one_sided, double least)
{
    double t = (reach + MW_BVH_TINY_LENGTH) * b->per_length * MW_BEAM_REACH_ERROR +
               MW_BVH_LEAST_WIDTH,
           ahead = (one_sided ? least * MW_BEAM_LESS * b->per_length : -t) - MW_BVH_LEAST_WIDTH;
    b->ahead = one_sided && b->at == 0;
    b->reach = mw__float_up(t);
    b->to = mw__float_up(b->at + t);
    b->from = mw__float_down(b->at + ahead);
}

/* m times a power of two, so that its largest component is 1/2 to 1. */
static MW_INLINE void mw__beam_scale(const double m[3], double scaled[3])
{
    double largest = mw__bvh_largest(m), factor;
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    uint64_t exponent = bits >> 52; /* of the double, as it is stored */
    if (MW_LIKELY(exponent >= 1 && exponent <= 2044)) {
        bits = (2045 - exponent) << 52;
        memcpy(&factor, &bits, sizeof factor);
        for (int k = 0; k < 3; k++) scaled[k] = m[k] * factor;
    } else {
        int power = ilogb(largest) + 1;
        for (int k = 0; k < 3; k++) scaled[k] = ldexp(m[k], -power);
    }
}

/* One axis of a beam: a point p of the line, and its direction m. */
static MW_INLINE void mw__beam_set_axis(mw_bvh_beam *b, int k, double p, double m, double width)
{
    float low = mw__float_up(p + width), high = mw__float_down(p - width);
    bool small = fabs(m) < MW_BEAM_SMALL_COMPONENT, down = !small && m < 0;
    uint32_t low_side = (uint32_t)(offsetof(mw_bvh_node, low) + (size_t)k * MW_BVH_SIDES),
             high_side = (uint32_t)(offsetof(mw_bvh_node, high) + (size_t)k * MW_BVH_SIDES);
    double inverse = small ? INFINITY : 1 / m;
    b->inverse[k] = (float)inverse;
    b->less[k] = (float)(inverse * (1 - MW_BEAM_END_ERROR));
    b->greater[k] = (float)(inverse * (1 + MW_BEAM_END_ERROR));
    b->enter[k] = down ? high_side : low_side;
    b->leave[k] = down ? low_side : high_side;
    b->add_enter[k] = down ? high : low;
    b->add_leave[k] = down ? low : high;
}

typedef float mw_beam_floats __attribute__((vector_size(16)));
typedef int32_t mw_beam_offsets __attribute__((vector_size(16)));

static MW_INLINE void mw__beam_store(float to[4], const mw_lanes *from)
{
    mw_beam_floats rounded = __builtin_convertvector(*from, mw_beam_floats);
    memcpy(to, &rounded, sizeof rounded);
}

#define MW_LANES_CHOOSE(mask, a, b)                                                                \
    ((mw_lanes)(((mw_lanes_mask)(a) & (mask)) | ((mw_lanes_mask)(b) & ~(mask))))

/* The same, all three at once (line_lanes.h). */
static MW_INLINE void mw__beam_set_axes(mw_bvh_beam *b, const mw_lanes *p, const mw_lanes *m,
                                        double width)
{
    mw_lanes size = MW_LANES_MAGNITUDE(*m), low = *p + width, high = *p - width;
    mw_lanes infinite = {INFINITY, INFINITY, INFINITY, INFINITY};
    low = low + (MW_LANES_MAGNITUDE(low) * MW_FLOAT_ROUND + MW_FLOAT_TINY);
    high = high - (MW_LANES_MAGNITUDE(high) * MW_FLOAT_ROUND + MW_FLOAT_TINY);
    mw_lanes_mask large = size >= MW_BEAM_SMALL_COMPONENT, down = (*m < 0) & large;
    mw_lanes inverse = MW_LANES_CHOOSE(large, 1 / *m, infinite);
    mw_lanes enter = MW_LANES_CHOOSE(down, high, low), leave = MW_LANES_CHOOSE(down, low, high);
    mw_lanes less = inverse * (1 - MW_BEAM_END_ERROR), greater = inverse * (1 + MW_BEAM_END_ERROR);
    mw__beam_store(b->add_enter, &enter);
    mw__beam_store(b->add_leave, &leave);
    mw__beam_store(b->inverse, &inverse);
    mw__beam_store(b->less, &less);
    mw__beam_store(b->greater, &greater);
    const int32_t side = MW_BVH_SIDES, other = (int32_t)offsetof(mw_bvh_node, high);
    mw_beam_offsets first = {0, side, 2 * side, 0},
                    turned = __builtin_convertvector(down, mw_beam_offsets) & other;
    mw_beam_offsets enters = first + turned, leaves = first + (other - turned);
    memcpy(b->enter, &enters, sizeof enters);
    memcpy(b->leave, &leaves, sizeof leaves);
}

/* All but its limits; in vectors or not. */
static MW_INLINE void mw__beam_aim(mw_bvh_beam *b, const mw_bvh *bvh, const mw_line *line,
                                   double slack, bool vectors)
{
    double q[3], m[3], square = 0, along = 0, shift = 0;
    double width = mw__bvh_aim(bvh, line->q, slack, q);
    mw__beam_scale(line->m, m);
    for (int k = 0; k < 3; k++) {
        square += m[k] * m[k];
        along += m[k] * q[k];
    }
    if (mw__bvh_largest(q) > MW_BEAM_NEAR) shift = -along / square;
    if (vectors) {
        mw_lanes along_m = MW_LANES_POINT(m), p = MW_LANES_POINT(q) + shift * along_m;
        mw__beam_set_axes(b, &p, &along_m, width);
    } else {
        for (int k = 0; k < 3; k++) mw__beam_set_axis(b, k, q[k] + shift * m[k], m[k], width);
    }
    b->at = -shift;
    b->at_low = mw__float_down(b->at);
    b->at_high = mw__float_up(b->at);
    b->per_length = bvh->scale / sqrt(square);
}

/* The sides of the children of a node that are `offset` bytes from its beginning. */
static MW_INLINE const float *mw__beam_sides(const mw_bvh_node *node, uint32_t offset)
{
    return (const float *)(const void *)((const char *)node + offset);
}

/* Test the children of a node against the beam. Returns those that it meets, as bits. No point of
 * the line in child i is nearer than near[i], in t, to the point that distances count from.
 * Children that are triangles, or none, are bits of *triangles. */
typedef uint32_t mw_beam_meets(const mw_bvh_beam *beam, const mw_bvh_node *node,
                               float near[MW_BVH_WIDTH], uint32_t *triangles);

static MW_INLINE uint32_t mw__beam_meets_portable(const mw_bvh_beam *beam, const mw_bvh_node *node,
                                                  float near[MW_BVH_WIDTH], uint32_t *triangles)
{
    uint32_t met = 0;
    *triangles = 0;
    for (uint32_t i = 0; i < MW_BVH_WIDTH; i++) {
        float low = -INFINITY, high = INFINITY;
        for (int k = 0; k < 3; k++) {
            float enter = mw__beam_sides(node, beam->enter[k])[i],
                  leave = mw__beam_sides(node, beam->leave[k])[i];
            float from = (enter - beam->add_enter[k]) * beam->inverse[k],
                  to = (leave - beam->add_leave[k]) * beam->inverse[k];
            low = from > low ? from : low;
            high = to < high ? to : high;
        }
        low = fminf(low * (1 - MW_BEAM_END_ERROR), low * (1 + MW_BEAM_END_ERROR));
        high = fmaxf(high * (1 - MW_BEAM_END_ERROR), high * (1 + MW_BEAM_END_ERROR));
        float before = low - beam->at_high, after = beam->at_low - high;
        near[i] = fmaxf(fmaxf(before, after), 0);
        low = low > beam->from ? low : beam->from;
        high = high < beam->to ? high : beam->to;
        met |= (uint32_t)(low <= high) << i;
        *triangles |= (node->child[i] & MW_BVH_TRIANGLE ? 1u : 0u) << i;
    }
    return met;
}

#ifdef __x86_64__

/* The same, eight at a time. Of two operands, max and min give the second one if one is NaN. */
__attribute__((target("avx2"))) static inline __m256
mw__beam_meets_avx2(const mw_bvh_beam *beam, const mw_bvh_node *node, __m256 *near)
{
    __m256 low = _mm256_set1_ps(-INFINITY), high = _mm256_set1_ps(INFINITY);
    for (int k = 0; k < 3; k++) {
        __m256 inverse = _mm256_set1_ps(beam->inverse[k]);
        __m256 enter = _mm256_load_ps(mw__beam_sides(node, beam->enter[k])),
               leave = _mm256_load_ps(mw__beam_sides(node, beam->leave[k]));
        __m256 from = _mm256_sub_ps(enter, _mm256_set1_ps(beam->add_enter[k])),
               to = _mm256_sub_ps(leave, _mm256_set1_ps(beam->add_leave[k]));
        low = _mm256_max_ps(_mm256_mul_ps(from, inverse), low);
        high = _mm256_min_ps(_mm256_mul_ps(to, inverse), high);
    }
    const __m256 less = _mm256_set1_ps(1 - MW_BEAM_END_ERROR),
                 more = _mm256_set1_ps(1 + MW_BEAM_END_ERROR);
    low = _mm256_min_ps(_mm256_mul_ps(low, less), _mm256_mul_ps(low, more));
    high = _mm256_max_ps(_mm256_mul_ps(high, less), _mm256_mul_ps(high, more));
    __m256 before = _mm256_sub_ps(low, _mm256_set1_ps(beam->at_high)),
           after = _mm256_sub_ps(_mm256_set1_ps(beam->at_low), high);
    *near = _mm256_max_ps(_mm256_max_ps(before, after), _mm256_setzero_ps());
    low = _mm256_max_ps(low, _mm256_set1_ps(beam->from));
    high = _mm256_min_ps(high, _mm256_set1_ps(beam->to));
    return _mm256_cmp_ps(low, high, _CMP_LE_OQ);
}

/* The same for a beam that goes ahead. An end that is not negative is moved outwards by the factor
 * in 1 / m. A negative one stays negative or becomes 0, and no t below 0 counts; the sign of a
 * difference and of a product is that of the exact one. */
__attribute__((target("avx2"))) static inline __m256
mw__beam_meets_ahead(const mw_bvh_beam *beam, const mw_bvh_node *node, __m256 *near)
{
    __m256 low = _mm256_set1_ps(beam->from), high = _mm256_set1_ps(beam->to);
    for (int k = 0; k < 3; k++) {
        __m256 enter = _mm256_load_ps(mw__beam_sides(node, beam->enter[k])),
               leave = _mm256_load_ps(mw__beam_sides(node, beam->leave[k]));
        __m256 from = _mm256_sub_ps(enter, _mm256_set1_ps(beam->add_enter[k])),
               to = _mm256_sub_ps(leave, _mm256_set1_ps(beam->add_leave[k]));
        low = _mm256_max_ps(_mm256_mul_ps(from, _mm256_set1_ps(beam->less[k])), low);
        high = _mm256_min_ps(_mm256_mul_ps(to, _mm256_set1_ps(beam->greater[k])), high);
    }
    *near = _mm256_max_ps(low, _mm256_setzero_ps());
    return _mm256_cmp_ps(low, high, _CMP_LE_OQ);
}

#endif

#endif
