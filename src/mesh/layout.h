/* layout.h - a mesh in memory along a Hilbert curve, whatever the order of the caller's arrays. Private.
 *
 * Walks and connectivity go from a triangle to its neighbours. Where these lie far apart in memory each step costs a
 * cache miss, so vertices are numbered anew along the curve, and triangles by their lowest vertex. Users never see it:
 * the mesh keeps the numbers of both. */
#ifndef MW_SRC_LAYOUT_H
#define MW_SRC_LAYOUT_H

#include "mesh/mesh.h"

/* Ranges of 2^shift vertices, and the triangles whose lowest vertex is in each: of part p they are first[p] to before
 * first[p + 1]. */
struct mw_parts {
    uint32_t shift, count;
    uint32_t *first;
};

static MW_INLINE uint32_t mw__part_of(const mw_parts *parts, uint32_t vertex)
{
    return (uint32_t)((uint64_t)vertex >> parts->shift);
}

static MW_INLINE uint32_t mw__part_begin(const mw_parts *parts, uint32_t p)
{
    return (uint32_t)((uint64_t)p << parts->shift);
}

static MW_INLINE uint32_t mw__part_size(const mw_parts *parts, uint32_t p, uint32_t vertex_count)
{
    uint64_t rest = vertex_count - (uint64_t)mw__part_begin(parts, p), size = UINT64_C(1) << parts->shift;
    return (uint32_t)(rest < size ? rest : size);
}

/* Are the vertices of the arrays' triangles far apart in memory, or triangles that follow each other? Looks at a few. */
bool mw__is_scattered(const mw_arrays *arrays);

/* Are points that follow each other far apart in the plane? Looks at a few. */
bool mw__are_scattered(const mw_point *points, uint32_t n);

/* Copy the points into a mesh that has none yet, the triangles of which name their places by `order`: place i is that of
 * point order[i]. NULL: they are the same; else the mesh owns it from here on. Returns false when out of memory. */
bool mw__give_points(mw_mesh *mesh, const mw_point *given, uint32_t *order, uint32_t threads);

/* Lay out the vertices of a mesh whose triangles are in good order, if they are scattered. Returns false when out of
 * memory; then the mesh can only be destroyed. */
bool mw__lay_out_vertices(mw_mesh *mesh, uint32_t threads);

/* Make points, triangles without links, and the numbers of both. *parts is released with free(parts->first), also on
 * failure. MW_ERROR_INPUT names the first triangle that is unusable; MW_ERROR_MEMORY. */
mw_status mw__lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_parts *parts, mw_error *error);

#endif
