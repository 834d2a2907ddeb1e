#include "bench/worst/trap_mesh.h"
#include "bench/data/dataset.h"

#include <math.h>
#include <stdlib.h>

static const double FULL_TURN = 6.28318530717958647692;

static bool trap_mesh_alloc(trap_mesh *m, size_t points, size_t triangles)
{
    *m = (trap_mesh){.points = malloc(2 * points * sizeof *m->points),
                     .triangles = triangles ? malloc(3 * triangles * sizeof *m->triangles) : NULL};
    return m->points && (m->triangles || !triangles);
}

void trap_mesh_release(trap_mesh *m)
{
    free(m->points);
    free(m->triangles);
    *m = (trap_mesh){0};
}

static void trap_mesh_point(trap_mesh *m, double x, double y)
{
    double *p = &m->points[2 * m->point_count++];
    p[0] = x;
    p[1] = y;
}

static void trap_mesh_triangle(trap_mesh *m, size_t a, size_t b, size_t c)
{
    uint32_t *t = &m->triangles[3 * m->triangle_count++];
    t[0] = (uint32_t)a;
    t[1] = (uint32_t)b;
    t[2] = (uint32_t)c;
}

/* x = 2^(range (1/2 - i/n)) for i = 0 to n, y = 0 and 1; two triangles a step. */
static bool trap_strip(trap_mesh *m, size_t n, double range)
{
    size_t steps = n / 2 - 1;
    if (!trap_mesh_alloc(m, 2 * steps + 2, 2 * steps)) return false;
    for (size_t i = 0; i <= steps; i++) {
        double x = exp2(range * (0.5 - (double)i / (double)steps));
        trap_mesh_point(m, x, 0);
        trap_mesh_point(m, x, 1);
    }
    for (size_t a = 0; a < 2 * steps; a += 2) {
        trap_mesh_triangle(m, a, a + 1, a + 2);
        trap_mesh_triangle(m, a + 2, a + 1, a + 3);
    }
    return true;
}

bool trap_strip_30(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    return trap_strip(m, n, 30);
}

bool trap_strip_300(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    return trap_strip(m, n, 300);
}

bool trap_strip_2000(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    return trap_strip(m, n, 2000);
}

/* The apex is the origin, the others (i, 10^6). */
bool trap_fan(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    if (!trap_mesh_alloc(m, n, n - 2)) return false;
    trap_mesh_point(m, 0, 0);
    for (size_t i = 1; i < n; i++) trap_mesh_point(m, (double)i, 1e6);
    for (size_t i = 1; i + 1 < n; i++) trap_mesh_triangle(m, 0, i + 1, i);
    return true;
}

/* Half a wheel. */
bool trap_half_fan(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    if (!trap_mesh_alloc(m, n, n - 2)) return false;
    trap_mesh_point(m, 0, 0);
    for (size_t i = 1; i < n; i++) {
        double angle = FULL_TURN / 2 * (double)(i - 1) / (double)(n - 2);
        trap_mesh_point(m, cos(angle), sin(angle));
    }
    for (size_t i = 1; i + 1 < n; i++) trap_mesh_triangle(m, 0, i, i + 1);
    return true;
}

/* A row of vertices with a hub on either side. */
bool trap_hubs(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    double far = (double)n;
    if (!trap_mesh_alloc(m, n, 2 * (n - 3))) return false;
    trap_mesh_point(m, far / 2, -far);
    trap_mesh_point(m, far / 2, far);
    for (size_t i = 2; i < n; i++) trap_mesh_point(m, (double)i, 0);
    for (size_t i = 2; i + 1 < n; i++) {
        trap_mesh_triangle(m, 0, i + 1, i);
        trap_mesh_triangle(m, 1, i, i + 1);
    }
    return true;
}

/* Squares round one another. */
bool trap_rings(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    size_t rings = n / 4;
    if (!trap_mesh_alloc(m, 4 * rings, 8 * (rings - 1) + 2)) return false;
    for (size_t r = 0; r < rings; r++)
        for (size_t k = 0; k < 4; k++) {
            double angle = FULL_TURN * (double)k / 4, radius = (double)(r + 1);
            trap_mesh_point(m, radius * cos(angle), radius * sin(angle));
        }
    trap_mesh_triangle(m, 0, 1, 2);
    trap_mesh_triangle(m, 0, 2, 3);
    for (size_t r = 0; r + 1 < rings; r++)
        for (size_t k = 0; k < 4; k++) {
            size_t a = 4 * r + k, b = 4 * r + (k + 1) % 4;
            trap_mesh_triangle(m, a, a + 4, b);
            trap_mesh_triangle(m, b, a + 4, b + 4);
        }
    return true;
}

