// bench_regular - the regular triangulation of weighted points, beside CGAL's, in one process:
// both must have the same triangles and as many hidden points. Weights are random, up to the mean
// area of a point: one in seven uniform points is hidden. Freeing the result is not timed.
#include "bench/core/cgal.h"
#include "bench/programs/inputs.h"
#include "bench/programs/program.h"

#include <CGAL/Regular_triangulation_2.h>
#include <algorithm>
#include <cstdio>
#include <meshwalk/meshwalk.h>
#include <random>

namespace
{

using namespace bench;
using Regular = CGAL::Regular_triangulation_2<Kernel>;
using WeightedPoint = Regular::Weighted_point;

struct Result {
    size_t triangles, hidden;
};

double run_ours(const Coordinates &points, const Coordinates &weights, Result &result)
{
    mw_mesh *mesh;
    mw_error error;
    mw_kind_report report;
    mw_kind_options options = {};
    options.threads = 1;
    options.weights = weights.data();
    Stopwatch watch;
    if (mw_triangulate(MW_KIND_REGULAR, points.data(), weights.size(), 2, &options, nullptr,
                       &report, &mesh, &error) != MW_OK)
        fail(error.message);
    double seconds = watch.seconds();
    result = {mw_mesh_triangle_count(mesh), report.hidden + report.delaunay.duplicates};
    mw_mesh_destroy(mesh);
    return seconds;
}

double run_peer(const std::vector<WeightedPoint> &points, Result &result)
{
    Regular triangulation;
    Stopwatch watch;
    triangulation.insert(points.begin(), points.end());
    double seconds = watch.seconds();
    result = {triangulation.number_of_faces(), triangulation.number_of_hidden_vertices()};
    return seconds;
}

Coordinates make_weights(const Coordinates &points, uint64_t seed)
{
    double low[2] = {points[0], points[1]}, high[2] = {points[0], points[1]};
    for (size_t i = 0; i < points.size(); i++) {
        low[i % 2] = std::min(low[i % 2], points[i]);
        high[i % 2] = std::max(high[i % 2], points[i]);
    }
    size_t n = points.size() / 2;
    double area = (high[0] - low[0]) * (high[1] - low[1]) / static_cast<double>(n);
    std::mt19937_64 random(seed);
    Coordinates weights(n);
    for (double &weight : weights) weight = area * static_cast<double>(random() >> 11) * 0x1p-53;
    return weights;
}

void measure(const std::string &name, size_t size, const ProgramOptions &options, TextTable &table)
{
    const Coordinates points = make_points(name, size, options.seed);
    const Coordinates weights = make_weights(points, options.seed);
    std::vector<WeightedPoint> same;
    for (size_t i = 0; i < weights.size(); i++)
        same.emplace_back(Kernel::Point_2(points[2 * i], points[2 * i + 1]), weights[i]);
    Result results[2] = {};
    Competitors competitors;
    size_t ours = competitors.enter([&] { return run_ours(points, weights, results[0]); });
    size_t peer = competitors.enter([&] { return run_peer(same, results[1]); });
    competitors.measure(options);
    if (results[0].triangles != results[1].triangles || results[0].hidden != results[1].hidden)
        fail(name + ": " + std::to_string(results[0].triangles) + " triangles, " +
             std::to_string(results[0].hidden) + " hidden; CGAL has " +
             std::to_string(results[1].triangles) + ", " + std::to_string(results[1].hidden));
    double scale = 1e9 / static_cast<double>(weights.size());
    std::vector<std::string> row = {name, std::to_string(weights.size()),
                                    std::to_string(results[0].triangles),
                                    std::to_string(results[0].hidden)};
    for (size_t competitor : {ours, peer}) {
        row.push_back(number(scale * competitors.median(competitor), 1));
        row.push_back(number(scale * competitors.least(competitor), 1));
    }
    row.push_back(number(competitors.median(ours) / competitors.median(peer), 3));
    table.row(row);
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.sizes = {10000, 100000, 1000000};
    defaults.data = {"uniform", "grid", "gaussian", "clusters"};
    ProgramOptions options =
        parse_options(argc, argv, defaults, "regular triangulation beside CGAL, ns per point");
    print_machine(options.tsv, cgal_version());
    TextTable table({"data", "points", "triangles", "hidden", "meshwalk", "(least)", "CGAL",
                     "(least)", "ratio"});
    for (const auto &name : options.data)
        for (size_t size : options.sizes) measure(name, size, options, table);
    table.print(options.tsv);
}
