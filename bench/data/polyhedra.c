#include "bench/data/polyhedra.h"
#include "bench/data/dataset.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

const char *polyhedron_name(int kind)
{
    static const char *const names[POLYHEDRON_KINDS] = {
        [POLYHEDRON_TETRAHEDRON] = "tetrahedron",
        [POLYHEDRON_OCTAHEDRON] = "octahedron",
        [POLYHEDRON_ICOSAHEDRON] = "icosahedron",
        [POLYHEDRON_STAR] = "star",
        [POLYHEDRON_BUMPS] = "bumps",
        [POLYHEDRON_KNOT] = "knot",
    };
    return kind >= 0 && kind < POLYHEDRON_KINDS ? names[kind] : NULL;
}

void polyhedron_direction(double direction[3], uint64_t *random)
{
    double z = 2 * dataset_unit(random) - 1, angle = 2 * PI * dataset_unit(random),
           r = sqrt(1 - z * z);
    direction[0] = r * cos(angle);
    direction[1] = r * sin(angle);
    direction[2] = z;
}

static double vector_dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void vector_cross3(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void vector_normalise(double a[3])
{
    double length = sqrt(vector_dot3(a, a));
    for (size_t k = 0; k < 3; k++) a[k] /= length;
}

static bool polyhedron_allocate(polyhedron *p, size_t points, size_t triangles)
{
    p->points = malloc(3 * points * sizeof *p->points);
    p->triangles = malloc(3 * triangles * sizeof *p->triangles);
    p->point_count = points;
    p->triangle_count = triangles;
    return p->points && p->triangles;
}

/* --- subdivided regular polyhedra */

typedef struct regular_solid {
    size_t vertices, facets;
    double corner[12][3];
    uint32_t facet[20][3];
} regular_solid;

#define G 1.6180339887498949 /* the golden section */

static const regular_solid solids[] = {
    [POLYHEDRON_TETRAHEDRON] = {.vertices = 4,
                                .facets = 4,
                                .corner = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                                .facet = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}},
    [POLYHEDRON_OCTAHEDRON] =
        {.vertices = 6,
         .facets = 8,
         .corner = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
         .facet = {{0, 2, 4},
                   {2, 1, 4},
                   {1, 3, 4},
                   {3, 0, 4},
                   {2, 0, 5},
                   {1, 2, 5},
                   {3, 1, 5},
                   {0, 3, 5}}},
    [POLYHEDRON_ICOSAHEDRON] = {.vertices = 12,
                                .facets = 20,
                                .corner = {{-1, G, 0},
                                           {1, G, 0},
                                           {-1, -G, 0},
                                           {1, -G, 0},
                                           {0, -1, G},
                                           {0, 1, G},
                                           {0, -1, -G},
                                           {0, 1, -G},
                                           {G, 0, -1},
                                           {G, 0, 1},
                                           {-G, 0, -1},
                                           {-G, 0, 1}},
                                .facet = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10},
                                          {0, 10, 11}, {1, 5, 9},  {5, 11, 4}, {11, 10, 2},
                                          {10, 7, 6},  {7, 1, 8},  {3, 9, 4},  {3, 4, 2},
                                          {3, 2, 6},   {3, 6, 8},  {3, 8, 9},  {4, 9, 5},
                                          {2, 4, 11},  {6, 2, 10}, {8, 6, 7},  {9, 8, 1}}},
};
#define SOLIDS (sizeof solids / sizeof *solids)

static size_t level_facets(polyhedron_kind kind, unsigned level)
{
    return solids[kind].facets << 2 * level;
}

/* By Euler's formula. */
static size_t level_vertices(polyhedron_kind kind, unsigned level)
{
    return level_facets(kind, level) / 2 + 2;
}

static unsigned level_below(polyhedron_kind kind, size_t n)
{
    unsigned level = 0;
    while (level_vertices(kind, level + 1) <= n) level++;
    return level;
}

polyhedron_kind polyhedron_subdivided(size_t n, polyhedron_kind other)
{
    for (size_t i = 0; i < SOLIDS; i++) {
        const polyhedron_kind kind = (polyhedron_kind)i;
        if (level_vertices(kind, level_below(kind, n)) == n) return kind;
    }
    return other;
}

static void polyhedron_begin_solid(polyhedron *p, const regular_solid *s)
{
    memcpy(p->points, s->corner, s->vertices * sizeof *s->corner);
    memcpy(p->triangles, s->facet, s->facets * sizeof *s->facet);
    p->point_count = s->vertices;
    p->triangle_count = s->facets;
    for (size_t i = 0; i < s->vertices; i++) vector_normalise(p->points + 3 * i);
}

/* The middles of edges, by the lower-numbered end of an edge, which at most six meet. */
typedef struct edge_middles {
    uint32_t other, middle; /* other 0: free, since no edge ends there as the higher one */
} edge_middles[6];

