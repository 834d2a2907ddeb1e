// bench_delaunay - the Delaunay triangulation of points, beside CGAL's, in one process: mw_delaunay
// makes a mesh, CGAL inserts the range of points. Freeing the result is not timed. With --threads N
// ours once more on so many threads, which has to give the same triangles.
#include "bench/core/cgal.h"
#include "bench/programs/inputs.h"
#include "bench/programs/program.h"

#include <meshwalk/meshwalk.h>

#include <cstdio>

namespace
{

using namespace bench;

double run_ours(const Coordinates &points, unsigned threads, size_t &triangles)
{
    mw_mesh *mesh;
    mw_error error;
    mw_delaunay_options setup = {};
    setup.threads = threads;
    Stopwatch watch;
    if (mw_delaunay(points.data(), points.size() / 2, 2, &setup, nullptr, nullptr, &mesh, &error) !=
        MW_OK)
        fail(error.message);
    double seconds = watch.seconds();
    triangles = mw_mesh_triangle_count(mesh);
    mw_mesh_destroy(mesh);
    return seconds;
}

double run_peer(const std::vector<Point> &points, size_t &triangles)
{
    Delaunay triangulation;
    Stopwatch watch;
    triangulation.insert(points.begin(), points.end());
    double seconds = watch.seconds();
    triangles = triangulation.number_of_faces();
    return seconds;
}

void measure(const std::string &name, size_t size, const ProgramOptions &options, TextTable &table)
{
    const Coordinates points = make_points(name, size, options.seed);
    const std::vector<Point> same = cgal_points(points);
    size_t n = same.size(), triangles[3] = {};
    Competitors competitors;
    size_t ours = competitors.enter([&] { return run_ours(points, 1, triangles[0]); });
    size_t peer = competitors.enter([&] { return run_peer(same, triangles[1]); });
    size_t more = options.threads == 1 ? ours : competitors.enter([&] {
        return run_ours(points, options.threads, triangles[2]);
    });
    competitors.measure(options);
    if (triangles[0] != triangles[1] || (more != ours && triangles[2] != triangles[0]))
        fail(name + ": " + std::to_string(triangles[0]) + " triangles, CGAL has " +
             std::to_string(triangles[1]));
    double scale = 1e9 / static_cast<double>(n);
    std::vector<std::string> row = {name, std::to_string(n), std::to_string(triangles[0])};
    for (size_t competitor : {ours, peer}) {
        row.push_back(number(scale * competitors.median(competitor), 1));
        row.push_back(number(scale * competitors.least(competitor), 1));
    }
    row.push_back(number(competitors.median(ours) / competitors.median(peer), 3));
    if (more != ours) {
        row.push_back(number(scale * competitors.median(more), 1));
        row.push_back(number(scale * competitors.least(more), 1));
        row.push_back(number(competitors.median(more) / competitors.median(ours), 3));
    }
    table.row(row);
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.sizes = {10000, 100000, 1000000};
    defaults.data = {"uniform", "grid", "gaussian", "clusters"};
    ProgramOptions options =
        parse_options(argc, argv, defaults, "Delaunay triangulation beside CGAL, ns per point");
    print_machine(options.tsv, cgal_version());
    std::vector<std::string> head = {"data",    "points", "triangles", "meshwalk",
                                     "(least)", "CGAL",   "(least)",   "ratio"};
    if (options.threads > 1)
        for (const char *title : {"on threads", "(least)", "of one's time"}) head.push_back(title);
    TextTable table(head);
    for (const auto &name : options.data)
        for (size_t size : options.sizes) measure(name, size, options, table);
    table.print(options.tsv);
}
