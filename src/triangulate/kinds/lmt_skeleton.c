/* lmt_skeleton.c - the LMT skeleton: candidate edges that cannot be locally minimal are removed,
 * until none is left.
 *
 *          l
 *        / | \
 *      a --+-- b
 *        \ | /
 *          r
 *
 * In a triangulation of least weight each inner edge ab is the diagonal of two empty triangles abl
 * and bar, and where these make a strictly convex quadrilateral it is no longer than the other
 * diagonal lr. An edge that has no two such triangles with sides among the candidates is in no
 * triangulation of least weight, and is removed; which may leave others without triangles. An edge
 * that no remaining one crosses is in all of them [Dickerson, Keil, Montague 1997].
 *
 * A triangle is taken for empty if no candidate edge from one of its corners ends in it. This may
 * overlook a vertex inside, which only keeps edges that could be removed. So does every other limit
 * here. */
#include "triangulate/kinds/lmt.h"

#include <math.h>
#include <stdlib.h>

#define MOST_EDGES (UINT32_MAX / 2) /* halves are numbered in 32 bits */

enum { APEXES = 64 };

typedef struct apexes {
    struct {
        uint32_t vertex, side[2]; /* and the edges to it from the ends of the base */
    } apex[APEXES];
    uint32_t count;
    bool overflow;
} apexes;

static uint32_t half_target(const mw_lmt *lmt, uint32_t half)
{
    return lmt->from[half ^ 1];
}

static uint32_t vertex_degree(const mw_lmt *lmt, uint32_t v)
{
    return lmt->first[v + 1] - lmt->first[v];
}

static double skeleton_side(const mw_lmt *lmt, uint32_t a, uint32_t b, uint32_t c)
{
    const mw_point *point = lmt->points->point;
    return mw__orient2d(point[a], point[b], point[c]);
}

static bool half_is_alive(const mw_lmt *lmt, uint32_t half)
{
    return lmt->state[half / 2] & MW_LMT_ALIVE;
}

/* --- the order round a vertex --- */

typedef struct spoke {
    double angle;
    uint32_t half;
} spoke;

static int spokes_compare(const void *a, const void *b)
{
    double x = ((const spoke *)a)->angle, y = ((const spoke *)b)->angle;
    return (x > y) - (x < y);
}

/* Is direction vp before direction vq, counter-clockwise from the direction to the left on?
 * Exact. */
static bool neighbour_is_before(const mw_lmt *lmt, uint32_t v, uint32_t p, uint32_t q)
{
    const mw_point *point = lmt->points->point;
    bool p_up = point[p].y >= point[v].y, q_up = point[q].y >= point[v].y;
    if (p_up != q_up) return q_up;
    double turn = skeleton_side(lmt, v, p, q);
    return turn != 0 ? turn > 0 : point[p].x > point[v].x && point[q].x < point[v].x;
}

/* Sorted by rounded angles first, so that the exact sort has little to do. */
static void skeleton_sort_ring(mw_lmt *lmt, uint32_t v, spoke *spokes)
{
    uint32_t begin = lmt->first[v], n = vertex_degree(lmt, v);
    const mw_point *at = lmt->points->scaled;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t half = lmt->ring[begin + i], w = half_target(lmt, half);
        spokes[i] = (spoke){atan2(at[w].y - at[v].y, at[w].x - at[v].x), half};
    }
    qsort(spokes, n, sizeof *spokes, spokes_compare);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t half = spokes[i].half, j = i;
        for (; j > 0 && neighbour_is_before(lmt, v, half_target(lmt, half),
                                            half_target(lmt, lmt->ring[begin + j - 1]));
             j--)
            lmt->ring[begin + j] = lmt->ring[begin + j - 1];
        lmt->ring[begin + j] = half;
    }
    for (uint32_t i = begin; i < begin + n; i++) lmt->ring_index[lmt->ring[i]] = i;
}

