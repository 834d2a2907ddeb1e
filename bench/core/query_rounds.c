#include "bench/core/query_rounds.h"
#include "bench/core/rounds.h"

size_t query_rounds_share(uint64_t queries)
{
    size_t all = queries < TIMED_QUERIES ? (size_t)queries : TIMED_QUERIES;
    return all < TIMED_ROUNDS ? 1 : all / TIMED_ROUNDS;
}

typedef struct query_rounds {
    query_rounds_run *run;
    void *self;
    size_t share;
} query_rounds;

static int query_rounds_run_share(void *self, size_t entry, size_t round, double *microseconds)
{
    const query_rounds *q = self;
    size_t begin = round == ROUNDS_WARMUP ? 0 : round * q->share;
    return q->run(q->self, entry, begin, q->share, microseconds);
}

int query_rounds_measure(size_t entries, size_t share, query_rounds_run *run, void *self,
                         double *medians)
{
    rounds_results results;
    rounds_plan plan = {.entries = entries, .figures = 1, .warmups = 1, .rounds = TIMED_ROUNDS};
    query_rounds q = {run, self, share};
    int end = rounds_measure(&plan, query_rounds_run_share, &q, &results);
    for (size_t i = 0; i < entries && end == 0; i++) medians[i] = rounds_median(&results, i, 0);
    rounds_release(&results);
    return end;
}
