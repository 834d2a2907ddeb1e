/* threads.c - threads made for one call. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "base/threads.h"
#include "base/posix.h"

/* Processors that this process may use. A container or taskset(1) may allow fewer than there are.
 */
static uint32_t processor_count(void)
{
#ifdef __linux__
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return (uint32_t)CPU_COUNT(&allowed);
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (uint32_t)online : 1;
}

uint32_t mw__team(uint32_t asked, uint64_t chunks)
{
    uint64_t most = chunks < MW_MOST_THREADS ? chunks : MW_MOST_THREADS;
    if (most <= 1) return 1;
    uint32_t threads = asked ? asked : processor_count();
    return threads < most ? threads : (uint32_t)most;
}

typedef struct team_member {
    mw_member_work *member_work;
    void *work;
    uint32_t number;
    pthread_t thread;
} team_member;

static void *team_member_run(void *argument)
{
    const team_member *member = argument;
    member->member_work(member->work, member->number);
    return NULL;
}

/* Make threads for the members from 1 on. Returns the first member without a thread. Signals stay
 * with the threads of the caller. */
static uint32_t team_begin(team_member *members, uint32_t team)
{
    sigset_t all, before;
    uint32_t made = 1;
    sigfillset(&all);
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0) return made;
    while (made < team &&
           pthread_create(&members[made].thread, NULL, team_member_run, &members[made]) == 0)
        made++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return made;
}

void mw__team_run(uint32_t team, mw_member_work *member_work, void *work)
{
    team_member members[MW_MOST_THREADS];
    uint32_t made = 1;
    if (team > 1) {
        for (uint32_t i = 0; i < team; i++) members[i] = (team_member){member_work, work, i, 0};
        made = team_begin(members, team);
    }
    member_work(work, 0);
    for (uint32_t i = made; i < team; i++) member_work(work, i);
    for (uint32_t i = 1; i < made; i++) pthread_join(members[i].thread, NULL);
}
