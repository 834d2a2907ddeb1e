/* race.c - walks from different first triangles, until one finds [thesis App. G, Alg. 2]: one after the other, or
 * several at a time in threads, the first to find stops the others.
 *
 * Walk number i is the same wherever it runs. So one after the other they find the same triangle each time; in a
 * race that depends on which walk is the first. Without OpenMP, and where it gives one thread only, they run one
 * after the other. */
#include "base/random.h"
#include "surface/walk.h"

enum { MOST_THREADS = 256 };

uint32_t mw__search_from(const mw_search *search, uint64_t i, uint32_t first, const _Atomic uint32_t *found,
                         mw_probe_counters *work, mw_trace *trace)
{
    if (work) work->iterations++;
    if (first == MW_NONE) return MW_NONE;
    mw_slice walk = mw__slice_begin(search, first, found, work);
    if (!trace) return mw__slice_run(&walk);
    trace->walk = (uint32_t)i;
    return mw__slice_trace(&walk, trace);
}

/* Walk number i from the triangle that is its own. */
static uint32_t search_once(const mw_search *search, uint64_t i, const _Atomic uint32_t *found, mw_probe_counters *work,
                            mw_trace *trace)
{
    uint64_t random = mw__random_seed(search->random, i);
    bool coherent = i == 0 && search->last != MW_NONE && mw__faces(search, search->last, work);
    uint32_t first = coherent ? search->last : mw__first_triangle(search, &random, work);
    return mw__search_from(search, i, first, found, work, trace);
}

static uint32_t in_turn(const mw_search *search, mw_probe_counters *work, mw_trace *trace)
{
    uint32_t found = MW_NONE;
    for (uint64_t i = 0; i < search->iterations && found == MW_NONE; i++)
        found = search_once(search, i, NULL, work, trace);
    return found;
}

/* What the threads of a race share. */
typedef struct race {
    const mw_search *search;
    _Atomic uint64_t next;  /* walk */
    _Atomic uint32_t found; /* triangle, or MW_NONE */
} race;

/* One thread: one walk after the other, as long as none has found. */
static mw_probe_counters run(race *r)
{
    const mw_search *search = r->search;
    mw_probe_counters work = {0};
    while (atomic_load_explicit(&r->found, memory_order_relaxed) == MW_NONE) {
        uint64_t i = atomic_fetch_add_explicit(&r->next, 1, memory_order_relaxed);
        if (i >= search->iterations) break;
        uint32_t t = search_once(search, i, &r->found, search->count ? &work : NULL, NULL), none = MW_NONE;
        if (t == MW_NONE) continue;
        atomic_compare_exchange_strong_explicit(&r->found, &none, t, memory_order_relaxed, memory_order_relaxed);
        break;
    }
    return work;
}

static uint32_t in_threads(const mw_search *search, mw_probe_counters *work)
{
    race r = {.search = search, .next = 0, .found = MW_NONE};
    uint32_t most = search->iterations < MOST_THREADS ? search->iterations : MOST_THREADS;
    int team = (int)(search->race < most ? search->race : most);
    (void)team; /* unused without OpenMP */
#ifdef _OPENMP
#pragma omp parallel num_threads(team)
#endif
    {
        mw_probe_counters mine = run(&r);
#ifdef _OPENMP
#pragma omp critical(mw_race)
#endif
        if (work) mw_probe_counters_add(work, &mine);
    }
    return atomic_load_explicit(&r.found, memory_order_relaxed);
}

uint32_t mw__search_all(const mw_search *search, mw_probe_counters *work, mw_trace *trace)
{
    bool alone = trace || search->race < 2 || search->iterations < 2;
    return alone ? in_turn(search, work, trace) : in_threads(search, work);
}
