/* hostile.h - rounds of hostile input: what every subject shares. A round draws one case from the
 * random numbers it is given, and holds all answers against an oracle. */
#ifndef MW_TESTS_HOSTILE_HOSTILE_H
#define MW_TESTS_HOSTILE_HOSTILE_H

#include "base/random.h"
#include "support/meshes.h"

#include <stdbool.h>

typedef void hostile_round(uint64_t *random);

/* Meshes of the plane: plane.c. */
hostile_round hostile_soup;      /* triangles that overlap, touch, repeat, lie flat  */
hostile_round hostile_graded;    /* triangles whose sizes differ by powers of ten    */
hostile_round hostile_hubs;      /* vertices of many triangles                       */
hostile_round hostile_exponents; /* coordinates up to both ends of the doubles      */
/* Space: space.c. */
hostile_round hostile_stars;  /* polyhedra that are, or are not, star-shaped */
hostile_round hostile_probes; /* lines against surfaces and soups            */
/* Others, a file each. */
hostile_round hostile_edits;   /* streams of edits                            */
hostile_round hostile_memory;  /* one allocation fails, anywhere              */
hostile_round hostile_files;   /* files with bytes changed                    */
hostile_round hostile_cancels; /* calls cancelled at any report               */
hostile_round hostile_forks;   /* children that call after their parent       */

/* Ends the program with the message, the subject and the seed that repeats the round. */
_Noreturn void hostile_failed(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The seed of this round. */
uint64_t hostile_seed(void);

/* Every walk, from starts, layouts, arithmetic, threads and lanes that chance chooses, has to
 * answer queries that find fault with the mesh as rationals do. The mesh is an embedding. */
void hostile_check_answers(const arrays *a, uint64_t *random);

#endif
