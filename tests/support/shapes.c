/* shapes.c - balls, tori, patches and soups on a lattice, and lines to probe them with. */
#include "support/shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/meshes.h"

shape shape_make(uint32_t point_room, uint32_t triangle_room)
{
    return (shape){calloc(point_room + 1, 3 * sizeof(double)),
                   calloc(triangle_room + 1, 3 * sizeof(uint32_t)), 0, 0};
}

void shape_free(shape *s)
{
    free(s->points);
    free(s->triangles);
}

uint32_t shape_point(shape *s, double x, double y, double z)
{
    double *p = s->points + 3 * (size_t)s->point_count;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    return s->point_count++;
}

void shape_triangle(shape *s, uint32_t u, uint32_t v, uint32_t w)
{
    uint32_t *t = s->triangles + 3 * (size_t)s->triangle_count++;
    t[0] = u;
    t[1] = v;
    t[2] = w;
}

/* --- made ------------------------------------------------------------------------------------- */

/* One face of an octahedron, cut into n * n triangles; corners as seen from outside
 * counter-clockwise. */
static void ball_face(shape *s, uint32_t n, const double a[3], const double b[3], const double c[3])
{
    uint32_t first = s->point_count;
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= n - i; j++) {
            double p[3];
            for (int k = 0; k < 3; k++) p[k] = a[k] * (n - i - j) + b[k] * j + c[k] * i;
            shape_point(s, p[0], p[1], p[2]);
        }
    uint32_t row = first;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t length = n - i + 1, above = row + length;
        for (uint32_t j = 0; j + 1 < length; j++) {
            shape_triangle(s, row + j, row + j + 1, above + j);
            if (j + 2 < length) shape_triangle(s, row + j + 1, above + j + 1, above + j);
        }
        row = above;
    }
}

/* Make one of points with equal coordinates. */
static void shape_weld(shape *s)
{
    uint32_t *to = malloc(sizeof *to * (s->point_count + 1)), kept = 0;
    for (uint32_t i = 0; i < s->point_count; i++) {
        const double *p = s->points + 3 * (size_t)i;
        uint32_t j = 0;
        while (j < kept && memcmp(s->points + 3 * (size_t)j, p, 3 * sizeof *p) != 0) j++;
        if (j == kept) memmove(s->points + 3 * (size_t)kept++, p, 3 * sizeof *p);
        to[i] = j;
    }
    for (uint32_t i = 0; i < 3 * s->triangle_count; i++) s->triangles[i] = to[s->triangles[i]];
    s->point_count = kept;
    free(to);
}

shape shape_ball(uint32_t n, double radius, double share, uint64_t *random)
{
    shape s = shape_make(4 * (n + 1) * (n + 2), 8 * n * n);
    for (int octant = 0; octant < 8; octant++) {
        double x[3] = {octant & 1 ? -1 : 1, 0, 0}, y[3] = {0, octant & 2 ? -1 : 1, 0},
               z[3] = {0, 0, octant & 4 ? -1 : 1};
        int turned = (octant & 1) ^ (octant >> 1 & 1) ^ (octant >> 2 & 1);
        ball_face(&s, n, x, turned ? z : y, turned ? y : z);
    }
    for (uint32_t i = 0; i < 3 * s.point_count; i++) s.points[i] += 0.0; /* no -0.0 */
    shape_weld(&s);
    for (uint32_t i = 0; i < s.point_count; i++) {
        double *p = s.points + 3 * (size_t)i,
               length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        double to = radius * (1 + share * (random_unit(random) - 0.5)) / length;
        for (int k = 0; k < 3; k++) p[k] = round(p[k] * to);
    }
    return s;
}

shape shape_torus(uint32_t n, uint32_t m, double scale)
{
    shape s = shape_make(n * m, 2 * n * m);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < m; j++) {
            double u = 2 * 3.14159265358979 * i / n, v = 2 * 3.14159265358979 * j / m,
                   r = 3 + cos(v);
            shape_point(&s, round(scale * r * cos(u)), round(scale * r * sin(u)),
                        round(scale * sin(v)));
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < m; j++) {
            uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                     d = i * m + (j + 1) % m;
            shape_triangle(&s, a, b, c);
            shape_triangle(&s, a, c, d);
        }
    return s;
}

shape shape_patch(uint32_t n, uint32_t height, uint64_t *random)
{
    shape s = shape_make((n + 1) * (n + 1), 2 * n * n);
    for (uint32_t y = 0; y <= n; y++)
        for (uint32_t x = 0; x <= n; x++)
            shape_point(&s, 4 * x, 4 * y, mw__random_below(random, height + 1));
    for (uint32_t y = 0; y < n; y++)
        for (uint32_t x = 0; x < n; x++) {
            uint32_t p = y * (n + 1) + x, q = p + 1, r = p + n + 2, t = p + n + 1;
            shape_triangle(&s, p, q, r);
            shape_triangle(&s, p, r, t);
        }
    return s;
}

shape shape_soup(uint32_t points, uint32_t triangles, uint64_t *random)
{
    shape s = shape_make(points, triangles);
    for (uint32_t i = 0; i < points; i++)
        shape_point(&s, mw__random_below(random, 17) - 8.0, mw__random_below(random, 17) - 8.0,
                    mw__random_below(random, 17) - 8.0);
    for (uint32_t i = 0; i < triangles; i++)
        shape_triangle(&s, mw__random_below(random, points), mw__random_below(random, points),
                       mw__random_below(random, points));
    return s;
}

