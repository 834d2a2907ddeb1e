/* clip.c - clips a triangle by a convex polygon. The figure is in clip.h. */
#include "clip/clip.h"

/* Twice the areas of edges with corners: signs exact, magnitudes rounded. `left` is the sign after
 * P has moved. */
typedef struct clip_sides {
    double p[3][MW_CLIP_SIDES], q[MW_CLIP_SIDES][3]; /* edge i of one with corner j of the other */
    bool in_p[3][MW_CLIP_SIDES], in_q[MW_CLIP_SIDES][3];
} clip_sides;

/* A rounded area is used if its relative error is below this. */
#define CLIP_ERROR 0x1p-45

static MW_INLINE uint32_t clip_next(uint32_t i, uint32_t n)
{
    return i + 1 == n ? 0 : i + 1;
}

/* Twice the area of abc, its sign exact. Edges along an axis, which pixels have, need no exact
 * stage: their area is a product of two differences. */
static MW_INLINE double clip_area(mw_point a, mw_point b, mw_point c)
{
    double area, bound;
    if (a.y == b.y && c.y != a.y)
        area = (b.x - a.x) * (c.y - a.y), bound = MW_UNDERFLOW_ERROR;
    else if (a.x == b.x && c.x != a.x)
        area = (a.x - c.x) * (b.y - a.y), bound = MW_UNDERFLOW_ERROR;
    else
        area = mw__orient2d_rounded(a, b, c, &bound);
    return MW_LIKELY(CLIP_ERROR * fabs(area) > bound) ? area : mw__orient2d_exact(a, b, c);
}

/* Is a corner of Q left of the edge ab of P after P has moved? `area` is twice the area of the two.
 */
static MW_INLINE bool clip_left_of_p(double area, mw_point a, mw_point b)
{
    if (MW_LIKELY(area != 0)) return area > 0;
    return b.y != a.y ? b.y > a.y : b.x < a.x;
}

/* Is a corner of P left of the edge ab of Q after P has moved? */
static MW_INLINE bool clip_left_of_q(double area, mw_point a, mw_point b)
{
    if (MW_LIKELY(area != 0)) return area > 0;
    return b.y != a.y ? b.y < a.y : b.x > a.x;
}

/* Find the sides of all corners. False if a line along an edge has P on one side and Q on the
 * other: then they have no common area. `apart`: they do not even have a common point. */
static bool clip_sides_find(clip_sides *s, const mw_point p[3], const mw_point *q, uint32_t m,
                            bool *apart)
{
    *apart = false;
    bool meets = true;
    for (uint32_t i = 0; i < 3; i++) {
        mw_point a = p[i], b = p[clip_next(i, 3)];
        double most = -INFINITY;
        for (uint32_t j = 0; j < m; j++) {
            s->p[i][j] = clip_area(a, b, q[j]);
            s->in_p[i][j] = clip_left_of_p(s->p[i][j], a, b);
            most = fmax(most, s->p[i][j]);
        }
        *apart |= most < 0;
        meets &= most > 0;
        if (*apart) return false;
    }
    for (uint32_t j = 0; j < m; j++) {
        mw_point a = q[j], b = q[clip_next(j, m)];
        double most = -INFINITY;
        for (uint32_t i = 0; i < 3; i++) {
            s->q[j][i] = clip_area(a, b, p[i]);
            s->in_q[j][i] = clip_left_of_q(s->q[j][i], a, b);
            most = fmax(most, s->q[j][i]);
        }
        *apart |= most < 0;
        meets &= most > 0;
        if (*apart) return false;
    }
    return meets;
}

/* --- corners --- */

typedef struct clip_work {
    const clip_sides *sides;
    const mw_point *p, *q;
    uint32_t m;
    mw_clip *clip;
    double frame[MW_CLIP_SIDES][3]; /* of each corner of Q, the weights of those that tell q */
} clip_work;

static mw_clip_corner *clip_add(clip_work *w)
{
    return &w->clip->corner[w->clip->count++];
}

