/**
 * @file remap.h
 * Conservative remapping: weights that carry cell values of a mesh to the cells of another mesh or
 * of a raster. The sum of value times area stays the same.
 *
 * The value of a target cell is the mean, over its area, of the source cells that it overlaps. So
 * the weight of a source cell is the area of the overlap divided by the area of the target cell.
 * Overlaps and the crossings of edges are decided exactly. Areas are rounded: each is off by at
 * most about 2^-45 of the smaller cell, nearly always by a few 2^-53. So for a source cell that the
 * target covers, its weights times the areas of their rows add up to its area, up to rounding.
 *
 * The cells of a mesh are its triangles or its faces, several triangles each. Values may also
 * belong to the vertices of the source and be linear between them. Then a weight is the integral of
 * the vertex's hat function over the target cell, divided by the area of that cell.
 *
 * Areas are those of the plane, in units of the coordinates. With `degrees` the coordinates are
 * longitudes and latitudes, and areas are those of the unit sphere, in steradians as in ESMF's
 * files; edges are straight in longitude and latitude. Longitudes that differ by whole turns are
 * the same: a mesh from 170 to 190 degrees meets a raster from -180 to 180 at both of its ends.
 * With `degrees`, the hat function of a vertex is weighted by the area of each common part as a
 * whole: sums are conserved, but the weights ignore how the cosine of the latitude varies within a
 * triangle.
 */
#ifndef MESHWALK_REMAP_H
#define MESHWALK_REMAP_H

#include <meshwalk/locate.h>
#include <meshwalk/operator.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A mesh and its cells. */
typedef struct mw_remap_mesh {
    const mw_locator *locator; /**< fills pockets and holes, of an embedding */
    const uint32_t *face;      /**< the cell of each triangle, from 0; NULL: triangles are cells */
    size_t face_count;         /**< number of cells, with `face` */
} mw_remap_mesh;

/** The pixels of a raster. Rows run east, columns run south. Pixel c of row r, both from 0, is cell
 * r * columns + c. */
typedef struct mw_remap_pixels {
    double west, north;   /**< outer corner of the first pixel */
    double width, height; /**< of a pixel, positive */
    uint32_t columns, rows;
} mw_remap_pixels;

/** Options of remapping. Zero-initialised options select the defaults. */
typedef struct mw_remap_options {
    uint32_t threads;            /**< number of threads; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    int vertices;                /**< 1: values belong to the vertices of the source */
    int degrees;                 /**< 1: coordinates are longitudes and latitudes */
    /** 1: a target cell gets the mean over its covered part, and the weights of a row add up to 1
     * ("fracarea"). 0: the mean over the whole cell; the weights add up to the covered fraction
     * ("dstarea"), and sums are conserved. */
    int covered;
    uint32_t reserved[4]; /**< must be zero */
} mw_remap_options;

/** Weights and areas. Release with mw_remap_release(). */
typedef struct mw_remap {
    mw_operator *weights;    /**< a row for each target cell, a column for each source value */
    double *source_area;     /**< of each column; of a vertex: the integral of its hat function */
    double *source_fraction; /**< the fraction of it that the target covers, 0 to 1 */
    double *target_area;     /**< of each row */
    double *target_fraction; /**< the fraction of it that the source covers, 0 to 1 */
    double source_sum;       /**< the area of the source */
    double common_sum;       /**< the area that both cover */
} mw_remap;

/**
 * Compute conservative weights from one mesh to another.
 *
 * @param source   the mesh with the values
 * @param target   the mesh whose cells receive values; may be the same
 * @param options  NULL selects the defaults
 * @param remap    receives weights and areas; empty on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also if nothing overlaps; MW_ERROR_ARGUMENT for NULL, a locator whose pockets and
 *         holes are open or whose mesh is not an embedding, or a cell number out of range;
 *         MW_ERROR_INPUT for latitudes beyond 90 degrees, longitudes beyond 720, longitudes that go
 *         round the sphere more than once, and a triangle whose longitudes differ by more than 180
 *         degrees (mw_seam_cut() cuts a mesh that crosses the meridian of 180); MW_ERROR_LIMIT for
 *         coordinates of 2^300 and more; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. The result is the same, bit for bit, for any number of threads. Time is proportional
 * to the number of triangles and of their common parts. Memory: 16 bytes a common part, and twice
 * that while the operator is made.
 */