shape shape_join(shape a, shape b, double dx)
{
    shape s = shape_make(a.point_count + b.point_count, a.triangle_count + b.triangle_count);
    for (uint32_t i = 0; i < a.point_count; i++)
        shape_point(&s, a.points[3 * i], a.points[3 * i + 1], a.points[3 * i + 2]);
    for (uint32_t i = 0; i < b.point_count; i++)
        shape_point(&s, b.points[3 * i] + dx, b.points[3 * i + 1], b.points[3 * i + 2]);
    for (uint32_t i = 0; i < a.triangle_count; i++)
        shape_triangle(&s, a.triangles[3 * i], a.triangles[3 * i + 1], a.triangles[3 * i + 2]);
    for (uint32_t i = 0; i < b.triangle_count; i++)
        shape_triangle(&s, a.point_count + b.triangles[3 * i],
                       a.point_count + b.triangles[3 * i + 1],
                       a.point_count + b.triangles[3 * i + 2]);
    shape_free(&a);
    shape_free(&b);
    return s;
}

shape shape_scaled(const shape *s, double scale, double shift)
{
    shape copy = shape_make(s->point_count, s->triangle_count);
    for (uint32_t i = 0; i < 3 * s->point_count; i++) copy.points[i] = s->points[i] * scale + shift;
    memcpy(copy.triangles, s->triangles, 3 * sizeof *s->triangles * s->triangle_count);
    copy.point_count = s->point_count;
    copy.triangle_count = s->triangle_count;
    return copy;
}

/* --- changed ---------------------------------------------------------------------------------- */

void shape_clash(shape *s, double share, uint64_t *random)
{
    for (uint32_t t = 0; t < s->triangle_count; t++)
        if (random_unit(random) < share) {
            uint32_t *v = s->triangles + 3 * (size_t)t, first = v[0];
            v[0] = v[1];
            v[1] = first;
        }
}

void shape_flatten(shape *s, double share, uint64_t *random)
{
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        if (random_unit(random) >= share) continue;
        const uint32_t *v = s->triangles + 3 * (size_t)t;
        double *a = s->points + 3 * (size_t)v[0], *b = s->points + 3 * (size_t)v[1],
               *c = s->points + 3 * (size_t)v[2];
        int same = (int)(mw__random(random) >> 63);
        for (int k = 0; k < 3; k++) a[k] = same ? b[k] : (b[k] + c[k]) / 2;
    }
}

void shape_tear(shape *s, uint64_t *random)
{
    shape torn = shape_make(3 * s->triangle_count, s->triangle_count);
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        const uint32_t *v = s->triangles + 3 * (size_t)i;
        uint32_t n[3], k = mw__random_below(random, 3);
        for (uint32_t j = 0; j < 3; j++) {
            const double *p = s->points + 3 * (size_t)v[(j + k) % 3];
            n[j] = shape_point(&torn, p[0], p[1], p[2]);
        }
        shape_triangle(&torn, n[0], n[1], n[2]);
    }
    shape_free(s);
    *s = torn;
}

void shape_shuffle(shape *s, uint64_t *random)
{
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        uint32_t j = i + mw__random_below(random, s->triangle_count - i), t[3];
        memcpy(t, s->triangles + 3 * (size_t)j, sizeof t);
        memmove(s->triangles + 3 * (size_t)j, s->triangles + 3 * (size_t)i, sizeof t);
        memcpy(s->triangles + 3 * (size_t)i, t, sizeof t);
    }
}

/* --- surfaces and queries --------------------------------------------------------------------- */

mw_surface *shape_surface(const shape *s, mw_surface_options options)
{
    mw_arrays view = {.points = s->points,
                      .point_count = s->point_count,
                      .triangles = s->triangles,
                      .triangle_count = s->triangle_count};
    mw_surface *surface;
    mw_error error;
    expect_ok(mw_surface_create(&view, &options, &surface, &error), "surface", &error);
    return surface;
}

double *shape_queries(const shape *s, size_t n, uint64_t *random)
{
    double *queries = malloc(6 * n * sizeof *queries);
    for (size_t i = 0; i < n; i++) {
        double *q = queries + 6 * i, *m = q + 3, through[3];
        const uint32_t *v = s->triangles + 3 * (size_t)mw__random_below(random, s->triangle_count);
        const double *a = s->points + 3 * (size_t)v[0], *b = s->points + 3 * (size_t)v[1],
                     *c = s->points + 3 * (size_t)v[2];
        const double *far = s->points + 3 * (size_t)mw__random_below(random, s->point_count);
        uint32_t place = mw__random_below(random, 4), way = mw__random_below(random, 4);
        double sign = mw__random(random) >> 63 ? 1 : -1, away = mw__random_below(random, 5) - 2.0;
        uint32_t axis = mw__random_below(random, 3);
        for (uint32_t k = 0; k < 3; k++) {
            double any = (mw__random_below(random, 1 << 20) - 0x1p19) / 0x1p15;
            through[k] = place == 0   ? a[k]
                         : place == 1 ? (a[k] + b[k]) / 2
                         : place == 2 ? (a[k] + b[k] + 2 * c[k]) / 4
                                      : any + a[k];
            m[k] = way == 0 ? (k == axis ? sign : 0) : way == 1 ? far[k] - through[k] : any;
        }
        if (way == 3) { /* against the normal */
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t x = (k + 1) % 3, y = (k + 2) % 3;
                m[k] = -((b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]));
            }
        }
        if (m[0] == 0 && m[1] == 0 && m[2] == 0) m[axis] = sign;
        for (uint32_t k = 0; k < 3; k++) q[k] = through[k] + away * m[k];
    }
    return queries;
}
