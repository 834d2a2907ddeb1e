/* count.c - pieces by union-find; border loops and fans in O(n), by turning round vertices, where each edge or corner
 * is marked once. */
#include "mesh/count.h"

#include <stdlib.h>

/* --- pieces: union-find over vertices --- */

static uint32_t root_of(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

bool mw__count_pieces(const mw_triangle *tri, uint32_t n, uint32_t vertex_count, const uint32_t *place, uint32_t *used,
                      uint32_t *pieces)
{
    uint32_t *parent = mw__alloc(vertex_count, sizeof *parent);
    if (!parent) return false;
    for (uint32_t v = 0; v < vertex_count; v++) parent[v] = MW_NONE;
    *used = *pieces = 0;
    for (uint32_t t = 0; t < n; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = mw__place_of(place, tri[t].v[k]);
            if (parent[v] == MW_NONE) {
                parent[v] = v;
                ++*used;
                ++*pieces;
            }
            uint32_t a = root_of(parent, v), b = root_of(parent, mw__place_of(place, tri[t].v[0]));
            if (a == b) continue;
            parent[a < b ? b : a] = a < b ? a : b;
            --*pieces;
        }
    free(parent);
    return true;
}

/* --- border loops --- */

/* The border edge that meets this one at its end, turning through the triangles between; and its end there. It is its
 * own inverse, so that border edges form closed loops. */
static mw_edge_end meet(const mw_triangle *tri, const uint32_t *place, mw_edge_end e)
{
    for (;;) {
        e = mw__other_edge(e);
        if (mw__link_of(tri, e) == MW_NONE) return e;
        e = mw__across(tri, place, e);
    }
}

bool mw__count_loops(const mw_triangle *tri, uint32_t n, const uint32_t *place, uint32_t *loops)
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
                e = meet(tri, place, e);
                e.start = !e.start; /* go on from the other end */
            }
        }
    free(seen);
    return true;
}

/* --- fans --- */

/* Mark a corner; was it marked before? */
static bool mark(uint8_t *seen, mw_edge_end e)
{
    uint8_t *bits = &seen[mw__link_triangle(e.half)], bit = (uint8_t)(1u << mw__near_corner(e));
    bool before = *bits & bit;
    *bits |= bit;
    return before;
}

/* Mark the corners from edge e on, until the fan ends or closes. */
static void mark_beyond(const mw_triangle *tri, const uint32_t *place, uint8_t *seen, mw_edge_end e)
{
    while (mw__link_of(tri, e) != MW_NONE) {
        e = mw__across(tri, place, e);
        if (mark(seen, e)) return;
        e = mw__other_edge(e);
    }
}

bool mw__count_fans(const mw_triangle *tri, uint32_t n, const uint32_t *place, uint8_t *fans)
{
    enum { MANY = 2 };
    uint8_t *seen = mw__calloc(n, sizeof *seen); /* a bit per corner */
    if (!seen) return false;
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3 && mw__has_three_places(&tri[t], place); k++) {
            mw_edge_end e = {mw__link(t, k), true};
            if (mark(seen, e)) continue;
            mark_beyond(tri, place, seen, e);
            mark_beyond(tri, place, seen, mw__other_edge(e));
            uint8_t *count = &fans[mw__place_of(place, tri[t].v[k])];
            if (*count < MANY) ++*count;
        }
    free(seen);
    return true;
}
