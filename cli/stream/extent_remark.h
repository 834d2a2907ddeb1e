/* extent_remark.h - compares where points lie with where the mesh lies, if most of them missed it.
 */
#ifndef MW_CLI_STREAM_EXTENT_REMARK_H
#define MW_CLI_STREAM_EXTENT_REMARK_H

#include <meshwalk/meshwalk.h>
#include <stddef.h>
#include <stdint.h>

/* The box round points, and how many there are that are finite. Zero is empty. */
typedef struct extent_box {
    double low[2], high[2];
    uint64_t count;
} extent_box;

/* Add points in the plane: x and y at points[i * stride]. Those that are not finite are passed
 * over. */
void extent_add(extent_box *e, const double *points, size_t count, size_t stride);

/* Tell on standard error that most points lie outside of the mesh, with both extents, and what the
 * reason may be: degrees, feet, exchanged coordinates, longitudes counted from another meridian.
 * Says nothing if half of the points were found, or if there are only a few and no reason is in
 * sight. `found` is how many points lie in the mesh. */
void extent_remark(const char *mesh_path, const extent_box *mesh, const char *points_path,
                   const extent_box *points, uint64_t found);

/* Warn of a mesh of longitudes that crosses the meridian of 180 degrees: one of its edges is wider
 * than 180. */
void extent_warn_of_seam(const char *mesh_path, const extent_box *extent, const mw_mesh *mesh);

#endif
