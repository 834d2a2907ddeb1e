/* lmt_diamond.c - edges with the diamond property: candidates for a triangulation of least weight.
 *
 *            apex
 *           /    \
 *         /  r     \
 *       p ---------- q
 *         \        /
 *           \    /
 *            apex
 *
 * An edge pq of a triangulation of least weight has no point in one, at least, of the two isosceles
 * triangles with base pq and base angle a = pi / 4.6 [Das, Joseph 1989; Drysdale, McElfresh,
 * Snoeyink 2001]. A point r at distance d from p, in direction t, lies in the left triangle of
 * every edge from p that leaves between the directions t - a and t and is longer than 2 d cos a,
 * and likewise in the right triangle of those between t and t + a. So each point makes two arcs of
 * directions that are dead on one side. A point that lies far enough away in a direction that is
 * dead on both sides is not the end of a candidate [Beirouti, Snoeyink 1998; Haas 2018].
 *
 * From each vertex the others are visited by increasing distance, in a tree of boxes; boxes that
 * lie in dead directions are left out whole. What is found so is tested once more against the
 * triangles themselves and the nearest points. Most vertices are closed by a few neighbours: no
 * longer edge is left in any direction. The others, as on the hull or the border of a cluster, come
 * last, and pass by what is closed and too far away. All in rounded numbers, with margins: an edge
 * is left out only if points lie surely in both triangles. */
#include "triangulate/kinds/lmt.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define BASE_ANGLE (PI / 4.6)

/* Angles of doubles are off by some 2^-51; the margin of 2^-40 is on the safe side. */
#define ANGLE_MARGIN 0x1p-40
#define LENGTH_MARGIN 0x1p-40

/* Scaling rounds coordinates below 2^-1022 and squares and products below it, by at most 2^-1074. A
 * difference of SHARP, and a square or product of TINY, are far enough above that to be as right as
 * others. */
#define SHARP 0x1p-900
#define TINY 0x1p-1000

enum { LEAF = 8, NEAREST = 24, ARCS = 24, FEW = 256, STEPS_PER_VISIT = 8 };

typedef struct seek_box {
    double low[2], high[2];
    uint32_t begin, end; /* of the vertices in `order`                                      */
    double reach;        /* most of what `reach` has for its vertices                      */
} seek_box;

typedef struct seek_item {
    double square; /* of the distance: of a box, to its nearest point */
    uint32_t number;
    bool is_box;
} seek_item;

typedef struct dead_arcs {
    struct {
        double from, to;
    } arc[ARCS];
    uint32_t count;
} dead_arcs;

typedef struct seen_point {
    double square, angle;
} seen_point;

typedef struct seeker {
    const mw_scaled *points;
    double *reach; /* per point: the square of the length of the edges that may leave it, at most */
    uint32_t *order;
    seek_box *node;
    uint32_t node_count, first_leaf;
    seek_item *heap;
    uint32_t heap_count;
    /* points visited, not before `active` of them have made their directions dead */
    seen_point *seen;
    uint32_t seen_count, active;
    dead_arcs left, right;
    mw_point nearest[NEAREST]; /* as seen from the vertex */
    uint32_t nearest_number[NEAREST];
    uint32_t nearest_count;
    double tangent, stretch; /* of the base angle; the square of 2 cos a: both with margins */
} seeker;

bool mw__edge_push(mw_edge_list *list, uint64_t key)
{
    if (list->count == list->capacity) {
        size_t capacity = list->capacity + list->capacity / 2 + 1024;
        uint64_t *grown = mw__realloc(list->key, capacity, sizeof *grown);
        if (!grown) return false;
        list->key = grown;
        list->capacity = capacity;
    }
    list->key[list->count++] = key;
    return true;
}

/* --- the tree of boxes: node i has the children 2 i + 1 and 2 i + 2 --- */

static double seeker_coordinate(const seeker *s, uint32_t i, int axis)
{
    mw_point p = s->points->scaled[s->order[i]];
    return axis == 0 ? p.x : p.y;
}

/* Order begin..end so that what is before `middle` is not above what comes from it on [Hoare
 * 1961]. */
