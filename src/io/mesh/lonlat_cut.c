#include "io/mesh/lonlat_cut.h"

#include "io/mesh/face_cut.h"

#include <math.h>

enum { MOST_CORNERS = 64 }; /* of a face that is cut in another way than in the plane */

/* A face in coordinates of its own. Its corners are numbered in the order of their vertices, as
 * cuts depend on that. */
typedef struct lonlat_face {
    const double *points;
    const uint32_t *vertices;
    size_t count;
    double local[3 * MOST_CORNERS];
    uint32_t corners[MOST_CORNERS];
} lonlat_face;

static const double *lonlat_point(const lonlat_face *f, size_t i)
{
    return f->points + 3 * (size_t)f->vertices[i];
}

static double *lonlat_local(lonlat_face *f, size_t i)
{
    return f->local + 3 * (size_t)f->corners[i];
}

static bool lonlat_is_pole(const double *p)
{
    return fabs(p[1]) >= 90;
}

/* The least and the greatest longitude; corners at poles have none. */
static void lonlat_extent(const lonlat_face *f, double extent[2])
{
    extent[0] = INFINITY;
    extent[1] = -INFINITY;
    for (size_t i = 0; i < f->count; i++) {
        const double *p = lonlat_point(f, i);
        if (lonlat_is_pole(p)) continue;
        extent[0] = fmin(extent[0], p[0]);
        extent[1] = fmax(extent[1], p[0]);
    }
}

static void lonlat_number(lonlat_face *f)
{
    for (size_t i = 0; i < f->count; i++) {
        uint32_t rank = 0;
        for (size_t k = 0; k < f->count; k++)
            rank += f->vertices[k] < f->vertices[i] || (f->vertices[k] == f->vertices[i] && k < i);
        f->corners[i] = rank;
    }
}

/* All longitudes on one side of the seam; a pole above the middle of the others. Returns false if
 * the face goes round a pole. */
static bool lonlat_unwrap(lonlat_face *f, const double extent[2])
{
    const bool wide = extent[1] - extent[0] > 180;
    double sum = 0, least = INFINITY, greatest = -INFINITY;
    size_t poles = 0;
    for (size_t i = 0; i < f->count; i++) {
        const double *p = lonlat_point(f, i);
        double *q = lonlat_local(f, i);
        q[0] = wide && p[0] < extent[1] - 180 ? p[0] + 360 : p[0];
        q[1] = p[1];
        q[2] = 0;
        if (lonlat_is_pole(p)) {
            poles++;
            continue;
        }
        sum += q[0];
        least = fmin(least, q[0]);
        greatest = fmax(greatest, q[0]);
    }
    for (size_t i = 0; i < f->count && poles < f->count; i++)
        if (lonlat_is_pole(lonlat_point(f, i)))
            lonlat_local(f, i)[0] = sum / (double)(f->count - poles);
    return !(greatest - least > 180);
}

static void lonlat_direction(const double *p, double u[3])
{
    const double degree = atan(1) / 45, lon = p[0] * degree, lat = p[1] * degree;
    u[0] = cos(lat) * cos(lon);
    u[1] = cos(lat) * sin(lon);
    u[2] = sin(lat);
}

/* Seen from the centre of the globe, on the plane that touches it in the middle of the face.
 * Returns false if the face is as wide as a hemisphere. */
static bool lonlat_project(lonlat_face *f)
{
    double m[3] = {0}, u[3];
    for (size_t i = 0; i < f->count; i++) {
        lonlat_direction(lonlat_point(f, i), u);
        for (int k = 0; k < 3; k++) m[k] += u[k];
    }
    const double length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), r = hypot(m[0], m[1]);
    const double east[3] = {r > 0 ? -m[1] / r : 0, r > 0 ? m[0] / r : 1, 0};
    if (!(length > 0)) return false;
    for (int k = 0; k < 3; k++) m[k] /= length;
    const double north[3] = {m[1] * east[2] - m[2] * east[1], m[2] * east[0] - m[0] * east[2],
                             m[0] * east[1] - m[1] * east[0]};
    for (size_t i = 0; i < f->count; i++) {
        double *q = lonlat_local(f, i);
        lonlat_direction(lonlat_point(f, i), u);
        const double depth = u[0] * m[0] + u[1] * m[1] + u[2] * m[2];
        if (!(depth > 1e-3)) return false;
        q[0] = (u[0] * east[0] + u[1] * east[1] + u[2] * east[2]) / depth;
        q[1] = (u[0] * north[0] + u[1] * north[1] + u[2] * north[2]) / depth;
        q[2] = 0;
    }
    return true;
}

/* Cut by the local coordinates, and name the vertices again. */
static bool lonlat_cut_locally(const lonlat_face *f, uint32_t *triangles)
{
    uint32_t vertex[MOST_CORNERS];
    if (!mw__face_cut(f->local, f->corners, f->count, triangles)) return false;
    for (size_t i = 0; i < f->count; i++) vertex[f->corners[i]] = f->vertices[i];
    for (size_t k = 0; k < 3 * (f->count - 2); k++) triangles[k] = vertex[triangles[k]];
    return true;
}

bool mw__lonlat_cut(const double *points, const uint32_t *corners, size_t count,
                    uint32_t *triangles)
{
    lonlat_face f = {.points = points, .vertices = corners, .count = count};
    double extent[2];
    lonlat_extent(&f, extent);
    const bool narrow = !(extent[1] - extent[0] > 180);
    if (narrow && mw__face_cut(points, corners, count, triangles)) return true;
    if (count > MOST_CORNERS) return false;
    lonlat_number(&f);
    if (lonlat_unwrap(&f, extent) && lonlat_cut_locally(&f, triangles)) return true;
    return lonlat_project(&f) && lonlat_cut_locally(&f, triangles);
}
