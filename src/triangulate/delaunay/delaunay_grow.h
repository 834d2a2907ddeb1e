/* delaunay_grow.h - a Delaunay triangulation that grows by one point at a time. Private. */
#ifndef MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_GROW_H
#define MW_SRC_TRIANGULATE_DELAUNAY_DELAUNAY_GROW_H

#include "predicates/predicates.h"

/* Three vertices, counter-clockwise, and three links as in mesh.h: 24 bytes, for more of them in
 * the cache. */
typedef struct mw_facet {
    uint32_t v[3], link[3];
} mw_facet;

/* The plane outside the hull belongs to ghost facets, each of a hull edge and the vertex at
 * infinity. So every edge has two facets, and a point outside the hull is inserted as any other. */
typedef struct mw_growth {
    const mw_point *point; /* finite */
    mw_facet *facet;       /* room for two facets more with each point */
    uint32_t facet_count;
    /* number of the vertex at infinity: the number of points */
    uint32_t infinity;
    /* where the next walk begins */
    uint32_t last;
    /* lift of the vertex at infinity, see delaunay_grow.c */
    double far;
    /* what underflow can add to the error of the circle test, at most */
    double underflow;
    /* squares of distances whose sum is below this: rounding is exact, see delaunay_grow.c */
    double lattice;
    /* facets visited by walks */
    uint64_t visited;
} mw_growth;

static MW_INLINE bool mw__is_ghost(const mw_growth *g, const mw_facet *f)
{
    return f->v[0] == g->infinity || f->v[1] == g->infinity || f->v[2] == g->infinity;
}

/* Fills in what depends on the points alone. No two coordinates differ by more than width and
 * height; all are multiples of unit, a power of two, or 0 for want of one. */
void mw__grow_prepare(mw_growth *g, uint32_t point_count, double width, double height, double unit);

/* Begin with the triangle of three vertices that do not lie on one line: four facets, from number
 * facet_count on. */
void mw__grow_begin(mw_growth *g, const uint32_t first[3]);

/* Insert a point. Returns its number, or that of the vertex with the same coordinates. */
uint32_t mw__grow(mw_growth *g, uint32_t point);

#endif