static bool skeleton_sort_rings(mw_lmt *lmt)
{
    uint32_t most = 0;
    for (uint32_t v = 0; v < lmt->points->count; v++)
        most = vertex_degree(lmt, v) > most ? vertex_degree(lmt, v) : most;
    spoke *spokes = mw__alloc(most, sizeof *spokes);
    if (!spokes) return false;
    for (uint32_t v = 0; v < lmt->points->count; v++) skeleton_sort_ring(lmt, v, spokes);
    free(spokes);
    return true;
}

mw_lmt_result mw__lmt_create(mw_lmt *lmt, const mw_scaled *points, const mw_edge_list *list)
{
    *lmt = (mw_lmt){0};
    if (list->count > MOST_EDGES) return MW_LMT_SPENT;
    *lmt = (mw_lmt){.points = points, .edge_count = (uint32_t)list->count};
    uint32_t n = points->count;
    lmt->from = mw__alloc(list->count, 2 * sizeof *lmt->from);
    lmt->ring = mw__alloc(list->count, 2 * sizeof *lmt->ring);
    lmt->ring_index = mw__alloc(list->count, 2 * sizeof *lmt->ring_index);
    lmt->first = mw__calloc((size_t)n + 1, sizeof *lmt->first);
    lmt->state = mw__calloc(list->count, sizeof *lmt->state);
    lmt->queue = mw__alloc(list->count, sizeof *lmt->queue);
    if (!lmt->from || !lmt->ring || !lmt->ring_index || !lmt->first || !lmt->state || !lmt->queue)
        return MW_LMT_MEMORY;
    for (uint32_t e = 0; e < lmt->edge_count; e++) {
        lmt->from[2 * e] = mw__edge_low(list->key[e]);
        lmt->from[2 * e + 1] = mw__edge_high(list->key[e]);
        lmt->state[e] = list->key[e] & MW_EDGE_KNOWN ? MW_LMT_ALIVE | MW_LMT_KNOWN : MW_LMT_ALIVE;
    }
    for (uint32_t h = 0; h < 2 * lmt->edge_count; h++) lmt->first[lmt->from[h]]++;
    for (uint32_t v = 0, sum = 0; v <= n; v++) lmt->first[v] = sum += lmt->first[v];
    for (uint32_t h = 2 * lmt->edge_count; h-- > 0;) lmt->ring[--lmt->first[lmt->from[h]]] = h;
    return skeleton_sort_rings(lmt) ? MW_LMT_DONE : MW_LMT_MEMORY;
}

void mw__lmt_release(mw_lmt *lmt)
{
    free(lmt->from);
    free(lmt->first);
    free(lmt->ring);
    free(lmt->ring_index);
    free(lmt->state);
    free(lmt->queue);
    *lmt = (mw_lmt){0};
}

/* --- the triangles over an edge --- */

/* The living edge between two vertices, or MW_NONE. */
static uint32_t edge_find(const mw_lmt *lmt, uint32_t a, uint32_t b, uint64_t *steps)
{
    if (vertex_degree(lmt, a) > vertex_degree(lmt, b)) {
        uint32_t t = a;
        a = b;
        b = t;
    }
    for (uint32_t i = lmt->first[a]; i < lmt->first[a + 1]; i++) {
        ++*steps;
        if (half_target(lmt, lmt->ring[i]) == b)
            return half_is_alive(lmt, lmt->ring[i]) ? lmt->ring[i] / 2 : MW_NONE;
    }
    return MW_NONE;
}

/* The triangles on the left of a half-edge a->b: turn round a, away from b. Of the ends of edges
 * met so, one lies in the triangle abl just if, seen from b, it is nearer to a than l is. So l is
 * the nearest to a of all before it. */
