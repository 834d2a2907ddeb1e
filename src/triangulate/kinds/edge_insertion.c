/* edge_insertion.c - one edge inserted for a smaller largest angle [Edelsbrunner, Tan, Waupotitsch
 * 1992; Bern, Edelsbrunner, Eppstein, Mitchell, Tan 1993].
 *
 *         s
 *        /|\
 *       / | \
 *      r--+--p
 *       \ | /
 *         q
 *
 * Let pqr be a triangle with the largest angle, at q. A triangulation T without an angle as large
 * has an edge at q that parts this one; it crosses pr, pqr being empty. So each vertex s that q
 * sees beyond pr is tried: the triangles that qs crosses are removed, which leaves a polygon on
 * either side of qs, with a chain of vertices from q to s; ears are cut off the chains that have
 * only smaller angles. If T has the edge qs, there is such an ear, other than at q and s, as long
 * as a polygon is left, whichever were cut before [the latter, "cake cutting"]. So if ears run out,
 * T does not have it.
 *
 * Ears at the vertices of a chain do not depend on s, except for the last of them. So chains grow
 * while the search moves away from q, triangle by triangle and nearest first, as stacks: an ear is
 * cut as soon as it shows, and what is below the top of a stack has been tried. Branches of the
 * search share the lower parts of their stacks, which are never changed. Where a chain turns into
 * its polygon, the ear is empty: each of its vertices sees a point of qs (segment_insertion.c has
 * the argument).
 *
 * How far the search goes. Say y is a vertex of a chain, and the angle qys is not smaller than the
 * one at q. Then T does not have qs: of the chain's vertices in the triangle qys let z be the one
 * nearest to qs; the angle qzs is not smaller either, so T has an edge that parts it, and this
 * would leave the triangle qzs, which is empty, through qs. Thus y takes from all that lies behind
 * it what lies beyond a ray from y; once the rays from both sides have met, nothing is left. The
 * larger the angle, the farther one has to look; a large one is rare.
 *
 * A triangle is seen again in each gap between the vertices before it that q sees: the visible
 * triangles may be as many as the square of the triangles. The caller bounds their number and the
 * work; what is beyond is not decided. */
#include "triangulate/kinds/edge_insertion.h"

#include <stdlib.h>

#define NOWHERE UINT32_MAX

/* A vertex of a chain and the one below it. */
struct mw_chain {
    uint32_t vertex, below;
};

/* A triangle that q sees through the edge of half-edge `half`, whose ends u and v are on the left
 * and on the right. */
struct mw_visible_triangle {
    uint32_t half, parent;
    /* the tops of the chains */
    uint32_t left, right;
    /* q sees what is strictly between these vertices */
    uint32_t left_bound, right_bound;
    /* a vertex of each chain: the one whose ray leaves least */
    uint32_t left_ray, right_ray;
};

/* A search from one corner. */
typedef struct insertion_search {
    mw_insertion *in;
    uint32_t q, p, r; /* p on the right of q's view, r on its left */
    mw_angle worst;
    double cosine, sine; /* of pi less that angle */
} insertion_search;

typedef enum hand { LEFT, RIGHT } hand;

void mw__insertion_release(mw_insertion *in)
{
    free(in->seen);
    free(in->chain);
    free(in->edge_list);
    free(in->made);
    free(in->placed);
    *in = (mw_insertion){0};
}

/* An array with room for n records: the old one, or a larger one that replaces it, or NULL. */
static void *insertion_array_with_room(void *array, size_t *room, size_t n, size_t size)
{
    if (n <= *room) return array;
    size_t more = n + n / 2 + 64;
    void *larger = mw__realloc(array, more, size);
    if (larger) *room = more;
    return larger;
}

static double vector_cross(mw_point a, mw_point b)
{
    return a.x * b.y - a.y * b.x;
}

static mw_point vector_minus(mw_point a, mw_point b)
{
    return (mw_point){a.x - b.x, a.y - b.y};
}

