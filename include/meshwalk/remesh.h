/**
 * @file remesh.h
 * Spherical remeshing: sample a star-shaped polyhedron where rays from its centre meet it, and
 * measure how far two surfaces are apart.
 *
 *     mw_icosphere_size(8, &vertices, &triangles, NULL);
 *     (allocate points, corners and locations)
 *     mw_star_remesh(star, 8, NULL, points, corners, locations, &error);
 *
 * Values at the vertices of the polyhedron follow by mw_operator_create_on_surface(). To sample it
 * on another mesh, give that mesh's vertices to mw_star_project_batch() (star.h) and keep its
 * triangles.
 */
#ifndef MESHWALK_REMESH_H
#define MESHWALK_REMESH_H

#include <meshwalk/probe.h>
#include <meshwalk/star.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The most subdivisions of an icosahedron: 335,544,320 triangles. */
#define MW_ICOSPHERE_MAX_LEVEL 12

/**
 * Tell the size of an icosphere: an icosahedron whose triangles were cut into four, `level` times.
 *
 * @param level      0 to MW_ICOSPHERE_MAX_LEVEL
 * @param vertices   receives 10 * 4^level + 2
 * @param triangles  receives 20 * 4^level
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or a level out of range.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_icosphere_size(uint32_t level, uint32_t *vertices, uint32_t *triangles,
                                   mw_error *error);

/** Options of the functions below. Zero-initialised options select the defaults. */
typedef struct mw_remesh_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[5];        /**< must be zero */
} mw_remesh_options;

/**
 * Make an icosphere: points on the unit sphere, and triangles.
 *
 * A new vertex lies in the direction of the middle of its edge. Levels nest: the vertices of a
 * level are the first ones of the next, in the same order, and triangle t becomes triangles 4 t to
 * 4 t + 3, the last of which is the middle one. Each point has the length 1 up to rounding. The
 * same numbers come out on every machine and for every number of threads.
 *
 * @param level      0 to MW_ICOSPHERE_MAX_LEVEL
 * @param options    NULL selects the defaults
 * @param points     receives x, y, z of each vertex (mw_icosphere_size() tells how many)
 * @param triangles  receives three vertices of each triangle, counter-clockwise seen from outside
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or a level out of range; MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe. O(vertices). Allocates 36 bytes for each triangle of the level before.
 */
MW_API mw_status mw_icosphere_create(uint32_t level, const mw_remesh_options *options,
                                     double *points, uint32_t *triangles, mw_error *error);

/**
 * Sample a star-shaped polyhedron on an icosphere about its centre.
 *
 * Vertex i is the point at which the ray from the centre through c + r * p meets the polyhedron: c
 * is the centre, p point i of mw_icosphere_create(), and r a power of two, at least 1 and at least
 * half of the centre's largest coordinate. The sum c + r * p is rounded, and defines the ray
 * exactly; if the centre is the origin, it is p. The meeting point is exact, each coordinate
 * rounded once (mw_star_project()). So the vertices lie on the polyhedron up to that rounding;
 * edges and corners of the polyhedron between the vertices are cut off.
 *
 * @param star       the star
 * @param level      0 to MW_ICOSPHERE_MAX_LEVEL
 * @param options    NULL selects the defaults
 * @param points     receives x, y, z of each vertex (mw_icosphere_size() tells how many)
 * @param triangles  NULL, or receives three vertices of each triangle, counter-clockwise seen from
 *                   outside
 * @param locations  NULL, or receives the facet and the weights of each vertex
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a level out of range, or a star that is not up to
 *         date; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. The same bits for any number of threads. O(vertices) typically; allocates 24 bytes
 * for each vertex, and 48 without locations. On a shared surface an update may come between two
 * vertices.
 */
MW_API mw_status mw_star_remesh(const mw_star *star, uint32_t level,
                                const mw_remesh_options *options, double *points,
                                uint32_t *triangles, mw_location *locations, mw_error *error);

/** How far the points of one surface are from another surface. */
typedef struct mw_deviation {
    /** The largest distance of a sample. Between samples a point may be farther. */
    double largest;
    /** No point of the surface is farther than this, up to rounding: see mw_surface_deviation(). */
    double at_most;
    double mean;               /**< by area, of the samples */
    double point[3];           /**< the sample with the largest distance */
    double nearest[3];         /**< the point of the other surface nearest to it */
    uint32_t triangle;         /**< the triangle of the surface that has this sample */
    uint32_t nearest_triangle; /**< the triangle of the other surface */
    uint64_t samples;          /**< how many distances were measured */
    double area;               /**< of the surface, rounded */
} mw_deviation;

/**
 * Measure how far a surface is from another one, by the nearest points of samples [Cignoni,
 * Rocchini, Scopigno 1998].
 *
 * Each triangle is cut into f * f equal pieces. f is chosen so that no piece is much larger than
 * the mean triangle of the other surface, and is at most 64. Samples are the corners of the pieces
 * and their centroids, rounded. The mean weights each piece by its area; in a piece the centroid's
 * distance counts three quarters, and each corner's a twelfth. That is exact where the distance is
 * a polynomial of degree two.
 *
 * `at_most` is the largest bound of a piece. A piece has two bounds, and the smaller one counts.
 * The first: the distance from one triangle is a convex function, so no point of the piece is
 * farther from the triangle nearest to the centroid than the farthest corner. The second: no point
 * is farther than the largest distance of a corner, plus the way to the nearest corner.
 *
 * This is one direction only: call it once more with the surfaces exchanged. The larger of the two
 * `largest` is a lower bound of the Hausdorff distance, the larger of the two `at_most` an upper
 * bound, up to rounding.
 *
 * @param surface  the surface with the samples; its vertices in use must be finite
 * @param other    a prober with boxes of the other surface
 * @param options  NULL selects the defaults
 * @param out      receives the result
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a prober without boxes, or boxes that are not up to
 *         date; MW_ERROR_INPUT if the surface has no triangle or a vertex is not finite, or the
 *         other surface has no triangle with an area; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. The same bits for any number of threads. O((n + m) log m) typically.
 */
MW_API mw_status mw_surface_deviation(const mw_surface *surface, const mw_prober *other,
                                      const mw_remesh_options *options, mw_deviation *out,
                                      mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
