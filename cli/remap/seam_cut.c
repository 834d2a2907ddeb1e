#include "cli/remap/seam_cut.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CORNERS = 8 }; /* of a quadrilateral that two meridians cut */

/* A corner of a piece. `vertex` is the file's, or MW_NONE of one that is new. `own` is its
 * longitude without turns, as the file has it; NaN where the seam cuts an edge. */
typedef struct seam_corner {
    double lon, lat, own;
    uint32_t vertex;
} seam_corner;

typedef struct seam_polygon {
    seam_corner corner[MOST_CORNERS];
    uint32_t count;
} seam_polygon;

typedef struct seam_cutter {
    const mw_mesh_file *file;
    const char *path;
    double west, east; /* the seam, as either end has it */
    double *points;    /* 3 of each vertex */
    uint32_t *triangles, *faces;
    size_t point_count, point_room, triangle_count, triangle_room;
    size_t now; /* the triangle of the file */
} seam_cutter;

/* The way from one longitude to another, the short way round. */
static double seam_way(double from, double to)
{
    const double way = to - from;
    return way - 360 * round(way / 360);
}

bool seam_crosses(const mw_mesh_file *file)
{
    for (size_t v = 0; v < file->point_count; v++)
        if (!isfinite(file->points[3 * v]) || !isfinite(file->points[3 * v + 1])) return false;
    for (size_t t = 0; t < file->triangle_count; t++)
        for (size_t k = 0; k < 3; k++) {
            const double *a = file->points + 3 * (size_t)file->triangles[3 * t + k],
                         *b = file->points + 3 * (size_t)file->triangles[3 * t + (k + 1) % 3];
            if (fabs(a[0] - b[0]) > 180 || fabs(a[1]) == 90) return true;
        }
    return false;
}

/* --- pieces are added --- */

static bool cutter_grow(seam_cutter *c)
{
    if (c->point_count + MOST_CORNERS > c->point_room) {
        const size_t room = c->point_count + c->point_count / 2 + MOST_CORNERS;
        double *points = realloc(c->points, 3 * room * sizeof *points);
        if (!points) return false;
        c->points = points;
        c->point_room = room;
    }
    if (c->triangle_count + MOST_CORNERS > c->triangle_room) {
        const size_t room = c->triangle_count + c->triangle_count / 2 + MOST_CORNERS;
        uint32_t *triangles = realloc(c->triangles, 3 * room * sizeof *triangles);
        if (triangles) c->triangles = triangles;
        uint32_t *faces = realloc(c->faces, room * sizeof *faces);
        if (faces) c->faces = faces;
        if (!triangles || !faces) return false;
        c->triangle_room = room;
    }
    return true;
}

static uint32_t cutter_vertex(seam_cutter *c, const seam_corner *corner)
{
    if (corner->vertex != MW_NONE && c->points[3 * (size_t)corner->vertex] == corner->lon)
        return corner->vertex;
    double *p = c->points + 3 * c->point_count;
    p[0] = corner->lon;
    p[1] = corner->lat;
    p[2] = 0;
    return (uint32_t)c->point_count++;
}

/* A convex piece, as a fan. */
static bool cutter_add_piece(seam_cutter *c, const seam_polygon *piece)
{
    uint32_t v[MOST_CORNERS];
    if (!cutter_grow(c)) return false;
    for (uint32_t i = 0; i < piece->count; i++) v[i] = cutter_vertex(c, &piece->corner[i]);
    for (uint32_t i = 1; i + 1 < piece->count; i++) {
        const double *p[3] = {c->points + 3 * (size_t)v[0], c->points + 3 * (size_t)v[i],
                              c->points + 3 * (size_t)v[i + 1]};
        if (mw_orient2d(p[0], p[1], p[2]) == 0) continue;
        uint32_t *to = c->triangles + 3 * c->triangle_count;
        to[0] = v[0];
        to[1] = v[i];
        to[2] = v[i + 1];
        c->faces[c->triangle_count++] =
            (uint32_t)(c->file->faces ? c->file->faces[c->now] : c->now);
    }
    return true;
}

/* --- cutting --- */

/* Where the edge between two corners meets the seam. Both triangles at an edge of the file get the
 * same double: it is computed from the lower vertex, whatever turns their longitudes have. */
