/**
 * @file volume.h
 * Cut and fill: the volume between a surface over the plane and another one, or a plane.
 *
 * A surface is a mesh with a height at each vertex, linear on each triangle. Each triangle is
 * clipped by the triangles of the other mesh that it overlaps. Overlaps and the crossings of edges
 * are decided exactly. Areas and volumes are sums of doubles: each common part is off by at most
 * about 2^-45 of the smaller of its two triangles, nearly always by a few 2^-53.
 *
 * Places where only one of the two surfaces has a height add no volume; their area is reported.
 */
#ifndef MESHWALK_VOLUME_H
#define MESHWALK_VOLUME_H

#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Options of volumes. Zero-initialised options select the defaults. */
typedef struct mw_volume_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_volume_options;

/** Volumes and areas, in units of the coordinates and heights. Areas are those of the plane. */
typedef struct mw_volume_info {
    double cut;          /**< volume where the surface is above the other: to be cut off */
    double fill;         /**< volume where it is below, as a positive number: to be filled */
    double cut_area;     /**< area where the surface is above */
    double fill_area;    /**< area where it is below */
    double level_area;   /**< area of common parts of triangles where both are equal throughout */
    double area;         /**< area where both have a height: the sum of these three */
    double surface_only; /**< area where only the surface has a height */
    double other_only;   /**< area where only the other one has a height */
    uint64_t parts;      /**< common parts of triangles that were added */
} mw_volume_info;

/**
 * Compute the volume between a surface and another one.
 *
 * @param surface        a locator that fills pockets and holes, of an embedding
 * @param heights        the height of each vertex of its mesh; a triangle with one that is not
 *                       finite is not there
 * @param other          a locator of the other mesh, as `surface`; may be the same
 * @param other_heights  the height of each vertex of the other mesh
 * @param options        NULL selects the defaults
 * @param info           receives volumes and areas
 * @param error          NULL, or receives the message of a failure
 * @return MW_OK, also if the two have no area in common; MW_ERROR_ARGUMENT for NULL, a locator
 *         whose pockets and holes are open or whose mesh is not an embedding; MW_ERROR_LIMIT for
 *         coordinates of 2^300 and more; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. The result is the same, bit for bit, for any number of threads. Time is proportional
 * to the number of triangles and of their common parts if neighbours are near each other in memory.
 * Each thread takes 4 bytes for each triangle of the other mesh.
 */
MW_API mw_status mw_volume_between(const mw_locator *surface, const double *heights,
                                   const mw_locator *other, const double *other_heights,
                                   const mw_volume_options *options, mw_volume_info *info,
                                   mw_error *error);

/**
 * Compute the volume between a surface and a horizontal plane.
 *
 * @param surface  a locator of an embedding, as for mw_volume_between()
 * @param heights  the height of each vertex of its mesh; a triangle with one that is not finite is
 *                 not there
 * @param base     height of the plane
 * @param options  NULL selects the defaults
 * @param info     receives volumes and areas: `surface_only` and `other_only` are 0
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a base that is not finite, and locators as for
 *         mw_volume_between(); MW_ERROR_LIMIT, MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. The result is the same, bit for bit, for any number of threads. O(triangles).
 */
MW_API mw_status mw_volume_above(const mw_locator *surface, const double *heights, double base,
                                 const mw_volume_options *options, mw_volume_info *info,
                                 mw_error *error);

/** Areas of the part of a surface over a region, in units of the coordinates and heights. */
typedef struct mw_surface_area_info {
    double area;         /**< area of the plane that both the region and the surface cover */
    double surface_area; /**< area of the surface over it, slopes included */
    double region_area;  /**< area of the region */
    uint64_t parts;      /**< common parts of triangles that were added */
} mw_surface_area_info;

/**
 * Compute the area of a surface over a region of the plane, such as a parcel on a slope.
 *
 * @param surface  a locator of an embedding, as for mw_volume_between()
 * @param heights  the height of each vertex of its mesh; a triangle with one that is not finite is
 *                 not there
 * @param region   a locator of a mesh that covers the region, such as a polygon triangulated by
 *                 mw_constrained_delaunay() with MW_KEEP_INSIDE
 * @param options  NULL selects the defaults
 * @param info     receives areas
 * @param error    NULL, or receives the message of a failure
 * @return as mw_volume_between().
 *
 * Thread-safe. The result is the same, bit for bit, for any number of threads. Time is proportional
 * to the triangles of the region and those of the surface over it.
 */
MW_API mw_status mw_surface_area(const mw_locator *surface, const double *heights,
                                 const mw_locator *region, const mw_volume_options *options,
                                 mw_surface_area_info *info, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
