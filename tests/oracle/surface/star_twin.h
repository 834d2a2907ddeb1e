/* star_twin.h - compares a star that follows an editor with one made anew. Failures end the program
 * (edit_require.h). */
#ifndef MW_TESTS_ORACLE_SURFACE_STAR_TWIN_H
#define MW_TESTS_ORACLE_SURFACE_STAR_TWIN_H

#include <meshwalk/meshwalk.h>
#include <stdint.h>

/* What star_twin_check met. */
typedef struct star_twin_counts {
    uint64_t ready, refused, flat;
} star_twin_counts;

/* The star must answer what one made anew answers, and be refused with the same words; its facets
 * and their links must be the same. Where facets lack an area it must wait for an update. `cursor`
 * may have served it before. Adds to *counts. */
void star_twin_check(mw_star *star, mw_star_cursor *cursor, int rays, star_twin_counts *counts,
                     uint64_t *random);

#endif
