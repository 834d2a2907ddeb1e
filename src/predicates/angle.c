/* angle.c - which of two angles is larger, exactly.
 *
 * An angle t between two vectors has cos t and sin t >= 0 as their dot product and the magnitude of
 * their cross product, each over the product of their lengths. So arms_cross(s) arms_dot(t) -
 * arms_dot(s) arms_cross(t) has the sign of sin(s - t); and that is the sign of s - t, which lies
 * between -pi and pi. The one exception: one of the angles is 0 and the other pi. */
#include "predicates/big.h"
#include "predicates/expansion.h"

/* Expansions are exact in the range that incircle has: products of four differences here too, eight
 * of them. */
#define LOW 0x1p-216
#define HIGH 0x1p253

#define PRODUCT_PARTS 512 /* 2 * 16 * 16 */
#define ROOM (16 + 4 * MW_CROSS_ROOM + 4 * PRODUCT_PARTS)

/* The x, y of the two vectors of an angle; they turn left. */
typedef struct arms {
    mw_expansion x[2], y[2];
} arms;

static arms make_arms(mw_arena *arena, mw_point a, mw_point b, mw_point c)
{
    arms r;
    r.x[0] = mw__expansion_difference(arena, a.x, b.x);
    r.y[0] = mw__expansion_difference(arena, a.y, b.y);
    r.x[1] = mw__expansion_difference(arena, c.x, b.x);
    r.y[1] = mw__expansion_difference(arena, c.y, b.y);
    return r;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 angle_wide;

/* A short cut for points of a grid, where many angles are equal: all differences are integers below
 * 2^30 times one power of two, so that cross and dot products are below 2^61. False for other
 * points, and where compilers have no integers of 128 bits. */
static bool to_integers(const arms *r, double scale, int64_t v[4])
{
    const mw_expansion *all[4] = {&r->x[0], &r->y[0], &r->x[1], &r->y[1]};
    for (int i = 0; i < 4; i++) {
        if (all[i]->n > 1) return false;
        double scaled = all[i]->n == 0 ? 0 : all[i]->part[0] * scale;
        v[i] = (int64_t)scaled;
        if ((double)v[i] != scaled) return false;
    }
    return true;
}

static double largest_part(const arms *r)
{
    double largest = 0;
    for (int i = 0; i < 2; i++) {
        if (r->x[i].n > 0) largest = fmax(largest, fabs(r->x[i].part[r->x[i].n - 1]));
        if (r->y[i].n > 0) largest = fmax(largest, fabs(r->y[i].part[r->y[i].n - 1]));
    }
    return largest;
}

static bool angle_on_grid(const arms *r, const arms *s, int *sign)
{
    double largest = fmax(largest_part(r), largest_part(s));
    double scale = largest > 0 ? ldexp(1, 29 - ilogb(largest)) : 1;
    int64_t v[4], w[4];
    if (!to_integers(r, scale, v) || !to_integers(s, scale, w)) return false;
    angle_wide left = (angle_wide)(v[0] * v[3] - v[1] * v[2]) * (w[0] * w[2] + w[1] * w[3]);
    angle_wide right = (angle_wide)(v[0] * v[2] + v[1] * v[3]) * (w[0] * w[3] - w[1] * w[2]);
    *sign = (left > right) - (left < right);
    return true;
}
#else
static bool angle_on_grid(const arms *r, const arms *s, int *sign)
{
    (void)r, (void)s, (void)sign;
    return false;
}
#endif

static mw_expansion arms_cross(mw_arena *arena, const arms *r)
{
    return mw__expansion_cross(arena, r->x[0], r->y[0], r->x[1], r->y[1]);
}

static mw_expansion arms_dot(mw_arena *arena, const arms *r)
{
    mw_expansion left = mw__expansion_multiply(arena, r->x[0], r->x[1]);
    mw_expansion right = mw__expansion_multiply(arena, r->y[0], r->y[1]);
    return mw__expansion_add(arena, left, right);
}

static int angle_with_expansions(const mw_point p[6])
{
    double room[ROOM];
    mw_arena arena = {room};
    arms r = make_arms(&arena, p[0], p[1], p[2]), s = make_arms(&arena, p[3], p[4], p[5]);
    int sign;
    if (angle_on_grid(&r, &s, &sign)) return sign;
    mw_expansion r_cross = arms_cross(&arena, &r), r_dot = arms_dot(&arena, &r);
    mw_expansion s_cross = arms_cross(&arena, &s), s_dot = arms_dot(&arena, &s);
    mw_expansion left = mw__expansion_multiply(&arena, r_cross, s_dot);
    mw_expansion right = mw__expansion_multiply(&arena, r_dot, s_cross);
    mw_expansion difference = mw__expansion_subtract(&arena, left, right);
    double top = difference.n == 0 ? 0 : difference.part[difference.n - 1];
    return (top > 0) - (top < 0);
}

static void big_products(mw_point a, mw_point b, mw_point c, int base, mw_big *cross, mw_big *dot)
{
    mw_big x[2], y[2];
    mw__big_difference(&x[0], a.x, b.x, base);
    mw__big_difference(&y[0], a.y, b.y, base);
    mw__big_difference(&x[1], c.x, b.x, base);
    mw__big_difference(&y[1], c.y, b.y, base);
    mw__big_cross(cross, &x[0], &y[0], &x[1], &y[1]);
    y[0].sign = -y[0].sign;
    mw__big_cross(dot, &x[0], &y[0], &y[1], &x[1]);
}

static int angle_with_integers(const mw_point p[6])
{
    int base = mw__big_base(&p[0].x, 12);
    mw_big cross[2], dot[2], difference;
    for (int i = 0; i < 2; i++)
        big_products(p[3 * i], p[3 * i + 1], p[3 * i + 2], base, &cross[i], &dot[i]);
    mw__big_cross(&difference, &cross[0], &dot[0], &cross[1], &dot[1]);
    return difference.sign;
}

static int sign_of(double v)
{
    return (v > 0) - (v < 0);
}

int mw__compare_angles_exact(const mw_angle *s, const mw_angle *t)
{
    mw_point p[6] = {s->a, s->b, s->c, t->a, t->b, t->c};
    if (!mw__all_finite(&p[0].x, 12)) return 0;
    double turn[2];
    for (int i = 0; i < 2; i++) {
        turn[i] = mw__orient2d(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
        if (turn[i] <= 0) continue; /* a, b, c turn right where b->a, b->c turn left */
        mw_point a = p[3 * i];
        p[3 * i] = p[3 * i + 2];
        p[3 * i + 2] = a;
    }
    if (turn[0] == 0 && turn[1] == 0)
        return sign_of(sign_of(mw__dot2d(p[4], p[3], p[5])) - sign_of(mw__dot2d(p[1], p[0], p[2])));
    return mw__within(&p[0].x, 12, LOW, HIGH) ? angle_with_expansions(p) : angle_with_integers(p);
}
