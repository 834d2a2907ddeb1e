/* star_location.c - the location of a ray in a facet that it meets. */
#include "star/star_location.h"

/* The error bound of areas, relative to their sum. */
#define AREA_ERROR 0x1p-36

static MW_INLINE double sum_norm(const double v[3])
{
    return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* No argument is a NaN, so fmax need not be called. */
static MW_INLINE double larger_norm(double a, double b)
{
    return a > b ? a : b;
}

/* Determinants lose digits if corners are far from the centre, but close to each other: what they
 * have in common cancels. It can be subtracted first, as det(a - c, b - c, d) does not change if
 * any multiple t d is subtracted from a - c. The rest w is short. w holds the corners relative to
 * the centre and is overwritten. Let S, W and D be the largest norms of a - c plus t d, of w, and
 * of d, and u = 2^-53. w is off by 2 u S, which changes the determinant by 4 u S W D. d is rounded:
 * 6 u S W D. The evaluation adds 7 u W W D, where W <= S. Together this is less than 2^-48 S W D,
 * which is returned. */
static MW_INLINE double areas_shear(double w[3][3], const double d[3], double area[3])
{
    double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], long_norm = 0, short_norm = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double t = (w[k][0] * d[0] + w[k][1] * d[1] + w[k][2] * d[2]) / square;
        long_norm = larger_norm(long_norm, sum_norm(w[k]) + fabs(t) * sum_norm(d));
        for (int i = 0; i < 3; i++) w[k][i] -= t * d[i];
        short_norm = larger_norm(short_norm, sum_norm(w[k]));
    }
    for (uint32_t k = 0; k < 3; k++) {
        const double *a = w[mw__next(k)], *b = w[mw__prev(k)];
        area[k] = fabs(d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
                       d[2] * (a[0] * b[1] - a[1] * b[0]));
    }
    return 0x1p-48 * long_norm * short_norm * sum_norm(d);
}

