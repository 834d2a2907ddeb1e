/* line.c - the exact stages of what is asked about a line in space: the line q + t m against edges
 * and planes.
 *
 * The plane of a triangle abc with normal n = (b - a) x (c - a) is met at t = N / M with N = n . (a
 * - q) and M = n . m. N and M are estimated in doubles, with bounds of their errors; big integers
 * decide what those cannot, by cross-multiplication. As long as coordinates are of similar size,
 * these integers have few limbs and cost less than expansions of so high a degree. */
#include "predicates/line.h"
#include "predicates/big.h"
#include "predicates/error_free.h"
#include "predicates/expansion.h"

#include <limits.h>
#include <stdlib.h>

/* --- the line --- */

bool mw__line_through(const double q[3], const double r[3], mw_line *line)
{
    bool some = false, finite = true;
    for (int k = 0; k < 3; k++) {
        line->q[k] = q[k];
        line->m[k] = mw__two_sum(r[k], -q[k], &line->tail[k]);
        some = some || line->m[k] != 0;
        finite = finite && isfinite(line->m[k]);
    }
    return some && finite;
}

/* --- sides --- */

/* Expansions are exact for nonzero coordinates of magnitude 2^-306 to 2^339, as in orient3d.c: m is
 * a factor in the place of a difference. */
#define LOW 0x1p-306
#define HIGH 0x1p339

/* A term has 16 * 2 * 2 = 64 parts, and takes room for a cross product and twice its own. */
#define TERM_PARTS 64
#define TERM_ROOM (MW_CROSS_ROOM + 2 * TERM_PARTS)

static double side_with_expansions(const mw_line *line, const double a[3], const double b[3])
{
    double room[18 + 3 * TERM_ROOM + 6 * TERM_PARTS];
    mw_arena arena = {room};
    mw_expansion p[3], r[3], sum = {room, 0};
    for (int k = 0; k < 3; k++) {
        p[k] = mw__expansion_difference(&arena, a[k], line->q[k]);
        r[k] = mw__expansion_difference(&arena, b[k], line->q[k]);
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mw_expansion m = mw__expansion_difference(&arena, line->m[k], -line->tail[k]),
                     minor = mw__expansion_cross(&arena, p[i], p[j], r[i], r[j]);
        sum = mw__expansion_add(&arena, sum, mw__expansion_multiply(&arena, minor, m));
    }
    return mw__expansion_estimate(sum);
}

/* r = (a - b) / 2^base */
static void big_vector(mw_big r[3], const double a[3], const double b[3], int base)
{
    for (int k = 0; k < 3; k++) mw__big_difference(&r[k], a[k], b[k], base);
}

/* Component k of a x b. */
static void big_minor(mw_big *r, const mw_big a[3], const mw_big b[3], int k)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    mw__big_cross(r, &a[i], &a[j], &b[i], &b[j]);
}

/* r += minor * (a - b) / 2^base */
static void add_term(mw_big *r, const mw_big *minor, double a, double b, int base)
{
    mw_big factor, term;
    mw__big_difference(&factor, a, b, base);
    mw__big_multiply(&term, minor, &factor);
    mw__big_add(r, r, &term);
}

/* The base of m and its tail. */
static int motion_base(const mw_line *line)
{
    const double *m = line->m, *tail = line->tail,
                 v[6] = {m[0], m[1], m[2], tail[0], tail[1], tail[2]};
    return mw__big_base(v, 6);
}

/* The side is *r * 2^(the exponent returned). */
static int big_side(mw_big *r, const mw_line *line, const double a[3], const double b[3])
{
    const double *q = line->q, v[9] = {q[0], q[1], q[2], a[0], a[1], a[2], b[0], b[1], b[2]};
    int base = mw__big_base(v, 9), motion = motion_base(line);
    mw_big from[3], to[3], minor;
    big_vector(from, a, q, base);
    big_vector(to, b, q, base);
    r->sign = r->n = 0;
    for (int k = 0; k < 3; k++) {
        big_minor(&minor, from, to, k);
        add_term(r, &minor, line->m[k], -line->tail[k], motion);
    }
    return 2 * base + motion;
}

double mw__side_exact(const mw_line *line, const double a[3], const double b[3])
{
    const double *const all[5] = {line->q, line->m, line->tail, a, b};
    bool within = true, finite = true;
    for (int i = 0; i < 5; i++) {
        within = within && mw__within(all[i], 3, LOW, HIGH);
        finite = finite && mw__all_finite(all[i], 3);
    }
    if (MW_LIKELY(within)) return side_with_expansions(line, a, b);
    if (!finite) return 0;
    mw_big side;
    int exponent = big_side(&side, line, a, b);
    return mw__big_double(&side, exponent);
}

