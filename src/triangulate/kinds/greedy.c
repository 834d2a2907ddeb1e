/* greedy.c - the greedy triangulation: edges by increasing length, each taken unless it crosses one
 * taken before.
 *
 *            z
 *         . : : ` .
 *       a---------b
 *          :  :
 *          q1 q2
 *
 * It grows in a constrained Delaunay triangulation of the edges taken so far. (The Delaunay
 * triangulation leads to it in linear time [Levcopoulos, Krznaric 1999], less simply.) Let an edge
 * be open if it is not taken, crosses no edge taken, and has no vertex inside. The shortest open
 * edge ab comes next, and few edges have to be considered: either ab is an edge of the
 * triangulation, or it cuts off a corner z between two taken edges za and zb that follow each other
 * round z, with an angle of 90 degrees or more.
 *
 * Why: if no vertex on or in the circle with diameter ab is visible from inside ab, then ab is an
 * edge of each constrained Delaunay triangulation. Otherwise let z be such a vertex. A rubber band
 * from a to b round the obstacles on that side of ab, pulled over to z, lies in the triangle abz.
 * It is a chain of edges, and bounds with ab a polygon without taken edges in it. Any two vertices
 * of this polygon but a and b are less than |ab| apart, as the circle holds them; so each edge
 * between two that see each other is taken, or it would come first. There is none in the polygon,
 * so it has no diagonals, and is a triangle: za and zb are taken and nothing is between. (The edges
 * that ab crosses then are a fan at z.)
 *
 * So the heap holds the open edges of the triangulation, the edges that cut off corners, and edges
 * that were one of these before. Taking an edge makes at most four new corners and changes the
 * triangles that it crosses. An edge that comes out of the heap is taken if it is open; if it is
 * not, it never will be again. */
#include "triangulate/constrained/segment_insertion.h"
#include "triangulate/kinds/greedy_heap.h"
#include "triangulate/kinds/kind_maker.h"

#include <stdlib.h>
#include <string.h>

typedef struct greedy {
    mw_segment_insertion net; /* the taken edges are its subsegments */
    mw_greedy_heap heap;
    uint32_t (*seen)[3]; /* per triangle: its vertices, when its edges were put into the heap */
    uint32_t *changed;   /* scratch: triangles that are others now */
    size_t limit;        /* gather anew what waits when it is more than this */
} greedy;

/* --- half-edges, named by links --- */

static bool greedy_is_taken(const greedy *g, uint32_t half)
{
    return g->net.subsegment[3 * (size_t)mw__link_triangle(half) + mw__link_edge(half)] != MW_NONE;
}

/* Turns round a vertex: counter-clockwise to the hull, then clockwise from the beginning. */
typedef struct greedy_fan {
    uint32_t half, first; /* half-edges that leave the vertex */
    bool clockwise;
} greedy_fan;

static greedy_fan greedy_rotor(const greedy *g, uint32_t vertex)
{
    uint32_t t = g->net.at[vertex], k = 0;
    while (g->net.tri[t].v[k] != vertex) k++;
    return (greedy_fan){mw__link(t, k), mw__link(t, k), false};
}

/* Returns a half-edge between the vertex and `other`, or goes on to the next triangle and returns
 * MW_NONE. */
static uint32_t greedy_rotor_turn(const greedy *g, greedy_fan *r, uint32_t other)
{
    uint32_t back = mw__half_prev(r->half);
    if (mw__half_end(g->net.tri, r->half) == other) return r->half;
    if (mw__half_start(g->net.tri, back) == other) return back;
    if (!r->clockwise && mw__half_link(g->net.tri, back) != MW_NONE) {
        r->half = mw__half_link(g->net.tri, back);
        return MW_NONE;
    }
    if (!r->clockwise) r->half = r->first;
    r->clockwise = true;
    r->half = mw__half_next(mw__half_link(g->net.tri, r->half));
    return MW_NONE;
}

/* A half-edge of the edge between a and b. Turns round both at once, for one of them may have a
 * high degree. */
static uint32_t greedy_half_between(const greedy *g, uint32_t a, uint32_t b)
{
    greedy_fan at_a = greedy_rotor(g, a), at_b = greedy_rotor(g, b);
    for (;;) {
        uint32_t half = greedy_rotor_turn(g, &at_a, b);
        if (half == MW_NONE) half = greedy_rotor_turn(g, &at_b, a);
        if (half != MW_NONE) return half;
    }
}

/* --- what waits --- */

/* Edges a, z and z, b are taken and follow each other round z, the corner on the left of a, z,
 * b. */
static bool greedy_add_corner(greedy *g, uint32_t a, uint32_t z, uint32_t b)
{
    const mw_point *p = g->net.point;
    if (mw__orient2d(p[a], p[z], p[b]) <= 0 || mw__dot2d(p[z], p[a], p[b]) > 0) return true;
    return mw__greedy_push(&g->heap, a, b);
}

