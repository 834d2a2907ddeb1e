/* edit_locate.h - answers about a mesh that is edited, held against its twin: every walk, every
 * start, cursors that are older than the edits. */
#ifndef MW_TESTS_ORACLE_EDIT_LOCATE_H
#define MW_TESTS_ORACLE_EDIT_LOCATE_H

#include "oracle/edit_twin.h"
#include "oracle/location_oracle.h"

/* Is q in triangle k? If it is, writes the answer. */
bool twin_triangle_holds(const twin *t, uint32_t k, const double *q, location_answer *answer);

/* The lowest triangle that holds q; MW_NONE and MW_OUTSIDE, or MW_BAD, where there is none. */
location_answer twin_locate(const twin *t, const double *q);

/* A cursor for every walk, opened at first and as chance will have it, which lives on while the
 * mesh is edited. */
typedef struct twin_cursors {
    mw_cursor cursor[MW_WALK_COUNT];
    const mw_index *index[MW_START_COUNT]; /* the editor's; NULL: none */
    uint64_t random;
} twin_cursors;

/* indexed: also from starts that need an index, which the editor then keeps. */
void twin_cursors_open(twin_cursors *cursors, const twin *t, bool indexed, uint64_t seed);

/* One query, by a walk and a start that chance chooses, which has to give the answer: location,
 * weights, values. */
void twin_cursors_check(twin_cursors *cursors, const twin *t, const double *q,
                        location_answer expected);

/* Queries at all vertices, the middles of all edges and of all triangles, and points round
 * about, one by one, in a batch, and as a path. */
void twin_check_queries(const twin *t, twin_cursors *cursors);

#endif