static uint32_t polyhedron_edge_middle(polyhedron *p, edge_middles *known, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t i = 0;
    while (known[low][i].other && known[low][i].other != high) i++;
    if (known[low][i].other == 0) {
        double *m = p->points + 3 * p->point_count;
        for (size_t k = 0; k < 3; k++)
            m[k] = p->points[3 * (size_t)a + k] + p->points[3 * (size_t)b + k];
        vector_normalise(m);
        known[low][i].other = high;
        known[low][i].middle = (uint32_t)p->point_count++;
    }
    return known[low][i].middle;
}

/* From the last facet down, so that its four parts may take the places of facets done. */
static void polyhedron_cut_in_four(polyhedron *p, edge_middles *known)
{
    for (size_t i = p->triangle_count; i-- > 0;) {
        uint32_t v[3], m[3];
        memcpy(v, p->triangles + 3 * i, sizeof v);
        for (size_t k = 0; k < 3; k++)
            m[k] = polyhedron_edge_middle(p, known, v[k], v[(k + 1) % 3]);
        const uint32_t parts[4][3] = {
            {v[0], m[0], m[2]}, {m[0], v[1], m[1]}, {m[2], m[1], v[2]}, {m[0], m[1], m[2]}};
        memcpy(p->triangles + 12 * i, parts, sizeof parts);
    }
    p->triangle_count *= 4;
}

static bool polyhedron_make_solid(polyhedron *p, polyhedron_kind kind, unsigned level)
{
    const size_t vertices = level_vertices(kind, level);
    edge_middles *known = malloc(vertices * sizeof *known);
    bool room = polyhedron_allocate(p, vertices, level_facets(kind, level)) && known;
    if (room) polyhedron_begin_solid(p, &solids[kind]);
    for (unsigned i = 0; i < level && room; i++) {
        memset(known, 0, p->point_count * sizeof *known);
        polyhedron_cut_in_four(p, known);
    }
    free(known);
    return room;
}

/* --- the hull of random points on the sphere */

/* u, v, pole: a right-handed frame. */
typedef struct sphere_frame {
    double u[3], v[3], pole[3];
} sphere_frame;

static sphere_frame polyhedron_draw_frame(uint64_t *random)
{
    sphere_frame f;
    double other[3];
    polyhedron_direction(f.pole, random);
    polyhedron_direction(other, random);
    vector_cross3(other, f.pole, f.u);
    vector_normalise(f.u);
    vector_cross3(f.pole, f.u, f.v);
    return f;
}

/* The first four points are the corners of a regular tetrahedron, the pole one of them: so the
 * origin is inside, however few points there are. */
static void polyhedron_draw_points(polyhedron *p, const sphere_frame *f, uint64_t *random)
{
    memcpy(p->points, f->pole, sizeof f->pole);
    for (size_t i = 1; i < 4; i++) {
        double angle = 2 * PI * (double)i / 3;
        for (size_t k = 0; k < 3; k++)
            p->points[3 * i + k] =
                sqrt(8) / 3 * (cos(angle) * f->u[k] + sin(angle) * f->v[k]) - f->pole[k] / 3;
    }
    for (size_t i = 4; i < p->point_count; i++) polyhedron_direction(p->points + 3 * i, random);
}

/* Of the plane's triangles, seen from the pole and so from inside, each is turned over; beyond its
 * border edges lie the facets at the pole. Vertex i of the plane is point i + 1. */
static void polyhedron_take_facets(polyhedron *p, const mw_mesh *plane)
{
    uint32_t *next = p->triangles;
    for (uint32_t i = 0; i < mw_mesh_triangle_count(plane); i++) {
        uint32_t v[3];
        mw_mesh_triangle(plane, i, v);
        for (size_t k = 0; k < 3; k++) *next++ = v[2 - k] + 1;
        for (unsigned k = 0; k < 3; k++) {
            if (mw_mesh_neighbour(plane, i, k, NULL) != MW_NONE) continue;
            *next++ = v[k] + 1;
            *next++ = v[(k + 1) % 3] + 1;
            *next++ = 0;
        }
    }
    p->triangle_count = (size_t)(next - p->triangles) / 3;
}

/* Circles of the sphere are circles of the plane: the facets of the hull are the Delaunay triangles
 * of the points seen from one of them, the pole, which is in the facets beyond the plane's hull
 * [Brown 1979]. */
static mw_status polyhedron_make_hull(polyhedron *p, size_t n, uint64_t *random, mw_error *error)
{
    mw_mesh *plane = NULL;
    mw_status status = MW_ERROR_MEMORY;
    double *seen = malloc(2 * n * sizeof *seen);
    if (seen && polyhedron_allocate(p, n, 2 * n - 4)) {
        sphere_frame f = polyhedron_draw_frame(random);
        polyhedron_draw_points(p, &f, random);
        for (size_t i = 1; i < n; i++) {
            const double *q = p->points + 3 * i;
            double height = 1 - vector_dot3(q, f.pole);
            seen[2 * (i - 1)] = vector_dot3(q, f.u) / height;
            seen[2 * (i - 1) + 1] = vector_dot3(q, f.v) / height;
        }
        status = mw_delaunay(seen, n - 1, 2, NULL, NULL, NULL, &plane, error);
    }
    if (plane) polyhedron_take_facets(p, plane);
    mw_mesh_destroy(plane);
    free(seen);
    return status;
}

