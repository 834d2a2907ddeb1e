// location_runs.h - the seconds that locating takes, one query at a time or in a batch.
#ifndef MW_BENCH_PROGRAMS_LOCATION_RUNS_H
#define MW_BENCH_PROGRAMS_LOCATION_RUNS_H

#include "bench/programs/inputs.h"
#include "bench/programs/program.h"

#include <meshwalk/meshwalk.h>

namespace bench
{

inline double locate_singly(const mw_locator *locator, const Coordinates &queries,
                            const mw_query_options &options, std::vector<mw_location> &found)
{
    mw_cursor cursor;
    mw_error error;
    if (mw_cursor_init(locator, &options, &cursor, &error) != MW_OK) fail(error.message);
    Stopwatch watch;
    for (size_t i = 0; i < found.size(); i++)
        found[i] = mw_locate(locator, &cursor, queries[2 * i], queries[2 * i + 1]);
    return watch.seconds();
}

inline double locate_in_batch(const mw_locator *locator, const Coordinates &queries,
                              const mw_query_options &options, std::vector<mw_location> &found,
                              mw_counters *counters = nullptr)
{
    mw_error error;
    Stopwatch watch;
    if (mw_locate_batch(locator, queries.data(), found.size(), 2, &options, found.data(), counters,
                        &error) != MW_OK)
        fail(error.message);
    return watch.seconds();
}

} // namespace bench

#endif
