// harness.h - how everything here is measured: competitors run in turn, several rounds, after a warm-up; what counts is
// the median over the rounds. So a disturbance hits all competitors alike, and one bad round none.
#ifndef MW_BENCH_HARNESS_H
#define MW_BENCH_HARNESS_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench
{

struct Options {
    std::vector<size_t> sizes;      // --sizes 10000,100000: numbers of points
    std::vector<std::string> data;  // --data uniform,grid: sets of points, see datasets.h, or files
    std::vector<std::string> walks; // --walks straight,lawson (location)
    size_t queries = 0;             // --queries N (location)
    int rounds = 7, warmup = 1;     // --rounds N --warmup N
    unsigned threads = 1;           // --threads N: that build and fit (bench_star, bench_probe)
    uint64_t seed = 1;              // --seed S
    bool tsv = false;               // --format table|tsv
};

// Ends the program on --help and on wrong usage.
Options parse(int argc, char **argv, const Options &defaults, const char *what_it_does);

class Stopwatch
{
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); }
};

// Competitors that do the same work. `run` does it once and returns the seconds that count.
class Contest
{
    struct Competitor {
        std::function<double()> run;
        std::vector<double> seconds;
    };
    std::vector<Competitor> competitors;

  public:
    // Returns the number of the competitor.
    size_t enter(std::function<double()> run);
    // Each round begins with another competitor, so that none always runs after the same one.
    void hold(const Options &options);
    double median(size_t competitor) const;
    double least(size_t competitor) const;
};

// Rows of text, printed aligned, or separated by tabs.
class Table
{
    std::vector<std::vector<std::string>> rows;

  public:
    explicit Table(std::vector<std::string> head) { rows.push_back(std::move(head)); }
    void row(std::vector<std::string> cells) { rows.push_back(std::move(cells)); }
    void print(bool tsv) const;
};

// A whole number, "1e6" too; of anything else the program ends.
size_t whole(const std::string &text);

std::string number(double value, int decimals);

// Processor, compiler, flags, versions, date. With --format tsv as a comment.
void print_machine(bool tsv, const std::string &peer);

// A failed call of the library ends a benchmark.
[[noreturn]] void fail(const std::string &why);

} // namespace bench

#endif
