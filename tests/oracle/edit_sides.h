/* edit_sides.h - the directed edges of a twin's triangles, and its border. */
#ifndef MW_TESTS_ORACLE_EDIT_SIDES_H
#define MW_TESTS_ORACLE_EDIT_SIDES_H

#include "oracle/edit_twin.h"

/* A directed edge of a triangle, which lies on its left with the third vertex, apex. */
typedef struct twin_side {
    uint32_t from, to, apex, triangle;
} twin_side;

/* Edge k of a triangle that turns left (turn > 0) or right. */
twin_side twin_side_of(const twin *t, uint32_t triangle, int turn, int k);

/* All sides, sorted by their ends. Requires that each triangle has an area, and that no edge has
 * two triangles on one side. The caller frees them. */
twin_side *twin_sides(const twin *t, size_t *count);

/* The order of that array, for qsort and bsearch. */
int twin_compare_sides(const void *left, const void *right);

/* The side with these ends among sorted ones; NULL if there is none. */
const twin_side *twin_find_side(const twin_side *sides, size_t count, uint32_t from, uint32_t to);

/* The same without an array of sides: *found is the side, if there is one. */
bool twin_find_edge(const twin *t, uint32_t a, uint32_t b, twin_side *found);

/* How many triangles the edge ab has: 0: it is none; 1: it is on the border; 2. */
int twin_count_sides(const twin *t, uint32_t a, uint32_t b);

/* --- the border ------------------------------------------------------------------------------- */

/* At a vertex: how many edges of the border end and begin here, and the other end of one of
 * each. */
typedef struct twin_border_vertex {
    uint32_t in, out, before, after;
} twin_border_vertex;

/* One for each vertex; the caller frees them. */
twin_border_vertex *twin_border_vertices(const twin *t, const twin_side *sides, size_t count);

/* Remembers the border of a mesh that does not fill its hull as its straight parts, whatever
 * vertices lie inside them. */
void twin_keep_border(twin *t);

/* Requires that the border is a convex polygon where the mesh fills its hull, and the remembered
 * one elsewhere. */
void twin_check_border(const twin *t, const twin_side *sides, size_t count);

#endif