/* --- hits --- */

/* A magnitude lies from low to high. */
typedef struct sign_range {
    double low, high;
} sign_range;

/* A rounded value with its bound is off by bound + u |value|; what is rounded here, by less than 4u
 * (|value| + bound). */
#define WIDEN 0x1p-50

static sign_range range_of(double value, double bound)
{
    double magnitude = fabs(value), off = bound + WIDEN * (magnitude + bound);
    if (!(magnitude + off <= DBL_MAX)) return (sign_range){0, INFINITY};
    return (sign_range){fmax(magnitude - off, 0), magnitude + off};
}

/* Where a plane is met: |N| and |M|. */
typedef struct estimate {
    sign_range n, m;
} estimate;

static void line_plane(const mw_line *line, const mw_corners s, mw_line_plane *e)
{
    double u[3], v[3], from[3], normal[3], size[3];
    for (int k = 0; k < 3; k++) {
        u[k] = s[1][k] - s[0][k];
        v[k] = s[2][k] - s[0][k];
        from[k] = s[0][k] - line->q[k];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        double left = u[i] * v[j], right = u[j] * v[i];
        normal[k] = left - right;
        size[k] = fabs(left) + fabs(right);
    }
    const double *m = line->m;
    e->n = from[0] * normal[0] + from[1] * normal[1] + from[2] * normal[2];
    e->m = m[0] * normal[0] + m[1] * normal[1] + m[2] * normal[2];
    double n = fabs(from[0]) * size[0] + fabs(from[1]) * size[1] + fabs(from[2]) * size[2],
           along = fabs(m[0]) * size[0] + fabs(m[1]) * size[1] + fabs(m[2]) * size[2];
    e->n_bound = MW_SIDE_ERROR * n + mw__side_underflow(from);
    e->m_bound = MW_SIDE_ERROR * along + mw__side_underflow(m);
}

static estimate line_estimated(const mw_line *line, const mw_corners s)
{
    mw_line_plane plane;
    line_plane(line, s, &plane);
    return (estimate){range_of(plane.n, plane.n_bound), range_of(plane.m, plane.m_bound)};
}

/* Is a * b surely less than c * d? A product that underflows is off by 2^-1075. */
static bool surely_less(double a, double b, double c, double d)
{
    return a * b * (1 + WIDEN) + MW_UNDERFLOW_ERROR < c * d;
}

/* The same, exactly: t is n / m * 2^(base - motion). */
typedef struct hit {
    mw_big n, m;
} hit;

static void big_hit(hit *h, const mw_line *line, const mw_corners s, int base, int motion)
{
    mw_big u[3], v[3], minor;
    big_vector(u, s[1], s[0], base);
    big_vector(v, s[2], s[0], base);
    h->n.sign = h->n.n = h->m.sign = h->m.n = 0;
    for (int k = 0; k < 3; k++) {
        big_minor(&minor, u, v, k);
        add_term(&h->n, &minor, s[0][k], line->q[k], base);
        add_term(&h->m, &minor, line->m[k], -line->tail[k], motion);
    }
}

/* The base of q, the corners of s, those of t, and d. */
static int common_base(const mw_line *line, const mw_corners s, const mw_corners t, double d)
{
    double v[22] = {d, line->q[0], line->q[1], line->q[2]};
    for (int i = 0; i < 9; i++) {
        v[4 + i] = s[i / 3][i % 3];
        v[13 + i] = t[i / 3][i % 3];
    }
    return mw__big_base(v, 22);
}

/* |a| * |b| against |c| * |d|. */
static int compare_products(const mw_big *a, const mw_big *b, const mw_big *c, const mw_big *d)
{
    mw_big left, right;
    mw__big_multiply(&left, a, b);
    mw__big_multiply(&right, c, d);
    left.sign = abs(left.sign);
    right.sign = abs(right.sign);
    mw__big_subtract(&left, &left, &right);
    return left.sign;
}

static int compare_hits_exact(const mw_line *line, const mw_corners s, const mw_corners t)
{
    hit p, r;
    int base = common_base(line, s, t, 0), motion = motion_base(line);
    big_hit(&p, line, s, base, motion);
    big_hit(&r, line, t, base, motion);
    return compare_products(&p.n, &r.m, &r.n, &p.m);
}

int mw__compare_hits(const mw_line *line, const mw_corners s, const mw_corners t)
{
    estimate p = line_estimated(line, s), r = line_estimated(line, t);
    if (surely_less(p.n.high, r.m.high, r.n.low, p.m.low)) return -1;
    if (surely_less(r.n.high, p.m.high, p.n.low, r.m.low)) return 1;
    return compare_hits_exact(line, s, t);
}

