/* constrained_oracle.h - takes a constrained triangulation apart by brute force: its segments are
 * chains of edges, its other edges are locally Delaunay, it fills the hull once, and the right part
 * of it is kept. Failures are those of cmocka. */
#ifndef MW_TESTS_ORACLE_CONSTRAINED_ORACLE_H
#define MW_TESTS_ORACLE_CONSTRAINED_ORACLE_H

#include "oracle/constrained/constrained_scene.h"

typedef struct constrained_edge {
    uint32_t low, high, triangle, apex, piece;
} constrained_edge;

typedef struct constrained_result {
    mw_status status;
    mw_error error;
    mw_constrain_report report;
    mw_constrained_edges pieces;
    mw_mesh *mesh;
    uint32_t n, count;
    mw_point *point;
    uint32_t (*tri)[3];
    constrained_edge *edge; /* half-edges, sorted */
    uint32_t *duplicate_of;
} constrained_result;

/* The first half-edge between two vertices, NULL if they are not joined. */
constrained_edge *constrained_find_edge(const constrained_result *r, uint32_t a, uint32_t b);
/* Triangulate a scene and list the edges of the result. Release it, also after a failure. */
constrained_result constrained_run(const constrained_scene *s, mw_keep keep, int split);
void constrained_release(constrained_result *r);
/* Triangles turn left, neighbours are linked, no edge has three; edges that are no pieces
 * are locally Delaunay. */
void constrained_assert_sound(const constrained_scene *s, const constrained_result *r);
/* The border is that of the hull, and there are as many triangles as it takes to fill that once. */
void constrained_assert_fills_hull(const constrained_scene *s, const constrained_result *r);
/* Is q inside a polygon of the scene? */
bool scene_inside_any(const constrained_scene *s, mw_point q);
/* A place strictly inside triangle t; false where rounding finds none. */
bool constrained_middle_of(const constrained_result *r, uint32_t t, mw_point *q);
/* Is there a triangle with these vertices, in any order? */
bool constrained_has_triangle(const constrained_result *r, const uint32_t v[3]);
/* Triangulate a scene without crossings, with each mw_keep, and check all of the above. */
void constrained_check(const constrained_scene *s);
/* How far p is from the segment ab, roughly. */
double points_distance(mw_point a, mw_point b, mw_point p);
/* Triangulate a scene whose crossings are split; no segment may move by more than `tolerance`.
 * Returns how many points were made. */
size_t constrained_check_split(const constrained_scene *s, double tolerance);

#endif
