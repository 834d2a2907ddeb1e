#include "predicates/expansion.h"

#include "predicates/error_free.h"

/* Is the product of a and b 0 because a or b is, or far from where its tail would be lost? */
static MW_INLINE bool product_is_safe(double a, double b, double product)
{
    double magnitude = fabs(product);
    return (magnitude > 0x1p-900 && magnitude < 0x1p900) || a == 0 || b == 0;
}

bool mw__double_cross(const double d[4], double *det)
{
    double left_tail, right_tail, high_tail, low_tail, sum_tail;
    if (fabs(d[0]) + fabs(d[1]) + fabs(d[2]) + fabs(d[3]) > 0x1p900) return false;
    double left = mw__two_product(d[0], d[1], &left_tail),
           right = mw__two_product(d[2], d[3], &right_tail);
    if (!product_is_safe(d[0], d[1], left) || !product_is_safe(d[2], d[3], right)) return false;
    double high = mw__two_sum(left, -right, &high_tail),
           low = mw__two_sum(left_tail, -right_tail, &low_tail);
    double sum = mw__two_sum(high, low, &sum_tail);
    *det = sum + 0.0; /* no -0 */
    return fabs(high_tail) + fabs(low_tail) <= 0x1p-52 * fabs(sum);
}

bool mw__difference_is_exact(double a, double b, double *difference)
{
    double tail;
    *difference = mw__two_sum(a, -b, &tail);
    return tail == 0;
}

mw_expansion mw__expansion_difference(mw_arena *arena, double a, double b)
{
    double *h = arena->next, tail, sum = mw__two_sum(a, -b, &tail);
    int n = 0;
    if (tail != 0) h[n++] = tail;
    if (sum != 0) h[n++] = sum;
    arena->next += n;
    return (mw_expansion){h, n};
}

/* h = e + sign * f, returns the number of parts. Merges the parts by magnitude and sums them up,
 * smallest first [Shewchuk's FAST-EXPANSION-SUM: keeps expansions "strongly nonoverlapping"]. */
static int expansion_add(const double *e, int m, const double *f, int n, double sign, double *h)
{
    int i = 0, j = 0, k = 0;
    double sum = 0, tail;
    while (i < m || j < n) {
        bool take_e = j == n || (i < m && fabs(e[i]) < fabs(f[j]));
        double part = take_e ? e[i++] : sign * f[j++];
        sum = mw__two_sum(sum, part, &tail);
        if (tail != 0) h[k++] = tail;
    }
    if (sum != 0) h[k++] = sum;
    return k;
}

/* h = b * e [SCALE-EXPANSION]; m > 0 and b is not 0. */
static int expansion_scale(const double *e, int m, double b, double *h)
{
    int k = 0;
    double tail, sum = mw__two_product(e[0], b, &tail);
    if (tail != 0) h[k++] = tail;
    for (int i = 1; i < m; i++) {
        double low, high = mw__two_product(e[i], b, &low);
        sum = mw__two_sum(sum, low, &tail);
        if (tail != 0) h[k++] = tail;
        sum = mw__fast_two_sum(high, sum, &tail);
        if (tail != 0) h[k++] = tail;
    }
    h[k++] = sum;
    return k;
}

/* h = e * f, m and n > 0: by halves of f, so that every part takes part in log2(n) sums only. h and
 * scratch have room for 2 * m * n; each half is made in the other's array. */
static int expansion_multiply(const double *e, int m, const double *f, int n, double *h,
                              double *scratch)
{
    if (n == 1) return expansion_scale(e, m, f[0], h);
    int half = n / 2, cut = 2 * m * half;
    int low = expansion_multiply(e, m, f, half, scratch, h);
    int high = expansion_multiply(e, m, f + half, n - half, scratch + cut, h + cut);
    return expansion_add(scratch, low, scratch + cut, high, 1, h);
}

mw_expansion mw__expansion_add(mw_arena *arena, mw_expansion e, mw_expansion f)
{
    double *h = arena->next;
    int n = expansion_add(e.part, e.n, f.part, f.n, 1, h);
    arena->next += n;
    return (mw_expansion){h, n};
}

mw_expansion mw__expansion_subtract(mw_arena *arena, mw_expansion e, mw_expansion f)
{
    double *h = arena->next;
    int n = expansion_add(e.part, e.n, f.part, f.n, -1, h);
    arena->next += n;
    return (mw_expansion){h, n};
}

mw_expansion mw__expansion_multiply(mw_arena *arena, mw_expansion e, mw_expansion f)
{
    double *h = arena->next;
    int n = 0;
    if (e.n < f.n) return mw__expansion_multiply(arena, f, e);
    if (f.n > 0) n = expansion_multiply(e.part, e.n, f.part, f.n, h, h + 2 * e.n * f.n);
    arena->next += n;
    return (mw_expansion){h, n};
}

double mw__expansion_estimate(mw_expansion e)
{
    double sum = 0;
    for (int i = 0; i < e.n; i++) sum += e.part[i];
    return sum;
}

mw_expansion mw__expansion_cross(mw_arena *arena, mw_expansion a, mw_expansion b, mw_expansion c,
                                 mw_expansion d)
{
    mw_expansion left = mw__expansion_multiply(arena, a, d);
    mw_expansion right = mw__expansion_multiply(arena, b, c);
    return mw__expansion_subtract(arena, left, right);
}

bool mw__scale_within(const double *v, int n, double low, double *scaled, int *shift)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fabs(v[i]) > most ? fabs(v[i]) : most;
    if (!(most > 0 && most <= DBL_MAX) || !mw__all_finite(v, n)) return false;
    *shift = 200 - ilogb(most);
    /* in two steps, since 2^shift may be no double */
    double half = ldexp(1, *shift / 2), rest = ldexp(1, *shift - *shift / 2);
    for (int i = 0; i < n; i++) {
        scaled[i] = v[i] * half * rest;
        if (v[i] != 0 && !(fabs(scaled[i]) >= low)) return false;
    }
    return true;
}

bool mw__within(const double *v, int n, double low, double high)
{
    for (int i = 0; i < n; i++) {
        double magnitude = fabs(v[i]);
        if (magnitude != 0 && !(magnitude >= low && magnitude <= high)) return false;
    }
    return true;
}

bool mw__all_finite(const double *v, int n)
{
    for (int i = 0; i < n; i++) {
        if (!isfinite(v[i])) return false;
    }
    return true;
}
