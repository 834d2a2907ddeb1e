/* star_shapes.c - the octahedron, cut as finely as wanted, and what makes it harder. */
#include "support/star_shapes.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"

uint32_t star_shape_point(star_shape *p, double x, double y, double z)
{
    p->point = realloc(p->point, sizeof(double) * 3 * (p->points + 1));
    assert_non_null(p->point);
    double *at = p->point + 3 * (size_t)p->points;
    at[0] = x;
    at[1] = y;
    at[2] = z;
    return p->points++;
}

uint32_t star_shape_triangle(star_shape *p, uint32_t a, uint32_t b, uint32_t c)
{
    p->corner = realloc(p->corner, sizeof(uint32_t) * 3 * (p->triangles + 1));
    assert_non_null(p->corner);
    uint32_t *at = p->corner + 3 * (size_t)p->triangles;
    at[0] = a;
    at[1] = b;
    at[2] = c;
    return p->triangles++;
}

void star_shape_free(star_shape *p)
{
    free(p->point);
    free(p->corner);
    *p = (star_shape){0};
}

mw_arrays star_shape_arrays(const star_shape *p)
{
    return (mw_arrays){.points = p->point,
                       .point_count = p->points,
                       .triangles = p->corner,
                       .triangle_count = p->triangles};
}

star_shape star_shape_octahedron(unsigned levels)
{
    star_shape p = {0};
    int n = 1 << levels;
    uint32_t *number = malloc(sizeof *number * (size_t)((2 * n + 1) * (2 * n + 1) * 2));
    assert_non_null(number);
#define AT(x, y, upper) number[((x + n) * (2 * n + 1) + y + n) * 2 + (upper)]
    for (int x = -n; x <= n; x++)
        for (int y = -n; y <= n; y++) {
            int z = n - abs(x) - abs(y);
            if (z < 0) continue;
            AT(x, y, 1) = star_shape_point(&p, x, y, z);
            AT(x, y, 0) = z ? star_shape_point(&p, x, y, -z) : AT(x, y, 1);
        }
    for (int face = 0; face < 8; face++) {
        int sx = face & 1 ? -1 : 1, sy = face & 2 ? -1 : 1, up = face & 4 ? 0 : 1;
        int turned = (sx * sy * (up ? 1 : -1)) < 0;
        for (int i = 0; i < n; i++)
            for (int j = 0; i + j < n; j++) {
                uint32_t a = AT(sx * i, sy * j, up), b = AT(sx * (i + 1), sy * j, up),
                         c = AT(sx * i, sy * (j + 1), up);
                star_shape_triangle(&p, a, turned ? c : b, turned ? b : c);
                if (i + j + 2 > n) continue;
                uint32_t d = AT(sx * (i + 1), sy * (j + 1), up);
                star_shape_triangle(&p, b, turned ? c : d, turned ? d : c);
            }
    }
#undef AT
    free(number);
    return p;
}

star_shape star_shape_globe(uint32_t around, uint32_t rings)
{
    star_shape p = {0};
    uint32_t north = star_shape_point(&p, 0, 0, 4), south = star_shape_point(&p, 0, 0, -4);
    for (uint32_t r = 1; r <= rings; r++)
        for (uint32_t i = 0; i < around; i++) {
            double theta = 3.14159265358979 * r / (rings + 1),
                   phi = 6.2831853071795862 * i / around;
            star_shape_point(&p, 4 * sin(theta) * cos(phi), 4 * sin(theta) * sin(phi),
                             4 * cos(theta));
        }
    for (uint32_t i = 0; i < around; i++) {
        uint32_t a = 2 + i, b = 2 + (i + 1) % around;
        star_shape_triangle(&p, north, a, b);
        for (uint32_t r = 1; r < rings; r++, a += around, b += around) {
            star_shape_triangle(&p, a, a + around, b + around);
            star_shape_triangle(&p, a, b + around, b);
        }
        star_shape_triangle(&p, south, b, a);
    }
    return p;
}

void star_shape_stretch(star_shape *p, unsigned most, uint64_t *seed)
{
    for (uint32_t v = 0; v < p->points; v++) {
        double factor = 1 + mw__random_below(seed, most);
        for (int k = 0; k < 3; k++) p->point[3 * v + (uint32_t)k] *= factor;
    }
}

void star_shape_shuffle(star_shape *p, uint64_t *seed)
{
    for (uint32_t t = p->triangles; t-- > 1;) {
        uint32_t other = mw__random_below(seed, t + 1);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = p->corner[3 * t + k];
            p->corner[3 * t + k] = p->corner[3 * other + k];
            p->corner[3 * other + k] = v;
        }
    }
    for (uint32_t t = 0; t < p->triangles; t++) {
        uint32_t v[3], turn = mw__random_below(seed, 3), back = mw__random_below(seed, 2);
        memcpy(v, p->corner + 3 * (size_t)t, sizeof v);
        for (uint32_t k = 0; k < 3; k++) p->corner[3 * t + k] = v[(turn + (back ? 3 - k : k)) % 3];
    }
}

bool star_shape_add_flat(star_shape *p, uint32_t t, uint32_t k)
{
    uint32_t a = p->corner[3 * t + k], b = p->corner[3 * t + (k + 1) % 3];
    double m[3];
    for (int i = 0; i < 3; i++) {
        m[i] = (p->point[3 * (size_t)a + (size_t)i] + p->point[3 * (size_t)b + (size_t)i]) / 2;
        if (m[i] != floor(m[i])) return false;
    }
    for (uint32_t u = 0; u < p->triangles; u++)
        for (uint32_t j = 0; j < 3; j++) {
            if (u == t || p->corner[3 * u + j] != b || p->corner[3 * u + (j + 1) % 3] != a)
                continue;
            uint32_t y = p->corner[3 * u + (j + 2) % 3], v = star_shape_point(p, m[0], m[1], m[2]);
            p->corner[3 * u] = b; /* b v y, v a y, and b a v between */
            p->corner[3 * u + 1] = v;
            p->corner[3 * u + 2] = y;
            star_shape_triangle(p, v, a, y);
            star_shape_triangle(p, b, a, v);
            return true;
        }
    return false;
}

void star_shape_tear(star_shape *p)
{
    star_shape parts = {0};
    for (uint32_t t = 0; t < p->triangles; t++) {
        uint32_t v[3];
        for (uint32_t k = 0; k < 3; k++) {
            const double *x = p->point + 3 * (size_t)p->corner[3 * t + k];
            v[k] = star_shape_point(&parts, x[0] == 0 && k == 1 ? -0.0 : x[0], x[1], x[2]);
        }
        star_shape_triangle(&parts, v[0], v[1], v[2]);
    }
    star_shape_free(p);
    *p = parts;
}
