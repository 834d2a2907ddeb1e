#include "bench/programs/program.h"
#include "bench/core/machine.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <meshwalk/base.h>

namespace bench
{

void fail(const std::string &why)
{
    std::fprintf(stderr, "bench: %s\n", why.c_str());
    std::exit(1);
}

size_t whole(const std::string &text)
{
    char *end;
    double value = std::strtod(text.c_str(), &end);
    if (*end || !(value >= 0 && value <= 1e9)) fail("not a number from 0 to 1e9: " + text);
    return static_cast<size_t>(value);
}

namespace
{

[[noreturn]] void usage(const char *program, const char *what_it_does, int status)
{
    std::fprintf(status ? stderr : stdout,
                 "%s: %s\n"
                 "  --sizes N,N,...     numbers of points\n"
                 "  --data NAME,...     uniform grid gaussian clusters arcs rectangle, or files; "
                 "of surfaces\n"
                 "                      icosahedron:N star:N bumps:N knot:N (vertices), or files\n"
                 "  --rounds N          rounds that count\n"
                 "  --warmup N          rounds before them that do not\n"
                 "  --seed S            of all random numbers\n"
                 "  --format table|tsv\n"
                 "only for location:\n"
                 "  --queries N         points to locate\n"
                 "  --walks NAME,...    walks to measure\n"
                 "only beside Embree:\n"
                 "  --threads N         that build and fit\n",
                 program, what_it_does);
    std::exit(status);
}

std::vector<std::string> split(const std::string &text)
{
    std::vector<std::string> parts;
    std::stringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

void set_option(ProgramOptions &o, const std::string &name, const std::string &value,
                const std::function<void()> &misuse)
{
    if (name == "--sizes") {
        o.sizes.clear();
        for (const auto &part : split(value)) o.sizes.push_back(whole(part));
    } else if (name == "--data") {
        o.data = split(value);
    } else if (name == "--walks") {
        o.walks = split(value);
    } else if (name == "--queries") {
        o.queries = std::max<size_t>(1, whole(value));
    } else if (name == "--rounds") {
        o.rounds = std::max(1, static_cast<int>(whole(value)));
    } else if (name == "--warmup") {
        o.warmup = static_cast<int>(whole(value));
    } else if (name == "--threads") {
        o.threads = std::max(1u, static_cast<unsigned>(whole(value)));
    } else if (name == "--seed") {
        o.seed = whole(value);
    } else if (name == "--format" && (value == "table" || value == "tsv")) {
        o.tsv = value == "tsv";
    } else {
        misuse();
    }
}

} // namespace

ProgramOptions parse_options(int argc, char **argv, const ProgramOptions &defaults,
                             const char *what_it_does)
{
    ProgramOptions options = defaults;
    for (int i = 1; i < argc; i += 2) {
        std::string name = argv[i];
        if (name == "--help") usage(argv[0], what_it_does, 0);
        if (i + 1 == argc) usage(argv[0], what_it_does, 2);
        set_option(options, name, argv[i + 1], [&] { usage(argv[0], what_it_does, 2); });
    }
    return options;
}

size_t Competitors::enter(std::function<double()> run)
{
    runs.push_back(std::move(run));
    return runs.size() - 1;
}

void Competitors::lead(std::function<void()> run)
{
    leaders++;
    enter([=] {
        run();
        return 0;
    });
}

void Competitors::measure(int rounds, int warmup)
{
    rounds_plan plan = {};
    plan.entries = runs.size();
    plan.leaders = leaders;
    plan.figures = 1;
    plan.warmups = static_cast<size_t>(warmup);
    plan.rounds = static_cast<size_t>(rounds);
    rounds_run *run = [](void *self, size_t entry, size_t, double *seconds) {
        *seconds = (*static_cast<std::vector<std::function<double()>> *>(self))[entry]();
        return 0;
    };
    if (rounds_measure(&plan, run, &runs, &results) != 0) std::exit(1); // it has complained
}

void TextTable::print(bool tsv) const
{
    std::vector<size_t> width(rows[0].size());
    for (const auto &cells : rows)
        for (size_t k = 0; k < cells.size(); k++) width[k] = std::max(width[k], cells[k].size());
    for (const auto &cells : rows)
        for (size_t k = 0; k < cells.size(); k++) {
            const char *end = k + 1 == cells.size() ? "\n" : tsv ? "\t" : "  ";
            int room = tsv ? 0 : static_cast<int>(width[k]);
            std::printf(k == 0 ? "%-*s%s" : "%*s%s", room, cells[k].c_str(), end);
        }
}

std::string number(double value, int decimals)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

void print_machine(bool tsv, const std::string &peer)
{
    char processor[256];
    machine_date_text date;
    machine_processor(processor, sizeof processor);
    machine_date(date);
#ifdef __clang__
    const char *compiler = "clang " __clang_version__;
#else
    const char *compiler = "gcc " __VERSION__;
#endif
    std::printf("%s%s, %u threads; %s, %s; meshwalk %s, %s; %s\n", tsv ? "# " : "", processor,
                std::thread::hardware_concurrency(), compiler, MW_BENCH_FLAGS, mw_version(),
                peer.c_str(), date);
}

} // namespace bench
