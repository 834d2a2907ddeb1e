/* cdt_split.c - points where segments cross.
 *
 * A part that could not be forced in is followed through the triangulation, over the subsegments
 * that it crosses and the vertices that lie on it. Each subsegment, and each such part, is a link,
 * which is cut at the points made on it. The pieces of all links, once for each segment that owns
 * them, are the parts of the next round. So parts still end at all vertices that lie on them
 * exactly. Points are rounded, but lie in the boxes of both links that cross there: so the box of a
 * part is smaller than that of its link.
 *
 * Rounding moves links a little, and may move them past vertices close by, so that they cross other
 * links. Among long links that are nearly parallel this could go on for very long, with one new
 * point beside the other. So after the first round, as in snap rounding [Hobby 1999; Guibas,
 * Marimont 1998], a link that crosses another and passes close by its end is led through that end,
 * and no point is made. Why this ends: see docs/proofs/delaunay.md. */
#include "triangulate/constrained/cdt_split.h"
#include "triangulate/constrained/cdt_spans.h"

#include <float.h>
#include <stdlib.h>

/* --- where two segments cross --- */

static double value_clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* In the boxes of both, which have a point in common. */
static double value_clamp_twice(double x, double a, double b, double c, double d)
{
    return value_clamp(x, fmax(fmin(a, b), fmin(c, d)), fmin(fmax(a, b), fmax(c, d)));
}

/* A share of the way from a to b. */
static double value_between(double a, double b, double share)
{
    double way = b - a;
    return isfinite(way) ? a + share * way : a * (1 - share) + b * share;
}

static double segment_extent(mw_point a, mw_point b)
{
    return fmax(fabs(b.x - a.x), fabs(b.y - a.y));
}

mw_point mw__crossing_point(mw_point a, mw_point b, mw_point c, mw_point d)
{
    /* the point is computed on the shorter of the two, from its nearer end */
    mw_point e[4] = {a, b, c, d};
    if (segment_extent(a, b) > segment_extent(c, d)) e[0] = c, e[1] = d, e[2] = a, e[3] = b;
    int exponent[2];
    double area[2];
    for (int i = 0; i < 2; i++)
        area[i] = fabs(mw__orient2d_fraction(e[2], e[3], e[i], &exponent[i]));
    int less = exponent[0] < exponent[1] ? 0 : 1;
    area[less] = ldexp(area[less], exponent[less] - exponent[1 - less]);
    int near = area[0] <= area[1] ? 0 : 1;
    double share = area[near] / (area[0] + area[1]);
    mw_point p = {value_between(e[near].x, e[1 - near].x, share),
                  value_between(e[near].y, e[1 - near].y, share)};
    return (mw_point){value_clamp_twice(p.x, a.x, b.x, c.x, d.x),
                      value_clamp_twice(p.y, a.y, b.y, c.y, d.y)};
}

/* --- cuts --- */

/* Links are subsegments, by number, then the remainders. */
typedef struct cut {
    size_t link;
    uint32_t point;
    bool exact;     /* lies on the link */
    mw_point along; /* how far: by x, then by y */
} cut;

typedef struct splitter {
    mw_cdt *m;
    mw_point *made;
    size_t made_count, made_capacity;
    cut *cut;
    size_t cut_count, cut_capacity;
    size_t remainder; /* the one that is followed */
    double tolerance; /* for ends that links pass by */
    bool too_many;
} splitter;

static const mw_segment_part *splitter_part_at(const mw_cdt *m, size_t link)
{
    return link < m->subsegments.count ? &m->subsegments.item[link]
                                       : &m->crossing.item[link - m->subsegments.count];
}

static mw_point splitter_point_at(const splitter *s, uint32_t p)
{
    return p < s->m->point_count ? s->m->point[p] : s->made[p - s->m->point_count];
}

/* How far p is along a link: the coordinate in which the link is longer, then the other, both
 * growing from the link's beginning to its end. */
static mw_point splitter_point_along(const splitter *s, const mw_segment_part *link, mw_point p)
{
    mw_point a = s->m->point[link->from], b = s->m->point[link->to];
    double x = b.x > a.x ? p.x : -p.x, y = b.y > a.y ? p.y : -p.y;
    return fabs(b.x - a.x) >= fabs(b.y - a.y) ? (mw_point){x, y} : (mw_point){y, x};
}

