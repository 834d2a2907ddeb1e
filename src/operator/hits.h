/* hits.h - places in triangles, of a mesh or of a surface. Private. */
#ifndef MW_SRC_OPERATOR_HITS_H
#define MW_SRC_OPERATOR_HITS_H

#include "mesh/mesh.h"
#include "surface/surface.h"

#include <meshwalk/operator.h>

/* Places, and what they lie in: a mesh, or else a surface. */
typedef struct mw_placed_hits {
    const mw_mesh *mesh; /* NULL: they lie in the surface */
    const mw_surface *surface;
    mw_hits hits;
} mw_placed_hits;

static MW_INLINE uint32_t mw__hit_triangle(const mw_hits *hits, size_t i)
{
    return *(const uint32_t *)(const void *)((const char *)hits->triangle + i * hits->stride);
}

static MW_INLINE const double *mw__hit_weights(const mw_hits *hits, size_t i)
{
    return (const double *)(const void *)((const char *)hits->weight + i * hits->stride);
}

static MW_INLINE uint32_t mw__placed_triangle_count(const mw_placed_hits *p)
{
    return p->mesh ? mw_mesh_triangle_count(p->mesh) : p->surface->tri_count;
}

static MW_INLINE uint32_t mw__placed_vertex_count(const mw_placed_hits *p)
{
    return p->mesh ? mw_mesh_vertex_count(p->mesh) : p->surface->point_count;
}

/* Where the triangle is in memory. */
static MW_INLINE uint32_t mw__placed_slot(const mw_placed_hits *p, uint32_t triangle)
{
    return p->mesh ? mw__triangle_slot(p->mesh, triangle) : triangle;
}

static MW_INLINE void mw__placed_vertices(const mw_placed_hits *p, uint32_t triangle,
                                          uint32_t vertices[3])
{
    if (p->mesh)
        mw_mesh_triangle(p->mesh, triangle, vertices);
    else
        mw_surface_triangle(p->surface, triangle, vertices);
}

#endif