/* Weights from twice the areas opposite corner 1 and the last corner of the frame, and twice the
 * area of the frame. */
static void clip_frame_weights(double weight[3], double area_1, double area_last, double whole)
{
    weight[1] = area_1 / whole;
    weight[2] = area_last / whole;
    weight[0] = 1 - weight[1] - weight[2];
}

static void clip_frame(clip_work *w)
{
    const uint32_t m = w->m;
    for (uint32_t j = 0; j < m; j++) {
        double *f = w->frame[j];
        f[0] = j == 0, f[1] = j == 1, f[2] = j == m - 1;
        if (j > 1 && j < m - 1)
            clip_frame_weights(f, clip_area(w->q[m - 1], w->q[0], w->q[j]),
                               clip_area(w->q[0], w->q[1], w->q[j]), w->clip->double_q);
    }
}

/* Corner i of P, inside Q. */
static void clip_add_p(clip_work *w, uint32_t i)
{
    mw_clip_corner *c = clip_add(w);
    const clip_sides *s = w->sides;
    for (uint32_t k = 0; k < 3; k++) c->p[k] = k == i;
    clip_frame_weights(c->q, s->q[w->m - 1][i], s->q[0][i], w->clip->double_q);
    if (w->m == 3) c->q[0] = s->q[1][i] / w->clip->double_q;
}

/* Corner j of Q, inside P. */
static void clip_add_q(clip_work *w, uint32_t j)
{
    mw_clip_corner *c = clip_add(w);
    for (uint32_t k = 0; k < 3; k++) {
        c->p[k] = w->sides->p[clip_next(k, 3)][j] / w->clip->double_p;
        c->q[k] = w->frame[j][k];
    }
}

/* The point where edge i of P crosses edge j of Q. At most one of the two areas of each edge is 0:
 * otherwise both edges would lie on one line, and its corners move together. */
static void clip_add_crossing(clip_work *w, uint32_t i, uint32_t j)
{
    mw_clip_corner *c = clip_add(w);
    const clip_sides *s = w->sides;
    uint32_t i2 = clip_next(i, 3), j2 = clip_next(j, w->m);
    double a = fabs(s->q[j][i]), b = fabs(s->q[j][i2]), d = fabs(s->p[i][j]), e = fabs(s->p[i][j2]);
    for (uint32_t k = 0; k < 3; k++) {
        c->p[k] = k == i ? b / (a + b) : k == i2 ? a / (a + b) : 0;
        c->q[k] = e / (d + e) * w->frame[j][k] + d / (d + e) * w->frame[j2][k];
    }
}

/* --- along the edges --- */

static bool clip_in_p(const clip_sides *s, uint32_t j)
{
    return s->in_p[0][j] && s->in_p[1][j] && s->in_p[2][j];
}

static bool clip_in_q(const clip_sides *s, uint32_t i, uint32_t m)
{
    bool in = true;
    for (uint32_t j = 0; j < m; j++) in &= s->in_q[j][i];
    return in;
}

/* Do edge i of P and edge j of Q cross, such that P enters Q there (`enters`) or leaves it? */
static bool clip_crosses(const clip_work *w, uint32_t i, uint32_t j, bool enters)
{
    const clip_sides *s = w->sides;
    uint32_t i2 = clip_next(i, 3), j2 = clip_next(j, w->m);
    return s->in_q[j][i] == !enters && s->in_q[j][i2] == enters && s->in_p[i][j] != s->in_p[i][j2];
}

/* The edge of Q over which edge i of P leaves Q, or m. */
static uint32_t clip_exit(const clip_work *w, uint32_t i)
{
    uint32_t j = 0;
    while (j < w->m && !clip_crosses(w, i, j, false)) j++;
    return j;
}

/* The edge of P that enters Q over edge j of Q, or 3. */
static uint32_t clip_entry(const clip_work *w, uint32_t j)
{
    uint32_t i = 0;
    while (i < 3 && !clip_crosses(w, i, j, true)) i++;
    return i;
}

