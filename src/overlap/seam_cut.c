/* seam_cut.c - meshes that go round the globe, cut so that they lie in the plane.
 *
 *     W               E     A triangle with longitudes on both sides of the seam is cut there: its
 *     |\             /|     pieces lie at either end of the 360 degrees between W and E. Edges are
 *     | \           / |     straight in longitude and latitude. One with a pole inside, or as a
 *     |_/           \_|     vertex, reaches up to the pole's latitude over all its longitudes. */
#include "base/base.h"
#include "predicates/predicates.h"

#include <math.h>
#include <meshwalk/remap.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CORNERS = 8 }; /* of a quadrilateral that two meridians cut */

/* A corner of a piece. `vertex` is the mesh's, or MW_NONE of one that is new. `own` is its
 * longitude without turns, as the mesh has it; NaN where the seam cuts an edge. The value of a
 * field there is interpolated: `part` of the way from vertex `from` to vertex `to`. If `from` is
 * MW_NONE, the corner is a pole inside a face, and the value is the mean round the face. */
typedef struct seam_corner {
    double lon, lat, own;
    uint32_t vertex, from, to;
    double part;
} seam_corner;

typedef struct seam_polygon {
    seam_corner corner[MOST_CORNERS];
    uint32_t count;
} seam_polygon;

/* The weights by which values at new vertices come from the mesh's vertices: entries of a matrix.
 * */
typedef struct seam_shares {
    uint32_t *row, *column;
    double *weight;
    size_t count, room;
} seam_shares;

typedef struct seam_cutter {
    const mw_arrays *mesh;
    const uint32_t *of_triangles, *of_faces; /* the mesh's triangles; its faces, or NULL */
    double west, east;                       /* the seam, as either end has it */
    mw_seam_pieces made;
    size_t point_room, triangle_room;
    seam_shares shares;
    uint32_t *round; /* the vertices round the face with a pole inside, one after another */
    size_t round_count, round_room;
    size_t now; /* the triangle of the mesh */
} seam_cutter;

/* The way from one longitude to another, the short way round. */
static double seam_way(double from, double to)
{
    const double way = to - from;
    return way - 360 * round(way / 360);
}

static const double *seam_vertex(const mw_arrays *mesh, uint32_t v)
{
    return mesh->points + v * (mesh->point_stride ? mesh->point_stride : 2);
}

static uint32_t seam_face(const seam_cutter *c, size_t triangle)
{
    return c->of_faces ? c->of_faces[triangle] : (uint32_t)triangle;
}

int mw_seam_crosses(const mw_arrays *mesh)
{
    const uint32_t *triangles = mesh->triangles;
    for (uint32_t v = 0; v < mesh->point_count; v++) {
        const double *p = seam_vertex(mesh, v);
        if (!isfinite(p[0]) || !isfinite(p[1])) return 0;
    }
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (size_t k = 0; k < 3; k++) {
            const double *a = seam_vertex(mesh, triangles[3 * t + k]),
                         *b = seam_vertex(mesh, triangles[3 * t + (k + 1) % 3]);
            if (fabs(a[0] - b[0]) > 180 || fabs(a[1]) == 90) return 1;
        }
    return 0;
}

/* --- pieces are added --- */

/* Room for `more` members; *array may move. */
static bool seam_make_room(void *array, size_t size, size_t count, size_t more, size_t *room)
{
    void *old, *larger;
    if (count + more <= *room) return true;
    const size_t wanted = count + count / 2 + more;
    memcpy(&old, array, sizeof old);
    larger = mw__realloc(old, wanted, size);
    if (!larger) return false;
    memcpy(array, &larger, sizeof larger);
    *room = wanted;
    return true;
}