static void half_find_apexes(const mw_lmt *lmt, uint32_t half, apexes *found, uint64_t *steps)
{
    bool left = true;
    if (vertex_degree(lmt, lmt->from[half]) > vertex_degree(lmt, half_target(lmt, half))) {
        half ^= 1;
        left = false;
    }
    uint32_t a = lmt->from[half], b = half_target(lmt, half), nearest = MW_NONE;
    uint32_t begin = lmt->first[a], end = lmt->first[a + 1], i = lmt->ring_index[half];
    found->count = 0;
    found->overflow = false;
    for (uint32_t turns = 1; turns < end - begin; turns++) {
        i = left ? (i + 1 == end ? begin : i + 1) : (i == begin ? end - 1 : i - 1);
        ++*steps;
        uint32_t l = half_target(lmt, lmt->ring[i]);
        double up = skeleton_side(lmt, a, b, l);
        if (left ? up <= 0 : up >= 0) return;
        if (nearest != MW_NONE) {
            double nearer = skeleton_side(lmt, b, nearest, l);
            if (left ? nearer <= 0 : nearer >= 0) continue;
        }
        nearest = l;
        if (!half_is_alive(lmt, lmt->ring[i])) continue;
        uint32_t other = edge_find(lmt, b, l, steps);
        if (other == MW_NONE) continue;
        if (found->count == APEXES) {
            found->overflow = true;
            return;
        }
        found->apex[found->count].vertex = l;
        found->apex[found->count].side[0] = lmt->ring[i] / 2;
        found->apex[found->count++].side[1] = other;
    }
}

static bool edge_is_minimal(const mw_lmt *lmt, uint32_t e, const apexes *left, const apexes *right,
                            uint64_t *steps)
{
    if (left->overflow || right->overflow) return true;
    uint32_t a = lmt->from[2 * e], b = lmt->from[2 * e + 1];
    double square = mw__square(lmt->points, a, b);
    for (uint32_t i = 0; i < left->count; i++)
        for (uint32_t j = 0; j < right->count; j++) {
            ++*steps;
            uint32_t l = left->apex[i].vertex, r = right->apex[j].vertex;
            if (!mw__surely_longer(square, mw__square(lmt->points, l, r))) return true;
            if (skeleton_side(lmt, l, a, r) <= 0 || skeleton_side(lmt, r, b, l) <= 0) return true;
        }
    return false;
}

/* --- removal --- */

typedef struct skeleton_work {
    uint32_t head, count; /* of the queue */
} skeleton_work;

static void edge_enqueue(mw_lmt *lmt, skeleton_work *w, uint32_t e)
{
    if ((lmt->state[e] & (MW_LMT_ALIVE | MW_LMT_KNOWN | MW_LMT_QUEUED)) != MW_LMT_ALIVE) return;
    lmt->state[e] |= MW_LMT_QUEUED;
    lmt->queue[((uint64_t)w->head + w->count++) % lmt->edge_count] = e;
}

static void edge_enqueue_sides(mw_lmt *lmt, skeleton_work *w, const apexes *found)
{
    for (uint32_t i = 0; i < found->count; i++) {
        edge_enqueue(lmt, w, found->apex[i].side[0]);
        edge_enqueue(lmt, w, found->apex[i].side[1]);
    }
}

void mw__lmt_reduce(mw_lmt *lmt, mw_effort *effort)
{
    skeleton_work w = {0, 0};
    uint64_t tried = 0;
    for (uint32_t e = 0; e < lmt->edge_count; e++) edge_enqueue(lmt, &w, e);
    while (w.count > 0 && mw__job_step(effort->job, tried, tried + w.count)) {
        tried++;
        uint32_t e = lmt->queue[w.head];
        w.head = w.head + 1 == lmt->edge_count ? 0 : w.head + 1;
        w.count--;
        lmt->state[e] &= (uint8_t)~MW_LMT_QUEUED;
        apexes left, right;
        uint64_t steps = 0;
        half_find_apexes(lmt, 2 * e, &left, &steps);
        half_find_apexes(lmt, 2 * e + 1, &right, &steps);
        if (!edge_is_minimal(lmt, e, &left, &right, &steps)) {
            lmt->state[e] &= (uint8_t)~MW_LMT_ALIVE;
            edge_enqueue_sides(lmt, &w, &left);
            edge_enqueue_sides(lmt, &w, &right);
        }
        if (effort->steps <= steps) return;
        effort->steps -= steps;
    }
}
