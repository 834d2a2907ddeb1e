/* outline.h - the outline of the triangles with an area: the edges where the plane does not
 * continue. Private.
 *
 * An outline edge is an edge of a triangle with an area whose neighbour there does not continue the
 * plane: the neighbour is missing, flat, or folded back. Of a fold only the edge of the lower
 * triangle is listed; it counts double. A node is a point of the outline: coincident vertices are
 * one node. */
#ifndef MW_SRC_TILING_OUTLINE_H
#define MW_SRC_TILING_OUTLINE_H

#include "mesh/mesh.h"

typedef struct mw_outline {
    const mw_mesh *mesh;
    uint8_t *flat;  /* per triangle: it has no area or is unusable; NULL: there is none */
    uint32_t *half; /* the outline edges, 4 * triangle + edge, in increasing order */
    uint32_t half_count;
    uint32_t *node; /* node of a vertex; MW_NONE: neither on the outline nor in a flat triangle */
    /* Of the outline; nodes that only flat triangles have get higher numbers. */
    uint32_t node_count;
    mw_point *point;  /* per node of the outline */
    uint32_t *vertex; /* per node of the outline: its vertex with the lowest number */
    uint64_t *bridge; /* the edges of flat triangles, as pairs of nodes, sorted */
    size_t bridge_count;
} mw_outline;

/* Returns false when out of memory. Release in either case. */
bool mw__outline_create(mw_outline *outline, const mw_mesh *mesh);
void mw__outline_release(mw_outline *outline);

static MW_INLINE bool mw__is_flat(const mw_outline *outline, uint32_t triangle)
{
    return outline->flat && outline->flat[triangle];
}

/* Is the half-edge one side of a fold? Then its neighbour runs along the edge in the same
 * direction. */
static MW_INLINE bool mw__is_fold(const mw_outline *outline, uint32_t half)
{
    const mw_triangle *t = &outline->mesh->tri[mw__link_triangle(half)];
    uint32_t k = mw__link_edge(half), link = t->link[k];
    if (link == MW_NONE || mw__is_flat(outline, mw__link_triangle(link))) return false;
    return outline->mesh->tri[mw__link_triangle(link)].v[mw__link_edge(link)] == t->v[k];
}

/* Does a flat triangle lie at outline edge `half`? It may join the edge to vertices inside it. */
bool mw__is_bridged(const mw_outline *outline, uint32_t half);

/* The nodes that an outline edge runs from and to. */
static MW_INLINE uint32_t mw__outline_from(const mw_outline *outline, uint32_t half)
{
    return outline->node[outline->mesh->tri[mw__link_triangle(half)].v[mw__link_edge(half)]];
}

static MW_INLINE uint32_t mw__outline_to(const mw_outline *outline, uint32_t half)
{
    return outline->node[outline->mesh->tri[mw__link_triangle(half)].v[mw__link_edge(half) + 1]];
}

/* Sorts outline edges in the order of the user's triangles. */
static MW_INLINE uint64_t mw__outline_rank(const mw_outline *outline, uint32_t edge)
{
    uint32_t half = outline->half[edge];
    return (uint64_t)mw__triangle_number(outline->mesh, mw__link_triangle(half)) << 2 |
           mw__link_edge(half);
}

#endif
