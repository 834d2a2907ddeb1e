/* wait_ranks.c - ranks that tell who they are and wait to be killed. */
#include <mpi.h>
#include <stdio.h>
#include <unistd.h>

int main(int count, char **arguments)
{
    int rank;
    MPI_Init(&count, &arguments);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Barrier(MPI_COMM_WORLD); /* all have begun: Open MPI 4.1 may hang if one has not */
    printf("rank %d is process %ld\n", rank, (long)getpid());
    fflush(stdout);
    for (;;) pause();
}
