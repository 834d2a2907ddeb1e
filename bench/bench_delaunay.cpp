// bench_delaunay - the Delaunay triangulation of points, beside CGAL's, in one process: mw_delaunay makes a mesh, CGAL
// inserts the range of points. Freeing the result is not timed.
#include "harness.h"
#include "peer.h"

#include <meshwalk/meshwalk.h>

#include <cstdio>

namespace
{

using namespace bench;

double run_ours(const Coordinates &points, size_t &triangles)
{
    mw_mesh *mesh;
    mw_error error;
    Stopwatch watch;
    if (mw_delaunay(points.data(), points.size() / 2, 2, nullptr, nullptr, &mesh, &error) != MW_OK) fail(error.message);
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

void measure(const std::string &name, size_t size, const Options &options, Table &table)
{
    const Coordinates points = make_points(name, size, options.seed);
    const std::vector<Point> same = peer_points(points);
    size_t n = same.size(), triangles[2];
    Contest contest;
    size_t ours = contest.enter([&] { return run_ours(points, triangles[0]); });
    size_t peer = contest.enter([&] { return run_peer(same, triangles[1]); });
    contest.hold(options);
    if (triangles[0] != triangles[1])
        fail(name + ": " + std::to_string(triangles[0]) + " triangles, CGAL has " + std::to_string(triangles[1]));
    double scale = 1e9 / static_cast<double>(n);
    table.row({name, std::to_string(n), std::to_string(triangles[0]), number(scale * contest.median(ours), 1),
               number(scale * contest.least(ours), 1), number(scale * contest.median(peer), 1),
               number(scale * contest.least(peer), 1), number(contest.median(ours) / contest.median(peer), 3)});
}

} // namespace

int main(int argc, char **argv)
{
    Options defaults;
    defaults.sizes = {10000, 100000, 1000000};
    defaults.data = {"uniform", "grid", "gaussian", "clusters"};
    Options options = parse(argc, argv, defaults, "Delaunay triangulation beside CGAL, ns per point");
    print_machine(options.tsv, peer_version());
    Table table({"data", "points", "triangles", "meshwalk", "(least)", "CGAL", "(least)", "ratio"});
    for (const auto &name : options.data)
        for (size_t size : options.sizes) measure(name, size, options, table);
    table.print(options.tsv);
}