static bool shares_add(seam_shares *s, size_t row, uint32_t column, double weight)
{
    size_t rooms[3] = {s->room, s->room, s->room};
    if (!seam_make_room(&s->row, sizeof *s->row, s->count, 1, &rooms[0]) ||
        !seam_make_room(&s->column, sizeof *s->column, s->count, 1, &rooms[1]) ||
        !seam_make_room(&s->weight, sizeof *s->weight, s->count, 1, &rooms[2]))
        return false;
    s->room = rooms[2];
    s->row[s->count] = (uint32_t)row;
    s->column[s->count] = column;
    s->weight[s->count++] = weight;
    return true;
}

static bool cutter_grow(seam_cutter *c)
{
    mw_seam_pieces *m = &c->made;
    size_t rooms[2] = {c->triangle_room, 3 * c->triangle_room};
    if (!seam_make_room(&m->points, 2 * sizeof *m->points, m->point_count, MOST_CORNERS,
                        &c->point_room) ||
        !seam_make_room(&m->triangles, sizeof *m->triangles, 3 * m->triangle_count,
                        3 * MOST_CORNERS, &rooms[1]) ||
        !seam_make_room(&m->faces, sizeof *m->faces, m->triangle_count, MOST_CORNERS, &rooms[0]))
        return false;
    c->triangle_room = rooms[0];
    return true;
}

/* Add the weights of new vertex `row`. */
static bool cutter_share(seam_cutter *c, const seam_corner *corner, size_t row)
{
    bool added = true;
    if (corner->from != MW_NONE)
        return (corner->part == 1 || shares_add(&c->shares, row, corner->from, 1 - corner->part)) &&
               (corner->part == 0 || shares_add(&c->shares, row, corner->to, corner->part));
    for (size_t i = 0; i < c->round_count && added; i++)
        added = shares_add(&c->shares, row, c->round[i], 1 / (double)c->round_count);
    return added;
}

/* False without memory. */
static bool cutter_vertex(seam_cutter *c, const seam_corner *corner, uint32_t *v)
{
    *v = corner->vertex;
    if (*v != MW_NONE && c->made.points[2 * (size_t)*v] == corner->lon) return true;
    *v = (uint32_t)c->made.point_count++;
    double *p = c->made.points + 2 * (size_t)*v;
    p[0] = corner->lon;
    p[1] = corner->lat;
    return cutter_share(c, corner, *v);
}

/* A convex piece, as a fan. */
static bool cutter_add_piece(seam_cutter *c, const seam_polygon *piece)
{
    uint32_t v[MOST_CORNERS];
    mw_seam_pieces *m = &c->made;
    if (!cutter_grow(c)) return false;
    for (uint32_t i = 0; i < piece->count; i++)
        if (!cutter_vertex(c, &piece->corner[i], &v[i])) return false;
    for (uint32_t i = 1; i + 1 < piece->count; i++) {
        const double *p[3] = {m->points + 2 * (size_t)v[0], m->points + 2 * (size_t)v[i],
                              m->points + 2 * (size_t)v[i + 1]};
        if (mw_orient2d(p[0], p[1], p[2]) == 0) continue;
        uint32_t *to = m->triangles + 3 * m->triangle_count;
        to[0] = v[0];
        to[1] = v[i];
        to[2] = v[i + 1];
        m->faces[m->triangle_count++] = seam_face(c, c->now);
    }
    return true;
}

/* --- cutting --- */

/* Where the edge between two corners meets the seam. Both triangles at an edge of the mesh get the
 * same doubles: they are computed from the lower vertex, whatever turns their longitudes have. */
