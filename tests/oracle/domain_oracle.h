/* domain_oracle.h - what part of the plane a mesh covers, by brute force over pairs of
 * triangles, exactly: coordinates are small integers. A tiling is that of the mesh times
 * 2^domain_oracle_exponent. */
#ifndef MW_TESTS_ORACLE_DOMAIN_ORACLE_H
#define MW_TESTS_ORACLE_DOMAIN_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

#include "tiling/tiling.h"
#include "support/meshes.h"

/* Set by the test that scales its meshes; 0 at first. */
extern int domain_oracle_exponent;

typedef struct domain_spot {
    int64_t x, y;
} domain_spot;

/* The corners of triangle t, counter-clockwise. Returns false if it is flat. */
bool domain_oracle_corners(const arrays *a, uint32_t t, domain_spot out[3]);

/* Can a mesh be made of the arrays: no triangle repeats a vertex, no edge has three triangles? */
bool domain_oracle_is_usable(const arrays *a);

/* Is the mesh an embedding? */
bool domain_oracle_is_embedding(const arrays *a);

/* What is wrong with the tiling of the arrays, which are an embedding; NULL if nothing is. */
const char *domain_oracle_fault(const arrays *a, const mw_tiling *tiling);

#endif
