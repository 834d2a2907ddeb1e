#include "cli/stream/extent_remark.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"

#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#define FOOT 0.3048
#define FEW 10 /* with at least so many points the remark is made even without a likely reason */

void extent_add(extent_box *e, const double *points, size_t count, size_t stride)
{
    for (size_t i = 0; i < count; i++) {
        const double *p = points + i * stride;
        if (!isfinite(p[0]) || !isfinite(p[1])) continue;
        for (int k = 0; k < 2; k++) {
            if (e->count == 0 || p[k] < e->low[k]) e->low[k] = p[k];
            if (e->count == 0 || p[k] > e->high[k]) e->high[k] = p[k];
        }
        e->count++;
    }
}

static bool extents_meet(const extent_box *a, const extent_box *b)
{
    for (int k = 0; k < 2; k++)
        if (a->high[k] < b->low[k] || b->high[k] < a->low[k]) return false;
    return true;
}

/* The extent with its coordinates exchanged. */
static extent_box extent_exchanged(const extent_box *e)
{
    return (extent_box){
        .low = {e->low[1], e->low[0]}, .high = {e->high[1], e->high[0]}, .count = e->count};
}

static extent_box extent_scaled(const extent_box *e, double factor)
{
    extent_box scaled = *e;
    for (int k = 0; k < 2; k++) {
        scaled.low[k] *= factor;
        scaled.high[k] *= factor;
    }
    return scaled;
}

static extent_box extent_shifted(const extent_box *e, double x)
{
    extent_box shifted = *e;
    shifted.low[0] += x;
    shifted.high[0] += x;
    return shifted;
}

/* Could these be longitudes and latitudes in degrees? */
static bool extent_is_lonlat(const extent_box *e)
{
    return e->low[0] >= -360 && e->high[0] <= 360 && e->low[1] >= -90 && e->high[1] <= 90;
}

/* A likely reason; NULL if none is found. */
static const char *extent_suspicion(const extent_box *mesh, const extent_box *points)
{
    extent_box exchanged = extent_exchanged(points);
    extent_box feet = extent_scaled(points, FOOT), metres = extent_scaled(points, 1 / FOOT);
    extent_box east = extent_shifted(points, 360), west = extent_shifted(points, -360);
    bool degrees = extent_is_lonlat(points), mesh_degrees = extent_is_lonlat(mesh);
    if (extents_meet(points, mesh)) return NULL;
    if (degrees && !mesh_degrees) return "the points look like degrees, the mesh does not";
    if (mesh_degrees && !degrees && !extent_is_lonlat(&exchanged))
        return "the mesh looks like degrees, the points do not";
    /* ranges of small numbers overlap by chance */
    if (degrees && mesh_degrees && points->count < FEW) return NULL;
    if (extents_meet(&exchanged, mesh))
        return "with x and y exchanged they would meet: --columns says which is which";
    if (degrees && extents_meet(&east, mesh)) return "with 360 degrees more in x they would meet";
    if (degrees && extents_meet(&west, mesh)) return "with 360 degrees less in x they would meet";
    if (extents_meet(&feet, mesh))
        return "they would meet if the points were in feet and the mesh in metres";
    if (extents_meet(&metres, mesh))
        return "they would meet if the points were in metres and the mesh in feet";
    return NULL;
}

/* Write "x from 1 to 2, y from 3 to 4". */
static const char *extent_write(const extent_box *e, char words[120])
{
    snprintf(words, 120, "x from %.10g to %.10g, y from %.10g to %.10g", e->low[0], e->high[0],
             e->low[1], e->high[1]);
    return words;
}

void extent_remark(const char *mesh_path, const extent_box *mesh, const char *points_path,
                   const extent_box *points, uint64_t found)
{
    if (points->count == 0 || mesh->count == 0 || 2 * found >= points->count) return;
    const char *suspicion = extent_suspicion(mesh, points);
    if (!suspicion && points->count < FEW) return;
    char of_mesh[120], of_points[120];
    complain("%s: remark: %" PRIu64 " of %" PRIu64
             " points lie outside of %s: the points have %s; the mesh has %s%s%s",
             files_is_standard(points_path) ? "standard input" : points_path, points->count - found,
             points->count, files_is_standard(mesh_path) ? "standard input" : mesh_path,
             extent_write(points, of_points), extent_write(mesh, of_mesh), suspicion ? "; " : "",
             suspicion ? suspicion : "");
}

static bool triangle_is_wide(const mw_mesh *mesh, uint32_t triangle)
{
    uint32_t corner[3];
    double x[3][2];
    mw_mesh_triangle(mesh, triangle, corner);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, corner[k], x[k]);
    return fabs(x[0][0] - x[1][0]) > 180 || fabs(x[1][0] - x[2][0]) > 180 ||
           fabs(x[2][0] - x[0][0]) > 180;
}

void extent_warn_of_seam(const char *mesh_path, const extent_box *extent, const mw_mesh *mesh)
{
    uint32_t wide = 0, count = mw_mesh_triangle_count(mesh);
    if (extent->count == 0 || !extent_is_lonlat(extent) || extent->high[0] - extent->low[0] <= 180)
        return;
    for (uint32_t t = 0; t < count; t++) wide += triangle_is_wide(mesh, t);
    if (wide == 0 || wide > count / 10) return;
    complain("%s: warning: %" PRIu32
             " of its triangles are wider than 180 degrees: in the plane a mesh cannot cross the "
             "meridian of 180 degrees; 'meshwalk star --lonlat' locates on the sphere, and with "
             "--open if the mesh does not cover all of it",
             mesh_path, wide);
}
