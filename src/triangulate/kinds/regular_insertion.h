/* regular_insertion.h - a regular triangulation that grows by one point at a time. Private. */
#ifndef MW_SRC_TRIANGULATE_KINDS_REGULAR_INSERTION_H
#define MW_SRC_TRIANGULATE_KINDS_REGULAR_INSERTION_H

#include "mesh/mesh.h"

/* Facets are triangles, and beyond each edge of the hull a ghost facet, one of whose vertices is
 * MW_NONE, the point at infinity. So every edge is linked. `user` of a facet: the point in whose
 * cavity it was met last, or FREED. */
typedef struct mw_regular {
    const mw_point *point;
    const double *weight;
    const uint32_t *number; /* of the points: of equal ones the lowest is a vertex */
    uint32_t point_count;
    mw_triangle *facet;
    uint32_t facet_count; /* slots in use, freed ones too */
    uint32_t *freed;      /* slots that can be used again */
    uint32_t freed_count;
    uint32_t *facet_at;           /* scratch, per vertex, the one at infinity last */
    uint32_t *cavity;             /* scratch: facets */
    struct mw_regular_edge *edge; /* scratch: round the cavity */
    uint32_t last;                /* where the next walk begins */
    uint64_t random, visited;
} mw_regular;

#define MW_REGULAR_FREED MW_NONE

/* Room for n points. False when out of memory; to be released in either case. */
bool mw__regular_create(mw_regular *r, const mw_point *point, const double *weight,
                        const uint32_t *number, uint32_t n);
void mw__regular_release(mw_regular *r);

/* The first triangle, of three points that turn left. */
void mw__regular_begin(mw_regular *r, uint32_t a, uint32_t b, uint32_t c);

/* Insert a point. It is hidden if its lifted point lies on or above the surface; of equal points
 * of equal weight the lowest is a vertex. Points that it hides go. */
void mw__regular_insert(mw_regular *r, uint32_t p);

static MW_INLINE bool mw__regular_is_triangle(const mw_triangle *facet)
{
    return facet->user != MW_REGULAR_FREED && facet->v[0] != MW_NONE && facet->v[1] != MW_NONE &&
           facet->v[2] != MW_NONE;
}

#endif
