/* threads.h - how many threads share some work. Private. */
#ifndef MW_SRC_BASE_THREADS_H
#define MW_SRC_BASE_THREADS_H

#include "base/base.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* Threads for `chunks` chunks of work: as many as asked for, 0 as OpenMP gives, but none without
 * work. */
static inline int mw__team(uint32_t asked, int64_t chunks)
{
#ifdef _OPENMP
    int64_t threads = asked ? (int64_t)asked : omp_get_max_threads();
#else
    int64_t threads = 1;
    (void)asked;
#endif
    return (int)(threads < chunks ? threads : chunks);
}

#endif
