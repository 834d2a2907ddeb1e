/* outline.h - the outline of the triangles that have an area: where they end, or do not go on as a plane does. Private.
 *
 * An outline edge is an edge of a triangle with an area whose mesh neighbour there does not continue the plane: there
 * is none, or a flat one, or one folded back. Of a fold only the lower triangle's edge is listed, and counts double.
 * The place of a vertex is its pair of coordinates: vertices at one place are one vertex of the outline. */
#ifndef MW_SRC_OUTLINE_H
#define MW_SRC_OUTLINE_H

#include "mesh/mesh.h"

typedef struct mw_outline {
    const mw_mesh *mesh;
    uint8_t *flat;        /* per triangle: it has no area, or is not usable; NULL if none is                  */
    uint32_t *half;       /* the edges, 4 * triangle + edge, in increasing order                              */
    uint32_t half_count;  /*                                                                                  */
    uint32_t *place;      /* per vertex: number of its place, MW_NONE if neither outline nor a flat one has it */
    uint32_t place_count; /* of the outline; places that only flat triangles have are numbered above          */
    mw_point *point;      /* per place of the outline                                                         */
    uint32_t *vertex;     /* per place of the outline: of the vertices there the user's lowest                 */
    uint64_t *bridge;     /* the edges of flat triangles, as pairs of places, sorted                          */
    size_t bridge_count;
} mw_outline;

/* Returns false when out of memory. Release in either case. */
bool mw__outline_create(mw_outline *outline, const mw_mesh *mesh);
void mw__outline_release(mw_outline *outline);

static MW_INLINE bool mw__is_flat(const mw_outline *outline, uint32_t triangle)
{
    return outline->flat && outline->flat[triangle];
}

/* Is the half-edge the side of a fold? Then the triangle beyond runs through the edge in the same direction. */
static MW_INLINE bool mw__is_fold(const mw_outline *outline, uint32_t half)
{
    const mw_triangle *t = &outline->mesh->tri[mw__link_triangle(half)];
    uint32_t k = mw__link_edge(half), link = t->link[k];
    if (link == MW_NONE || mw__is_flat(outline, mw__link_triangle(link))) return false;
    return outline->mesh->tri[mw__link_triangle(link)].v[mw__link_edge(link)] == t->v[k];
}

/* Does a flat triangle lie at outline edge `half`? It may join the edge to vertices inside it. */
bool mw__is_bridged(const mw_outline *outline, uint32_t half);

/* The places that an outline edge runs from and to. */
static MW_INLINE uint32_t mw__outline_from(const mw_outline *outline, uint32_t half)
{
    return outline->place[outline->mesh->tri[mw__link_triangle(half)].v[mw__link_edge(half)]];
}

static MW_INLINE uint32_t mw__outline_to(const mw_outline *outline, uint32_t half)
{
    return outline->place[outline->mesh->tri[mw__link_triangle(half)].v[mw__link_edge(half) + 1]];
}

/* Outline edges in the order of the user's triangles. */
static MW_INLINE uint64_t mw__outline_rank(const mw_outline *outline, uint32_t edge)
{
    uint32_t half = outline->half[edge];
    return (uint64_t)mw__users_triangle(outline->mesh, mw__link_triangle(half)) << 2 | mw__link_edge(half);
}

#endif