static MW_INLINE double dot3(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static MW_INLINE void cross3(const double u[3], const double v[3], double r[3])
{
    for (uint32_t k = 0; k < 3; k++)
        r[k] = u[mw__next(k)] * v[mw__prev(k)] - u[mw__prev(k)] * v[mw__next(k)];
}

/* Is a square neither so small nor so large that products with it could leave the range of doubles?
 */
static MW_INLINE bool square_is_ordinary(double square)
{
    return square > 0x1p-200 && square < 0x1p200;
}

/* The areas from one corner a and the edges e, f from it: with D = det(e, f, d) they are D less the
 * others, det(f, a, d) and det(a, e, d). Every difference of coordinates is off by u = 2^-53 of
 * itself, and so is d. A component of f x d is off by 4u of its sum of magnitudes, its product with
 * a by 8u, and by Cauchy and Schwarz det(f, a, d) by 8u sqrt(2) |a| |f| |d|. D is off by as
 * much with |e| |f| |d|. Where edges are shorter than a quarter of a, all this and two sums come to
 * less than 2^-48 |a| |d| max(|e|, |f|), whose square is compared. Returns whether the areas are
 * certainly not 0, and accurate; a facet that is not very small nor seen from its edge takes this
 * way. */
static MW_INLINE bool areas_by_edges(const mw_star *star, const uint32_t v[3], const double q[3],
                                     double area[3])
{
    const double *p = mw__star_corner_point(star, v, 0), *s = mw__star_corner_point(star, v, 1),
                 *t = mw__star_corner_point(star, v, 2);
    double a[3], d[3], e[3], f[3], fd[3], de[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[k] - star->centre[k];
        d[k] = q[k] - star->centre[k];
        e[k] = s[k] - p[k];
        f[k] = t[k] - p[k];
    }
    cross3(f, d, fd);
    cross3(e, d, de);
    double sum = dot3(e, fd), one = -dot3(a, fd), two = dot3(a, de);
    double sign = sum < 0 ? -1 : 1, aa = dot3(a, a), dd = dot3(d, d), ee = dot3(e, e),
           ff = dot3(f, f), longer = ee > ff ? ee : ff, off = 0x1p-96 * aa * dd * longer;
    area[0] = sign * (sum - one - two);
    area[1] = sign * one;
    area[2] = sign * two;
    bool positive = area[0] > 0 && area[1] > 0 && area[2] > 0;
    double least = area[0] < area[1] ? area[0] : area[1];
    least = least < area[2] ? least : area[2];
    return positive && square_is_ordinary(aa) && square_is_ordinary(dd) &&
           square_is_ordinary(longer) && 16 * longer < aa && least * least > off &&
           9 * off < AREA_ERROR * AREA_ERROR * sum * sum;
}

/* Compute the areas by areas_shear. Returns whether they are certainly not 0, and accurate. */
static MW_INLINE bool areas_refine(const mw_star *star, const uint32_t v[3], const double q[3],
                                   double area[3])
{
    const double *c = star->centre, d[3] = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    double w[3][3];
    for (uint32_t k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) w[k][i] = mw__star_corner_point(star, v, k)[i] - c[i];
    double off = areas_shear(w, d, area), sum = area[0] + area[1] + area[2];
    bool positive = area[0] > off && area[1] > off && area[2] > off;
    return positive && off > 0x1p-900 && 3 * off < AREA_ERROR * sum;
}

/* Is an edge long, seen from the centre: more than about 1/32? Then corners have little in common,
 * and plain determinants are more accurate: for short coordinates they are exact. */
static MW_INLINE bool facet_is_wide(const mw_star *star, const uint32_t v[3])
{
    double edge = 0, height = 0;
    for (int i = 0; i < 3; i++) {
        double a = mw__star_corner_point(star, v, 0)[i],
               along = mw__star_corner_point(star, v, 1)[i] - a, up = a - star->centre[i];
        edge += along * along;
        height += up * up;
    }
    return edge > 0x1p-10 * height;
}

void mw__star_areas(const mw_star *star, const uint32_t v[3], const double q[3], double area[3])
{
    const double *c = star->centre;
    bool wide = facet_is_wide(star, v);
    if (MW_LIKELY(!wide) &&
        MW_LIKELY(areas_by_edges(star, v, q, area) || areas_refine(star, v, q, area)))
        return;
    double sum = 0, off = 0;
    bool sure = true;
    for (uint32_t k = 0; k < 3; k++) {
        double bound;
        area[k] = mw__orient3d_rounded(mw__star_corner_point(star, v, mw__next(k)),
                                       mw__star_corner_point(star, v, mw__prev(k)), q, c, &bound);
        sure = sure && fabs(area[k]) > bound;
        sum += area[k];
        off += bound;
    }
    if (sure && (off < AREA_ERROR * fabs(sum) || (wide && areas_refine(star, v, q, area)))) return;
    for (uint32_t k = 0; k < 3; k++)
        area[k] = mw__orient3d_exact(mw__star_corner_point(star, v, mw__next(k)),
                                     mw__star_corner_point(star, v, mw__prev(k)), q, c);
}

/* Rescale determinants beyond the range of doubles: those of facet and ray become about 1 each.
 * Exact zeros stay 0. */
static void areas_rescale(const mw_star *star, const uint32_t facet[3], const double q[3],
                          double area[3])
{
    const double *c = star->centre;
    double v[4][3], large[2] = {0, 0}, most[2] = {0, 0}; /* of the facet, of the ray */
    for (int k = 0; k < 3; k++) {
        large[0] = fmax(large[0], fabs(c[k]));
        large[1] = fmax(large[1], fmax(fabs(c[k]), fabs(q[k])));
        for (uint32_t i = 0; i < 3; i++)
            large[0] = fmax(large[0], fabs(mw__star_corner_point(star, facet, i)[k]));
    }
    for (uint32_t i = 0; i < 4; i++) {
        const double *p = i < 3 ? mw__star_corner_point(star, facet, i) : q;
        double half = large[i == 3] > 0x1p1000 ? 0.5 : 1; /* differences do not overflow */
        for (int k = 0; k < 3; k++) {
            v[i][k] = half * p[k] - half * c[k];
            most[i == 3] = fmax(most[i == 3], fabs(v[i][k]));
        }
    }
    for (uint32_t i = 0; i < 4; i++) {
        int exponent;
        frexp(most[i == 3], &exponent);
        for (int k = 0; k < 3; k++) v[i][k] = ldexp(v[i][k], -exponent);
    }
    double exact[3] = {area[0], area[1], area[2]};
    areas_shear(v, v[3], area);
    for (uint32_t k = 0; k < 3; k++) area[k] = exact[k] == 0 ? 0 : fmax(area[k], DBL_MIN);
}

void mw__star_location_in_facet(const mw_star *star, uint32_t number, const double q[3],
                                double area[3], mw_location *location)
{
    double sum = area[0] + area[1] + area[2];
    if (MW_UNLIKELY(!(fabs(sum) > 0x1p-900 && fabs(sum) < 0x1p900))) {
        areas_rescale(star, star->surface->tri[number].v, q, area);
        sum = area[0] + area[1] + area[2];
    }
    *location =
        (mw_location){.triangle = number, .hole = MW_NONE, .where = MW_INSIDE, .local = 255};
    uint32_t zeros = 0, on = 0, at = 0;
    for (uint32_t k = 0; k < 3; k++) {
        location->weight[k] = area[k] == 0 ? 0 : area[k] / sum; /* never -0 */
        if (area[k] != 0) {
            at = k;
        } else {
            zeros++;
            on = mw__next(k); /* the edge opposite to vertex k */
        }
    }
    if (zeros == 1) {
        location->where = MW_ON_EDGE;
        location->local = (uint8_t)on;
    } else if (zeros == 2) {
        location->where = MW_ON_VERTEX;
        location->local = (uint8_t)at;
    }
}

mw_location mw__star_location_none(void)
{
    return (mw_location){.weight = {NAN, NAN, NAN},
                         .triangle = MW_NONE,
                         .hole = MW_NONE,
                         .where = MW_BAD,
                         .local = 255};
}
