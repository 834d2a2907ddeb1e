/* surface.h - the records of a surface in space. Private. Triangles, edges and links as in mesh.h; but triangles are
 * stored as the user gave them, whatever their orientation. */
#ifndef MW_SRC_SURFACE_H
#define MW_SRC_SURFACE_H

#include "mesh/gate.h"
#include "mesh/mesh.h"

#include <meshwalk/surface.h>

struct mw_surface {
    double *point; /* x, y, z of each vertex */
    mw_triangle *tri;
    uint32_t *place; /* of a welded surface: the lowest vertex with the same coordinates, for each; else NULL */
    uint32_t point_count, tri_count;
    uint64_t version; /* one more with each update */
    mw_gate *gate;    /* NULL: the caller sees to it that no query runs during an update */
    bool borrowed;    /* the points are the caller's */
    bool tolerant;
};

static MW_INLINE const double *mw__surface_point(const mw_surface *surface, uint32_t vertex)
{
    return surface->point + 3 * (size_t)vertex;
}

/* Corner k of a triangle, 0 to 3: corner 3 is corner 0. */
static MW_INLINE const double *mw__surface_corner(const mw_surface *surface, uint32_t triangle, uint32_t k)
{
    return mw__surface_point(surface, surface->tri[triangle].v[k]);
}

static MW_INLINE bool mw__is_finite3(const double p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

/* Are all three corners of a triangle finite? */
static MW_INLINE bool mw__corners_finite(const mw_surface *surface, uint32_t triangle)
{
    return mw__is_finite3(mw__surface_corner(surface, triangle, 0)) &&
           mw__is_finite3(mw__surface_corner(surface, triangle, 1)) &&
           mw__is_finite3(mw__surface_corner(surface, triangle, 2));
}

/* Do a, b, c (finite) lie on one line? Exact. */
bool mw__collinear3(const double a[3], const double b[3], const double c[3]);

/* Have two triangles the same orientation along the edge that link joins to edge `edge` of triangle `t`? In a welded
 * surface the ends are compared by place. */
bool mw__surface_agrees(const mw_surface *surface, uint32_t t, uint32_t edge);

/* Around every query: it waits while an update is on its way. */
static MW_INLINE void mw__surface_enter(const mw_surface *surface)
{
    if (surface->gate) mw__gate_enter(surface->gate);
}
static MW_INLINE void mw__surface_leave(const mw_surface *surface)
{
    if (surface->gate) mw__gate_leave(surface->gate);
}

#endif
