#include "bench/core/rounds.h"

size_t rounds_share(uint64_t queries)
{
    size_t all = queries < TIMED_QUERIES ? (size_t)queries : TIMED_QUERIES;
    return all < TIMED_ROUNDS ? 1 : all / TIMED_ROUNDS;
}

double rounds_median(double *times, size_t count)
{
    for (size_t i = 1; i < count; i++)
        for (size_t k = i; k > 0 && times[k] < times[k - 1]; k--) {
            double other = times[k];
            times[k] = times[k - 1];
            times[k - 1] = other;
        }
    return (times[(count - 1) / 2] + times[count / 2]) / 2;
}

/* Round -1 warms up, with the first share of queries. */
int rounds_time(size_t entries, size_t share, time_share *run, void *self, double *medians)
{
    double times[MOST_TIMED][TIMED_ROUNDS];
    int end = 0;
    for (int round = -1; round < TIMED_ROUNDS; round++)
        for (size_t k = 0; k < entries && end == 0; k++) {
            size_t entry = (k + (size_t)(round + 1)) % entries, turn = round < 0 ? 0 : (size_t)round;
            end = run(self, entry, turn * share, share, &times[entry][turn]);
        }
    for (size_t i = 0; i < entries && end == 0; i++) medians[i] = rounds_median(times[i], TIMED_ROUNDS);
    return end;
}
