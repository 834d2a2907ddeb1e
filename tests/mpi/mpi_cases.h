/* mpi_cases.h - meshes, and ways to cut them in pieces, for the tests of meshes in pieces. They
 * know nothing of MPI. */
#ifndef MW_TESTS_MPI_CASES_H
#define MW_TESTS_MPI_CASES_H

#include "support/meshes.h"

#include <stdbool.h>

/* --- meshes: embeddings, most of them with holes, pockets and several components -------------- */

enum { MPI_MESHES = 10 };

/* Mesh `i`, and its name. The same for the same seed. */
arrays mpi_mesh(int i, uint64_t seed, const char **name);

/* Put a vertex into the common edge of two triangles, here and there: one of them is cut in two,
 * and a triangle without area fills the gap to the other. Coordinates must be even. */
void mpi_break_edges(arrays *a, uint32_t every, uint64_t *random);

/* Give a share of the triangles vertices of their own, at the same places. */
void mpi_tear(arrays *a, double share, uint64_t *random);

/* --- cuts ------------------------------------------------------------------------------------- */

enum { MPI_CUTS = 8 };

/* The rank of each triangle under cut `i`, for the caller to free. */
int *mpi_cut(int i, const arrays *a, int ranks, uint64_t seed, const char **name);

/* A rank's piece: the triangles that `rank_of` gives it, in a scrambled order, with their vertices.
 */
typedef struct piece {
    arrays part;
    int64_t *vertex, *triangle; /* numbers in the whole mesh, as mpi_number makes them */
} piece;

/* Numbers in the whole mesh need not be dense, nor fit 32 bits; their order counts. */
static inline int64_t mpi_number(uint32_t i)
{
    return INT64_C(5000000000) + 3 * (int64_t)i;
}
static inline uint32_t mpi_place(int64_t number)
{
    return (uint32_t)((number - INT64_C(5000000000)) / 3);
}

piece piece_make(const arrays *a, const int *rank_of, int rank, uint64_t seed);
void piece_free(piece *p);

#endif
