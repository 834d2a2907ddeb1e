/* constrained_scene.h - points, segments, polygons and hole seeds: the input of a constrained
 * triangulation, put together piece by piece. Failures are those of cmocka. */
#ifndef MW_TESTS_ORACLE_CONSTRAINED_SCENE_H
#define MW_TESTS_ORACLE_CONSTRAINED_SCENE_H

#include "predicates/predicates.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

enum { MAX_POINTS = 4000, MAX_SEGMENTS = 8000, MAX_HOLES = 64 };

typedef struct constrained_scene {
    double point[2 * MAX_POINTS];
    uint32_t segment[2 * MAX_SEGMENTS], polygon[MAX_SEGMENTS];
    double hole[2 * MAX_HOLES];
    uint32_t points, segments, holes;
    uint64_t random;
} constrained_scene;

/* An empty scene, the same object in each call; `seed` is that of its random numbers. */
constrained_scene *scene_new(uint64_t seed);
/* Returns the number of the point. */
uint32_t scene_add_point(constrained_scene *s, double x, double y);
void scene_add_segment(constrained_scene *s, uint32_t a, uint32_t b, uint32_t polygon);
/* The next three add their points, too. A line is a segment of no polygon; a ring has n points. */
void scene_add_line(constrained_scene *s, double x0, double y0, double x1, double y1);
void scene_add_ring(constrained_scene *s, uint32_t n, const double *xy, uint32_t polygon);
void scene_add_box(constrained_scene *s, double x0, double y0, double x1, double y1,
                   uint32_t polygon);
void scene_add_hole(constrained_scene *s, double x, double y);
/* A random integer below n, and a random number from 0 to 1. */
double scene_below(constrained_scene *s, uint32_t n);
double scene_uniform(constrained_scene *s);
/* The scene for mw_constrained_delaunay(). */
mw_constraints scene_view(const constrained_scene *s);
mw_point scene_point(const constrained_scene *s, uint32_t p);
/* Would the segment from a to b cross one of the scene? */
bool scene_crosses_any(const constrained_scene *s, uint32_t a, uint32_t b);
/* Add random segments that cross no other; `tries` are drawn. */
void scene_add_random_segments(constrained_scene *s, uint32_t tries);
/* Do the insides of the segments ab and cd cross? Exact, as the next three. */
bool points_cross(mw_point a, mw_point b, mw_point c, mw_point d);
/* Does p lie on the segment ab, its ends included? */
bool point_lies_on(mw_point a, mw_point b, mw_point p);
/* 1: a, b, c turn left; -1: right; 0: they are on one line. */
int points_turn(mw_point a, mw_point b, mw_point c);
bool points_equal(mw_point a, mw_point b);

#endif
