/* distance.c - which of two segments is nearer to a point, exactly.
 *
 *      q
 *      :  \
 *   a--:-----b
 *
 * The nearest point of a segment ab is a, b, or the foot of the perpendicular; dot products tell
 * which without error. The squared distance is |q - v|^2 to a vertex v, and to the line it is
 * orient2d(a, b, q)^2 / |b - a|^2, a quotient of two polynomials. Intervals in doubles compare
 * nearly all of them, big integers the others, by cross-multiplication (of degree 6 at most:
 * expansions would get long). */
#include "predicates/big.h"
#include "predicates/expansion.h"

/* The part of a segment that is nearest to a point: vertex a, or where `line` is set the inside of
 * ab. */
typedef struct feature {
    mw_point a, b;
    bool line;
} feature;

typedef struct interval {
    double low, high;
} interval;

/* numerator / denominator > 0, a squared distance. */
typedef struct ratio {
    mw_big numerator, denominator;
} ratio;

static feature nearest_feature(mw_point q, mw_point a, mw_point b)
{
    if (mw__dot2d(a, b, q) <= 0) return (feature){a, a, false};
    if (mw__dot2d(b, a, q) <= 0) return (feature){b, b, false};
    return (feature){a, b, true};
}

/* Rounding errors, u = 2^-53. The square of a length, two differences squared and added, is off by
 * a factor of at most (1 + u)^4. |orient2d| lies between area - bound and area + bound
 * (predicates.h: the bound covers the error even after a factor 1 - u), each off by (1 + u)^2;
 * squared, and divided by the square of a length, that makes (1 + u)^10. WIDEN = 2^4 u covers it
 * together with its own rounding. FLOOR covers what underflows: an end that decides a comparison is
 * above FLOOR, and so what it was made of is normal as long as squares of lengths are at least
 * SHORT: 2^-800 * 2^-200 is well above 2^-1022. */
#define WIDEN 0x1p-49
#define FLOOR 0x1p-800
#define SHORT 0x1p-200

/* low..high made wider, so that it holds the true value; unbounded where something has
 * overflowed. */
static interval interval_widened(double low, double high)
{
    interval wide = {low * (1 - WIDEN), high * (1 + WIDEN) + FLOOR};
    if (!(wide.high <= DBL_MAX)) wide = (interval){0, INFINITY};
    return wide;
}

static double square_length(mw_point p, mw_point q)
{
    double x = p.x - q.x, y = p.y - q.y;
    return x * x + y * y;
}

static interval distance_estimate(mw_point q, const feature *f)
{
    if (!f->line) {
        double square = square_length(q, f->a);
        return interval_widened(square, square);
    }
    double length = square_length(f->a, f->b);
    if (!(length >= SHORT && length <= DBL_MAX)) return (interval){0, INFINITY};
    double bound, area = fabs(mw__orient2d_rounded(f->a, f->b, q, &bound));
    double low = fmax(area - bound, 0), high = area + bound;
    return interval_widened(low * low / length, high * high / length);
}

static void square_sum(mw_big *r, const mw_big *x, const mw_big *y)
{
    mw_big square;
    mw__big_multiply(r, x, x);
    mw__big_multiply(&square, y, y);
    mw__big_add(r, r, &square);
}

static void distance_exact(ratio *r, mw_point q, const feature *f, int base)
{
    mw_big ax, ay, bx, by, area;
    mw__big_difference(&ax, f->a.x, q.x, base);
    mw__big_difference(&ay, f->a.y, q.y, base);
    if (!f->line) {
        square_sum(&r->numerator, &ax, &ay);
        mw__big_unit(&r->denominator);
        return;
    }
    mw__big_difference(&bx, f->b.x, q.x, base);
    mw__big_difference(&by, f->b.y, q.y, base);
    mw__big_cross(&area, &ax, &ay, &bx, &by);
    mw__big_multiply(&r->numerator, &area, &area);
    mw__big_subtract(&ax, &bx, &ax);
    mw__big_subtract(&ay, &by, &ay);
    square_sum(&r->denominator, &ax, &ay);
}

static int ratio_compare(const ratio *r, const ratio *s)
{
    mw_big difference;
    mw__big_cross(&difference, &r->numerator, &s->numerator, &r->denominator, &s->denominator);
    return difference.sign;
}

/* Two edges of a border, nearest at the vertex they share: too common for the exact stage. */
static bool same_vertex(const feature *f, const feature *g)
{
    return !f->line && !g->line && f->a.x == g->a.x && f->a.y == g->a.y;
}

static int compare_features(mw_point q, const feature *f, const feature *g)
{
    const double v[10] = {q.x, q.y, f->a.x, f->a.y, f->b.x, f->b.y, g->a.x, g->a.y, g->b.x, g->b.y};
    if (!mw__all_finite(v, 10)) return 0;
    int base = mw__big_base(v, 10);
    ratio r, s;
    distance_exact(&r, q, f, base);
    distance_exact(&s, q, g, base);
    return ratio_compare(&r, &s);
}

int mw__compare_distance(mw_point q, mw_point a, mw_point b, mw_point c, mw_point d)
{
    feature f = nearest_feature(q, a, b), g = nearest_feature(q, c, d);
    if (same_vertex(&f, &g)) return 0;
    interval s = distance_estimate(q, &f), t = distance_estimate(q, &g);
    if (s.high < t.low) return -1;
    if (s.low > t.high) return 1;
    return compare_features(q, &f, &g);
}

static int compare_with_length(mw_point q, const feature *f, double d)
{
    const double v[7] = {q.x, q.y, f->a.x, f->a.y, f->b.x, f->b.y, d};
    if (!mw__all_finite(v, 7)) return 0;
    int base = mw__big_base(v, 7);
    ratio r, s;
    mw_big length;
    distance_exact(&r, q, f, base);
    mw__big_difference(&length, d, 0, base);
    mw__big_multiply(&s.numerator, &length, &length);
    mw__big_unit(&s.denominator);
    return ratio_compare(&r, &s);
}

int mw__compare_distance_to(mw_point q, mw_point a, mw_point b, double d)
{
    if (isinf(d)) return -1;
    feature f = nearest_feature(q, a, b);
    interval s = distance_estimate(q, &f), t = interval_widened(d * d, d * d);
    if (s.high < t.low) return -1;
    if (s.low > t.high) return 1;
    return compare_with_length(q, &f, d);
}
