/* clock.h - the time that something takes. Private. */
#ifndef MW_SRC_BASE_CLOCK_H
#define MW_SRC_BASE_CLOCK_H

#include "base/posix.h"

/* Seconds of a clock that is never set: only differences mean something. */
static inline double mw__seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