static bool trap_points(trap_mesh *m, dataset_kind kind, size_t n, uint64_t seed, double scale)
{
    dataset data;
    *m = (trap_mesh){0};
    if (!dataset_make(&data, kind, n, false, seed)) return false;
    for (size_t i = 0; i < 2 * data.count; i++) data.points[i] *= scale;
    *m = (trap_mesh){.points = data.points, .point_count = data.count};
    return true;
}

bool trap_uniform(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_UNIFORM, n, seed, 1);
}

bool trap_tiny(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_UNIFORM, n, seed, 1e-150);
}

bool trap_tinier(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_UNIFORM, n, seed, 1e-290);
}

bool trap_huge(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_UNIFORM, n, seed, 1e250);
}

bool trap_least(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_UNIFORM, n, seed, 1e-300);
}

/* Multiples of the least double. */
bool trap_denormal(trap_mesh *m, size_t n, uint64_t seed)
{
    if (!trap_points(m, DATASET_UNIFORM, n, seed, 0x1p40)) return false;
    for (size_t i = 0; i < 2 * m->point_count; i++)
        m->points[i] = ldexp(floor(m->points[i]), -1074);
    return true;
}

bool trap_clusters(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_points(m, DATASET_CLUSTERS, n, seed, 1);
}

/* On a circle, except for rounding. */
bool trap_circle(trap_mesh *m, size_t n, uint64_t seed)
{
    if (!trap_mesh_alloc(m, n, 0)) return false;
    for (size_t i = 0; i < n; i++) {
        double angle = FULL_TURN * dataset_unit(&seed);
        trap_mesh_point(m, cos(angle), sin(angle));
    }
    return true;
}

/* --- queries ---------------------------------------------------------------------------------- */

/* Shares of the corners: they sum up to 1. */
static void trap_shares(trap_position position, uint64_t *random, double share[3])
{
    share[0] = share[1] = share[2] = 0;
    if (position == TRAP_ON_VERTICES) {
        share[0] = 1;
    } else if (position == TRAP_ON_EDGES) {
        share[0] = share[1] = 0.5;
    } else {
        double s = sqrt(dataset_unit(random)), t = dataset_unit(random);
        share[0] = 1 - s;
        share[1] = s * (1 - t);
        share[2] = s * t;
    }
}

/* The triangles with a vertex from `first` on; NULL: no memory. */
static uint32_t *trap_triangles_from(const mw_mesh *mesh, size_t first, double *count)
{
    const uint32_t all = mw_mesh_triangle_count(mesh);
    uint32_t *triangle = malloc(all * sizeof *triangle), n = 0, v[3];
    for (uint32_t t = 0; t < all && triangle; t++) {
        mw_mesh_triangle(mesh, t, v);
        if (v[0] >= first || v[1] >= first || v[2] >= first) triangle[n++] = t;
    }
    *count = n;
    return triangle;
}

bool trap_draw(const mw_mesh *mesh, size_t first, trap_position position, double *queries, size_t n,
               uint64_t seed)
{
    double count, share[3], corner[2];
    uint32_t *triangle = trap_triangles_from(mesh, first, &count);
    for (size_t i = 0; i < n && triangle; i++) {
        uint32_t v[3];
        mw_mesh_triangle(mesh, triangle[(uint32_t)(dataset_unit(&seed) * count)], v);
        trap_shares(position, &seed, share);
        queries[2 * i] = queries[2 * i + 1] = 0;
        for (int k = 0; k < 3; k++) {
            if (share[k] == 0) continue;
            mw_mesh_vertex(mesh, v[k], corner);
            queries[2 * i] += share[k] * corner[0];
            queries[2 * i + 1] += share[k] * corner[1];
        }
    }
    const bool done = triangle != NULL;
    free(triangle);
    return done;
}
