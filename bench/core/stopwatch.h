// stopwatch.h - seconds since it was made. For C++; C takes monotonic_seconds of cli/frame.
#ifndef MW_BENCH_CORE_STOPWATCH_H
#define MW_BENCH_CORE_STOPWATCH_H

#include <chrono>

namespace bench
{

class Stopwatch
{
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
};

} // namespace bench

#endif
