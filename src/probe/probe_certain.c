/* probe_certain.c - certain probes: searches all triangles in the boxes that the line meets in
 * reach, nearer boxes first.
 *
 * Doubles with margins decide which boxes are searched. Exact predicates decide which triangles are
 * touched, and which touch is nearer. So a box that contains the answer must not be missed. In the
 * frame of the BVH the line is q + t m. A power of two scales m so that its largest component is
 * 1/2 to 1. If a point of the line lies in a box, in reach, then for each axis k
 *
 *     (low[k] - q[k]) / m[k] <= t <= (high[k] - q[k]) / m[k]   (or the other way round),
 *     -reach <= t <= reach,
 *
 * and the line meets the box if these intervals have a point in common. The computed intervals
 * differ for these reasons:
 *  - q in the frame is off by 2^-53 of itself, and by underflow. The boxes are widened by 2^-50 of
 *    the largest coordinate of q.
 *  - Boxes are widened by w. Then low - q is off by 2^-53 of itself, and (low - q) - w by as much
 *    again. If the two do not cancel, this is less than 2^-50 of the result; if they do, it is less
 *    than 2^-50 w. So w is taken 1 + 2^-40 times as large, and the ends of intervals are moved by
 *    2^-48 of themselves. This covers 1 / m and the product, too.
 *  - Components of m below 2^-800 may have underflown. They count as 0. Boxes reach to 2^127 at
 *    most (else they are all of space), so |t| < 2^130, and the line moves by less than 2^-660.
 *    w is at least 2^-600. Nothing overflows then: 1 / m <= 2^800. Products that underflow are off
 *    by 2^-1075, which w covers, too.
 *  - If q is farther than 2^100, or overflows, all boxes are searched. */
#include "probe/prober.h"

#define END_ERROR 0x1p-48
#define SMALL_COMPONENT 0x1p-800
/* Distances are off by 2^-40 of themselves, |m| and the quotient by a few times 2^-53 more. */
#define REACH_ERROR (1 + 0x1p-38)
#define GREATEST_REACH 0x1p1000

/* The line in the frame of the BVH. */
typedef struct beam {
    double q[3], inverse[3]; /* 1 / m; infinite where m is 0 */
    double width;            /* boxes are widened by this */
    double per_length;       /* t for a unit of length */
    double reach;
} beam;

typedef struct certain_search {
    const mw_prober *prober;
    const mw_line *line;
    double max_distance;
    uint32_t best;
    beam beam;
    uint64_t boxes, triangles, hits;
} certain_search;

static void beam_set_reach(beam *b, double distance)
{
    double reach =
        (distance + MW_BVH_TINY_LENGTH) * b->per_length * REACH_ERROR + MW_BVH_LEAST_WIDTH;
    b->reach = reach < GREATEST_REACH ? reach : GREATEST_REACH;
}

static beam beam_make(const mw_prober *prober, const mw_line *line)
{
    beam b;
    double largest = fmax(fabs(line->m[0]), fmax(fabs(line->m[1]), fabs(line->m[2]))), square = 0;
    b.width = mw__bvh_aim(&prober->bvh, line->q, prober->slack, b.q);
    int exponent = ilogb(largest) + 1;
    for (int k = 0; k < 3; k++) {
        double m = ldexp(line->m[k], -exponent);
        if (fabs(m) < SMALL_COMPONENT) m = 0;
        b.inverse[k] = m == 0 ? INFINITY : 1 / m;
        square += m * m;
    }
    b.per_length = prober->bvh.scale / sqrt(square);
    return b;
}

/* Does the beam meet a box? Then it meets nothing in the box before t = *near. Comparisons are
 * written so that a NaN does not narrow the interval: 0 / 0, for a line along a side. */
