/* rehearsal.h - work that may bring the process down is tried in a child of fork first. Private;
 * for this room only. */
#ifndef MW_SRC_IO_NETCDF_REHEARSAL_H
#define MW_SRC_IO_NETCDF_REHEARSAL_H

#include <stdbool.h>
#include <sys/types.h>

/* A rehearsal that has begun. */
typedef struct mw_rehearsal {
    pid_t child;
    int pipe; /* closed by the child when it ends; a byte comes before if it ends in order */
} mw_rehearsal;

/* In the parent: true, and the child is under way. False: no child could be made. In the child the
 * call does not return: it calls `perform` and ends. The child prints nothing, and has five seconds
 * of the processor. It has one thread and what the caller has locked. */
bool mw__rehearsal_begin(mw_rehearsal *r, void (*perform)(void *), void *work);

/* Wait for the child. False: it fell, or used up its time. True: it came to its end; or it only
 * waits, for a lock that another thread held when the child began, which nobody opens there. */
bool mw__rehearsal_end(mw_rehearsal *r);

#endif