/* Work is counted in tests of an ear in doubles, about 40 nanoseconds. An exact comparison of
 * angles takes some microseconds; three points on a line, which mostly need the exact test, a tenth
 * of that; a triangle looked at or written as much as a few ears. */
#define EXACT_WORK 128
#define LINE_WORK 16
#define TRIANGLE_WORK 4

static bool insertion_angle_is_smaller(const insertion_search *s, mw_point a, mw_point b,
                                       mw_point c)
{
    mw_angle angle = mw__angle(a, b, c);
    double bound, difference = mw__angle_difference_rounded(&angle, &s->worst, &bound);
    if (MW_LIKELY(fabs(difference) > bound)) return difference < 0;
    s->in->work += EXACT_WORK;
    return mw__compare_angles_exact(&angle, &s->worst) < 0;
}

/* May b, between a and c on a chain away from q, be cut off? */
static bool search_ear_is_good(const insertion_search *s, hand side, uint32_t va, uint32_t vb,
                               uint32_t vc)
{
    const mw_point *point = s->in->point;
    mw_point a = point[va], b = point[vb], c = point[vc];
    double turn = mw__orient2d(a, b, c);
    s->in->work += turn == 0 ? LINE_WORK : 1;
    if (side == LEFT ? turn >= 0 : turn <= 0) return false;
    return insertion_angle_is_smaller(s, a, b, c) && insertion_angle_is_smaller(s, c, a, b) &&
           insertion_angle_is_smaller(s, b, c, a);
}

static bool insertion_is_spent(const mw_insertion *in)
{
    return in->work >= in->most_work;
}

/* Cut off one ear below vertex v, put on the chain: the new top; the old one if there is none. */
static uint32_t search_cut_one(const insertion_search *s, hand side, uint32_t top, uint32_t v)
{
    const mw_chain *chain = s->in->chain;
    uint32_t below = chain[top].below;
    return below != NOWHERE &&
                   search_ear_is_good(s, side, chain[below].vertex, chain[top].vertex, v)
               ? below
               : top;
}

/* Cut off what vertex v, put on a chain, makes an ear of: the new top below v. Less where the work
 * is spent. */
static uint32_t search_cut(const insertion_search *s, hand side, uint32_t top, uint32_t v)
{
    for (uint32_t old = NOWHERE; old != top && !insertion_is_spent(s->in);) {
        old = top;
        top = search_cut_one(s, side, top, v);
    }
    return top;
}

static bool chain_push(mw_insertion *in, uint32_t vertex, uint32_t below, uint32_t *top)
{
    mw_chain *chain =
        insertion_array_with_room(in->chain, &in->chain_room, in->chain_count + 1, sizeof *chain);
    if (!chain) return false;
    in->chain = chain;
    in->chain[in->chain_count] = (mw_chain){vertex, below};
    *top = (uint32_t)in->chain_count++;
    return true;
}

/* --- rays --- */

#define RAY_ERROR 0x1p-40
#define RAY_SHORTEST 0x1p-900

/* Of the rest of pi beside the worst angle. Where the products are too small or too large for that,
 * 0: such rays leave everything. */
static void search_set_turn(insertion_search *s)
{
    double length = hypot(s->worst.dot, s->worst.cross);
    bool usable = length >= RAY_SHORTEST && length <= DBL_MAX;
    s->cosine = usable ? -s->worst.dot / length : 0;
    s->sine = usable ? s->worst.cross / length : 0;
}

/* What y leaves of what is behind it: the points z with vector_cross(direction, z - y) < 0 (left
 * chain) or > 0 (right chain). Rounded: it only saves work. */
typedef struct ray {
    mw_point y, direction;
} ray;

/* The angle qys is that at q where s is on the ray: y - q turned by the rest of pi, to the right
 * from a vertex of the left chain. */
