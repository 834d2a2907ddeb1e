/* meshes.c - arrays of points and triangles; grids, fans, the trap; meshes and locators of them. */
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void expect_ok(mw_status status, const char *what, const mw_error *error)
{
    if (status == MW_OK) return;
    fprintf(stderr, "%s: %s\n", what, error->message);
    abort();
}

/* --- arrays ----------------------------------------------------------------------------------- */

arrays arrays_make(uint32_t point_room, uint32_t triangle_room)
{
    return (arrays){calloc(point_room + 1, 2 * sizeof(double)),
                    calloc(triangle_room + 1, 3 * sizeof(uint32_t)), 0, 0};
}

void arrays_free(arrays *a)
{
    free(a->points);
    free(a->triangles);
}

uint32_t arrays_point(arrays *a, double x, double y)
{
    a->points[2 * a->point_count] = x;
    a->points[2 * a->point_count + 1] = y;
    return a->point_count++;
}

void arrays_triangle(arrays *a, uint32_t u, uint32_t v, uint32_t w)
{
    uint32_t *t = a->triangles + 3 * (size_t)a->triangle_count++;
    t[0] = u;
    t[1] = v;
    t[2] = w;
}

mw_arrays arrays_view(const arrays *a)
{
    return (mw_arrays){.points = a->points,
                       .point_count = a->point_count,
                       .triangles = a->triangles,
                       .triangle_count = a->triangle_count};
}

arrays arrays_of_mesh(const mw_mesh *mesh)
{
    uint32_t points = mw_mesh_vertex_count(mesh), triangles = mw_mesh_triangle_count(mesh), v[3];
    arrays a = arrays_make(points, triangles);
    double at[2];
    for (uint32_t i = 0; i < points; i++) {
        mw_mesh_vertex(mesh, i, at);
        arrays_point(&a, at[0], at[1]);
    }
    for (uint32_t i = 0; i < triangles; i++) {
        mw_mesh_triangle(mesh, i, v);
        arrays_triangle(&a, v[0], v[1], v[2]);
    }
    return a;
}

uint32_t *mesh_neighbours(const mw_mesh *mesh)
{
    uint32_t n = mw_mesh_triangle_count(mesh),
             *neighbours = malloc((3 * (size_t)n + 1) * sizeof *neighbours);
    for (uint32_t t = 0; t < n; t++)
        for (uint32_t k = 0; k < 3; k++)
            neighbours[3 * (size_t)t + (k + 2) % 3] = mw_mesh_neighbour(mesh, t, k, NULL);
    return neighbours;
}

/* --- made ------------------------------------------------------------------------------------- */

arrays arrays_grid(uint32_t n, double jitter, uint64_t *random)
{
    arrays a = arrays_make((n + 1) * (n + 1), 2 * n * n);
    for (uint32_t y = 0; y <= n; y++)
        for (uint32_t x = 0; x <= n; x++) {
            double dx = x > 0 && x < n ? jitter * (random_unit(random) - 0.5) : 0;
            double dy = y > 0 && y < n ? jitter * (random_unit(random) - 0.5) : 0;
            arrays_point(&a, x + dx, y + dy);
        }
    for (uint32_t y = 0; y < n; y++)
        for (uint32_t x = 0; x < n; x++) {
            uint32_t p = y * (n + 1) + x, q = p + 1, r = p + n + 2, s = p + n + 1;
            if (mw__random(random) >> 63) {
                arrays_triangle(&a, p, q, r);
                arrays_triangle(&a, p, r, s);
            } else {
                arrays_triangle(&a, p, q, s);
                arrays_triangle(&a, q, r, s);
            }
        }
    return a;
}

arrays arrays_fan(uint32_t n)
{
    arrays a = arrays_make(n + 1, n);
    uint32_t hub = arrays_point(&a, 0, 0);
    for (uint32_t i = 0; i < n; i++)
        arrays_point(&a, cos(2 * 3.14159265358979 * i / n), sin(2 * 3.14159265358979 * i / n));
    for (uint32_t i = 0; i < n; i++) arrays_triangle(&a, hub, 1 + i, 1 + (i + 1) % n);
    return a;
}

arrays arrays_trap(void)
{
    static const double p[8][2] = {
        {.169678, .0175461}, {1, 0}, {.74616, .12756},  {.322629, .0519267},
        {.391841, .269754},  {1, 1}, {.811393, .632747}};
    static const uint32_t t[7][3] = {{0, 1, 2}, {3, 0, 2}, {3, 4, 0}, {5, 4, 3},
                                     {6, 5, 3}, {6, 1, 5}, {2, 1, 6}};
    arrays a = arrays_make(8, 8);
    for (int i = 0; i < 7; i++) arrays_point(&a, p[i][0], p[i][1]);
    for (int i = 0; i < 7; i++) arrays_triangle(&a, t[i][0], t[i][1], t[i][2]);
    return a;
}