static double cutter_latitude(const seam_cutter *c, const seam_corner *a, const seam_corner *b,
                              double seam)
{
    if (a->vertex != MW_NONE && b->vertex != MW_NONE) {
        const bool turned = a->vertex > b->vertex;
        const double *low = c->file->points + 3 * (size_t)(turned ? b : a)->vertex,
                     *high = c->file->points + 3 * (size_t)(turned ? a : b)->vertex;
        const double way = seam_way(low[0], high[0]),
                     part = (way > 0 ? c->east - low[0] : c->west - low[0]) / way;
        return low[1] + (high[1] - low[1]) * part;
    }
    return a->lat + (b->lat - a->lat) * ((seam - a->lon) / (b->lon - a->lon));
}

/* What of a convex polygon lies east of a meridian (`side` 1), or west of it (-1). */
static seam_polygon cutter_clip(const seam_cutter *c, const seam_polygon *p, double seam, int side)
{
    seam_polygon out = {.count = 0};
    for (uint32_t i = 0; i < p->count; i++) {
        const seam_corner *a = &p->corner[i], *b = &p->corner[i + 1 < p->count ? i + 1 : 0];
        const double from = side * (a->lon - seam), to = side * (b->lon - seam);
        if (from >= 0) out.corner[out.count++] = *a;
        if ((from > 0 && to < 0) || (from < 0 && to > 0))
            out.corner[out.count++] =
                (seam_corner){seam, cutter_latitude(c, a, b, seam), NAN, MW_NONE};
    }
    return out;
}

/* The pieces of a convex polygon, whose longitudes may lie up to some turns away. */
static bool cutter_place(seam_cutter *c, const seam_polygon *polygon)
{
    for (int turn = -2; turn <= 2; turn++) {
        seam_polygon p = *polygon;
        for (uint32_t i = 0; i < p.count; i++) {
            seam_corner *corner = &p.corner[i];
            corner->lon += 360 * turn;
            if (fabs(corner->lon - corner->own) < 90) corner->lon = corner->own; /* not rounded */
        }
        p = cutter_clip(c, &p, c->west, 1);
        if (p.count > 2) p = cutter_clip(c, &p, c->east, -1);
        if (p.count > 2 && !cutter_add_piece(c, &p)) return false;
    }
    return true;
}

/* The part of a triangle between an edge and a pole. */
static bool cutter_place_below_pole(seam_cutter *c, const seam_corner *a, const seam_corner *b,
                                    double pole)
{
    const seam_polygon p = {
        {*a, *b, {b->lon, pole, b->own, MW_NONE}, {a->lon, pole, a->own, MW_NONE}}, 4};
    return cutter_place(c, &p);
}

/* The longitude of a corner as it goes on from another one: its own, and whole turns. */
static double seam_go_on(const seam_corner *from, double own)
{
    const double near = from->lon + seam_way(from->lon, own);
    return own + 360 * round((near - own) / 360);
}

static seam_corner seam_corner_of(const seam_cutter *c, size_t triangle, int k)
{
    const uint32_t v = c->file->triangles[3 * triangle + (size_t)k % 3];
    const double *p = c->file->points + 3 * (size_t)v;
    return (seam_corner){p[0], p[1], p[0], v};
}

/* The corners of a triangle, and the first again, with longitudes that go on from one to the next.
 * Is that a whole turn, so that a pole is inside? At a pole there is no longitude. */
static bool triangle_goes_round(const seam_cutter *c, size_t triangle, seam_corner corner[4])
{
    for (int k = 0; k < 4; k++) {
        corner[k] = seam_corner_of(c, triangle, k);
        if (fabs(corner[k].lat) == 90) return false;
        if (k > 0) corner[k].lon = seam_go_on(&corner[k - 1], corner[k].lon);
    }
    return fabs(corner[3].lon - corner[0].lon) > 180;
}

