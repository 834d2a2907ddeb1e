/* fuzz_constrained.c - constrained triangulation of a few points and segments, checked by exact
 * predicates: the mesh is an embedding, each segment is a chain of constrained edges, and every
 * other edge is locally Delaunay. And the points as rings of polygons, which are held against an
 * oracle. */
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>

#include "oracle/location_oracle.h"

enum { MOST = 24, MOST_SEGMENTS = 24 };

typedef struct input {
    const uint8_t *byte;
    size_t left;
} input;

static uint32_t next(input *in)
{
    if (in->left == 0) return 0;
    in->left--;
    return *in->byte++;
}

/* Is there a constrained edge between two vertices? */
static int is_piece(const mw_constrained_edges *edges, uint32_t a, uint32_t b)
{
    for (size_t i = 0; i < edges->count; i++) {
        uint32_t p = edges->edge[2 * i], q = edges->edge[2 * i + 1];
        if ((p == a && q == b) || (p == b && q == a)) return 1;
    }
    return 0;
}

static int is_nearer(const double *points, uint32_t to, uint32_t v, uint32_t w)
{
    double dv = hypot(points[2 * v] - points[2 * to], points[2 * v + 1] - points[2 * to + 1]);
    return dv < hypot(points[2 * w] - points[2 * to], points[2 * w + 1] - points[2 * to + 1]);
}

/* Follow constrained edges along the segment from a to b, each nearer to b. */
static void follow(const double *points, const mw_constrained_edges *edges, uint32_t a, uint32_t b)
{
    while (a != b) {
        uint32_t found = MW_NONE;
        for (size_t i = 0; i < edges->count; i++) {
            uint32_t p = edges->edge[2 * i], q = edges->edge[2 * i + 1];
            uint32_t other = p == a ? q : q == a ? p : MW_NONE;
            if (other == MW_NONE || !is_nearer(points, b, other, a)) continue;
            if (mw_orient2d(points + 2 * a, points + 2 * b, points + 2 * other) == 0) found = other;
        }
        if (found == MW_NONE) abort();
        a = found;
    }
}

static void check_delaunay(const mw_mesh *mesh, const mw_constrained_edges *edges)
{
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        uint32_t v[3], w[3];
        double p[3][2], q[2];
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
        if (!(mw_orient2d(p[0], p[1], p[2]) > 0)) abort();
        for (unsigned k = 0; k < 3; k++) {
            unsigned edge;
            uint32_t other = mw_mesh_neighbour(mesh, t, k, &edge);
            if (other == MW_NONE || is_piece(edges, v[k], v[(k + 1) % 3])) continue;
            mw_mesh_triangle(mesh, other, w);
            mw_mesh_vertex(mesh, w[(edge + 2) % 3], q);
            if (mw_incircle(p[0], p[1], p[2], q) > 0) abort();
        }
    }
}

static void check_embedding(const mw_mesh *mesh)
{
    mw_mesh_info info;
    if (mw_mesh_describe(mesh, NULL, &info, NULL)) abort();
    if (!info.embedding || info.flat_triangles || info.clockwise_triangles) abort();
}

/* Rings of three points and more, each of one of three polygons; returns the segments. */
static uint32_t make_rings(input *in, uint32_t n, uint32_t *segments, uint32_t *polygon)
{
    uint32_t m = 0;
    for (uint32_t first = 0; first + 3 <= n;) {
        uint32_t corners = 3 + next(in) % 4, of = next(in) % 3;
        if (first + corners > n) corners = n - first;
        for (uint32_t k = 0; k < corners; k++, m++) {
            segments[2 * m] = first + k;
            segments[2 * m + 1] = first + (k + 1) % corners;
            polygon[m] = of;
        }
        first += corners;
    }
    return m;
}

