/* trap_few.c - uniform points, and in one place few others whose triangles may lie badly: one in a
 * hundred. Queries are in these. */
#include "bench/data/dataset.h"
#include "bench/worst/trap_mesh.h"

#include <math.h>
#include <stdlib.h>

static const double FULL_TURN = 6.28318530717958647692;

enum { SHARE = 100 }; /* one point in so many is of the few */

static void few_point(trap_mesh *m, double x, double y)
{
    m->points[2 * m->point_count] = x;
    m->points[2 * m->point_count++ + 1] = y;
}

/* A disc without uniform points. */
typedef struct few_hole {
    double x, y, radius;
} few_hole;

/* Uniform points of the unit square, but none in the holes. Returns how many points are left to
 * make; 0: no memory. */
static size_t few_begin(trap_mesh *m, size_t n, uint64_t seed, const few_hole *hole, size_t holes)
{
    const size_t few = n / SHARE > 8 ? n / SHARE : 8;
    *m = (trap_mesh){.points = malloc(2 * n * sizeof *m->points)};
    if (!m->points) return 0;
    while (m->point_count < n - few) {
        const double x = dataset_unit(&seed), y = dataset_unit(&seed);
        bool free_place = true;
        for (size_t i = 0; i < holes; i++)
            free_place &= hypot(x - hole[i].x, y - hole[i].y) > hole[i].radius;
        if (free_place) few_point(m, x, y);
    }
    m->first_few = m->point_count;
    return few;
}

/* A cluster. */
bool trap_few_cluster(trap_mesh *m, size_t n, uint64_t seed)
{
    size_t few = few_begin(m, n, seed, NULL, 0);
    for (size_t i = 0; i < few; i++)
        few_point(m, 0.3 + 1e-9 * dataset_unit(&seed), 0.7 + 1e-9 * dataset_unit(&seed));
    return few > 0;
}

/* Two rows of points along a hole, whose steps shrink by 2^range, or are equal. */
static bool trap_few_rows(trap_mesh *m, size_t n, uint64_t seed, double range)
{
    static const few_hole hole = {0.5, 0.5, 0.2};
    size_t few = few_begin(m, n, seed, &hole, 1), steps = few / 2;
    for (size_t i = 0; i < steps; i++) {
        double t = (double)i / (double)steps, x = 0.4 + 0.2 * (range > 0 ? exp2(-range * t) : t);
        few_point(m, x, 0.4);
        few_point(m, x, 0.6);
    }
    return few > 0;
}

bool trap_few_graded(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_few_rows(m, n, seed, 36);
}

bool trap_few_comb(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_few_rows(m, n, seed, 0);
}

/* Wheels: a hub, and points round it. */
static bool trap_few_round(trap_mesh *m, size_t n, uint64_t seed, size_t wheels)
{
    enum { MOST = 8 };
    few_hole hole[MOST];
    for (size_t i = 0; i < wheels; i++) {
        double angle = FULL_TURN * (double)i / (double)wheels;
        hole[i] = (few_hole){0.5 + 0.3 * cos(angle), 0.5 + 0.3 * sin(angle), 0.1};
    }
    size_t few = few_begin(m, n, seed, hole, wheels);
    for (size_t i = 0; i < few; i++) {
        const few_hole *h = &hole[i % wheels];
        const size_t spokes = few / wheels, k = i / wheels;
        double angle = FULL_TURN * (double)k / (double)spokes, radius = k ? 0.9 * h->radius : 0;
        few_point(m, h->x + radius * cos(angle), h->y + radius * sin(angle));
    }
    return few > 0;
}

bool trap_few_wheel(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_few_round(m, n, seed, 1);
}

bool trap_few_wheels(trap_mesh *m, size_t n, uint64_t seed)
{
    return trap_few_round(m, n, seed, 8);
}
