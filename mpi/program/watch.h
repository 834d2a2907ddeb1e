/* watch.h - a killed rank is named, whichever MPI runs it. Private.
 *
 * A rank that is killed cannot say so, the others cannot learn who it was (docs/mpi.md), and
 * mpiexec may name a process that it ended itself. So each rank has a watcher, which says it before
 * mpiexec knows. */
#ifndef MWP_PROGRAM_WATCH_H
#define MWP_PROGRAM_WATCH_H

/* Before MPI begins: fork. The child returns and becomes the rank; the parent waits for it, names
 * it on standard error if a signal killed it, and ends as it did. If there is no memory or no
 * process for that, the caller goes on unwatched. */
void watch_begin(void);

/* After MPI has begun: who this process is. */
void watch_set_rank(int rank, int size);

#endif
