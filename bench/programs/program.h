// program.h - what the programs of this folder share: options, competitors in rounds, tables, the
// line about the machine.
#ifndef MW_BENCH_PROGRAMS_PROGRAM_H
#define MW_BENCH_PROGRAMS_PROGRAM_H

#include "bench/core/rounds.h"
#include "bench/core/stopwatch.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench
{

struct ProgramOptions {
    std::vector<size_t> sizes;      // --sizes 10000,100000: numbers of points
    std::vector<std::string> data;  // --data uniform,grid: sets of points, see inputs.h, or files
    std::vector<std::string> walks; // --walks straight,lawson (location)
    size_t queries = 0;             // --queries N (location)
    int rounds = 7, warmup = 1;     // --rounds N --warmup N
    unsigned threads = 1;           // --threads N: that build and fit (bench_star, bench_probe)
    uint64_t seed = 1;              // --seed S
    bool tsv = false;               // --format table|tsv
};

// Ends the program on --help and on wrong usage.
ProgramOptions parse_options(int argc, char **argv, const ProgramOptions &defaults,
                             const char *what_it_does);

// Competitors that do the same work, measured in the rounds of core/rounds.h.
class Competitors
{
    std::vector<std::function<double()>> runs;
    size_t leaders = 0;
    rounds_results results = {};

  public:
    Competitors() = default;
    ~Competitors() { rounds_release(&results); }
    Competitors(const Competitors &) = delete;
    Competitors &operator=(const Competitors &) = delete;

    // `run` does the work once and returns the seconds that count. Returns the number of the
    // competitor.
    size_t enter(std::function<double()> run);
    // What has to be done first in every round. Before all others.
    void lead(std::function<void()> run);
    void measure(int rounds, int warmup);
    void measure(const ProgramOptions &options) { measure(options.rounds, options.warmup); }
    double median(size_t competitor) const { return rounds_median(&results, competitor, 0); }
    double least(size_t competitor) const { return rounds_minimum(&results, competitor, 0); }
};

// Rows of text, printed aligned, or separated by tabs.
class TextTable
{
    std::vector<std::vector<std::string>> rows;

  public:
    explicit TextTable(std::vector<std::string> head) { rows.push_back(std::move(head)); }
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