/* r = |m + tail|^2 / 2^(2 motion) */
static void big_square_length(mw_big *r, const mw_line *line, int motion)
{
    mw_big part, square;
    r->sign = r->n = 0;
    for (int k = 0; k < 3; k++) {
        mw__big_difference(&part, line->m[k], -line->tail[k], motion);
        mw__big_multiply(&square, &part, &part);
        mw__big_add(r, r, &square);
    }
}

/* N^2 |m|^2 against d^2 M^2. */
static int compare_hit_to_exact(const mw_line *line, const mw_corners s, double d)
{
    hit h;
    mw_big length, squares[2];
    int base = common_base(line, s, s, d), motion = motion_base(line);
    big_hit(&h, line, s, base, motion);
    mw__big_multiply(&squares[0], &h.n, &h.n);
    mw__big_multiply(&squares[1], &h.m, &h.m);
    big_square_length(&h.n, line, motion);
    mw__big_difference(&length, d, 0, base);
    mw__big_multiply(&h.m, &length, &length);
    return compare_products(&squares[0], &h.n, &h.m, &squares[1]);
}

/* Where |m|^2 lies here, its rounding errors are relative ones: less than 3u, 2u by the tails, and
 * of the root 4u. */
#define SHORT 0x1p-900
#define LONG 0x1p1000

static sign_range length_of(const double m[3])
{
    double square = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    if (!(square >= SHORT && square <= LONG)) return (sign_range){0, INFINITY};
    return range_of(sqrt(square), 0);
}

int mw__compare_hit_to(const mw_line *line, const mw_corners s, double d)
{
    if (isinf(d)) return -1;
    estimate p = line_estimated(line, s);
    sign_range length = length_of(line->m);
    if (surely_less(p.n.high, length.high, d, p.m.low)) return -1;
    if (surely_less(d, p.m.high, p.n.low, length.low)) return 1;
    return compare_hit_to_exact(line, s, d);
}

/* --- what is told of a hit --- */

/* x * 2^exponent, not 0 unless x is, and then without a sign. */
static double line_scaled(double x, int exponent)
{
    if (x == 0) return 0;
    double value = ldexp(x, exponent);
    return value == 0 ? copysign(DBL_TRUE_MIN, x) : value;
}

/* |m| = fraction * 2^*exponent, rounded. */
static double length_fraction(const double m[3], int *exponent)
{
    frexp(fmax(fmax(fabs(m[0]), fabs(m[1])), fabs(m[2])), exponent);
    double x = ldexp(m[0], -*exponent), y = ldexp(m[1], -*exponent), z = ldexp(m[2], -*exponent);
    return sqrt(x * x + y * y + z * z);
}

/* N and M as fractions, with their exponents. */
static void exact_quotient(const mw_line *line, const mw_corners s, double fraction[2],
                           int exponent[2])
{
    hit h;
    int base = common_base(line, s, s, 0), motion = motion_base(line);
    big_hit(&h, line, s, base, motion);
    fraction[0] = mw__big_fraction(&h.n, &exponent[0]);
    fraction[1] = mw__big_fraction(&h.m, &exponent[1]);
    exponent[0] += base;
    exponent[1] += motion;
}

double mw__hit_distance_slow(const mw_line *line, const mw_corners s, const mw_line_plane *plane,
                             bool fine)
{
    double fraction[2];
    int exponent[3] = {0};
    if (fine) {
        fraction[0] = frexp(plane->n, &exponent[0]);
        fraction[1] = frexp(plane->m, &exponent[1]);
    } else {
        exact_quotient(line, s, fraction, exponent);
    }
    double length = length_fraction(line->m, &exponent[2]);
    return line_scaled(fraction[0] * length / fraction[1], exponent[0] - exponent[1] + exponent[2]);
}

double mw__hit_distance_noted(const mw_line *line, const mw_corners s, mw_line_estimate *e)
{
    mw_line_plane plane;
    line_plane(line, s, &plane);
    return mw__hit_distance_by(line, s, &plane, e);
}

double mw__hit_distance(const mw_line *line, const mw_corners s)
{
    mw_line_estimate e;
    return mw__hit_distance_noted(line, s, &e);
}

/* The sides as fractions of about the size of the largest. */
static void exact_sides(const mw_line *line, const mw_corners s, double side[3])
{
    int exponent[3], largest = INT_MIN / 2;
    for (int k = 0; k < 3; k++) {
        mw_big big;
        int base = big_side(&big, line, s[(k + 1) % 3], s[(k + 2) % 3]);
        side[k] = fabs(mw__big_fraction(&big, &exponent[k]));
        exponent[k] += base;
        if (side[k] != 0 && exponent[k] > largest) largest = exponent[k];
    }
    for (int k = 0; k < 3; k++) side[k] = line_scaled(side[k], exponent[k] - largest);
}