MW_API mw_status mw_remap_to_mesh(const mw_remap_mesh *source, const mw_remap_mesh *target,
                                  const mw_remap_options *options, mw_remap *remap,
                                  mw_error *error);

/**
 * Compute conservative weights from a mesh to the pixels of a raster.
 *
 * @param source   the mesh with the values
 * @param target   the pixels
 * @param options  NULL selects the defaults
 * @param remap    receives weights and areas; empty on failure
 * @param error    NULL, or receives the message of a failure
 * @return as mw_remap_to_mesh(); MW_ERROR_ARGUMENT also for pixels without a size; MW_ERROR_LIMIT
 *         for 2^32 - 1 or more pixels, or pixels too small for their coordinates.
 *
 * Thread-safe. Time and memory: as mw_remap_to_mesh().
 */
MW_API mw_status mw_remap_to_pixels(const mw_remap_mesh *source, const mw_remap_pixels *target,
                                    const mw_remap_options *options, mw_remap *remap,
                                    mw_error *error);

/** Release weights and areas. Zero-initialised ones are allowed. */
MW_API void mw_remap_release(mw_remap *remap);

/**
 * A mesh of longitudes and latitudes, cut by mw_seam_cut() into pieces that lie in the plane.
 * Release with mw_seam_pieces_release().
 */
typedef struct mw_seam_pieces {
    double *points;      /**< x, y of each vertex, packed: those of the mesh, then new ones */
    uint32_t *triangles; /**< 3 vertices of each piece */
    uint32_t *faces;     /**< of each piece, the face of the mesh that it is a part of */
    size_t point_count, triangle_count;
    /** Turns values at the mesh's vertices into values at `points` (mw_operator_apply()): a column
     * for each vertex of the mesh, a row for each of `points`. */
    mw_operator *values;
    double west; /**< -180 or 0: longitudes of the pieces are from west to west + 360 */
} mw_seam_pieces;

/**
 * Decide whether a mesh of longitudes and latitudes must be cut by mw_seam_cut() before it is
 * remapped: whether a triangle has longitudes that differ by more than 180 degrees, or a pole as a
 * vertex.
 *
 * @param mesh  longitudes and latitudes, in degrees; vertex numbers of type uint32_t, not checked
 * @return 1 or 0; 0 if a coordinate is not finite.
 *
 * Thread-safe. O(n).
 */
MW_API int mw_seam_crosses(const mw_arrays *mesh);

/**
 * Cut a mesh of longitudes and latitudes where it crosses the meridian of 180 degrees, or that of 0
 * if no longitude is negative, and at the poles, so that it can be remapped with `degrees`.
 *
 * Edges are straight in longitude and latitude, and go the short way round. A triangle with a pole
 * as a vertex, or a face with a pole inside, reaches up to the latitude of the pole over all its
 * longitudes. The value of a field at the pole is the value of that vertex, or the mean of the
 * vertices round that face.
 *
 * @param mesh    longitudes from -180 to 180 or from 0 to 360, and latitudes; numbers of type
 *                uint32_t
 * @param faces   the face of each triangle; the triangles of a face follow each other. NULL: each
 *                triangle is a face
 * @param pieces  receives the pieces, an embedding if the mesh's triangles do not overlap with
 *                such edges; empty on failure
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or numbers of another type; MW_ERROR_INPUT for a
 *         vertex that does not exist or is not finite, and for longitudes out of range;
 *         MW_ERROR_LIMIT for more than 134 million vertices or triangles; MW_ERROR_MEMORY.
 *
 * Thread-safe. O(n); 40 bytes for each vertex beside the arrays.
 */
MW_API mw_status mw_seam_cut(const mw_arrays *mesh, const uint32_t *faces, mw_seam_pieces *pieces,
                             mw_error *error);

/** Release pieces. Zero-initialised ones are allowed. */
MW_API void mw_seam_pieces_release(mw_seam_pieces *pieces);

#ifdef __cplusplus
}
#endif
#endif
