/* mend_geometry.h - the questions that mending asks about positions, exact with the tolerance 0.
 * Private. */
#ifndef MW_SRC_MEND_MEND_GEOMETRY_H
#define MW_SRC_MEND_MEND_GEOMETRY_H

#include "mend/mend_work.h"

bool mw__mend_finite(const mw_mend_work *w, uint32_t vertex);

/* Is the distance of two vertices at most the tolerance? Both are finite. */
bool mw__mend_near(const mw_mend_work *w, uint32_t a, uint32_t b);

/* Do three vertices lie on one line? Exact. */
bool mw__mend_flat(const mw_mend_work *w, const uint32_t v[3]);

/* In the plane, twice the area of a triangle: its sign is exact. */
double mw__mend_area(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t c);

/* Does vertex v lie inside the edge from a to b: no farther from it than the tolerance, and beside
 * neither end? */
bool mw__mend_inside_edge(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v);

/* How far along from a to b a vertex lies: a number that grows, exactly so for vertices on the
 * line. */
double mw__mend_along(const mw_mend_work *w, uint32_t a, uint32_t b, uint32_t v);

/* The distance of two vertices, squared and rounded. */
double mw__mend_square_distance(const mw_mend_work *w, uint32_t a, uint32_t b);

#endif
