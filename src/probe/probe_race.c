/* probe_race.c - walks from different first triangles, until one touches a triangle [thesis App. G,
 * Alg. 2]: one after the other, or several at the same time in threads. The first touch stops the
 * others.
 *
 * Walk i is the same in any thread. So walks one after the other always find the same triangle. In
 * a race the answer depends on the fastest walk. With one thread, walks run one after the other. */
#include "base/posix.h"
#include "base/random.h"
#include "base/threads.h"
#include "probe/plane_walk.h"

uint32_t mw__probe_search_from(const mw_probe_search *search, uint64_t i, uint32_t first,
                               const _Atomic uint32_t *found, mw_probe_counters *work,
                               mw_probe_trace *trace)
{
    if (work) work->iterations++;
    if (first == MW_NONE) return MW_NONE;
    mw_plane_walk walk = mw__plane_walk_begin(search, first, found, work);
    if (!trace) return mw__plane_walk_run(&walk);
    trace->walk = (uint32_t)i;
    return mw__plane_walk_trace(&walk, trace);
}

/* Run walk i from its first triangle. */
static uint32_t race_search_once(const mw_probe_search *search, uint64_t i,
                                 const _Atomic uint32_t *found, mw_probe_counters *work,
                                 mw_probe_trace *trace)
{
    uint64_t random = mw__random_seed(search->random, i);
    bool coherent =
        i == 0 && search->first != MW_NONE && mw__probe_faces(search, search->first, work);
    uint32_t first = coherent ? search->first : mw__probe_first_triangle(search, &random, work);
    return mw__probe_search_from(search, i, first, found, work, trace);
}

static uint32_t race_in_turn(const mw_probe_search *search, mw_probe_counters *work,
                             mw_probe_trace *trace)
{
    uint32_t found = MW_NONE;
    for (uint64_t i = 0; i < search->iterations && found == MW_NONE; i++)
        found = race_search_once(search, i, NULL, work, trace);
    return found;
}

/* The data that the threads of a race share. */
typedef struct probe_race {
    const mw_probe_search *search;
    _Atomic uint64_t next;  /* number of the next walk */
    _Atomic uint32_t found; /* triangle, or MW_NONE */
    pthread_mutex_t lock;
    mw_probe_counters *work; /* of all walks; NULL: not counted */
} probe_race;

/* The work of one thread: one walk after the other, until some walk has found a triangle. */
static void race_member_run(void *race, uint32_t member)
{
    probe_race *r = race;
    const mw_probe_search *search = r->search;
    mw_probe_counters work = {0};
    (void)member;
    while (atomic_load_explicit(&r->found, memory_order_relaxed) == MW_NONE) {
        uint64_t i = atomic_fetch_add_explicit(&r->next, 1, memory_order_relaxed);
        if (i >= search->iterations) break;
        uint32_t t = race_search_once(search, i, &r->found, search->count ? &work : NULL, NULL),
                 none = MW_NONE;
        if (t == MW_NONE) continue;
        atomic_compare_exchange_strong_explicit(&r->found, &none, t, memory_order_relaxed,
                                                memory_order_relaxed);
        break;
    }
    if (!r->work) return;
    pthread_mutex_lock(&r->lock);
    mw_probe_counters_add(r->work, &work);
    pthread_mutex_unlock(&r->lock);
}

static uint32_t race_in_threads(const mw_probe_search *search, mw_probe_counters *work)
{
    probe_race r = {.search = search, .next = 0, .found = MW_NONE, .work = work};
    uint32_t most = search->iterations < MW_MOST_THREADS ? search->iterations : MW_MOST_THREADS;
    pthread_mutex_init(&r.lock, NULL);
    mw__team_run(search->race < most ? search->race : most, race_member_run, &r);
    pthread_mutex_destroy(&r.lock);
    return atomic_load_explicit(&r.found, memory_order_relaxed);
}

uint32_t mw__probe_search_all(const mw_probe_search *search, mw_probe_counters *work,
                              mw_probe_trace *trace)
{
    bool alone = trace || search->race < 2 || search->iterations < 2;
    return alone ? race_in_turn(search, work, trace) : race_in_threads(search, work);
}
