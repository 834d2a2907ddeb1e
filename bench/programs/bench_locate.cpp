// bench_locate - location in a Delaunay triangulation, every walk from random triangles, beside
// CGAL's locate from random faces of the same triangulation; and, for queries that may be put in
// order, `auto` beside CGAL's locate from face to face along its own spatial order, the sorting
// timed. One thread. The answers of both are compared.
#include "bench/core/cgal.h"
#include "bench/programs/location_runs.h"

#include <meshwalk/meshwalk.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <random>

namespace
{

using namespace bench;

struct LocateScene {
    Coordinates points, queries;
    std::vector<Point> peer_queries;
    mw_mesh *mesh = nullptr;
    mw_locator *locator = nullptr;
    Delaunay peer;
    std::vector<Delaunay::Face_handle> faces;

    LocateScene(const std::string &name, size_t size, const ProgramOptions &options)
        : points(make_points(name, size, options.seed)),
          queries(make_queries(points, options.queries, options.seed)),
          peer_queries(cgal_points(queries))
    {
        mw_error error;
        if (mw_delaunay(points.data(), points.size() / 2, 2, NULL, nullptr, nullptr, &mesh,
                        &error) != MW_OK ||
            mw_locator_create(mesh, nullptr, &locator, &error) != MW_OK)
            fail(error.message);
        std::vector<Point> same = cgal_points(points);
        peer.insert(same.begin(), same.end());
        for (auto face : peer.finite_face_handles()) faces.push_back(face);
    }
    ~LocateScene()
    {
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
    }
    LocateScene(const LocateScene &) = delete;
    LocateScene &operator=(const LocateScene &) = delete;
    size_t query_count() const { return peer_queries.size(); }
};

mw_query_options how(mw_walk_kind walk, mw_start_kind start, int count)
{
    mw_query_options options = {};
    options.walk = walk;
    options.start = start;
    options.threads = 1;
    options.counters = count;
    return options;
}

using CgalFaces = std::vector<Delaunay::Face_handle>;

double run_peer_random(const LocateScene &scene, uint64_t seed, CgalFaces &found)
{
    std::mt19937_64 random(seed);
    size_t n = scene.faces.size();
    Stopwatch watch;
    for (size_t i = 0; i < found.size(); i++)
        found[i] = scene.peer.locate(scene.peer_queries[i], scene.faces[random() % n]);
    return watch.seconds();
}

double run_peer_sorted(const LocateScene &scene, CgalFaces &found)
{
    using Map = CGAL::Pointer_property_map<Point>::const_type;
    Stopwatch watch;
    std::vector<size_t> order(found.size());
    std::iota(order.begin(), order.end(), 0);
    CGAL::spatial_sort(
        order.begin(), order.end(),
        CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(Map(scene.peer_queries.data())));
    Delaunay::Face_handle face = scene.faces[0];
    for (size_t i : order) {
        face = scene.peer.locate(scene.peer_queries[i], face);
        found[i] = face;
    }
    return watch.seconds();
}

// Where both found the inside of a triangle, it has to be the same one.
void compare(const LocateScene &scene, const std::vector<mw_location> &ours,
             const CgalFaces &theirs)
{
    for (size_t i = 0; i < ours.size(); i++) {
        if (ours[i].where != MW_INSIDE || scene.peer.is_infinite(theirs[i])) {
            if (ours[i].where == MW_INSIDE ||
                (ours[i].where == MW_OUTSIDE && !scene.peer.is_infinite(theirs[i])))
                fail("query " + std::to_string(i) + ": one found it inside, one outside");
            continue;
        }
        uint32_t corners[3];
        std::array<Point, 3> a, b;
        mw_mesh_triangle(scene.mesh, ours[i].triangle, corners);
        for (size_t k = 0; k < 3; k++) {
            a[k] = Point(scene.points[2 * size_t(corners[k])],
                         scene.points[2 * size_t(corners[k]) + 1]);
            b[k] = theirs[i]->vertex(static_cast<int>(k))->point();
        }
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        if (a != b) fail("query " + std::to_string(i) + ": found in different triangles");
    }
}

struct LocateLine {
    std::string walk, start, way;
    size_t competitor;
    mw_counters counters;
    bool counted;
};

void print_lines(const std::string &name, const LocateScene &scene,
                 const std::vector<LocateLine> &lines, const Competitors &competitors,
                 TextTable &table)
{
    double queries = static_cast<double>(scene.query_count()), base = 0;
    for (const LocateLine &line : lines)
        if (line.walk == "CGAL" && line.start == "random")
            base = competitors.median(line.competitor);
    for (const LocateLine &line : lines) {
        double median = competitors.median(line.competitor);
        auto each = [&](uint64_t count) {
            return line.counted ? number(double(count) / queries, 2) : std::string("-");
        };
        table.row(
            {name, std::to_string(scene.points.size() / 2), line.walk, line.start, line.way,
             number(1e9 * median / queries, 1),
             number(1e9 * competitors.least(line.competitor) / queries, 1),
             number(median / base, 3), each(line.counters.triangles_visited),
             each(line.counters.orient_init + line.counters.orient + line.counters.orient_final)});
    }
}

void measure(const std::string &name, size_t size, const ProgramOptions &options, TextTable &table)
{
    LocateScene scene(name, size, options);
    std::vector<mw_location> found(scene.query_count());
    CgalFaces faces(scene.query_count());
    Competitors competitors;
    std::vector<LocateLine> lines;
    auto count = [&](mw_walk_kind walk, mw_start_kind start) {
        mw_counters counters;
        locate_in_batch(scene.locator, scene.queries, how(walk, start, 1), found, &counters);
        return counters;
    };
    auto enter = [&](mw_walk_kind walk, mw_start_kind start, bool batch) {
        size_t competitor = competitors.enter([=, &scene, &found] {
            return batch ? locate_in_batch(scene.locator, scene.queries, how(walk, start, 0), found)
                         : locate_singly(scene.locator, scene.queries, how(walk, start, 0), found);
        });
        lines.push_back({mw_walk_name(walk), mw_start_name(start), batch ? "batch" : "single",
                         competitor, count(walk, start), true});
    };
    for (const std::string &walk : options.walks)
        for (bool batch : {false, true}) {
            mw_walk_kind kind = mw_walk_by_name(walk.c_str());
            if (kind == MW_WALK_COUNT) fail("no such walk: " + walk);
            enter(kind, MW_START_RANDOM, batch);
        }
    enter(MW_WALK_AUTO, MW_START_AUTO, true);
    run_peer_random(scene, options.seed, faces);
    compare(scene, found, faces);
    lines.push_back({"CGAL",
                     "random",
                     "single",
                     competitors.enter([&] { return run_peer_random(scene, options.seed, faces); }),
                     {},
                     false});
    lines.push_back({"CGAL",
                     "sorted",
                     "single",
                     competitors.enter([&] { return run_peer_sorted(scene, faces); }),
                     {},
                     false});
    competitors.measure(options);
    print_lines(name, scene, lines, competitors, table);
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.sizes = {10000, 100000, 1000000};
    defaults.data = {"uniform"};
    defaults.queries = 5000;
#define MW_WALK_ENTRY(id, symbol, name, source, help) defaults.walks.push_back(name);
#include <meshwalk/walks.def>
    ProgramOptions options =
        parse_options(argc, argv, defaults, "point location beside CGAL, ns per query");
    print_machine(options.tsv, cgal_version());
    TextTable table({"data", "points", "walk", "start", "way", "ns/query", "(least)", "ratio",
                     "triangles", "tests"});
    for (const auto &name : options.data)
        for (size_t size : options.sizes) measure(name, size, options, table);
    table.print(options.tsv);
}