/* Add the corners on the left of a taken edge, at its end and at its start. */
static bool greedy_add_corners(greedy *g, uint32_t half)
{
    uint32_t after = mw__half_next(half), before = mw__half_prev(half);
    while (!greedy_is_taken(g, after) && mw__half_link(g->net.tri, after) != MW_NONE)
        after = mw__half_next(mw__half_link(g->net.tri, after));
    while (!greedy_is_taken(g, before) && mw__half_link(g->net.tri, before) != MW_NONE)
        before = mw__half_prev(mw__half_link(g->net.tri, before));
    if (greedy_is_taken(g, after) &&
        !greedy_add_corner(g, mw__half_start(g->net.tri, half), mw__half_end(g->net.tri, half),
                           mw__half_end(g->net.tri, after)))
        return false;
    return !greedy_is_taken(g, before) ||
           greedy_add_corner(g, mw__half_start(g->net.tri, before),
                             mw__half_start(g->net.tri, half), mw__half_end(g->net.tri, half));
}

/* Add the open edges of a triangle: each from one of its two triangles only. */
static bool greedy_add_edges(greedy *g, uint32_t t)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t half = mw__link(t, k);
        if (half > mw__half_link(g->net.tri, half) || greedy_is_taken(g, half)) continue;
        if (!mw__greedy_push(&g->heap, mw__half_start(g->net.tri, half),
                             mw__half_end(g->net.tri, half)))
            return false;
    }
    return true;
}

/* Begin with an empty heap: all open edges, all corners. Done anew when half as many others as
 * there are triangles may have gathered in it, so memory and time stay in proportion. */
static bool greedy_gather(greedy *g)
{
    g->heap.count = 0;
    for (uint32_t t = 0; t < g->net.tri_count; t++) {
        memcpy(g->seen[t], g->net.tri[t].v, sizeof g->seen[t]);
        if (!greedy_add_edges(g, t)) return false;
        for (uint32_t k = 0; k < 3; k++)
            if (greedy_is_taken(g, mw__link(t, k)) && !greedy_add_corners(g, mw__link(t, k)))
                return false;
    }
    g->limit = g->heap.count + g->net.tri_count / 2;
    return true;
}

/* --- taking an edge --- */

/* Put the triangle of a half-edge on the list if it is another than before. */
static void greedy_visit(greedy *g, uint32_t half, uint32_t *count)
{
    if (half == MW_NONE) return;
    uint32_t t = mw__link_triangle(half);
    if (memcmp(g->seen[t], g->net.tri[t].v, sizeof g->seen[t]) == 0) return;
    memcpy(g->seen[t], g->net.tri[t].v, sizeof g->seen[t]);
    g->changed[(*count)++] = t;
}

/* An edge was forced in: add the edges of the triangles that this has changed. They hang together,
 * along the edge and on either side of it, and each has other vertices than the one it replaces. */
static bool greedy_add_changes(greedy *g, uint32_t half)
{
    uint32_t count = 0;
    greedy_visit(g, half, &count);
    for (uint32_t i = 0; i < count; i++) {
        if (!greedy_add_edges(g, g->changed[i])) return false;
        for (uint32_t k = 0; k < 3; k++)
            greedy_visit(g, mw__half_link(g->net.tri, mw__link(g->changed[i], k)), &count);
    }
    return true;
}

/* Take an edge if it is open. An edge with a vertex inside is not open: its first part, up to that
 * vertex, is shorter and therefore taken already, or it crosses a taken edge. Returns false when
 * out of memory. */
static bool greedy_take(greedy *g, mw_greedy_edge edge)
{
    uint32_t from = edge.low, to = edge.high, taken = g->net.subsegment_count;
    mw_subsegment subsegment;
    if (mw__insert_subsegment(&g->net, &from, &to, &subsegment) == MW_SUBSEGMENT_MEMORY)
        return false;
    if (g->net.subsegment_count == taken) return true;
    uint32_t half = greedy_half_between(g, subsegment.from, subsegment.to),
             twin = mw__half_link(g->net.tri, half);
    return greedy_add_corners(g, half) && (twin == MW_NONE || greedy_add_corners(g, twin)) &&
           greedy_add_changes(g, half);
}

static bool greedy_create(greedy *g, mw_triangulation *t)
{
    bool created =
        mw__segment_insertion_create(&g->net, t->point, t->point_count, t->tri, t->tri_count);
    g->heap.point = t->point;
    g->seen = mw__alloc(t->tri_count, sizeof *g->seen);
    g->changed = mw__alloc(t->tri_count, sizeof *g->changed);
    return created && g->seen && g->changed;
}

static void greedy_release(greedy *g)
{
    mw__segment_insertion_release(&g->net);
    free(g->heap.item);
    free(g->seen);
    free(g->changed);
}

mw_status mw__make_greedy(mw_triangulation *t, const mw_kind_options *options,
                          mw_kind_report *report, mw_error *error)
{
    (void)options;
    (void)report;
    greedy g = {0};
    mw__job_stage(t->job, "gathering edges", 0.1);
    bool done = greedy_create(&g, t) && greedy_gather(&g);
    mw__job_stage(t->job, "taking the shortest edges", 0.9);
    while (done && g.heap.count > 0) {
        done =
            greedy_take(&g, mw__greedy_pop(&g.heap)) &&
            mw__job_step(t->job, g.net.subsegment_count, t->tri_count + (uint64_t)t->tri_count / 2);
        if (done && g.heap.count > g.limit) done = greedy_gather(&g);
    }
    greedy_release(&g);
    return done ? MW_OK : mw__fail_memory(error);
}
