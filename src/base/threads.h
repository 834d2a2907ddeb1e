/* threads.h - work that several threads share. Private.
 *
 * Threads are made by a call and end with it. So a process that uses the library has no threads of
 * the library between calls, and a child of fork() may call it like its parent. To make a
 * thread and to end it takes 20 to 45 microseconds; work that is not worth that has a team of one,
 * which makes none. */
#ifndef MW_SRC_BASE_THREADS_H
#define MW_SRC_BASE_THREADS_H

#include <stdint.h>

#define MW_MOST_THREADS 256

/* The number of members of a team for `chunks` chunks of work: as many as asked for (0: as there
 * are processors that the process may use), but at most one for each chunk, at most
 * MW_MOST_THREADS, and at least one. */
uint32_t mw__team(uint32_t asked, uint64_t chunks);

/* The work of one member of a team. */
typedef void mw_member_work(void *work, uint32_t member);

/* Do the work of the members 0 .. team - 1, each once, and return when all have finished. Member 0
 * is the calling thread. Others have threads of their own, with all signals blocked; if the system
 * refuses a thread, the calling thread does the work of that member too, after its own. So no
 * member may wait for another. */
void mw__team_run(uint32_t team, mw_member_work *member_work, void *work);

#endif