static void check_point(const mw_polygons *polygons, const mw_constraints *rings,
                        const mw_locator *locator, const double q[2])
{
    mw_cursor cursor = {0};
    mw_polygon_hit hits[3];
    mw_location at = mw_locate(locator, &cursor, q[0], q[1]);
    size_t count = mw_polygons_at(polygons, q, &at, hits, 3), i = 0;
    for (uint32_t of = 0; of < 3; of++) {
        polygon_side side = location_oracle_polygon(rings, of, q);
        if (side == POLYGON_OUTSIDE) continue;
        if (i >= count || hits[i].polygon != of || hits[i].border != (side == POLYGON_BORDER))
            abort();
        i++;
    }
    if (i != count) abort();
}

static void check_polygons(input *in, const double *points, uint32_t n, double scale, double offset)
{
    uint32_t segments[2 * MOST], polygon[MOST], found[3];
    mw_constraints rings = {
        .points = points, .point_count = n, .segments = segments, .polygon = polygon};
    rings.segment_count = make_rings(in, n, segments, polygon);
    mw_polygons *polygons;
    mw_locator *locator;
    if (mw_polygons_create(&rings, NULL, &polygons, NULL)) {
        if (polygons) abort();
        return;
    }
    if (mw_locator_create(mw_polygons_mesh(polygons), NULL, &locator, NULL)) abort();
    for (int i = 0; i < 12; i++) {
        double q[2];
        for (int k = 0; k < 2; k++) q[k] = (next(in) % 50 / 4.0 + offset) * scale;
        check_point(polygons, &rings, locator, q);
    }
    for (uint32_t i = 0; i < n; i++) check_point(polygons, &rings, locator, points + 2 * i);
    size_t count = mw_polygons_crossing(polygons, found, 3);
    for (uint32_t of = 0, i = 0; of < 3; of++) {
        bool listed = i < count && found[i] == of;
        if (listed != location_oracle_crosses(&rings, of)) abort();
        i += listed;
    }
    mw_locator_destroy(locator);
    mw_polygons_destroy(polygons);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {data, size};
    double points[2 * MOST], holes[4];
    uint32_t segments[2 * MOST_SEGMENTS], polygon[MOST_SEGMENTS], duplicate_of[MOST];
    size_t n = 3 + next(&in) % (MOST - 3), m = next(&in) % MOST_SEGMENTS;
    uint32_t options = next(&in);
    double scale = ldexp(1, (int)(next(&in) & 7) * 90 - 360), offset = options & 1 ? 4096 : 0;
    for (size_t i = 0; i < 2 * n; i++) points[i] = (next(&in) % 12 + offset) * scale;
    for (size_t i = 0; i < m; i++) {
        segments[2 * i] = next(&in) % (uint32_t)n;
        segments[2 * i + 1] = next(&in) % (uint32_t)n;
        polygon[i] = next(&in) % 3 == 0 ? MW_NONE : 0;
    }
    for (int i = 0; i < 4; i++) holes[i] = (next(&in) / 20.0 + offset) * scale;
    check_polygons(&in, points, (uint32_t)n, scale, offset);
    mw_constraints given = {.points = points,
                            .point_count = n,
                            .segments = segments,
                            .segment_count = m,
                            .polygon = options & 2 ? polygon : NULL,
                            .hole_seeds = holes,
                            .hole_seed_count = options >> 2 & 1 ? 2 : 0};
    mw_constrain_options how = {.keep = (mw_keep)((options >> 3) % 3),
                                .split = (int)(options >> 6 & 1)};
    mw_constrained_edges edges;
    mw_mesh *mesh;
    if (mw_constrained_delaunay(&given, &how, duplicate_of, NULL, &edges, &mesh, NULL)) {
        if (mesh) abort();
        return 0;
    }
    check_embedding(mesh);
    check_delaunay(mesh, &edges);
    for (size_t i = 0; i < m && how.keep == MW_KEEP_HULL && !how.split && !given.hole_seed_count;
         i++) {
        uint32_t a = segments[2 * i], b = segments[2 * i + 1];
        follow(points, &edges, duplicate_of[a] == MW_NONE ? a : duplicate_of[a],
               duplicate_of[b] == MW_NONE ? b : duplicate_of[b]);
    }
    mw_constrained_edges_release(&edges);
    mw_mesh_destroy(mesh);
    return 0;
}