static ray search_ray_from(const insertion_search *s, hand side, uint32_t vertex)
{
    mw_point y = s->in->point[vertex], d = vector_minus(y, s->in->point[s->q]);
    double cosine = s->cosine, sine = side == LEFT ? -s->sine : s->sine;
    ray r = {y, {d.x * cosine - d.y * sine, d.x * sine + d.y * cosine}};
    if (!(fabs(r.direction.x) + fabs(r.direction.y) >= RAY_SHORTEST))
        r.direction = (mw_point){0, 0};
    return r;
}

/* How far z lies on the side that the ray leaves, or more: an error of RAY_ERROR times the lengths
 * is far more than what a dozen operations can bring about, and MW_UNDERFLOW_ERROR more than what
 * underflows. */
static double ray_left_over(const ray *r, hand side, mw_point z)
{
    mw_point d = vector_minus(z, r->y);
    double value = vector_cross(r->direction, d);
    double slack =
        (fabs(r->direction.x) + fabs(r->direction.y)) * (fabs(d.x) + fabs(d.y)) * RAY_ERROR;
    return (side == LEFT ? -value : value) + slack + MW_UNDERFLOW_ERROR;
}

/* Is nothing left of the edge from u, on the left, to v between the rays of two vertices? */
static bool search_is_closed(const insertion_search *s, uint32_t left_vertex, uint32_t right_vertex,
                             mw_point u, mw_point v)
{
    ray left = search_ray_from(s, LEFT, left_vertex),
        right = search_ray_from(s, RIGHT, right_vertex);
    double from_u = ray_left_over(&left, LEFT, u), from_v = ray_left_over(&left, LEFT, v);
    double to_u = ray_left_over(&right, RIGHT, u), to_v = ray_left_over(&right, RIGHT, v);
    if (from_v < 0 && from_u < 0) return true;
    if (to_u < 0 && to_v < 0) return true;
    /* left over: from u + t (v - u) on with t = from, up to t = to */
    double from = from_u < 0 ? from_u / (from_u - from_v) : 0,
           to = to_v < 0 ? to_u / (to_u - to_v) : 1;
    if (from_v < 0 || to_u < 0) return false;
    return from > to + RAY_ERROR;
}

/* Of two vertices of a chain, that whose ray leaves less near the new one, w. */
static uint32_t hand_narrower(const insertion_search *s, hand side, uint32_t old, uint32_t w)
{
    ray r = search_ray_from(s, side, old);
    return ray_left_over(&r, side, s->in->point[w]) < 0 ? old : w;
}

/* --- the search --- */

static uint32_t half_apex(const mw_insertion *in, uint32_t half)
{
    return in->tri[mw__link_triangle(half)].v[mw__prev(mw__link_edge(half))];
}

/* Is there anything to see through a half-edge, from u on the left to v on the right? */
static bool search_is_open(const insertion_search *s, const mw_visible_triangle *next, uint32_t u,
                           uint32_t v)
{
    const mw_insertion *in = s->in;
    if (next->half == MW_NONE || in->tri[mw__link_triangle(next->half)].user == MW_INSERTION_FIXED)
        return false;
    return !search_is_closed(s, next->left_ray, next->right_ray, in->point[u], in->point[v]);
}

static mw_insertion_result insertion_look(mw_insertion *in, mw_visible_triangle next)
{
    if (in->seen_count >= in->most_seen || in->seen_count >= MW_INSERTION_MOST_SEEN)
        return MW_INSERTION_SPENT;
    mw_visible_triangle *visible =
        insertion_array_with_room(in->seen, &in->seen_room, in->seen_count + 1, sizeof *visible);
    if (!visible) return MW_INSERTION_MEMORY;
    in->seen = visible;
    in->seen[in->seen_count++] = next;
    return MW_INSERTION_NONE;
}

/* Pass w, the apex beyond half-edge `half` of visible triangle i: leave it on the given side,
 * whose chain it joins. */