static seam_corner cutter_cross(const seam_cutter *c, const seam_corner *a, const seam_corner *b,
                                double seam)
{
    if (a->vertex == MW_NONE || b->vertex == MW_NONE) { /* along a pole's latitude */
        const double lat = a->lat + (b->lat - a->lat) * ((seam - a->lon) / (b->lon - a->lon));
        return (seam_corner){seam, lat, NAN, MW_NONE, a->from, a->to, a->part};
    }
    const bool turned = a->vertex > b->vertex;
    const seam_corner *first = turned ? b : a, *second = turned ? a : b;
    const double *low = seam_vertex(c->mesh, first->vertex),
                 *high = seam_vertex(c->mesh, second->vertex);
    const double way = seam_way(low[0], high[0]),
                 part = (way > 0 ? c->east - low[0] : c->west - low[0]) / way;
    return (seam_corner){
        seam, low[1] + (high[1] - low[1]) * part, NAN, MW_NONE, first->vertex, second->vertex,
        part};
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
            out.corner[out.count++] = cutter_cross(c, a, b, seam);
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

/* The part of a triangle between an edge and a pole, which is vertex `at`, or inside: MW_NONE. */
static bool cutter_place_below_pole(seam_cutter *c, const seam_corner *a, const seam_corner *b,
                                    double pole, uint32_t at)
{
    const seam_polygon p = {{*a,
                             *b,
                             {b->lon, pole, b->own, MW_NONE, at, at, 0},
                             {a->lon, pole, a->own, MW_NONE, at, at, 0}},
                            4};
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
    const uint32_t v = c->of_triangles[3 * triangle + (size_t)k % 3];
    const double *p = seam_vertex(c->mesh, v);
    return (seam_corner){p[0], p[1], p[0], v, v, v, 0};
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
        return cutter_place_below_pole(c, &a, &b, pole.lat, pole.vertex);
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

/* Note the edges round the triangles first .. end - 1 of a face: each from its first vertex. */
static bool cutter_go_round(seam_cutter *c, size_t first, size_t end)
{
    c->round_count = 0;
    for (size_t t = first; t < end; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t a = seam_corner_of(c, t, k).vertex,
                           b = seam_corner_of(c, t, k + 1).vertex;
            if (face_has_edge(c, first, end, b, a)) continue;
            if (!seam_make_room(&c->round, sizeof *c->round, c->round_count, 1, &c->round_room))
                return false;
            c->round[c->round_count++] = a;
        }
    return true;
}

/* The triangles of a face, first .. end - 1, as one: what lies between its outline and the pole. */
static bool cutter_cut_cap(seam_cutter *c, size_t first, size_t end)
{
    bool placed = cutter_go_round(c, first, end);
    for (size_t t = first; t < end; t++)
        for (int k = 0; k < 3 && placed; k++) {
            const seam_corner a = seam_corner_of(c, t, k);
            seam_corner b = seam_corner_of(c, t, k + 1);
            if (face_has_edge(c, first, end, b.vertex, a.vertex)) continue;
            b.lon = seam_go_on(&a, b.lon);
            placed = cutter_place_below_pole(c, &a, &b, a.lat > 0 ? 90 : -90, MW_NONE);
        }
    return placed;
}

/* The triangles of the face that begins with triangle `now`. */
static bool cutter_cut_face(seam_cutter *c)
{
    const size_t first = c->now, count = c->mesh->triangle_count;
    size_t end = first + 1;
    seam_corner corner[4];
    while (end < count && seam_face(c, end) == seam_face(c, first)) end++;
    bool round = false, placed = true;
    for (size_t t = first; t < end && !round; t++) round = triangle_goes_round(c, t, corner);
    if (round) placed = cutter_cut_cap(c, first, end);
    for (; c->now < end && placed && !round; c->now++) placed = cutter_cut_triangle(c);
    c->now = end;
    return placed;
}

/* --- all --- */

static mw_status cutter_find_seam(seam_cutter *c, mw_error *error)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t v = 0; v < c->mesh->point_count; v++) {
        const double *p = seam_vertex(c->mesh, v);
        if (!isfinite(p[0]) || !isfinite(p[1]))
            return mw__fail_at(error, -1, v, "vertex %u is not finite", v);
        low = fmin(low, p[0]);
        high = fmax(high, p[0]);
    }
    c->west = low < 0 ? -180 : 0;
    c->east = c->west + 360;
    if (low >= c->west && high <= c->east) return MW_OK;
    return mw__fail(error, MW_ERROR_INPUT,
                    "crosses the meridian of 180 degrees, or a pole; its longitudes, from %g to "
                    "%g, have to lie between -180 and 180 or between 0 and 360",
                    low, high);
}