static void seeker_select_middle(const seeker *s, uint32_t begin, uint32_t end, uint32_t middle,
                                 int axis)
{
    int64_t low = begin, high = (int64_t)end - 1;
    while (low < high) {
        double pivot = seeker_coordinate(s, (uint32_t)(low + (high - low) / 2), axis);
        int64_t i = low, j = high;
        while (i <= j) {
            while (seeker_coordinate(s, (uint32_t)i, axis) < pivot) i++;
            while (seeker_coordinate(s, (uint32_t)j, axis) > pivot) j--;
            if (i <= j) mw__swap(&s->order[i++], &s->order[j--]);
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            return;
    }
}

static void box_bound(seeker *s, seek_box *b)
{
    for (int axis = 0; axis < 2; axis++) {
        b->low[axis] = INFINITY;
        b->high[axis] = -INFINITY;
        for (uint32_t i = b->begin; i < b->end; i++) {
            b->low[axis] = fmin(b->low[axis], seeker_coordinate(s, i, axis));
            b->high[axis] = fmax(b->high[axis], seeker_coordinate(s, i, axis));
        }
    }
}

static void seeker_build(seeker *s, uint32_t vertex_count)
{
    s->node[0].reach = INFINITY;
    s->node[0].begin = 0;
    s->node[0].end = vertex_count;
    for (uint32_t i = 0; i < s->node_count; i++) {
        seek_box *b = &s->node[i];
        box_bound(s, b);
        if (i >= s->first_leaf) continue;
        uint32_t middle = b->begin + (b->end - b->begin) / 2;
        seeker_select_middle(s, b->begin, b->end, middle,
                             b->high[0] - b->low[0] < b->high[1] - b->low[1]);
        s->node[2 * i + 1].reach = s->node[2 * i + 2].reach = INFINITY;
        s->node[2 * i + 1].begin = b->begin;
        s->node[2 * i + 1].end = s->node[2 * i + 2].begin = middle;
        s->node[2 * i + 2].end = b->end;
    }
}

static bool seeker_prepare(seeker *s, const uint32_t *vertex, uint32_t vertex_count)
{
    uint32_t leaves = 1;
    while (vertex_count / leaves > LEAF) leaves *= 2;
    s->node_count = 2 * leaves - 1;
    s->first_leaf = leaves - 1;
    s->order = mw__alloc(vertex_count, sizeof *s->order);
    s->node = mw__alloc(s->node_count, sizeof *s->node);
    s->heap = mw__alloc((size_t)vertex_count + s->node_count, sizeof *s->heap);
    s->seen = mw__alloc(vertex_count, sizeof *s->seen);
    s->reach = mw__alloc(s->points->count, sizeof *s->reach);
    if (!s->reach || !s->order || !s->node || !s->heap || !s->seen) return false;
    for (uint32_t i = 0; i < vertex_count; i++) {
        s->order[i] = vertex[i];
        s->reach[vertex[i]] = INFINITY;
    }
    seeker_build(s, vertex_count);
    double cosine = cos(BASE_ANGLE);
    s->stretch = 4 * cosine * cosine * (1 + LENGTH_MARGIN);
    s->tangent = tan(BASE_ANGLE) * (1 - LENGTH_MARGIN);
    return true;
}

/* --- a heap, the nearest first --- */

static void seeker_push(seeker *s, seek_item it)
{
    uint32_t i = s->heap_count++;
    for (; i > 0 && s->heap[(i - 1) / 2].square > it.square; i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = it;
}

static seek_item seeker_pop(seeker *s)
{
    seek_item top = s->heap[0], last = s->heap[--s->heap_count];
    uint32_t i = 0;
    for (uint32_t child = 1; child < s->heap_count; child = 2 * i + 1) {
        if (child + 1 < s->heap_count && s->heap[child + 1].square < s->heap[child].square) child++;
        if (last.square <= s->heap[child].square) break;
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = last;
    return top;
}

/* --- dead directions: arcs within -pi..pi; one that goes beyond is cut there --- */
/* 4 and -4 stand for no end. */

static void arcs_add(dead_arcs *a, double from, double to)
{
    for (uint32_t i = 0; i < a->count;)
        if (a->arc[i].from < to && from < a->arc[i].to) {
            from = fmin(from, a->arc[i].from);
            to = fmax(to, a->arc[i].to);
            a->arc[i] = a->arc[--a->count];
        } else {
            i++;
        }
    /* cannot be: arcs apart from each other are at least half a radian long, but two */
    if (a->count == ARCS) return;
    a->arc[a->count].from = from;
    a->arc[a->count++].to = to;
}

static void arcs_make_dead(dead_arcs *a, double from, double to)
{
    from += ANGLE_MARGIN;
    to -= ANGLE_MARGIN;
    if (from < -PI) {
        arcs_add(a, from + 2 * PI, 4);
        arcs_add(a, -4, to);
    } else if (to > PI) {
        arcs_add(a, from, 4);
        arcs_add(a, -4, to - 2 * PI);
    } else {
        arcs_add(a, from, to);
    }
}

static bool arcs_cover(const dead_arcs *a, double from, double to)
{
    for (uint32_t i = 0; i < a->count; i++)
        if (a->arc[i].from < from && to < a->arc[i].to) return true;
    return false;
}

/* Are all directions dead from `from` counter-clockwise to `to`? */
static bool seeker_is_all_dead(const seeker *s, double from, double to)
{
    if (from <= to) return arcs_cover(&s->left, from, to) && arcs_cover(&s->right, from, to);
    return seeker_is_all_dead(s, from, PI) && seeker_is_all_dead(s, -PI, to);
}

/* The points at less than the square of a distance, divided by 2 cos a, make their directions dead
 * from there on. */
static void seeker_activate(seeker *s, double square)
{
    for (; s->active < s->seen_count && s->seen[s->active].square * s->stretch + TINY < square;
         s->active++) {
        double angle = s->seen[s->active].angle;
        arcs_make_dead(&s->left, angle - BASE_ANGLE, angle);
        arcs_make_dead(&s->right, angle, angle + BASE_ANGLE);
    }
}

/* Do all directions from p to the box lie between dead ones? Its outermost corners, seen from p,
 * tell. */
static bool box_is_hidden(const seeker *s, mw_point p, const seek_box *b)
{
    double x0 = b->low[0] - p.x, x1 = b->high[0] - p.x, y0 = b->low[1] - p.y, y1 = b->high[1] - p.y;
    mw_point right, left;
    if (x0 > 0) {
        right = (mw_point){y0 > 0 ? x1 : x0, y0};
        left = (mw_point){y1 < 0 ? x1 : x0, y1};
    } else if (x1 < 0) {
        right = (mw_point){y1 < 0 ? x0 : x1, y1};
        left = (mw_point){y0 > 0 ? x0 : x1, y0};
    } else if (y0 > 0) {
        right = (mw_point){x1, y0};
        left = (mw_point){x0, y0};
    } else if (y1 < 0) {
        right = (mw_point){x0, y1};
        left = (mw_point){x1, y1};
    } else {
        return false; /* p is in the box */
    }
    return seeker_is_all_dead(s, atan2(right.y, right.x), atan2(left.y, left.x));
}

/* --- from one vertex --- */

static double box_square(const seek_box *b, mw_point p)
{
    double dx = fmax(0, fmax(b->low[0] - p.x, p.x - b->high[0]));
    double dy = fmax(0, fmax(b->low[1] - p.y, p.y - b->high[1]));
    return dx * dx + dy * dy;
}

static void seeker_open_box(seeker *s, uint32_t p, uint32_t number)
{
    mw_point at = s->points->scaled[p];
    const seek_box *b = &s->node[number];
    if (box_is_hidden(s, at, b)) return;
    for (uint32_t child = 2 * number + 1; number < s->first_leaf && child <= 2 * number + 2;
         child++) {
        double square = box_square(&s->node[child], at);
        if (square <= s->node[child].reach) seeker_push(s, (seek_item){square, child, true});
    }
    for (uint32_t i = b->begin; number >= s->first_leaf && i < b->end; i++) {
        double square = mw__square(s->points, p, s->order[i]);
        if (s->order[i] != p && square <= s->reach[s->order[i]])
            seeker_push(s, (seek_item){square, s->order[i], false});
    }
}

/* Is b, another point than a and c, on the way from a to c? Exact. */
static bool diamond_point_is_between(mw_point a, mw_point b, mw_point c)
{
    return fmin(a.x, c.x) <= b.x && b.x <= fmax(a.x, c.x) && fmin(a.y, c.y) <= b.y &&
           b.y <= fmax(a.y, c.y) && mw__orient2d(a, b, c) == 0;
}

/* Is a point near by on the way from p to q, or do such points lie surely in both triangles of that
 * edge? */
static bool diamond_fails(const seeker *s, uint32_t p, uint32_t q, mw_point u, double square)
{
    const mw_point *point = s->points->point;
    bool left = false, right = false;
    for (uint32_t i = 0; i < s->nearest_count; i++) {
        mw_point w = s->nearest[i];
        double a = u.x * w.y, b = u.y * w.x, height = fabs(a - b), along = u.x * w.x + u.y * w.y;
        if (height <= LENGTH_MARGIN * (fabs(a) + fabs(b)) + TINY) {
            if (along > 0 &&
                diamond_point_is_between(point[p], point[s->nearest_number[i]], point[q]))
                return true;
            continue;
        }
        bool inside = height < s->tangent * along &&
                      height < s->tangent * (square - along - LENGTH_MARGIN * square);
        left |= inside && a > b;
        right |= inside && a < b;
    }
    return left && right;
}

/* Does u differ from the vector from p to q only by rounding of its last bits? It need not: if the
 * coordinates of the points span too large a range, scaling loses bits, and points that differ may
 * even become equal. */
static bool diamond_is_sharp(const seeker *s, uint32_t p, uint32_t q, mw_point u)
{
    mw_point from = s->points->point[p], to = s->points->point[q];
    return (fabs(u.x) >= SHARP || from.x == to.x) && (fabs(u.y) >= SHARP || from.y == to.y);
}

/* Visit a point; is the edge to it a candidate? One that is not sharp may be, and rules out
 * nothing. */
static bool seeker_visit(seeker *s, uint32_t p, seek_item it)
{
    mw_point from = s->points->scaled[p], to = s->points->scaled[it.number],
             u = {to.x - from.x, to.y - from.y};
    double angle = atan2(u.y, u.x);
    bool sharp = diamond_is_sharp(s, p, it.number, u);
    bool candidate = !seeker_is_all_dead(s, angle, angle) &&
                     !(sharp && diamond_fails(s, p, it.number, u, it.square));
    if (!sharp) return candidate;
    s->seen[s->seen_count++] = (seen_point){it.square, angle};
    if (s->nearest_count < NEAREST) {
        s->nearest_number[s->nearest_count] = it.number;
        s->nearest[s->nearest_count++] = u;
    }
    return candidate;
}

/* Collect the candidates from p, unless more than `most` points come before it is closed. */
static mw_lmt_result seeker_seek(seeker *s, uint32_t p, uint32_t most, mw_effort *effort,
                                 mw_edge_list *list)
{
    size_t before = list->count;
    s->heap_count = s->seen_count = s->active = s->nearest_count = 0;
    s->left.count = s->right.count = 0;
    seeker_push(s, (seek_item){0, 0, true});
    while (s->heap_count > 0) {
        if (effort->steps < STEPS_PER_VISIT) return MW_LMT_SPENT;
        effort->steps -= STEPS_PER_VISIT;
        seek_item it = seeker_pop(s);
        seeker_activate(s, it.square);
        if (seeker_is_all_dead(s, -PI, PI)) {
            s->reach[p] = it.square;
            return MW_LMT_DONE;
        }
        if (it.is_box) {
            seeker_open_box(s, p, it.number);
        } else if (s->seen_count == most) {
            list->count = before;
            return MW_LMT_DONE;
        } else if (seeker_visit(s, p, it)) {
            if (list->count >= effort->candidates) return MW_LMT_SPENT;
            if (!mw__edge_push(list, mw__edge_key(p, it.number))) return MW_LMT_MEMORY;
        }
    }
    s->reach[p] = DBL_MAX; /* never closed, but all are seen */
    return MW_LMT_DONE;
}

static void seeker_propagate_reach(seeker *s)
{
    for (uint32_t i = s->node_count; i-- > 0;) {
        seek_box *b = &s->node[i];
        b->reach = 0;
        if (i < s->first_leaf)
            b->reach = fmax(s->node[2 * i + 1].reach, s->node[2 * i + 2].reach);
        else
            for (uint32_t k = b->begin; k < b->end; k++)
                b->reach = fmax(b->reach, s->reach[s->order[k]]);
    }
}

mw_lmt_result mw__diamond(const mw_scaled *points, const uint32_t *vertex, uint32_t vertex_count,
                          mw_effort *effort, mw_edge_list *list)
{
    seeker s = {.points = points};
    mw_lmt_result result = seeker_prepare(&s, vertex, vertex_count) ? MW_LMT_DONE : MW_LMT_MEMORY;
    for (uint32_t i = 0; result == MW_LMT_DONE && i < vertex_count; i++)
        result = mw__job_step(effort->job, i, 2 * (uint64_t)vertex_count)
                     ? seeker_seek(&s, s.order[i], FEW, effort, list)
                     : MW_LMT_MEMORY;
    if (result == MW_LMT_DONE) seeker_propagate_reach(&s);
    for (uint32_t i = 0; result == MW_LMT_DONE && i < vertex_count; i++)
        if (s.reach[s.order[i]] == INFINITY)
            result =
                mw__job_step(effort->job, (uint64_t)vertex_count + i, 2 * (uint64_t)vertex_count)
                    ? seeker_seek(&s, s.order[i], UINT32_MAX, effort, list)
                    : MW_LMT_MEMORY;
    free(s.reach);
    free(s.order);
    free(s.node);
    free(s.heap);
    free(s.seen);
    return result;
}