/* A sum of sides that are computed from q is good from here to there. */
#define LEAST_SUM 0x1p-900
#define MOST_SUM 0x1p900

/* A vector to each corner from the point p of the line near the triangle. From q they would be much
 * longer than the triangle, and the sides small differences of large products. p = q + t (m + tail)
 * + off, where t is a rounded N / M and `off` is what rounding leaves; corners are p + head + tail.
 * So each coordinate below is off by 2u of itself, and by 2^-100 of the largest coordinate. */
static void corners_from_line(const mw_line *line, const mw_corners s, double t, double from[3][3])
{
    for (int k = 0; k < 3; k++) {
        double product_tail, sum_tail, product = mw__two_product(t, line->m[k], &product_tail);
        double p = mw__two_sum(line->q[k], product, &sum_tail);
        double off = sum_tail + (product_tail + t * line->tail[k]);
        for (int i = 0; i < 3; i++) {
            double tail, head = mw__two_sum(s[i][k], -p, &tail);
            from[i][k] = head + (tail - off);
        }
    }
}

/* The larger one of two; a if b is NaN. The library's fmax is a call. */
static MW_INLINE double larger_of(double a, double b)
{
    return b > a ? b : a;
}

/* Magnitudes of the sides from there, with a bound of their errors: that of mw__side_rounded is
 * about doubled by 2u for each coordinate, and q adds MW_SIDE_FAR_ERROR of the coordinates. */
static double near_sides(const mw_line *line, const mw_corners s, double t, double side[3])
{
    double from[3][3], most = 0, length = 0, extent = 0, farthest = 0;
    mw_line through = {{0}, {line->m[0], line->m[1], line->m[2]}, {0}};
    corners_from_line(line, s, t, from);
    for (int k = 0; k < 3; k++) {
        double bound;
        side[k] = fabs(mw__side_rounded(&through, from[(k + 1) % 3], from[(k + 2) % 3], &bound));
        most = larger_of(most, bound);
        length += fabs(line->m[k]);
        farthest = larger_of(farthest, fabs(line->q[k]));
        for (int i = 0; i < 3; i++) {
            extent = larger_of(extent, fabs(from[i][k]));
            farthest = larger_of(farthest, fabs(s[i][k]));
        }
    }
    return 2 * most + length * extent * farthest * MW_SIDE_FAR_ERROR;
}

void mw__hit_sides(const mw_line *line, const mw_corners s, double side[3])
{
    mw_line_estimate e;
    mw_line_plane plane;
    mw__estimate_sides(line, s, &e);
    line_plane(line, s, &plane);
    e.n = plane.n;
    e.m = plane.m;
    mw__hit_sides_noted(line, s, &e, side);
}

void mw__hit_sides_noted(const mw_line *line, const mw_corners s, const mw_line_estimate *e,
                         double side[3])
{
    double bound[3], sum = 0, near[3];
    bool exact[3];
    for (int k = 0; k < 3; k++) {
        side[k] = fabs(e->side[(k + 1) % 3]);
        bound[k] = e->bound[(k + 1) % 3];
        exact[k] = !(side[k] > bound[k]);
        if (exact[k]) {
            side[k] = fabs(mw__side_exact(line, s[(k + 1) % 3], s[(k + 2) % 3]));
            bound[k] = 0;
        }
        sum += side[k];
    }
    double most = larger_of(larger_of(bound[0], bound[1]), bound[2]);
    if (most <= MW_WEIGHT_FINE * sum && sum >= LEAST_SUM && sum <= MOST_SUM) return;
    most = near_sides(line, s, e->n / e->m, near);
    sum = 0;
    for (int k = 0; k < 3; k++) sum += near[k] = exact[k] ? side[k] : near[k];
    if (most <= MW_WEIGHT_FINE * sum && sum >= MW_WEIGHT_NEAR_LEAST && sum <= MW_WEIGHT_NEAR_MOST)
        for (int k = 0; k < 3; k++) side[k] = near[k];
    else
        exact_sides(line, s, side);
}

bool mw__hit_inside(const mw_line *line, const mw_corners s, double side[3])
{
    double bound, most = 0, sum = 0;
    for (int k = 0; k < 3; k++) {
        side[k] = -mw__side_rounded(line, s[(k + 1) % 3], s[(k + 2) % 3], &bound);
        if (!(side[k] > bound)) return false;
        most = bound > most ? bound : most;
        sum += side[k];
    }
    return most <= MW_WEIGHT_FINE * sum && sum >= LEAST_SUM && sum <= MOST_SUM;
}