/* The first edge of P that enters Q. 3: none. */
static uint32_t clip_first_entry(const clip_work *w)
{
    uint32_t i = 3;
    for (uint32_t j = 0; j < w->m && i == 3; j++) i = clip_entry(w, j);
    return i;
}

/* Follow the common part from edge i of P inside Q: along edges of P until they leave Q, then along
 * edges of Q until P enters again. Returns the edge of P that enters; 3 if Q is not convex. */
static uint32_t clip_follow(clip_work *w, uint32_t i)
{
    uint32_t j, entry = 3;
    while ((j = clip_exit(w, i)) == w->m && w->clip->count < w->m + 3) {
        i = clip_next(i, 3);
        clip_add_p(w, i);
    }
    if (w->clip->count >= w->m + 3) return 3;
    clip_add_crossing(w, i, j);
    w->clip->over |= 1u << j;
    while ((entry = clip_entry(w, j)) == 3 && w->clip->count < w->m + 3) {
        j = clip_next(j, w->m);
        clip_add_q(w, j);
        w->clip->over |= 1u << j;
    }
    if (w->clip->count >= w->m + 3) return 3;
    clip_add_crossing(w, entry, j);
    return entry;
}

static void clip_collect(clip_work *w)
{
    uint32_t first = clip_first_entry(w), i = first;
    if (first < 3) {
        do i = clip_follow(w, i);
        while (i < 3 && i != first);
        if (i == 3) w->clip->count = 0;
    } else if (clip_in_q(w->sides, 0, w->m)) {
        for (i = 0; i < 3; i++) clip_add_p(w, i);
    } else if (clip_in_p(w->sides, 0)) {
        for (uint32_t j = 0; j < w->m; j++) clip_add_q(w, j);
        w->clip->over = (1u << w->m) - 1;
    }
}

uint32_t mw__clip(const mw_point p[3], const mw_point *q, uint32_t m, mw_clip *clip)
{
    clip_sides sides;
    bool apart;
    clip->count = clip->over = 0;
    if (!clip_sides_find(&sides, p, q, m, &apart)) return 0;
    clip->double_p = clip_area(p[0], p[1], p[2]);
    clip->double_q = clip_area(q[0], q[1], q[m - 1]);
    clip_work work = {.sides = &sides, .p = p, .q = q, .m = m, .clip = clip};
    clip_frame(&work);
    clip_collect(&work);
    return clip->count;
}

bool mw__clip_touches(const mw_point p[3], const mw_point *q, uint32_t m)
{
    clip_sides sides;
    bool apart;
    clip_sides_find(&sides, p, q, m, &apart);
    return !apart;
}

/* --- integrals --- */

double mw__clip_part(const mw_clip *clip, uint32_t k)
{
    const mw_clip_corner *c = clip->corner;
    bool by_p = clip->double_p <= clip->double_q;
    const double *o = by_p ? c[0].p : c[0].q, *a = by_p ? c[k].p : c[k].q,
                 *b = by_p ? c[k + 1].p : c[k + 1].q;
    double cross = (a[1] - o[1]) * (b[2] - o[2]) - (a[2] - o[2]) * (b[1] - o[1]);
    return fmax(cross, 0) / 2 * (by_p ? clip->double_p : clip->double_q);
}

mw_clip_integral mw__clip_integral(const mw_clip *clip)
{
    const mw_clip_corner *c = clip->corner;
    mw_clip_integral sum = {0};
    for (uint32_t k = 1; k + 1 < clip->count; k++) {
        double area = mw__clip_part(clip, k);
        sum.area += area;
        for (int i = 0; i < 3; i++) {
            sum.p[i] += area / 3 * (c[0].p[i] + c[k].p[i] + c[k + 1].p[i]);
            sum.q[i] += area / 3 * (c[0].q[i] + c[k].q[i] + c[k + 1].q[i]);
        }
    }
    return sum;
}
