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

/* Fill in points, triangles without links, and the numbers of both. *parts is released with free(parts->first), also on
 * failure. MW_ERROR_INPUT names the first triangle that is unusable; MW_ERROR_MEMORY. */
mw_status mw__lay_out(mw_mesh *mesh, const mw_arrays *arrays, uint32_t threads, mw_parts *parts, mw_error *error);

#endif
