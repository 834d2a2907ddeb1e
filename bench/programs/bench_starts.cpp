// bench_starts - every way to choose the first triangle, one walk after it: time of a query alone
// and in a batch, triangles visited, and what the index costs that some starts need. One thread.
#include "bench/programs/location_runs.h"

#include <meshwalk/meshwalk.h>

namespace
{

using namespace bench;

struct StartsScene {
    Coordinates points, queries;
    mw_mesh *mesh = nullptr;
    mw_locator *locator = nullptr;
    mw_index *index[MW_START_COUNT] = {};

    StartsScene(const std::string &name, size_t size, const ProgramOptions &options)
        : points(make_points(name, size, options.seed)),
          queries(make_queries(points, options.queries, options.seed))
    {
        mw_error error;
        if (mw_delaunay(points.data(), points.size() / 2, 2, NULL, nullptr, nullptr, &mesh,
                        &error) != MW_OK ||
            mw_locator_create(mesh, nullptr, &locator, &error) != MW_OK)
            fail(error.message);
        for (int i = 0; i < MW_START_COUNT; i++) {
            auto start = static_cast<mw_start_kind>(i);
            if (mw_start_has_index(start) &&
                mw_index_create(locator, start, nullptr, &index[i], &error) != MW_OK)
                fail(error.message);
        }
    }
    ~StartsScene()
    {
        for (mw_index *one : index) mw_index_destroy(one);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
    StartsScene(const StartsScene &) = delete;
    StartsScene &operator=(const StartsScene &) = delete;
    size_t query_count() const { return queries.size() / 2; }
};

// How a start is asked for: sampling has two rules for the number of triangles.
struct StartRule {
    std::string name;
    mw_start_kind kind;
    uint32_t sample;
};

std::vector<StartRule> all_starts()
{
    std::vector<StartRule> starts;
    for (int kind = MW_START_AUTO; kind < MW_START_COUNT; kind++) {
        mw_start_kind start = static_cast<mw_start_kind>(kind);
        starts.push_back({mw_start_name(start), start, MW_SAMPLE_CUBE_ROOT_OF_VERTICES});
        if (start == MW_START_SAMPLE)
            starts.push_back({"sample, fourth root", start, MW_SAMPLE_FOURTH_ROOT_OF_VERTICES});
    }
    return starts;
}

mw_query_options how(const StartsScene &scene, mw_walk_kind walk, const StartRule &start,
                     bool count)
{
    mw_query_options options = {};
    options.walk = walk;
    options.start = start.kind;
    options.samples = start.sample;
    options.index = scene.index[start.kind];
    options.threads = 1;
    options.counters = count;
    return options;
}

// Whatever the start, the answers are the same.
void compare(const std::vector<mw_location> &found, const std::vector<mw_location> &expected,
             const StartRule &start)
{
    for (size_t i = 0; i < found.size(); i++)
        if (found[i].triangle != expected[i].triangle || found[i].where != expected[i].where)
            fail("query " + std::to_string(i) + ": another triangle from the start " + start.name);
}

void measure(const std::string &name, size_t size, mw_walk_kind walk, const ProgramOptions &options,
             TextTable &table)
{
    StartsScene scene(name, size, options);
    std::vector<mw_location> found(scene.query_count()), expected(scene.query_count());
    std::vector<StartRule> starts = all_starts();
    std::vector<size_t> single, batch;
    Competitors competitors;
    locate_in_batch(scene.locator, scene.queries, how(scene, walk, starts[0], false), expected);
    for (const StartRule &start : starts) {
        single.push_back(competitors.enter([&] {
            return locate_singly(scene.locator, scene.queries, how(scene, walk, start, false),
                                 found);
        }));
        batch.push_back(competitors.enter([&] {
            return locate_in_batch(scene.locator, scene.queries, how(scene, walk, start, false),
                                   found);
        }));
    }
    competitors.measure(options);
    for (size_t i = 0; i < starts.size(); i++) {
        mw_counters counters;
        mw_index_info info = {};
        double queries = static_cast<double>(scene.query_count());
        locate_in_batch(scene.locator, scene.queries, how(scene, walk, starts[i], true), found,
                        &counters);
        compare(found, expected, starts[i]);
        if (scene.index[starts[i].kind]) mw_index_describe(scene.index[starts[i].kind], &info);
        table.row({name, std::to_string(scene.points.size() / 2), mw_walk_name(walk),
                   starts[i].name, number(1e9 * competitors.median(single[i]) / queries, 0),
                   number(1e9 * competitors.median(batch[i]) / queries, 0),
                   number(static_cast<double>(counters.triangles_visited) / queries, 2),
                   std::to_string(info.bytes), number(1e3 * info.seconds, 1)});
    }
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.sizes = {10000, 100000, 1000000};
    defaults.data = {"uniform", "clusters"};
    defaults.queries = 20000;
    defaults.rounds = 5;
    defaults.walks = {"remembering"};
    ProgramOptions options =
        parse_options(argc, argv, defaults, "ways to choose the first triangle, ns per query");
    print_machine(options.tsv, "no peer");
    TextTable table({"data", "points", "walk", "start", "single", "batch", "triangles",
                     "index bytes", "built in ms"});
    for (const auto &name : options.data)
        for (size_t size : options.sizes)
            for (const auto &walk : options.walks) {
                mw_walk_kind kind = mw_walk_by_name(walk.c_str());
                if (kind == MW_WALK_COUNT) fail("no such walk: " + walk);
                measure(name, size, kind, options, table);
            }
    table.print(options.tsv);
}