/* --- changed ---------------------------------------------------------------------------------- */

void arrays_scramble(arrays *a, int mixed, uint64_t *random)
{
    for (uint32_t i = 0; i < a->triangle_count; i++) {
        uint32_t j = i + mw__random_below(random, a->triangle_count - i),
                 k = mw__random_below(random, 3), t[3];
        memcpy(t, a->triangles + 3 * (size_t)j, sizeof t);
        memcpy(a->triangles + 3 * (size_t)j, a->triangles + 3 * (size_t)i, sizeof t);
        int turn = mixed && mw__random(random) >> 63;
        for (uint32_t l = 0; l < 3; l++)
            a->triangles[3 * (size_t)i + l] = t[(k + (turn ? 3 - l : l)) % 3];
    }
}

void arrays_transform(arrays *a, double scale, double dx, double dy)
{
    for (uint32_t i = 0; i < a->point_count; i++) {
        a->points[2 * i] = a->points[2 * i] * scale + dx;
        a->points[2 * i + 1] = a->points[2 * i + 1] * scale + dy;
    }
}

void arrays_punch(arrays *a, double share, uint64_t *random)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a->triangle_count; i++)
        if (random_unit(random) >= share || a->triangle_count - i + kept <= 1) {
            memmove(a->triangles + 3 * (size_t)kept, a->triangles + 3 * (size_t)i,
                    3 * sizeof(uint32_t));
            kept++;
        }
    a->triangle_count = kept;
}

/* --- meshes and locators ---------------------------------------------------------------------- */

mw_mesh *arrays_mesh(const arrays *a, mw_mesh_options options)
{
    mw_arrays view = arrays_view(a);
    mw_mesh *mesh;
    mw_error error;
    expect_ok(mw_mesh_create(&view, &options, &mesh, &error), "mesh", &error);
    return mesh;
}

mw_mesh *mesh_delaunay(const double *points, uint32_t n)
{
    mw_mesh *mesh;
    mw_error error;
    expect_ok(mw_delaunay(points, n, 2, NULL, NULL, NULL, &mesh, &error), "delaunay", &error);
    return mesh;
}

mw_mesh *mesh_with_hole(uint32_t right, uint64_t *random)
{
    arrays a = arrays_grid(16, 0, random);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < a.triangle_count; i++) {
        uint32_t x = i / 2 % 16, y = i / 32;
        if (x >= 5 && x < right && y >= 4 && y < 9) continue;
        memmove(a.triangles + 3 * (size_t)kept++, a.triangles + 3 * (size_t)i,
                3 * sizeof *a.triangles);
    }
    a.triangle_count = kept;
    arrays_scramble(&a, 0, random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.layout = mw__random_below(random, 2)
                                                                    ? MW_LAYOUT_AS_GIVEN
                                                                    : MW_LAYOUT_HILBERT});
    arrays_free(&a);
    return mesh;
}

mw_locator *mesh_locator(const mw_mesh *mesh, mw_locator_options options)
{
    mw_locator *locator;
    mw_error error;
    expect_ok(mw_locator_create(mesh, &options, &locator, &error), "locator", &error);
    return locator;
}

/* --- queries ---------------------------------------------------------------------------------- */

double *arrays_queries(const arrays *a, size_t n, size_t *count, uint64_t *random)
{
    enum { KINDS = 8 };
    double *q = malloc(KINDS * n * 2 * sizeof(double)), low[2] = {INFINITY, INFINITY},
           high[2] = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < a->point_count; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], a->points[2 * i + (uint32_t)k]);
            high[k] = fmax(high[k], a->points[2 * i + (uint32_t)k]);
        }
    for (size_t i = 0; i < n; i++) {
        const uint32_t *t = a->triangles + 3 * (size_t)mw__random_below(random, a->triangle_count);
        uint32_t k = mw__random_below(random, 3);
        const double *u = a->points + 2 * (size_t)t[k], *v = a->points + 2 * (size_t)t[(k + 1) % 3];
        double s = random_unit(random), *out = q + 2 * KINDS * i;
        for (int c = 0; c < 2; c++) {
            double r = random_unit(random), away = mw__random(random) >> 63 ? INFINITY : -INFINITY;
            out[c] = low[c] + r * (high[c] - low[c]);
            out[2 + c] = u[c];
            out[4 + c] = u[c] / 2 + v[c] / 2;
            out[6 + c] = u[c] + s * (v[c] - u[c]);
            out[8 + c] = nextafter(u[c], away);
            out[10 + c] = nextafter(u[c] / 2 + v[c] / 2, away);
            out[12 + c] = low[c] + (3 * r - 1) * (high[c] - low[c]);
            out[14 + c] = u[c] + (r - 0.5) * 1e6 * (high[c] - low[c]);
        }
    }
    *count = KINDS * n;
    return q;
}
