/* surface.h - the records of a surface in space. Private. Triangles, edges and links are as in
 * mesh.h, but triangles are stored as the user gave them, in any orientation. */
#ifndef MW_SRC_SURFACE_SURFACE_H
#define MW_SRC_SURFACE_SURFACE_H

#include "surface/rwlock.h"
#include "base/job.h"
#include "mesh/mesh.h"

#include <meshwalk/surface.h>

struct mw_surface {
    double *point; /* x, y, z of each vertex */
    mw_triangle *tri;
    /* Of a welded surface: the representative of each vertex (coincident.h); else NULL. */
    uint32_t *coincident;
    uint32_t point_count, tri_count;
    /* Of these numbers, how many an editor has freed. */
    uint32_t freed_points, freed_triangles;
    uint64_t version;    /* each update adds one */
    uint64_t edit_count; /* each edit of an editor adds one */
    uint64_t shape;      /* each change of its triangles adds one */
    mw_rwlock *rwlock;   /* NULL: the caller must not run queries during updates */
    bool borrowed;       /* the points belong to the caller */
    bool tolerant;
    bool updating; /* between begin and end of an update; only the updating thread looks */
    bool edited;   /* it has an editor */
};

/* A triangle that an editor has freed: it names one vertex three times and has no links. `user`
 * then holds this bit, and a triangle that took its place, or MW_USER_MASK. */
#define MW_SURFACE_FREED MW_GHOST

static MW_INLINE bool mw__surface_is_freed(const mw_surface *surface, uint32_t triangle)
{
    return (surface->tri[triangle].user & MW_SURFACE_FREED) != 0;
}

static MW_INLINE const double *mw__surface_point(const mw_surface *surface, uint32_t vertex)
{
    return surface->point + 3 * (size_t)vertex;
}

/* Corner k of a triangle, 0 to 3: corner 3 is corner 0. */
static MW_INLINE const double *mw__surface_corner(const mw_surface *surface, uint32_t triangle,
                                                  uint32_t k)
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

/* Are a, b, c, all finite, collinear? Exact. */
bool mw__collinear3(const double a[3], const double b[3], const double c[3]);

/* Do triangle t and its neighbour at edge `edge` have the same orientation? In a welded surface,
 * coincident vertices are equal here. */
bool mw__surface_orientations_agree(const mw_surface *surface, uint32_t t, uint32_t edge);

/* A query stands between these two. It waits while an update runs. */
static MW_INLINE void mw__surface_read_lock(const mw_surface *surface)
{
    if (surface->rwlock) mw__rwlock_read_lock(surface->rwlock);
}
static MW_INLINE void mw__surface_read_unlock(const mw_surface *surface)
{
    if (surface->rwlock) mw__rwlock_read_unlock(surface->rwlock);
}

/* As mw_surface_create, as stages of the present part of the job. *out is not changed on failure.
 */
mw_status mw__surface_create(const mw_arrays *arrays, const mw_surface_options *options,
                             mw_job *job, mw_surface **out, mw_error *error);

/* As mw_surface_check_arrays, likewise; the check may hold something on failure. */
mw_status mw__surface_check(const mw_arrays *arrays, int weld, mw_job *job, mw_check *check,
                            mw_error *error);

#endif