static void scale_vector(double point[3], double factor)
{
    for (size_t k = 0; k < 3; k++) point[k] *= factor;
}

static void polyhedron_roughen(polyhedron *p, uint64_t *random)
{
    for (size_t i = 0; i < p->point_count; i++)
        scale_vector(p->points + 3 * i, 0.8 + 0.4 * dataset_unit(random));
}

#define WAVES 12

/* Plane waves of one to three periods over the sphere. */
static void polyhedron_wave(polyhedron *p, uint64_t *random)
{
    double way[WAVES][3], phase[WAVES];
    for (size_t w = 0; w < WAVES; w++) {
        polyhedron_direction(way[w], random);
        scale_vector(way[w], PI * (1 + 2 * dataset_unit(random)));
        phase[w] = 2 * PI * dataset_unit(random);
    }
    for (size_t i = 0; i < p->point_count; i++) {
        double sum = 0;
        for (size_t w = 0; w < WAVES; w++)
            sum += cos(vector_dot3(way[w], p->points + 3 * i) + phase[w]);
        scale_vector(p->points + 3 * i, exp(0.15 * sum));
    }
}

/* --- a knotted tube */

#define GIRTH 0.45 /* the tube's radius; parts of the knot are about two apart */

/* The knot lies on a torus of the radii 2 and 1, whose normals are the knot's; they, its direction
 * and their product span the tube. */
static void knot_point(double t, double s, double point[3])
{
    double c = cos(3 * t), z = sin(3 * t), radius = 2 + c;
    double out[3] = {c * cos(2 * t), c * sin(2 * t), z}, side[3];
    double along[3] = {-3 * z * cos(2 * t) - 2 * radius * sin(2 * t),
                       -3 * z * sin(2 * t) + 2 * radius * cos(2 * t), 3 * c};
    vector_normalise(along);
    vector_cross3(along, out, side);
    double girth = GIRTH * (1 + 0.2 * sin(20 * t) * cos(3 * s));
    const double centre[3] = {radius * cos(2 * t), radius * sin(2 * t), z};
    for (size_t k = 0; k < 3; k++)
        point[k] = centre[k] + girth * (cos(s) * out[k] + sin(s) * side[k]);
}

/* The knot is about eleven times as long as the tube is round. */
static bool polyhedron_make_knot(polyhedron *p, size_t n)
{
    size_t round = (size_t)lround(sqrt((double)n / 11));
    if (round < 3) round = 3;
    size_t length = n / round;
    if (!polyhedron_allocate(p, length * round, 2 * length * round)) return false;
    for (size_t i = 0; i < length; i++)
        for (size_t k = 0; k < round; k++) {
            size_t vertex = i * round + k, next = (i + 1) % length * round;
            uint32_t a = (uint32_t)vertex, b = (uint32_t)(i * round + (k + 1) % round);
            uint32_t c = (uint32_t)(next + (k + 1) % round), d = (uint32_t)(next + k);
            const uint32_t pair[6] = {a, b, c, a, c, d};
            knot_point(2 * PI * (double)i / (double)length, 2 * PI * (double)k / (double)round,
                       p->points + 3 * vertex);
            memcpy(p->triangles + 6 * vertex, pair, sizeof pair);
        }
    return true;
}

mw_status polyhedron_make(polyhedron *p, polyhedron_kind kind, size_t n, uint64_t seed,
                          mw_error *error)
{
    uint64_t random = seed + n;
    mw_status status = MW_ERROR_MEMORY;
    *p = (polyhedron){0};
    *error = (mw_error){.status = status, .message = "out of memory"};
    if (kind < (polyhedron_kind)SOLIDS) {
        if (polyhedron_make_solid(p, kind, level_below(kind, n))) status = MW_OK;
    } else if (kind == POLYHEDRON_KNOT) {
        if (polyhedron_make_knot(p, n)) status = MW_OK;
    } else {
        status = polyhedron_make_hull(p, n, &random, error);
        if (status == MW_OK && kind == POLYHEDRON_STAR) polyhedron_roughen(p, &random);
        if (status == MW_OK && kind == POLYHEDRON_BUMPS) polyhedron_wave(p, &random);
    }
    if (status != MW_OK) polyhedron_release(p);
    return status;
}

void polyhedron_release(polyhedron *p)
{
    free(p->points);
    free(p->triangles);
    *p = (polyhedron){0};
}

mw_arrays polyhedron_arrays(const polyhedron *p)
{
    return (mw_arrays){
        .points = p->points,
        .point_count = p->point_count,
        .point_stride = 3,
        .triangles = p->triangles,
        .triangle_count = p->triangle_count,
    };
}