static mw_insertion_result search_pass(insertion_search *s, uint32_t i, uint32_t w, hand side)
{
    mw_insertion *in = s->in;
    mw_visible_triangle from = in->seen[i], next = from;
    const mw_triangle *tri = &in->tri[mw__link_triangle(from.half)];
    uint32_t e = mw__link_edge(from.half), u = tri->v[e], v = tri->v[e + 1];
    next.parent = i;
    if (side == LEFT) {
        next.left_ray = hand_narrower(s, LEFT, from.left_ray, w);
        if (mw__orient2d(in->point[s->q], in->point[from.left_bound], in->point[w]) < 0)
            next.left_bound = w;
        next.half = tri->link[mw__next(e)];
        if (!search_is_open(s, &next, w, v)) return MW_INSERTION_NONE;
        if (!chain_push(in, w, search_cut(s, LEFT, from.left, w), &next.left))
            return MW_INSERTION_MEMORY;
    } else {
        next.right_ray = hand_narrower(s, RIGHT, from.right_ray, w);
        if (mw__orient2d(in->point[s->q], in->point[from.right_bound], in->point[w]) > 0)
            next.right_bound = w;
        next.half = tri->link[mw__prev(e)];
        if (!search_is_open(s, &next, u, w)) return MW_INSERTION_NONE;
        if (!chain_push(in, w, search_cut(s, RIGHT, from.right, w), &next.right))
            return MW_INSERTION_MEMORY;
    }
    return insertion_look(in, next);
}

/* Are both polygons cut up to the edge to w? Ears are cut on both sides in turn, so that where one
 * side fails soon it does not matter how many there are on the other. */
static bool search_is_better(const insertion_search *s, const mw_visible_triangle *from, uint32_t w)
{
    const mw_chain *chain = s->in->chain;
    uint32_t left = from->left, right = from->right;
    while (!insertion_is_spent(s->in)) {
        bool left_done = chain[left].below == NOWHERE, right_done = chain[right].below == NOWHERE;
        if (left_done && right_done) return true;
        uint32_t next_left = search_cut_one(s, LEFT, left, w);
        if (!left_done && next_left == left) return false;
        uint32_t next_right = search_cut_one(s, RIGHT, right, w);
        if (!right_done && next_right == right) return false;
        left = next_left;
        right = next_right;
    }
    return false;
}

static mw_insertion_result search_begin(insertion_search *s, uint32_t half)
{
    mw_insertion *in = s->in;
    mw_visible_triangle first = {
        .half = half, .parent = NOWHERE, .left_bound = s->r, .right_bound = s->p};
    uint32_t bottom;
    in->seen_count = in->chain_count = 0;
    if (!chain_push(in, s->q, NOWHERE, &bottom) || !chain_push(in, s->r, bottom, &first.left) ||
        !chain_push(in, s->p, bottom, &first.right))
        return MW_INSERTION_MEMORY;
    first.left_ray = s->r;
    first.right_ray = s->p;
    return search_is_open(s, &first, s->r, s->p) ? insertion_look(in, first) : MW_INSERTION_NONE;
}

/* The visible triangle beyond which lies an s that makes things better. Chains are cut in full as
 * long as the work is not spent, and none is used after. */
static mw_insertion_result search_find(insertion_search *s, uint32_t half, uint32_t *found)
{
    mw_insertion *in = s->in;
    const mw_point *point = in->point;
    mw_insertion_result result = search_begin(s, half);
    for (uint32_t i = 0; result == MW_INSERTION_NONE && i < in->seen_count; i++) {
        if (insertion_is_spent(in)) return MW_INSERTION_SPENT;
        mw_visible_triangle from = in->seen[i];
        uint32_t w = half_apex(in, from.half);
        bool right_of_left = mw__orient2d(point[s->q], point[from.left_bound], point[w]) < 0;
        bool left_of_right = mw__orient2d(point[s->q], point[from.right_bound], point[w]) > 0;
        in->work += TRIANGLE_WORK;
        if (right_of_left && left_of_right && search_is_better(s, &from, w)) {
            *found = i;
            return MW_INSERTION_DONE;
        }
        if (in->reach == 1) break;
        if (left_of_right) result = search_pass(s, i, w, LEFT);
        if (right_of_left && result == MW_INSERTION_NONE) result = search_pass(s, i, w, RIGHT);
    }
    return result == MW_INSERTION_NONE && insertion_is_spent(in) ? MW_INSERTION_SPENT : result;
}

