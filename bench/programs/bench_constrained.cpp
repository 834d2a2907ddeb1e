// bench_constrained - constrained Delaunay triangulation beside CGAL's, in one process:
// mw_constrained_delaunay makes a mesh of the whole hull, CGAL inserts the range of points with the
// pairs of their numbers. Freeing the result is not timed.
#include "bench/core/cgal.h"
#include "bench/programs/inputs.h"
#include "bench/programs/program.h"

#include <meshwalk/meshwalk.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace
{

using namespace bench;

using Constrained = CGAL::Constrained_Delaunay_triangulation_2<Kernel>;

struct ConstrainedScene {
    Coordinates points;
    std::vector<uint32_t> segments; // two numbers of points each
};

uint32_t add(ConstrainedScene &s, double x, double y)
{
    s.points.push_back(x);
    s.points.push_back(y);
    return static_cast<uint32_t>(s.points.size() / 2 - 1);
}

void join(ConstrainedScene &s, uint32_t a, uint32_t b)
{
    s.segments.push_back(a);
    s.segments.push_back(b);
}

double uniform(std::mt19937_64 &random)
{
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Points in any order, as a file may bring them.
void shuffle(ConstrainedScene &s, std::mt19937_64 &random)
{
    size_t n = s.points.size() / 2;
    std::vector<uint32_t> number(n);
    std::iota(number.begin(), number.end(), 0u);
    for (size_t i = n; i > 1; i--) std::swap(number[i - 1], number[random() % i]);
    Coordinates moved(2 * n);
    for (size_t i = 0; i < n; i++) {
        moved[2 * number[i]] = s.points[2 * i];
        moved[2 * number[i] + 1] = s.points[2 * i + 1];
    }
    s.points = moved;
    for (uint32_t &end : s.segments) end = number[end];
}

// A closed line round the origin with bays of all sizes, in polar coordinates: it does not meet
// itself.
ConstrainedScene coast(size_t n, size_t inside, std::mt19937_64 &random)
{
    ConstrainedScene s;
    std::vector<double> depth(20), phase(20);
    for (size_t k = 0; k < 20; k++) {
        depth[k] = 0.5 / std::pow(1.6, static_cast<double>(k));
        phase[k] = 6.283185307179586 * uniform(random);
    }
    auto radius = [&](double angle) {
        double r = 2;
        for (size_t k = 0; k < 20; k++)
            r += depth[k] *
                 std::sin(std::floor(std::pow(1.7, static_cast<double>(k))) * angle + phase[k]);
        return r;
    };
    for (size_t i = 0; i < n; i++) {
        double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n),
               r = radius(angle);
        add(s, r * std::cos(angle), r * std::sin(angle));
    }
    for (size_t i = 0; i < n; i++)
        join(s, static_cast<uint32_t>(i), static_cast<uint32_t>((i + 1) % n));
    while (s.points.size() < 2 * (n + inside)) {
        double x = 8 * uniform(random) - 4, y = 8 * uniform(random) - 4;
        if (std::hypot(x, y) < radius(std::atan2(y, x))) add(s, x, y);
    }
    return s;
}

// Points, and segments of about `length` spacings between some of them: one per cell of a grid, so
// that none cross.
ConstrainedScene segments(size_t n, double length, std::mt19937_64 &random)
{
    ConstrainedScene s;
    size_t cells = static_cast<size_t>(std::sqrt(static_cast<double>(n)) / length);
    double side = 1 / static_cast<double>(cells);
    for (size_t i = 0; i < cells * cells; i++) {
        double x = side * static_cast<double>(i % cells), y = side * static_cast<double>(i / cells);
        uint32_t a = add(s, x + side * uniform(random), y + side * uniform(random));
        join(s, a, add(s, x + side * uniform(random), y + side * uniform(random)));
    }
    while (s.points.size() < 2 * n) add(s, uniform(random), uniform(random));
    shuffle(s, random);
    return s;
}

// Parcels: quadrilaterals that share their borders, with points along them.
ConstrainedScene parcels(size_t n, std::mt19937_64 &random)
{
    ConstrainedScene s;
    size_t side = static_cast<size_t>(std::sqrt(static_cast<double>(n) / 5));
    std::vector<uint32_t> corner;
    for (size_t i = 0; i < side * side; i++)
        corner.push_back(add(s, static_cast<double>(i % side) + 0.5 * uniform(random),
                             static_cast<double>(i / side) + 0.5 * uniform(random)));
    auto border = [&](uint32_t a, uint32_t b) {
        double x = s.points[2 * a], y = s.points[2 * a + 1], dx = s.points[2 * b] - x,
               dy = s.points[2 * b + 1] - y;
        uint32_t from = a;
        for (double t : {0.31, 0.67}) {
            uint32_t to = add(s, x + t * dx, y + t * dy);
            join(s, from, to);
            from = to;
        }
        join(s, from, b);
    };
    for (size_t i = 0; i < side * side; i++) {
        if (i % side + 1 < side) border(corner[i], corner[i + 1]);
        if (i / side + 1 < side) border(corner[i], corner[i + side]);
    }
    shuffle(s, random);
    return s;
}

// Few segments from one side of the points to the other.
ConstrainedScene across(size_t n, size_t lines, std::mt19937_64 &random)
{
    ConstrainedScene s;
    for (size_t i = 0; i < lines; i++) {
        double low = static_cast<double>(i) / static_cast<double>(lines),
               room = 0.9 / static_cast<double>(lines);
        uint32_t a = add(s, 0, low + room * uniform(random));
        join(s, a, add(s, 1, low + room * uniform(random)));
    }
    while (s.points.size() < 2 * n) add(s, uniform(random), uniform(random));
    shuffle(s, random);
    return s;
}

double run_ours(const ConstrainedScene &s, size_t &triangles)
{
    mw_constraints given = {};
    given.points = s.points.data();
    given.point_count = s.points.size() / 2;
    given.segments = s.segments.data();
    given.segment_count = s.segments.size() / 2;
    mw_mesh *mesh;
    mw_error error;
    mw_constrain_options one_thread = {};
    one_thread.threads = 1;
    Stopwatch watch;
    if (mw_constrained_delaunay(&given, &one_thread, nullptr, nullptr, nullptr, &mesh, &error) !=
        MW_OK)
        fail(error.message);
    double seconds = watch.seconds();
    triangles = mw_mesh_triangle_count(mesh);
    mw_mesh_destroy(mesh);
    return seconds;
}

double run_peer(const std::vector<Point> &points,
                const std::vector<std::pair<size_t, size_t>> &pairs, size_t &triangles)
{
    Constrained triangulation;
    Stopwatch watch;
    triangulation.insert_constraints(points.begin(), points.end(), pairs.begin(), pairs.end());
    double seconds = watch.seconds();
    triangles = triangulation.number_of_faces();
    return seconds;
}

// The triangulation of the points alone, to tell what the segments cost.
double run_plain(const ConstrainedScene &s)
{
    mw_mesh *mesh;
    mw_error error;
    mw_delaunay_options one_thread = {};
    one_thread.threads = 1;
    Stopwatch watch;
    if (mw_delaunay(s.points.data(), s.points.size() / 2, 2, &one_thread, nullptr, nullptr, &mesh,
                    &error) != MW_OK)
        fail(error.message);
    double seconds = watch.seconds();
    mw_mesh_destroy(mesh);
    return seconds;
}

void measure(const std::string &name, const ConstrainedScene &s, const ProgramOptions &options,
             TextTable &table)
{
    const std::vector<Point> points = cgal_points(s.points);
    std::vector<std::pair<size_t, size_t>> pairs;
    for (size_t i = 0; i < s.segments.size(); i += 2)
        pairs.emplace_back(s.segments[i], s.segments[i + 1]);
    size_t triangles[2];
    Competitors competitors;
    size_t ours = competitors.enter([&] { return run_ours(s, triangles[0]); });
    size_t peer = competitors.enter([&] { return run_peer(points, pairs, triangles[1]); });
    size_t plain = competitors.enter([&] { return run_plain(s); });
    competitors.measure(options);
    if (triangles[0] != triangles[1])
        fail(name + ": " + std::to_string(triangles[0]) + " triangles, CGAL has " +
             std::to_string(triangles[1]));
    table.row({name, std::to_string(points.size()), std::to_string(pairs.size()),
               number(1e3 * competitors.median(plain), 1),
               number(1e3 * competitors.median(ours), 1), number(1e3 * competitors.least(ours), 1),
               number(1e3 * competitors.median(peer), 1), number(1e3 * competitors.least(peer), 1),
               number(competitors.median(ours) / competitors.median(peer), 3)});
}

ConstrainedScene make(const std::string &name, std::mt19937_64 &random)
{
    if (name == "coast") return coast(100000, 0, random);
    if (name == "coast-filled") return coast(100000, 100000, random);
    if (name == "short") return segments(1000000, 2, random);
    if (name == "middling") return segments(1000000, 30, random);
    if (name == "parcels") return parcels(500000, random);
    if (name == "across") return across(1000000, 20, random);
    if (name == "bundle") return across(1000000, 2000, random);
    fail("no such scene: " + name);
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.rounds = 5;
    defaults.data = {"coast", "coast-filled", "short", "middling", "parcels", "across", "bundle"};
    ProgramOptions options = parse_options(
        argc, argv, defaults, "constrained triangulation beside CGAL, ms; --data: scenes");
    print_machine(options.tsv, cgal_version());
    TextTable table({"scene", "points", "segments", "Delaunay", "meshwalk", "(least)", "CGAL",
                     "(least)", "ratio"});
    for (const auto &name : options.data) {
        std::mt19937_64 random(options.seed);
        measure(name, make(name, random), options, table);
    }
    table.print(options.tsv);
}