static mw_status cutter_check(const mw_arrays *mesh, mw_error *error)
{
    const size_t most = MW_NONE / (4 * MOST_CORNERS);
    if (!mesh || (!mesh->points && mesh->point_count) ||
        (!mesh->triangles && mesh->triangle_count) || mesh->point_stride == 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the mesh is NULL, or has a stride of 1");
    if (mesh->integer_type != MW_UINT32)
        return mw__fail(error, MW_ERROR_ARGUMENT, "vertex numbers must be uint32_t");
    if (mesh->point_count > most || mesh->triangle_count > most)
        return mw__fail(error, MW_ERROR_LIMIT, "more than %zu vertices or triangles", most);
    const uint32_t *v = mesh->triangles;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        if (v[i] >= mesh->point_count)
            return mw__fail_at(error, (int64_t)(i / 3), v[i],
                               "triangle %zu names vertex %u, which does not exist; there are %zu",
                               i / 3, v[i], mesh->point_count);
    return MW_OK;
}

static bool cutter_begin(seam_cutter *c)
{
    mw_seam_pieces *m = &c->made;
    const size_t n = c->mesh->point_count, triangles = c->mesh->triangle_count;
    m->west = c->west;
    m->points = mw__alloc(c->point_room = n, 2 * sizeof *m->points);
    m->triangles = mw__alloc(3 * triangles, sizeof *m->triangles);
    m->faces = mw__alloc(c->triangle_room = triangles, sizeof *m->faces);
    if (!m->points || !m->triangles || !m->faces) return false;
    for (uint32_t v = 0; v < n; v++) {
        memcpy(m->points + 2 * (size_t)v, seam_vertex(c->mesh, v), 2 * sizeof *m->points);
        if (!shares_add(&c->shares, v, v, 1)) return false;
    }
    m->point_count = n;
    return true;
}

static mw_status cutter_run(seam_cutter *c, mw_error *error)
{
    bool made = cutter_begin(c);
    while (c->now < c->mesh->triangle_count && made) made = cutter_cut_face(c);
    if (!made) return mw__fail_memory(error);
    const mw_operator_entries entries = {.row = c->shares.row,
                                         .column = c->shares.column,
                                         .weight = c->shares.weight,
                                         .count = c->shares.count,
                                         .rows = (uint32_t)c->made.point_count,
                                         .columns = (uint32_t)c->mesh->point_count};
    const mw_operator_options options = {.threads = 1};
    return mw_operator_create_from_entries(&entries, &options, &c->made.values, error);
}

mw_status mw_seam_cut(const mw_arrays *mesh, const uint32_t *faces, mw_seam_pieces *pieces,
                      mw_error *error)
{
    if (!pieces) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the pieces is NULL");
    *pieces = (mw_seam_pieces){0};
    mw_status status = cutter_check(mesh, error);
    if (status) return status;
    seam_cutter c = {.mesh = mesh, .of_triangles = mesh->triangles, .of_faces = faces};
    status = cutter_find_seam(&c, error);
    if (status) return status;
    status = cutter_run(&c, error);
    free(c.shares.row);
    free(c.shares.column);
    free(c.shares.weight);
    free(c.round);
    if (status)
        mw_seam_pieces_release(&c.made);
    else
        *pieces = c.made;
    return status;
}

void mw_seam_pieces_release(mw_seam_pieces *pieces)
{
    if (!pieces) return;
    free(pieces->points);
    free(pieces->triangles);
    free(pieces->faces);
    mw_operator_destroy(pieces->values);
    *pieces = (mw_seam_pieces){0};
}
