/* touch_oracle.h - which triangles of a shape a line touches, by brute force in exact rationals
 * (GMP). */
#ifndef MW_TESTS_ORACLE_TOUCH_ORACLE_H
#define MW_TESTS_ORACLE_TOUCH_ORACLE_H

#include <gmp.h>
#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#include "support/shapes.h"

/* A line q + t m against all triangles of a shape. met: the line crosses the plane in the
 * triangle; touched: it comes from the front. side: the signs of the line's sides of the edges
 * of each triangle. */
typedef struct touch_oracle {
    const shape *s;
    uint32_t count; /* of triangles */
    char *met, *touched, (*side)[3];
    mpq_t *t;                 /* of triangles met: where */
    mpq_t q[3], m[3], square; /* |m|^2 */
} touch_oracle;

/* All triangles of the shape, which has to outlive the result, against the line query: a point,
 * then a motion, finite. The caller frees it with touch_oracle_free. */
touch_oracle touch_oracle_make(const shape *s, const double query[6]);
/* The same against the line from one point to another: t is 0 and 1 there. */
touch_oracle touch_oracle_through(const shape *s, const double ends[6]);
void touch_oracle_free(touch_oracle *o);

/* Is triangle i, which the line meets, at most d away from q? 0: no limit. */
bool touch_oracle_in_reach(const touch_oracle *o, uint32_t i, double d);

/* The touched triangle at most d away that is nearest to q, of those the lowest; MW_NONE: none. */
uint32_t touch_oracle_best(const touch_oracle *o, double d);

/* How far from q the line meets triangle i, along m, rounded. */
double touch_oracle_distance(const touch_oracle *o, uint32_t i);

/* The lowest touched triangle among those that are linked to triangle i, which is touched, over
 * edges that hold the place where the line meets it. */
uint32_t touch_oracle_lowest_linked(const touch_oracle *o, const mw_surface *surface, uint32_t i);

/* Where on triangle i the line meets it, as mw_where; *local: the local edge or vertex, 255 for
 * neither. */
int touch_oracle_where(const touch_oracle *o, uint32_t i, int *local);

/* Are all n numbers finite? */
bool touch_oracle_finite(const double *p, size_t n);

#endif
