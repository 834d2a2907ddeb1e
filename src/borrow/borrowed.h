/* borrowed.h - the caller's arrays as a walk reads them. Private.
 *
 *            S             Numbers are never trusted: what names no triangle is no neighbour, and a
 *           / \            triangle that names no vertex cannot be read. A walk names the corners
 *          /   \           of a triangle A, B and S, whatever the orientation of the arrays: it
 *         /  *q \          came over the edge AB, and q lies strictly to the left of A -> B, as the
 *                          triangle does. So a clockwise triangle costs it nothing. */
#ifndef MW_SRC_BORROW_BORROWED_H
#define MW_SRC_BORROW_BORROWED_H

#include "base/job.h"
#include "mesh/mesh.h"

#include <meshwalk/borrow.h>

struct mw_borrowed {
    const double *points;
    const void *triangles, *neighbours;
    size_t stride;
    uint32_t point_count, tri_count;
    uint32_t turn; /* neighbour (k + turn) mod 3 is opposite to vertex k */
    bool wide;     /* numbers have 64 bits */
    bool checked, convex;
    uint32_t flat_count, reversed_count; /* if checked */
    double low[2], high[2];              /* extent of a few triangles: a guide only */
};

/* A triangle of the caller: the numbers and positions of its corners, as given. */
typedef struct mw_borrowed_tile {
    uint32_t v[3];
    mw_point p[3];
} mw_borrowed_tile;

/* A number of the caller; one that does not fit, as a negative one, is out of range of any mesh. */
static MW_INLINE uint32_t mw__borrowed_number(const mw_borrowed *mesh, const void *array, size_t i)
{
    if (MW_LIKELY(!mesh->wide)) return ((const uint32_t *)array)[i];
    uint64_t number = ((const uint64_t *)array)[i];
    return number < MW_NONE ? (uint32_t)number : MW_NONE;
}

static MW_INLINE mw_point mw__borrowed_point(const mw_borrowed *mesh, uint32_t v)
{
    const double *p = mesh->points + v * mesh->stride;
    return (mw_point){p[0], p[1]};
}

/* False where a corner is no vertex. */
static MW_INLINE bool mw__borrowed_read(const mw_borrowed *mesh, uint32_t t, mw_borrowed_tile *tile)
{
    for (uint32_t k = 0; k < 3; k++) {
        tile->v[k] = mw__borrowed_number(mesh, mesh->triangles, 3 * (size_t)t + k);
        if (MW_UNLIKELY(tile->v[k] >= mesh->point_count)) return false;
        tile->p[k] = mw__borrowed_point(mesh, tile->v[k]);
    }
    return true;
}

/* The triangle across the edge opposite to corner k, or MW_NONE. */
static MW_INLINE uint32_t mw__borrowed_across(const mw_borrowed *mesh, uint32_t t, uint32_t k)
{
    uint32_t at = mesh->turn ? mw__next(k) : k;
    uint32_t other = mw__borrowed_number(mesh, mesh->neighbours, 3 * (size_t)t + at);
    return MW_LIKELY(other < mesh->tri_count) ? other : MW_NONE;
}

/* The corner of a tile that is neither vertex a nor b; 3 unless the two others are a and b. */
static MW_INLINE uint32_t mw__borrowed_apex(const mw_borrowed_tile *tile, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t c = tile->v[mw__next(k)], d = tile->v[mw__prev(k)];
        if ((c == a && d == b) || (c == b && d == a)) return k;
    }
    return 3;
}

static MW_INLINE bool mw__borrowed_is_finite(const mw_borrowed_tile *tile)
{
    return mw__is_finite(tile->p[0]) && mw__is_finite(tile->p[1]) && mw__is_finite(tile->p[2]);
}

/* Look at every triangle: MW_ERROR_INPUT names the first one that breaks a promise. Finds
 * counts, and whether the mesh is convex. A part of the job. */
mw_status mw__borrowed_check(mw_borrowed *mesh, mw_job *job, mw_error *error);

/* Do the triangles fill their convex hull? For a mesh in which the links of all triangles are
 * right, and that has `borders` edges without a neighbour, one of them that of triangle `first`,
 * which has an area, opposite to its corner `k`. */
bool mw__borrowed_is_convex(const mw_borrowed *mesh, uint32_t first, uint32_t k, uint32_t borders);

#endif