/* Note that a link is to be cut at a point, unless it ends there. */
static bool splitter_add_cut(splitter *s, size_t link, uint32_t point, bool exact)
{
    const mw_segment_part *l = splitter_part_at(s->m, link);
    mw_point p = splitter_point_at(s, point);
    if (mw__points_equal(p, s->m->point[l->from]) || mw__points_equal(p, s->m->point[l->to]))
        return true;
    if (s->cut_count == s->cut_capacity) {
        size_t capacity = 2 * s->cut_capacity + 64;
        cut *list = mw__realloc(s->cut, capacity, sizeof *list);
        if (!list) return false;
        s->cut = list;
        s->cut_capacity = capacity;
    }
    s->cut[s->cut_count++] = (cut){link, point, exact, splitter_point_along(s, l, p)};
    return true;
}

/* The number of a point where two links cross: an end of one of them, or a new one. MW_NONE when
 * out of memory. */
static uint32_t splitter_make_point(splitter *s, const mw_segment_part *a, const mw_segment_part *b)
{
    const mw_point *point = s->m->point;
    uint32_t ends[4] = {a->from, a->to, b->from, b->to};
    mw_point p = mw__crossing_point(point[a->from], point[a->to], point[b->from], point[b->to]);
    for (int i = 0; i < 4; i++)
        if (mw__points_equal(p, point[ends[i]])) return ends[i];
    s->too_many = s->m->point_count + s->made_count >= MW_MAX_TRIANGLES / 2;
    if (s->too_many) return MW_NONE;
    if (s->made_count == s->made_capacity) {
        size_t capacity = 2 * s->made_capacity + 64;
        mw_point *list = mw__realloc(s->made, capacity, sizeof *list);
        if (!list) return MW_NONE;
        s->made = list;
        s->made_capacity = capacity;
    }
    s->made[s->made_count++] = p;
    return (uint32_t)(s->m->point_count + s->made_count - 1);
}

/* Scale three coordinates by a power of two, to at most 1. Returns the distance of doubles at the
 * largest then. */
static double line_rescale(double c[3])
{
    int exponent;
    frexp(fmax(fmax(fabs(c[0]), fabs(c[1])), fabs(c[2])), &exponent);
    for (int i = 0; i < 3; i++) c[i] = ldexp(c[i], -exponent);
    return fmax(DBL_EPSILON / 2, ldexp(DBL_TRUE_MIN, -exponent));
}

static bool value_is_between(double a, double b, double x)
{
    return x >= fmin(a, b) && x <= fmax(a, b);
}

/* Does ab, with p in its box, pass by p so closely that it would go through p if the coordinates
 * were off by that many times the distance of doubles? */
static bool segment_passes_by(mw_point a, mw_point b, mw_point p, double tolerance)
{
    if (!value_is_between(a.x, b.x, p.x) || !value_is_between(a.y, b.y, p.y)) return false;
    double x[3] = {a.x, b.x, p.x}, y[3] = {a.y, b.y, p.y};
    double off_x = line_rescale(x), off_y = line_rescale(y);
    double dx = x[1] - x[0], dy = y[1] - y[0];
    double area = dx * (y[2] - y[0]) - dy * (x[2] - x[0]);
    return fabs(area) <= tolerance * (fabs(dx) * off_y + fabs(dy) * off_x);
}

/* Two links cross. Cut the one at those ends of the other that it passes by. */
static bool splitter_cut_at_ends(splitter *s, size_t link, size_t other)
{
    const mw_point *point = s->m->point;
    const mw_segment_part *l = splitter_part_at(s->m, link), *o = splitter_part_at(s->m, other);
    for (int i = 0; i < 2; i++) {
        uint32_t end = i == 0 ? o->from : o->to;
        if (segment_passes_by(point[l->from], point[l->to], point[end], s->tolerance) &&
            !splitter_add_cut(s, link, end, false))
            return false;
    }
    return true;
}

/* A link crosses a subsegment. */
static bool splitter_cross(splitter *s, size_t link, uint32_t subsegment)
{
    size_t before = s->cut_count;
    if (s->tolerance > 0 &&
        !(splitter_cut_at_ends(s, link, subsegment) && splitter_cut_at_ends(s, subsegment, link)))
        return false;
    if (s->cut_count > before) return true;
    uint32_t point =
        splitter_make_point(s, splitter_part_at(s->m, link), &s->m->subsegments.item[subsegment]);
    return point != MW_NONE && splitter_add_cut(s, link, point, false) &&
           splitter_add_cut(s, subsegment, point, false);
}

static bool splitter_meet(void *context, mw_segment_meeting meeting, uint32_t number)
{
    splitter *s = context;
    size_t link = s->m->subsegments.count + s->remainder;
    if (meeting == MW_MEETS_VERTEX) return splitter_add_cut(s, link, number, true);
    return meeting != MW_MEETS_SUBSEGMENT || splitter_cross(s, link, number);
}

