/* certain.c - what a probe touches, complete: the triangles in all boxes that the line meets in reach, the
 * nearer ones first.
 *
 * Which boxes are looked into is decided in doubles with margins, what is touched, and which is nearer, exactly. So a
 * box that holds the answer must not be missed. In the frame of the boxes the line is q + t m, where m is scaled by a
 * power of two so that its largest component is 1/2 to 1. A point of it that lies in a box, in reach, fulfils for each
 * axis k
 *
 *     (low[k] - q[k]) / m[k] <= t <= (high[k] - q[k]) / m[k]   (or the other way round),   -reach <= t <= reach,
 *
 * and the box is met if these intervals have a point in common. What is computed differs from that by
 *  - q in the frame: 2^-53 of it, and an underflow. The boxes are widened by 2^-50 of the largest coordinate of q.
 *  - the widths w that boxes are widened by: low - q is off by 2^-53 of itself, (low - q) - w by as much again. Where
 *    the two do not cancel, that is less than 2^-50 of the result; where they do, less than 2^-50 w: w is taken
 *    1 + 2^-40 times as large, and the ends of intervals are moved by 2^-48 of themselves, which covers also 1 / m and
 *    the product.
 *  - components of m below 2^-800, which may have underflown: they are taken as 0. Boxes reach to 2^127 at most (else
 *    they are all of space), so |t| < 2^130 and the line is moved by less than 2^-660: w is 2^-600 at least. Nor does
 *    anything overflow then: 1 / m <= 2^800. Products that underflow are off by 2^-1075, which w covers, too.
 *  - a q farther than 2^100 off, or that overflows: all boxes are looked into. */
#include "surface/prober.h"

#define END_ERROR 0x1p-48
#define SMALL_COMPONENT 0x1p-800
/* Distances are off by 2^-40 of themselves, |m| and the quotient by a few 2^-53 more. */
#define REACH_ERROR (1 + 0x1p-38)
#define GREATEST_REACH 0x1p1000

/* The line in the frame of the boxes. */
typedef struct beam {
    double q[3], inverse[3]; /* 1 / m; infinite where m is 0 */
    double width;            /* that boxes are widened by    */
    double per_length;       /* t of a unit of length        */
    double reach;
} beam;

typedef struct search {
    const mw_prober *prober;
    const mw_line *line;
    double max_distance;
    uint32_t best;
    beam beam;
    uint64_t boxes, triangles, hits;
} search;

static void set_reach(beam *b, double distance)
{
    double reach = (distance + MW_SURFACE_TINY_LENGTH) * b->per_length * REACH_ERROR + MW_SURFACE_LEAST_WIDTH;
    b->reach = reach < GREATEST_REACH ? reach : GREATEST_REACH;
}

static beam make_beam(const mw_prober *prober, const mw_line *line)
{
    beam b;
    double largest = fmax(fabs(line->m[0]), fmax(fabs(line->m[1]), fabs(line->m[2]))), square = 0;
    b.width = mw__surface_boxes_aim(&prober->boxes, line->q, prober->slack, b.q);
    int exponent = ilogb(largest) + 1;
    for (int k = 0; k < 3; k++) {
        double m = ldexp(line->m[k], -exponent);
        if (fabs(m) < SMALL_COMPONENT) m = 0;
        b.inverse[k] = m == 0 ? INFINITY : 1 / m;
        square += m * m;
    }
    b.per_length = prober->boxes.scale / sqrt(square);
    return b;
}

/* Does the beam meet a box? Then nothing in it is met before t = *near. Comparisons are written so that NaN, 0 / 0 of a
 * line that runs along a side, narrows nothing. */
static MW_INLINE bool meets_box(const beam *b, const mw_surface_box *box, double *near)
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

static void look_at_triangle(search *s, uint32_t t)
{
    const mw_surface *surface = s->prober->surface;
    if (t == s->best || !mw__touches(surface, s->line, t)) return;
    s->hits++;
    bool better = s->best == MW_NONE ? mw__in_reach(surface, s->line, t, s->max_distance)
                                     : mw__better(surface, s->line, t, s->best);
    if (!better) return;
    s->best = t;
    const mw_corners corners = {mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                                mw__surface_corner(surface, t, 2)};
    set_reach(&s->beam, fmin(fabs(mw__hit_distance(s->line, corners)), s->max_distance));
}

/* Push the boxes below one that the beam meets, or look at the triangles of a leaf. */
static void look_into(search *s, mw_surface_box_stack *stack, mw_surface_box_visit visit)
{
    const mw_surface_boxes *boxes = &s->prober->boxes;
    uint32_t first, end = mw__surface_boxes_below(boxes, visit.level, visit.box, &first), floor = stack->count;
    if (visit.level == 0) {
        s->triangles += end - first;
        for (uint32_t i = first; i < end; i++) look_at_triangle(s, mw__surface_boxes_triangle(boxes, i));
        return;
    }
    s->boxes += end - first;
    mw_surface_box_visit below = {0, visit.level - 1, 0};
    for (below.box = first; below.box < end; below.box++)
        if (meets_box(&s->beam, mw__surface_box(boxes, below.level, below.box), &below.near))
            mw__surface_box_push(stack, floor, below);
}

uint32_t mw__certain(const mw_prober *prober, const mw_line *line, double max_distance, uint32_t seed,
                     mw_probe_counters *counters)
{
    search s = {.prober = prober,
                .line = line,
                .max_distance = max_distance > 0 ? max_distance : INFINITY,
                .best = MW_NONE,
                .beam = make_beam(prober, line)};
    set_reach(&s.beam, s.max_distance);
    if (seed != MW_NONE) look_at_triangle(&s, seed);
    mw_surface_box_stack stack = {.count = 1, .visit[0] = {0, prober->boxes.level_count - 1, 0}};
    while (stack.count) {
        mw_surface_box_visit visit = stack.visit[--stack.count];
        if (visit.near <= s.beam.reach) look_into(&s, &stack, visit);
    }
    if (counters) {
        counters->boxes += s.boxes;
        counters->box_triangles += s.triangles;
        counters->intersections += s.hits;
    }
    return s.best;
}
