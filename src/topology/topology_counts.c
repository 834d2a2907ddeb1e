/* topology_counts.c - counts components by union-find; border loops and fans by turning round
 * vertices, in O(n), as each edge or corner is marked once. */
#include "topology/topology_counts.h"

#include <stdlib.h>

/* --- components: union-find over vertices --- */

static uint32_t vertex_root(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

bool mw__count_components(const mw_triangle *tri, uint32_t n, uint32_t vertex_count,
                          const uint32_t *coincident, uint32_t *used, uint32_t *components)
{
    uint32_t *parent = mw__alloc(vertex_count, sizeof *parent);
    if (!parent) return false;
    for (uint32_t v = 0; v < vertex_count; v++) parent[v] = MW_NONE;
    *used = *components = 0;
    for (uint32_t t = 0; t < n; t++)
        for (int k = 0; k < 3 && !(tri[t].user & MW_GHOST); k++) {
            uint32_t v = mw__representative(coincident, tri[t].v[k]);
            if (parent[v] == MW_NONE) {
                parent[v] = v;
                ++*used;
                ++*components;
            }
            uint32_t a = vertex_root(parent, v),
                     b = vertex_root(parent, mw__representative(coincident, tri[t].v[0]));
            if (a == b) continue;
            parent[a < b ? b : a] = a < b ? a : b;
            --*components;
        }
    free(parent);
    return true;
}

/* --- border loops --- */

/* The next border edge: turn round the given end of a border edge, through the triangles there, to
 * the other border edge. The result has the same end. The function is its own inverse, so border
 * edges form closed loops. */
static mw_edge_end border_edge_next(const mw_triangle *tri, const uint32_t *coincident,
                                    mw_edge_end e)
{
    for (;;) {
        e = mw__other_edge(e);
        if (mw__link_of(tri, e) == MW_NONE) return e;
        e = mw__across(tri, coincident, e);
    }
}

bool mw__count_border_loops(const mw_triangle *tri, uint32_t n, const uint32_t *coincident,
                            uint32_t *loops)
{
    uint8_t *seen = mw__calloc(n, sizeof *seen); /* a bit per edge */
    if (!seen) return false;
    *loops = 0;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3; k++) {
            if (tri[t].link[k] != MW_NONE || seen[t] >> k & 1) continue;
            ++*loops;
            mw_edge_end e = {mw__link(t, k), false};
            while (!(seen[mw__link_triangle(e.half)] >> mw__link_edge(e.half) & 1)) {
                seen[mw__link_triangle(e.half)] |= (uint8_t)(1u << mw__link_edge(e.half));
                e = border_edge_next(tri, coincident, e);
                e.start = !e.start; /* continue at the other end */
            }
        }
    free(seen);
    return true;
}

/* --- fans --- */

/* Mark a corner. Returns whether it was marked before. */
static bool corner_mark(uint8_t *seen, mw_edge_end e)
{
    uint8_t *bits = &seen[mw__link_triangle(e.half)], bit = (uint8_t)(1u << mw__near_corner(e));
    bool before = *bits & bit;
    *bits |= bit;
    return before;
}

/* Mark the corners from edge e on, until the fan ends or closes. */
static void corners_mark_beyond(const mw_triangle *tri, const uint32_t *coincident, uint8_t *seen,
                                mw_edge_end e)
{
    while (mw__link_of(tri, e) != MW_NONE) {
        e = mw__across(tri, coincident, e);
        if (corner_mark(seen, e)) return;
        e = mw__other_edge(e);
    }
}

bool mw__count_fans(const mw_triangle *tri, uint32_t n, const uint32_t *coincident, uint8_t *fans)
{
    enum { MANY = 2 };
    uint8_t *seen = mw__calloc(n, sizeof *seen); /* a bit per corner */
    if (!seen) return false;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3 && mw__has_three_representatives(&tri[t], coincident); k++) {
            mw_edge_end e = {mw__link(t, k), true};
            if (corner_mark(seen, e)) continue;
            corners_mark_beyond(tri, coincident, seen, e);
            corners_mark_beyond(tri, coincident, seen, mw__other_edge(e));
            uint8_t *count = &fans[mw__representative(coincident, tri[t].v[k])];
            if (*count < MANY) ++*count;
        }
    free(seen);
    return true;
}