static bool cutter_cut_triangle(seam_cutter *c)
{
    seam_corner corner[4];
    for (int k = 0; k < 3; k++) {
        const seam_corner pole = seam_corner_of(c, c->now, k), a = seam_corner_of(c, c->now, k + 1);
        seam_corner b = seam_corner_of(c, c->now, k + 2);
        if (fabs(pole.lat) != 90) continue;
        if (fabs(a.lat) == 90 || fabs(b.lat) == 90) return true; /* no area */
        b.lon = seam_go_on(&a, b.lon);
        return cutter_place_below_pole(c, &a, &b, pole.lat);
    }
    triangle_goes_round(c, c->now, corner);
    return cutter_place(c, &(seam_polygon){{corner[0], corner[1], corner[2]}, 3});
}

/* --- faces with a pole inside --- */

/* Is there an edge from b to a in the triangles first .. end - 1? */
static bool face_has_edge(const seam_cutter *c, size_t first, size_t end, uint32_t b, uint32_t a)
{
    for (size_t t = first; t < end; t++)
        for (int k = 0; k < 3; k++)
            if (seam_corner_of(c, t, k).vertex == b && seam_corner_of(c, t, k + 1).vertex == a)
                return true;
    return false;
}

/* The triangles of a face, first .. end - 1, as one: what lies between its outline and the pole. */
static bool cutter_cut_cap(seam_cutter *c, size_t first, size_t end)
{
    bool placed = true;
    for (size_t t = first; t < end; t++)
        for (int k = 0; k < 3 && placed; k++) {
            const seam_corner a = seam_corner_of(c, t, k);
            seam_corner b = seam_corner_of(c, t, k + 1);
            if (face_has_edge(c, first, end, b.vertex, a.vertex)) continue;
            b.lon = seam_go_on(&a, b.lon);
            placed = cutter_place_below_pole(c, &a, &b, a.lat > 0 ? 90 : -90);
        }
    return placed;
}

/* The triangles of the face that begins with triangle `now`. */
static bool cutter_cut_face(seam_cutter *c)
{
    const uint32_t *faces = c->file->faces;
    const size_t first = c->now;
    size_t end = first + 1;
    seam_corner corner[4];
    while (faces && end < c->file->triangle_count && faces[end] == faces[first]) end++;
    bool round = false, placed = true;
    for (size_t t = first; t < end && !round; t++) round = triangle_goes_round(c, t, corner);
    if (round) placed = cutter_cut_cap(c, first, end);
    for (; c->now < end && placed && !round; c->now++) placed = cutter_cut_triangle(c);
    c->now = end;
    return placed;
}

/* --- all --- */

static int cutter_find_seam(seam_cutter *c)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t v = 0; v < c->file->point_count; v++) {
        low = fmin(low, c->file->points[3 * v]);
        high = fmax(high, c->file->points[3 * v]);
    }
    c->west = low < 0 ? -180 : 0;
    c->east = c->west + 360;
    if (low >= c->west && high <= c->east) return 0;
    complain("%s: crosses the meridian of 180 degrees, or a pole; its longitudes, from %g to %g, "
             "have to lie between -180 and 180 or between 0 and 360",
             c->path, low, high);
    return END_INPUT;
}

static bool cutter_begin(seam_cutter *c)
{
    const mw_mesh_file *f = c->file;
    c->point_room = c->point_count = f->point_count;
    c->triangle_room = f->triangle_count;
    c->points = malloc(3 * f->point_count * sizeof *c->points + 1);
    c->triangles = malloc(3 * f->triangle_count * sizeof *c->triangles + 1);
    c->faces = malloc(f->triangle_count * sizeof *c->faces + 1);
    if (!c->points || !c->triangles || !c->faces) return false;
    memcpy(c->points, f->points, 3 * f->point_count * sizeof *c->points);
    return true;
}

int seam_cut(mw_mesh_file *file, const char *path, double *west)
{
    seam_cutter c = {.file = file, .path = path};
    int end = cutter_find_seam(&c);
    if (end) return end;
    *west = c.west;
    bool made = cutter_begin(&c);
    while (c.now < file->triangle_count && made) made = cutter_cut_face(&c);
    if (!made) {
        free(c.points);
        free(c.triangles);
        free(c.faces);
        return fail_memory();
    }
    if (!file->faces) file->face_count = file->triangle_count;
    free(file->points);
    free(file->triangles);
    free(file->faces);
    file->points = c.points;
    file->point_count = c.point_count;
    file->triangles = c.triangles;
    file->triangle_count = c.triangle_count;
    file->faces = c.faces;
    return 0;
}
