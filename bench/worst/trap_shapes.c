/* trap_shapes.c - shapes that meshes have where few walks tell little: hubs and fans within a mesh,
 * spirals, combs, weaves, quadtrees, boundary layers. */
#include "bench/data/dataset.h"
#include "bench/worst/trap_mesh.h"

#include <math.h>
#include <stdlib.h>

static const double FULL_TURN = 6.28318530717958647692;

static bool shape_alloc(trap_mesh *m, size_t points, size_t triangles)
{
    *m = (trap_mesh){.points = malloc(2 * points * sizeof *m->points),
                     .triangles = triangles ? malloc(3 * triangles * sizeof *m->triangles) : NULL};
    return m->points && (m->triangles || !triangles);
}

static void shape_point(trap_mesh *m, double x, double y)
{
    m->points[2 * m->point_count] = x;
    m->points[2 * m->point_count++ + 1] = y;
}

static void shape_triangle(trap_mesh *m, size_t a, size_t b, size_t c)
{
    uint32_t *t = &m->triangles[3 * m->triangle_count++];
    t[0] = (uint32_t)a;
    t[1] = (uint32_t)b;
    t[2] = (uint32_t)c;
}

/* One point in ten is on an arc round a hub; the others are uniform, outside of the circle. */
static bool shape_arc(trap_mesh *m, size_t n, uint64_t seed, double turn)
{
    const size_t spokes = n / 10;
    if (!shape_alloc(m, n, 0)) return false;
    shape_point(m, 0, 0);
    for (size_t i = 0; i < spokes; i++) {
        const double angle = turn * (double)i / (double)spokes;
        shape_point(m, 0.09 * cos(angle), 0.09 * sin(angle));
    }
    while (m->point_count < n) {
        const double x = 2 * dataset_unit(&seed) - 1, y = 2 * dataset_unit(&seed) - 1;
        if (hypot(x, y) > 0.1) shape_point(m, x, y);
    }
    return true;
}

bool trap_hub_within(trap_mesh *m, size_t n, uint64_t seed)
{
    return shape_arc(m, n, seed, FULL_TURN);
}

bool trap_fan_within(trap_mesh *m, size_t n, uint64_t seed)
{
    return shape_arc(m, n, seed, FULL_TURN / 2);
}

/* Points along a spiral of a hundred turns, closer on it than its turns are. */
bool trap_spiral(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    if (!shape_alloc(m, n, 0)) return false;
    for (size_t i = 0; i < n; i++) {
        const double t = sqrt(((double)i + 1) / (double)n), angle = 100 * FULL_TURN * t;
        shape_point(m, t * cos(angle), t * sin(angle));
    }
    return true;
}

/* Long thin teeth on a back; what is between them is filled. */
bool trap_comb(trap_mesh *m, size_t n, uint64_t seed)
{
    (void)seed;
    const size_t teeth = n / 4;
    if (!shape_alloc(m, 4 * teeth, 4 * teeth)) return false;
    for (size_t i = 0; i < teeth; i++) {
        const double x = (double)i, length = (double)teeth;
        shape_point(m, x, 0);
        shape_point(m, x + 0.5, 0);
        shape_point(m, x + 0.25, length);
        shape_point(m, x + 0.25, -1);
        const size_t a = 4 * i;
        shape_triangle(m, a, a + 1, a + 2);
        shape_triangle(m, a, a + 3, a + 1);
        if (i + 1 == teeth) continue;
        shape_triangle(m, a + 1, a + 3, a + 4);
        shape_triangle(m, a + 4, a + 3, a + 7);
    }
    return true;
}

/* A board of 16 x 16 squares, with points along two sides of each: left and right, or above and
 * below. Their steps shrink by 2^20 in every third square. */
bool trap_weave(trap_mesh *m, size_t n, uint64_t seed)
{
    size_t side = 16; /* squares in a row; fewer where each would get no points */
    while (side > 1 && n < 2 * side * side) side /= 2;
    const size_t squares = side * side, steps = n / (2 * squares);
    if (!shape_alloc(m, 2 * steps * squares, 0)) return false;
    for (size_t k = 0; k < squares; k++) {
        const double x = (double)(k % side), y = (double)(k / side);
        const bool upright = (k + k / side) % 2;
        for (size_t i = 0; i < steps; i++) {
            const double s = ((double)i + dataset_unit(&seed)) / (double)steps,
                         t = 0.1 + 0.8 * (k % 3 ? s : exp2(-20 * s));
            for (int end = 0; end < 2; end++) {
                const double far = end ? 0.95 : 0.05;
                shape_point(m, x + (upright ? t : far), y + (upright ? far : t));
            }
        }
    }
    return true;
}

/* Corners of a quadtree that is refined to depth 40 at points of a circle. */
bool trap_quadtree(trap_mesh *m, size_t n, uint64_t seed)
{
    enum { DEPTH = 40 };
    if (!shape_alloc(m, n, 0)) return false;
    while (m->point_count < n) {
        const double angle = FULL_TURN * dataset_unit(&seed), x = 0.5 + 0.3 * cos(angle),
                     y = 0.5 + 0.3 * sin(angle);
        for (int depth = 0; depth < DEPTH; depth++)
            for (int k = 0; k < 4 && m->point_count < n; k++)
                shape_point(m, ldexp(floor(ldexp(x, depth)) + k % 2, -depth),
                            ldexp(floor(ldexp(y, depth)) + k / 2, -depth));
    }
    return true;
}

/* Sixty rings round a circle, whose distances grow from 1e-9 to 1: two triangles for each point. */
bool trap_layers_round(trap_mesh *m, size_t n, uint64_t seed)
{
    enum { LAYERS = 60 };
    (void)seed;
    const size_t round = n / LAYERS > 3 ? n / LAYERS : 3;
    if (!shape_alloc(m, LAYERS * round, 2 * (LAYERS - 1) * round)) return false;
    for (size_t k = 0; k < LAYERS; k++)
        for (size_t i = 0; i < round; i++) {
            const double angle = FULL_TURN * (double)i / (double)round,
                         radius = k ? 1 + pow(10, -9 + 9 * (double)k / (LAYERS - 1)) : 1;
            shape_point(m, radius * cos(angle), radius * sin(angle));
        }
    for (size_t k = 0; k + 1 < LAYERS; k++)
        for (size_t i = 0; i < round; i++) {
            const size_t a = k * round + i, b = k * round + (i + 1) % round;
            shape_triangle(m, a, a + round, b);
            shape_triangle(m, b, a + round, b + round);
        }
    return true;
}
