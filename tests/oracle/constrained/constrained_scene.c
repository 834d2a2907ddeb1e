#include "oracle/constrained/constrained_scene.h"
#include "base/random.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static constrained_scene scenes[1]; /* large: not on the stack */

constrained_scene *scene_new(uint64_t seed)
{
    memset(scenes, 0, sizeof scenes);
    scenes->random = seed;
    return scenes;
}

uint32_t scene_add_point(constrained_scene *s, double x, double y)
{
    assert_true(s->points < MAX_POINTS);
    s->point[2 * s->points] = x;
    s->point[2 * s->points + 1] = y;
    return s->points++;
}

void scene_add_segment(constrained_scene *s, uint32_t a, uint32_t b, uint32_t polygon)
{
    assert_true(s->segments < MAX_SEGMENTS);
    s->segment[2 * s->segments] = a;
    s->segment[2 * s->segments + 1] = b;
    s->polygon[s->segments++] = polygon;
}

void scene_add_line(constrained_scene *s, double x0, double y0, double x1, double y1)
{
    uint32_t a = scene_add_point(s, x0, y0), b = scene_add_point(s, x1, y1);
    scene_add_segment(s, a, b, MW_NONE);
}

void scene_add_ring(constrained_scene *s, uint32_t n, const double *xy, uint32_t polygon)
{
    uint32_t first = s->points;
    for (uint32_t i = 0; i < n; i++) scene_add_point(s, xy[2 * i], xy[2 * i + 1]);
    for (uint32_t i = 0; i < n; i++) scene_add_segment(s, first + i, first + (i + 1) % n, polygon);
}

void scene_add_box(constrained_scene *s, double x0, double y0, double x1, double y1,
                   uint32_t polygon)
{
    scene_add_ring(s, 4, (double[]){x0, y0, x1, y0, x1, y1, x0, y1}, polygon);
}

void scene_add_hole(constrained_scene *s, double x, double y)
{
    s->hole[2 * s->holes] = x;
    s->hole[2 * s->holes++ + 1] = y;
}

double scene_below(constrained_scene *s, uint32_t n)
{
    return mw__random_below(&s->random, n);
}

double scene_uniform(constrained_scene *s)
{
    return (double)(mw__random(&s->random) >> 11) * 0x1p-53;
}

mw_constraints scene_view(const constrained_scene *s)
{
    return (mw_constraints){.points = s->point,
                            .point_count = s->points,
                            .segments = s->segment,
                            .segment_count = s->segments,
                            .polygon = s->polygon,
                            .hole_seeds = s->hole,
                            .hole_seed_count = s->holes};
}

mw_point scene_point(const constrained_scene *s, uint32_t p)
{
    return (mw_point){s->point[2 * p], s->point[2 * p + 1]};
}

static int double_sign(double x)
{
    return (x > 0) - (x < 0);
}

int points_turn(mw_point a, mw_point b, mw_point c)
{
    return double_sign(mw__orient2d(a, b, c));
}

bool points_equal(mw_point a, mw_point b)
{
    return a.x == b.x && a.y == b.y;
}

bool points_cross(mw_point a, mw_point b, mw_point c, mw_point d)
{
    return points_turn(a, b, c) * points_turn(a, b, d) < 0 &&
           points_turn(c, d, a) * points_turn(c, d, b) < 0;
}

bool point_lies_on(mw_point a, mw_point b, mw_point p)
{
    return points_turn(a, b, p) == 0 && p.x >= fmin(a.x, b.x) && p.x <= fmax(a.x, b.x) &&
           p.y >= fmin(a.y, b.y) && p.y <= fmax(a.y, b.y);
}

bool scene_crosses_any(const constrained_scene *s, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < s->segments; i++)
        if (points_cross(scene_point(s, a), scene_point(s, b), scene_point(s, s->segment[2 * i]),
                         scene_point(s, s->segment[2 * i + 1])))
            return true;
    return false;
}

void scene_add_random_segments(constrained_scene *s, uint32_t tries)
{
    for (uint32_t i = 0; i < tries; i++) {
        uint32_t a = mw__random_below(&s->random, s->points),
                 b = mw__random_below(&s->random, s->points);
        if (!scene_crosses_any(s, a, b)) scene_add_segment(s, a, b, MW_NONE);
    }
}
