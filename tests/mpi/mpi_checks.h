/* mpi_checks.h - what the tests on several ranks share. A rank that finds a fault tells what it was
 * about and ends all of them. */
#ifndef MW_TESTS_MPI_CHECKS_H
#define MW_TESTS_MPI_CHECKS_H

#include <meshwalk-mpi/meshwalk-mpi.h>
#include <stdio.h>

#define mpi_check(holds, ...)                                                                      \
    do {                                                                                           \
        if (holds) break;                                                                          \
        fprintf(stderr, "%s:%d: not true: %s: ", __FILE__, __LINE__, #holds);                      \
        fprintf(stderr, __VA_ARGS__);                                                              \
        fprintf(stderr, "\n");                                                                     \
        MPI_Abort(MPI_COMM_WORLD, 1);                                                              \
    } while (0)

static inline int mpi_rank(void)
{
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

static inline int mpi_ranks(void)
{
    int ranks;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    return ranks;
}

#endif
