/* threads.c - the work of a team, where there is one thread. */
#include "base/threads.h"

uint32_t mw__team(uint32_t asked, uint64_t chunks)
{
    (void)asked;
    (void)chunks;
    return 1;
}

void mw__team_run(uint32_t team, mw_member_work *member_work, void *work)
{
    for (uint32_t i = 0; i < team; i++) member_work(work, i);
}