static bool splitter_find_cuts(splitter *s)
{
    const mw_segment_parts *crossing = &s->m->crossing;
    for (s->remainder = 0; s->remainder < crossing->count; s->remainder++) {
        const mw_segment_part *r = &crossing->item[s->remainder];
        if (!mw__segment_insertion_trace(&s->m->net, r->from, r->to, splitter_meet, s))
            return false;
    }
    return true;
}

static int cut_compare(const void *left, const void *right)
{
    const cut *a = left, *b = right;
    if (a->link != b->link) return a->link < b->link ? -1 : 1;
    if (a->along.x != b->along.x) return a->along.x < b->along.x ? -1 : 1;
    if (a->along.y != b->along.y) return a->along.y < b->along.y ? -1 : 1;
    return a->point < b->point ? -1 : a->point > b->point;
}

/* --- the stretches of the next round --- */

/* The parts of a link, cut at `count` points, for one segment. No part runs back in either
 * coordinate, so their boxes are smaller than the link's, even if the link is only a few doubles
 * long. Points that would make a part run back are left out; the next round makes them again if
 * they are still needed. */
static bool parts_add_cut(splitter *s, const mw_segment_part *link, const cut *cuts, size_t count,
                          uint32_t segment, mw_segment_parts *parts)
{
    uint32_t from = link->from;
    double reached = splitter_point_along(s, link, splitter_point_at(s, from)).y;
    for (size_t i = 0; i <= count; i++) {
        uint32_t to = i < count ? cuts[i].point : link->to;
        if (i < count && cuts[i].along.y < reached && !cuts[i].exact) continue;
        if (i < count) reached = cuts[i].along.y;
        if (mw__points_equal(splitter_point_at(s, from), splitter_point_at(s, to))) continue;
        if (!mw__segment_parts_add(parts, (mw_segment_part){from, to, segment})) return false;
        from = to;
    }
    return true;
}

static bool splitter_cut_all(splitter *s, const mw_subsegment_owners *owners,
                             mw_segment_parts *parts)
{
    const mw_cdt *m = s->m;
    const cut *cuts = s->cut;
    size_t left = s->cut_count, count;
    for (size_t link = 0; link < m->subsegments.count + m->crossing.count;
         link++, cuts += count, left -= count) {
        for (count = 0; count < left && cuts[count].link == link;) count++;
        const mw_segment_part *l = splitter_part_at(m, link);
        if (link >= m->subsegments.count) {
            if (!parts_add_cut(s, l, cuts, count, l->segment, parts)) return false;
            continue;
        }
        for (size_t i = owners->first[link]; i < owners->first[link + 1]; i++)
            if (!parts_add_cut(s, l, cuts, count, owners->segment[i], parts)) return false;
    }
    return true;
}

/* Append the points made to the others. */
static bool splitter_take_points(splitter *s)
{
    mw_cdt *m = s->m;
    mw_point *point = mw__alloc_lines(m->point_count + s->made_count, sizeof *point);
    if (!point) return false;
    for (size_t i = 0; i < m->point_count + s->made_count; i++)
        point[i] = splitter_point_at(s, (uint32_t)i);
    free(m->point);
    m->point = point;
    m->point_count += s->made_count;
    return true;
}

/* None in the first round, when links are still the segments as given; then it doubles every few
 * rounds. */
static double round_tolerance(int round)
{
    enum { DOUBLING_ROUNDS = 8, MOST_DOUBLINGS = 6 };
    int doublings = round / DOUBLING_ROUNDS;
    return round == 1 ? 0 : ldexp(1, doublings < MOST_DOUBLINGS ? doublings : MOST_DOUBLINGS);
}

mw_status mw__cdt_split_crossings(mw_cdt *m, int round, mw_error *error)
{
    splitter s = {.m = m, .tolerance = round_tolerance(round)};
    mw_subsegment_owners owners = {0};
    mw_segment_parts parts = {0};
    bool done =
        splitter_find_cuts(&s) && mw__cdt_spans_list(m) && mw__subsegment_owners_create(&owners, m);
    if (done) {
        qsort(s.cut, s.cut_count, sizeof *s.cut, cut_compare);
        done = splitter_cut_all(&s, &owners, &parts) && splitter_take_points(&s);
    }
    if (done) {
        free(m->parts.item);
        m->parts = parts;
    } else {
        free(parts.item);
    }
    free(s.cut);
    free(s.made);
    mw__subsegment_owners_release(&owners);
    if (s.too_many) return mw__fail(error, MW_ERROR_LIMIT, "too many points where segments cross");
    return done ? MW_OK : mw__fail_memory(error);
}
