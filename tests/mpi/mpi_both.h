/* mpi_both.h - a mesh on one machine and the same in pieces. */
#ifndef MW_TESTS_MPI_BOTH_H
#define MW_TESTS_MPI_BOTH_H

#include "mpi_cases.h"
#include "mpi_checks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh on this machine, and the same in pieces. */
typedef struct both {
    arrays a;
    mw_mesh *mesh;
    mw_locator *locator;
    int *rank_of;
    piece own;
    mwp_mesh *pieces;
    const char *mesh_name, *cut_name;
} both;

/* Make both of arrays, which become theirs. Either both are refused, or none; then false is
 * returned. */
static inline bool both_make(both *b, arrays a, const char *mesh_name, int cut, uint64_t seed)
{
    mwp_error error;
    mw_error whole = {0};
    *b = (both){.a = a, .mesh_name = mesh_name};
    const mw_arrays view = arrays_view(&a);
    const bool sound =
        mw_mesh_create(&view, &(mw_mesh_options){.threads = 1}, &b->mesh, &whole) == MW_OK &&
        mw_locator_create(b->mesh, &(mw_locator_options){.border = 1, .threads = 1}, &b->locator,
                          &whole) == MW_OK;
    b->rank_of = mpi_cut(cut, &a, mpi_ranks(), seed, &b->cut_name);
    b->own = piece_make(&a, b->rank_of, mpi_rank(), seed);
    const mwp_piece given = {arrays_view(&b->own.part), b->own.vertex, b->own.triangle};
    mw_status status = mwp_mesh_create(MPI_COMM_WORLD, &given, NULL, &b->pieces, &error);
    mpi_check((status == MW_OK) == sound && (sound || status == MW_ERROR_INPUT),
              "%s, %s: the whole mesh: %s; in pieces: %s", mesh_name, b->cut_name,
              sound ? "sound" : whole.message, status ? error.message : "sound");
    return sound;
}

static inline void both_release(both *b)
{
    mwp_mesh_destroy(b->pieces);
    mw_locator_destroy(b->locator);
    mw_mesh_destroy(b->mesh);
    piece_free(&b->own);
    arrays_free(&b->a);
    free(b->rank_of);
}

#endif