/* --- the exchange --- */

/* while triangles are exchanged, `user` of those removed is their index on the path + ON_PATH */
enum { ON_PATH = 3 };

/* A vertex of a chain, and the edge that leads to it from the one below. */
struct mw_chain_edge {
    uint32_t vertex;
    uint32_t beyond;     /* the half-edge on the edge's other side, MW_NONE on the hull           */
    uint32_t path_index; /* of the triangle removed on this side; NOWHERE for the base of an ear  */
};

static bool path_room(mw_insertion *in, uint32_t n)
{
    uint32_t *made = insertion_array_with_room(in->made, &in->made_room, n, sizeof *made);
    if (made) in->made = made;
    uint32_t *placed = insertion_array_with_room(in->placed, &in->placed_room, n, sizeof *placed);
    if (placed) in->placed = placed;
    mw_chain_edge *edge_list = insertion_array_with_room(in->edge_list, &in->edge_room,
                                                         2 * (size_t)n + 4, sizeof *edge_list);
    if (edge_list) in->edge_list = edge_list;
    return made && placed && edge_list;
}

/* made[] = the triangles to be removed, from t to that beyond visible triangle `found`. */
static bool path_list(mw_insertion *in, uint32_t t, uint32_t found)
{
    uint32_t n = 1;
    for (uint32_t i = found; i != NOWHERE; i = in->seen[i].parent) n++;
    if (!path_room(in, n)) return false;
    in->made_count = n;
    for (uint32_t i = found; i != NOWHERE; i = in->seen[i].parent)
        in->made[--n] = mw__link_triangle(in->seen[i].half);
    in->made[0] = t;
    for (uint32_t i = 0; i < in->made_count; i++) {
        in->tri[in->made[i]].user = ON_PATH + i;
        in->placed[i] = MW_NONE;
    }
    return true;
}

/* The step over edge e of the triangle at an index of the path, to the given vertex. */
static mw_chain_edge path_step_over(const mw_insertion *in, uint32_t path_index, uint32_t e,
                                    uint32_t vertex)
{
    return (mw_chain_edge){vertex, in->tri[in->made[path_index]].link[e], path_index};
}

static bool path_leads_to(const mw_insertion *in, uint32_t path_index, uint32_t e, uint32_t other)
{
    uint32_t half = in->tri[in->made[path_index]].link[e];
    return half != MW_NONE && mw__link_triangle(half) == in->made[other];
}

/* Write both chains, from q to w, uncut. Each triangle between the first and the last has one edge
 * on them. */
static void path_list_chains(const insertion_search *s, uint32_t k, mw_chain_edge *chain[2],
                             uint32_t count[2])
{
    mw_insertion *in = s->in;
    uint32_t last = in->made_count - 1, left = 0, right = 0;
    chain[LEFT][left++] = chain[RIGHT][right++] = (mw_chain_edge){s->q, MW_NONE, NOWHERE};
    chain[LEFT][left++] = path_step_over(in, 0, mw__prev(k), s->r);
    chain[RIGHT][right++] = path_step_over(in, 0, k, s->p);
    uint32_t half = in->tri[in->made[0]].link[mw__next(k)];
    for (uint32_t i = 1; i <= last; i++) {
        uint32_t e = mw__link_edge(half), w = half_apex(in, half);
        bool out_right = i < last && path_leads_to(in, i, mw__next(e), i + 1),
             out_left = i < last && !out_right;
        if (!out_left) chain[LEFT][left++] = path_step_over(in, i, mw__prev(e), w);
        if (!out_right) chain[RIGHT][right++] = path_step_over(in, i, mw__next(e), w);
        half = in->tri[in->made[i]].link[out_left ? mw__prev(e) : mw__next(e)];
    }
    count[LEFT] = left;
    count[RIGHT] = right;
}

/* Edge `half` of a new triangle lies where the step was. Where chains run along both sides of an
 * edge, what lies beyond a step is the triangle that has replaced the other one. */
