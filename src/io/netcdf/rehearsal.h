/* rehearsal.h - tries work that may crash the process in a child made by fork first. Private; for
 * this room only. */
#ifndef MW_SRC_IO_NETCDF_REHEARSAL_H
#define MW_SRC_IO_NETCDF_REHEARSAL_H

#include "base/posix.h"

#include <stdbool.h>

/* A rehearsal that has begun. */
typedef struct mw_rehearsal {
    pid_t child;
    int pipe; /* closed when the child ends; it writes a byte before if it ends normally */
} mw_rehearsal;

/* In the parent: true, and the child is under way. False: no child could be made. In the child the
 * call does not return: it calls `perform` and ends. The child prints nothing, and has five seconds
 * of the processor. It has one thread and what the caller has locked. */
bool mw__rehearsal_begin(mw_rehearsal *r, void (*perform)(void *), void *work);

/* Wait for the child. False: it crashed or used up its time. True: it ended normally; or it is only
 * waiting, for a lock that another thread of the parent held at the fork and that nothing in the
 * child can release. */
bool mw__rehearsal_end(mw_rehearsal *r);

#endif
