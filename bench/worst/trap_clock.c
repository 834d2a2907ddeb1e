#include "bench/worst/trap_clock.h"
#include "bench/core/rounds.h"
#include "cli/frame/monotonic_clock.h"

static int trap_clock_ask(trap_clock *c, size_t way, size_t n, double *seconds)
{
    if (way >= TRAP_PEERS)
        return trap_peers_locate(c->peers, way - TRAP_PEERS, c->points, n, seconds);
    double begin = monotonic_seconds();
    int end = c->answer(c->self, n, way == TRAP_ALONE);
    *seconds = monotonic_seconds() - begin;
    return end;
}

static int trap_clock_run(void *self, size_t way, size_t round, double *figures)
{
    trap_clock *c = self;
    (void)round;
    int end = trap_clock_ask(c, way, c->count[way], figures);
    figures[0] *= 1e6 / (double)c->count[way];
    return end;
}

/* As many queries as take about a tenth of a second, so that a slow trap ends. */
static int trap_clock_choose(trap_clock *c, size_t way)
{
    static const double LONG = 0.1;
    double seconds;
    for (size_t n = 16;; n *= 4) {
        c->count[way] = n < c->queries ? n : c->queries;
        int end = trap_clock_ask(c, way, c->count[way], &seconds);
        if (end || n >= c->queries || seconds > LONG / 4) return end;
    }
}

int trap_take_times(trap_clock *c, const trap_plan *plan, trap_figures *f)
{
    rounds_results results = {0};
    const size_t peers = c->peers ? c->peers->count : 0;
    rounds_plan rounds = {.entries = TRAP_PEERS + peers, .figures = 1, .rounds = plan->rounds};
    int end = 0;
    for (size_t way = 0; way < rounds.entries && end == 0; way++) end = trap_clock_choose(c, way);
    if (end == 0) end = rounds_measure(&rounds, trap_clock_run, c, &results);
    if (end == 0) {
        f->batch = rounds_median(&results, TRAP_BATCH, 0);
        f->alone = rounds_median(&results, TRAP_ALONE, 0);
    }
    for (size_t k = 0; k < peers && end == 0; k++)
        f->peers[c->peers->peers[k].id].query = rounds_median(&results, TRAP_PEERS + k, 0);
    rounds_release(&results);
    return end;
}
