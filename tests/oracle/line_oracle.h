/* line_oracle.h - a line in space by brute force in GMP integers, for the tests and the fuzz
 * target: where it meets the planes of two triangles. Used as predicate_oracle.h. */
#ifndef MW_TESTS_ORACLE_LINE_ORACLE_H
#define MW_TESTS_ORACLE_LINE_ORACLE_H

#include "oracle/predicate_oracle.h"

/* Coordinates of q, m, the corners of two triangles, and a length; in this order in what is
 * loaded. */
#define LINE_ORACLE_COORDINATES 25

/* The line is q + t m. */
typedef struct line_oracle {
    mpz_t v[LINE_ORACLE_COORDINATES], normal[3], s, t;
    mpz_t n[2], m[2]; /* the line meets the plane of triangle i at n / m, in units of m */
    mpz_t square;     /* |m|^2 */
    long base;        /* all are coordinates / 2^base */
} line_oracle;

void line_oracle_init(line_oracle *o);
void line_oracle_clear(line_oracle *o);

/* Takes a line, two triangles and a length, and finds n, m and square. */
void line_oracle_load(line_oracle *o, const double p[LINE_ORACLE_COORDINATES]);

/* Are the comparisons defined? The motion must not be 0, and parallel to neither plane. */
bool line_oracle_ready(const line_oracle *o);

/* -1, 0 or 1: the distance along the line from q to the first plane against that to the second. */
int line_oracle_compare_hits(line_oracle *o);

/* -1, 0 or 1: the distance along the line from q to the first plane against the length. */
int line_oracle_compare_hit_to(line_oracle *o);

/* o->result = m . ((a - q) x (b - q)) of p: q, m, a, b, three coordinates each. Returns the
 * exponent of two to multiply it with. */
long line_oracle_side(predicate_oracle *o, const double *p);

#endif
