#include "support/solids.h"
#include "base/random.h"
#include "support/meshes.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

solid solid_make(uint32_t point_room, uint32_t triangle_room)
{
    solid s = {.points = calloc(3 * (size_t)point_room + 1, sizeof *s.points),
               .triangles = calloc(3 * (size_t)triangle_room + 1, sizeof *s.triangles)};
    assert_true(s.points && s.triangles);
    return s;
}

void solid_free(solid *s)
{
    free(s->points);
    free(s->triangles);
}

uint32_t solid_point(solid *s, double x, double y, double z)
{
    double *p = s->points + 3 * (size_t)s->point_count;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    return s->point_count++;
}

void solid_triangle(solid *s, uint32_t u, uint32_t v, uint32_t w)
{
    uint32_t *t = s->triangles + 3 * (size_t)s->triangle_count++;
    t[0] = u;
    t[1] = v;
    t[2] = w;
}

mw_arrays solid_view(const solid *s)
{
    return (mw_arrays){.points = s->points,
                       .point_count = s->point_count,
                       .triangles = s->triangles,
                       .triangle_count = s->triangle_count};
}

mw_surface *solid_surface(const solid *s, mw_surface_options options)
{
    mw_arrays view = solid_view(s);
    mw_surface *surface;
    mw_error error;
    expect_ok(mw_surface_create(&view, &options, &surface, &error), "surface", &error);
    return surface;
}

/* The corners of the unit cube by bits x, y, z; fronts face out. */
const uint32_t cube_triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                        {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                        {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

/* A box with a corner at `at`; `soup`: each triangle with vertices of its own, and zeros of either
 * sign. */
static void solid_add_box(solid *s, const double at[3], double size, int soup)
{
    uint32_t first = s->point_count;
    for (uint32_t i = 0; i < 8 && !soup; i++)
        solid_point(s, at[0] + size * (i & 1), at[1] + size * (i >> 1 & 1),
                    at[2] + size * (i >> 2));
    for (uint32_t t = 0; t < 12; t++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) {
            uint32_t i = cube_triangles[t][k];
            double p[3] = {at[0] + size * (i & 1), at[1] + size * (i >> 1 & 1),
                           at[2] + size * (i >> 2)};
            for (int c = 0; c < 3; c++)
                if (p[c] == 0 && t % 2) p[c] = -0.0;
            v[k] = soup ? solid_point(s, p[0], p[1], p[2]) : first + i;
        }
        solid_triangle(s, v[0], v[1], v[2]);
    }
}

solid solid_box(double x, double y, double z, double size, int soup)
{
    solid s = solid_make(36, 12);
    solid_add_box(&s, (const double[]){x, y, z}, size, soup);
    return s;
}

solid solid_soup(uint32_t points, uint32_t triangles, int bad, uint64_t *random)
{
    solid s = solid_make(points, triangles);
    for (uint32_t i = 0; i < points; i++) {
        double p[3];
        for (int k = 0; k < 3; k++) p[k] = (double)mw__random_below(random, 3) - 1;
        if (p[0] == 0 && mw__random_below(random, 2)) p[0] = -0.0;
        if (bad && mw__random_below(random, 8) == 0)
            p[mw__random_below(random, 3)] = mw__random_below(random, 2) ? NAN : INFINITY;
        solid_point(&s, p[0], p[1], p[2]);
    }
    while (s.triangle_count < triangles) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) v[k] = mw__random_below(random, points);
        if (bad || (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]))
            solid_triangle(&s, v[0], v[1], v[2]);
    }
    return s;
}

solid solid_sphere(int levels, uint64_t *random)
{
    uint32_t n = 8u << 2 * levels;
    solid s = solid_make(n, n);
    for (int i = 0; i < 6; i++)
        solid_point(&s,
                    i == 0   ? 1
                    : i == 1 ? -1
                             : 0,
                    i == 2   ? 1
                    : i == 3 ? -1
                             : 0,
                    i == 4   ? 1
                    : i == 5 ? -1
                             : 0);
    for (uint32_t i = 0; i < 8; i++) {
        uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2), odd = (i ^ i >> 1 ^ i >> 2) & 1;
        solid_triangle(&s, x, odd ? z : y, odd ? y : z);
    }
    for (; levels > 0; levels--) {
        uint32_t count = s.triangle_count, *pairs = malloc(3 * sizeof *pairs * 3 * count),
                 pair_count = 0;
        assert_non_null(pairs);
        for (uint32_t t = 0; t < count; t++) {
            uint32_t v[3], m[3];
            memcpy(v, s.triangles + 3 * (size_t)t, sizeof v);
            for (int k = 0; k < 3; k++) {
                uint32_t a = v[k], b = v[(k + 1) % 3], low = a < b ? a : b, high = a < b ? b : a,
                         i = 0;
                while (i < pair_count && (pairs[3 * i] != low || pairs[3 * i + 1] != high)) i++;
                if (i == pair_count) {
                    double p[3], length = 0;
                    for (int c = 0; c < 3; c++) {
                        p[c] = s.points[3 * a + (uint32_t)c] + s.points[3 * b + (uint32_t)c];
                        p[c] += 0.01 * random_unit(random);
                        length += p[c] * p[c];
                    }
                    pairs[3 * i] = low;
                    pairs[3 * i + 1] = high;
                    length = sqrt(length);
                    pairs[3 * i + 2] = solid_point(&s, p[0] / length, p[1] / length, p[2] / length);
                    pair_count++;
                }
                m[k] = pairs[3 * i + 2];
            }
            memcpy(s.triangles + 3 * (size_t)t, m, sizeof m);
            for (int k = 0; k < 3; k++) solid_triangle(&s, v[k], m[k], m[(k + 2) % 3]);
        }
        free(pairs);
    }
    return s;
}