static MW_INLINE bool beam_meets_box(const beam *b, const mw_bvh_box *box, double *near)
{
    double low = -b->reach, high = b->reach;
    for (int k = 0; k < 3; k++) {
        double s = ((double)box->low[k] - b->q[k] - b->width) * b->inverse[k];
        double e = ((double)box->high[k] - b->q[k] + b->width) * b->inverse[k];
        double from = b->inverse[k] < 0 ? e : s, to = b->inverse[k] < 0 ? s : e;
        low = from > low ? from : low;
        high = to < high ? to : high;
    }
    low -= fabs(low) * END_ERROR;
    high += fabs(high) * END_ERROR;
    *near = low > 0 ? low : high < 0 ? -high : 0;
    return low <= high;
}

/* Has the best triangle so far the same corners, in the same order, and a lower number? Then t is
 * touched where it is, and is not better: of many equal triangles only one takes exact tests. */
static bool certain_is_repeated(const certain_search *s, uint32_t t)
{
    if (s->best >= t) return false; /* or there is none */
    const mw_surface *surface = s->prober->surface;
    for (uint32_t k = 0; k < 3; k++) {
        const double *p = mw__surface_corner(surface, t, k),
                     *best = mw__surface_corner(surface, s->best, k);
        if (p[0] != best[0] || p[1] != best[1] || p[2] != best[2]) return false;
    }
    return true;
}

static void certain_look_at_triangle(certain_search *s, uint32_t t)
{
    const mw_surface *surface = s->prober->surface;
    if (t == s->best || certain_is_repeated(s, t) || !mw__line_touches(surface, s->line, t)) return;
    s->hits++;
    bool better = s->best == MW_NONE ? mw__touch_in_reach(surface, s->line, t, s->max_distance)
                                     : mw__touch_is_better(surface, s->line, t, s->best);
    if (!better) return;
    s->best = t;
    const mw_corners corners = {mw__surface_corner(surface, t, 0),
                                mw__surface_corner(surface, t, 1),
                                mw__surface_corner(surface, t, 2)};
    beam_set_reach(&s->beam, fmin(fabs(mw__hit_distance(s->line, corners)), s->max_distance));
}

/* Push the children that the beam meets, or look at the triangles of a leaf. */
static void certain_look_into(certain_search *s, mw_bvh_stack *stack, mw_bvh_visit visit)
{
    const mw_bvh *bvh = &s->prober->bvh;
    uint32_t first, end = mw__bvh_children(bvh, visit.level, visit.box, &first),
                    floor = stack->count;
    if (visit.level == 0) {
        s->triangles += end - first;
        for (uint32_t i = first; i < end; i++)
            certain_look_at_triangle(s, mw__bvh_triangle(bvh, i));
        return;
    }
    s->boxes += end - first;
    mw_bvh_visit below = {0, visit.level - 1, 0};
    for (below.box = first; below.box < end; below.box++)
        if (beam_meets_box(&s->beam, mw__bvh_box_at(bvh, below.level, below.box), &below.near))
            mw__bvh_push(stack, floor, below);
}

uint32_t mw__probe_certain(const mw_prober *prober, const mw_line *line, double max_distance,
                           uint32_t seed, mw_probe_counters *counters)
{
    certain_search s = {.prober = prober,
                        .line = line,
                        .max_distance = max_distance > 0 ? max_distance : INFINITY,
                        .best = MW_NONE,
                        .beam = beam_make(prober, line)};
    beam_set_reach(&s.beam, s.max_distance);
    if (seed != MW_NONE) certain_look_at_triangle(&s, seed);
    mw_bvh_stack stack = {.count = 1, .visit[0] = {0, prober->bvh.level_count - 1, 0}};
    while (stack.count) {
        mw_bvh_visit visit = stack.visit[--stack.count];
        if (visit.near <= s.beam.reach) certain_look_into(&s, &stack, visit);
    }
    if (counters) {
        counters->boxes += s.boxes;
        counters->box_triangles += s.triangles;
        counters->intersections += s.hits;
    }
    return s.best;
}