static void insertion_place(mw_insertion *in, uint32_t half, const mw_chain_edge *step)
{
    uint32_t beyond = step->beyond;
    if (step->path_index != NOWHERE && beyond != MW_NONE &&
        in->tri[mw__link_triangle(beyond)].user >= ON_PATH) {
        in->placed[step->path_index] = half;
        beyond = in->placed[in->tri[mw__link_triangle(beyond)].user - ON_PATH];
    }
    in->tri[mw__link_triangle(half)].link[mw__link_edge(half)] = beyond;
    if (beyond != MW_NONE) in->tri[mw__link_triangle(beyond)].link[mw__link_edge(beyond)] = half;
}

/* The ear of a, b, c, which follow each other away from q, becomes triangle t. */
static void search_write_ear(mw_insertion *in, hand side, uint32_t t, const mw_chain_edge *a,
                             const mw_chain_edge *b, mw_chain_edge *c)
{
    mw_triangle *tri = &in->tri[t];
    tri->v[0] = tri->v[3] = b->vertex;
    tri->v[1] = side == LEFT ? a->vertex : c->vertex;
    tri->v[2] = side == LEFT ? c->vertex : a->vertex;
    insertion_place(in, mw__link(t, side == LEFT ? 0 : 2), b);
    insertion_place(in, mw__link(t, side == LEFT ? 2 : 0), c);
    c->beyond = mw__link(t, 1);
    c->path_index = NOWHERE;
}

/* Cut a chain as the search has done, into triangles made[*next], ...: what lies beside qs. */
static uint32_t search_write_side(const insertion_search *s, hand side, mw_chain_edge *chain,
                                  uint32_t count, uint32_t *next)
{
    mw_insertion *in = s->in;
    uint32_t n = 1;
    for (uint32_t i = 1; i < count; i++) {
        mw_chain_edge c = chain[i];
        for (; n > 1 &&
               search_ear_is_good(s, side, chain[n - 2].vertex, chain[n - 1].vertex, c.vertex);
             n--)
            search_write_ear(in, side, in->made[(*next)++], &chain[n - 2], &chain[n - 1], &c);
        chain[n++] = c;
    }
    return chain[1].beyond;
}

static mw_insertion_result search_exchange(const insertion_search *s, uint32_t t, uint32_t k,
                                           uint32_t found)
{
    mw_insertion *in = s->in;
    if (!path_list(in, t, found)) return MW_INSERTION_MEMORY;
    mw_chain_edge *chain[2] = {in->edge_list, in->edge_list + in->made_count + 2};
    uint32_t count[2], next = 0;
    path_list_chains(s, k, chain, count);
    uint32_t left = search_write_side(s, LEFT, chain[LEFT], count[LEFT], &next);
    uint32_t right = search_write_side(s, RIGHT, chain[RIGHT], count[RIGHT], &next);
    in->tri[mw__link_triangle(left)].link[mw__link_edge(left)] = right;
    in->tri[mw__link_triangle(right)].link[mw__link_edge(right)] = left;
    for (uint32_t i = 0; i < in->made_count; i++) in->tri[in->made[i]].user = MW_INSERTION_FREE;
    in->work += TRIANGLE_WORK * (uint64_t)in->made_count;
    return MW_INSERTION_DONE;
}

mw_insertion_result mw__insert_edge(mw_insertion *in, uint32_t t, uint32_t k)
{
    const mw_triangle *tri = &in->tri[t];
    uint32_t q = tri->v[k], p = tri->v[mw__next(k)], r = tri->v[mw__prev(k)], found = 0;
    insertion_search s = {.in = in,
                          .q = q,
                          .p = p,
                          .r = r,
                          .worst = mw__angle(in->point[p], in->point[q], in->point[r])};
    search_set_turn(&s);
    mw_insertion_result result = search_find(&s, tri->link[mw__next(k)], &found);
    return result == MW_INSERTION_DONE ? search_exchange(&s, t, k, found) : result;
}
