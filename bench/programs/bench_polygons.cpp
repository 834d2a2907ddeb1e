// bench_polygons - point in polygon beside GEOS, in one process and on one thread: mw_polygons
// with a batch of mw_locate_batch, and GEOS's STRtree over the boxes of its polygons, each
// prepared. Both list all polygons that a point is in or on; the numbers of these have to agree.
#include "bench/programs/program.h"

#include <geos_c.h>
#include <meshwalk/meshwalk.h>

#include <cmath>
#include <memory>
#include <random>

namespace
{

using namespace bench;

struct PolygonScene {
    std::vector<std::vector<double>> rings; // x0 y0 x1 y1 ...: one for each polygon
    double low[2], high[2];                 // of the queries
};

double uniform(std::mt19937_64 &random)
{
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Quadrilaterals that share their borders, two points along each.
PolygonScene parcels(size_t side, std::mt19937_64 &random)
{
    PolygonScene s = {{}, {0, 0}, {static_cast<double>(side), static_cast<double>(side)}};
    std::vector<double> corner;
    for (size_t i = 0; i < (side + 1) * (side + 1); i++) {
        corner.push_back(static_cast<double>(i % (side + 1)) + 0.5 * uniform(random));
        corner.push_back(static_cast<double>(i / (side + 1)) + 0.5 * uniform(random));
    }
    // The points along a border are the same ones from both sides.
    auto along = [&](std::vector<double> &ring, size_t a, size_t b) {
        double shares[] = {0, 0.31, 0.67};
        for (int k = 0; k < 3; k++) {
            double t = a < b || k == 0 ? shares[k] : shares[3 - k];
            size_t from = a < b || k == 0 ? a : b, to = a < b || k == 0 ? b : a;
            for (size_t axis = 0; axis < 2; axis++)
                ring.push_back(corner[2 * from + axis] +
                               t * (corner[2 * to + axis] - corner[2 * from + axis]));
        }
    };
    for (size_t i = 0; i < side * side; i++) {
        size_t a = i / side * (side + 1) + i % side, b = a + 1, c = b + side + 1, d = a + side + 1;
        std::vector<double> ring;
        along(ring, a, b), along(ring, b, c), along(ring, c, d), along(ring, d, a);
        s.rings.push_back(ring);
    }
    return s;
}

// A closed line round a centre, with bays of all sizes.
std::vector<double> coast(size_t n, double x, double y, double size, std::mt19937_64 &random)
{
    std::vector<double> ring, phase(20);
    for (double &p : phase) p = 6.283185307179586 * uniform(random);
    for (size_t i = 0; i < n; i++) {
        double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n), r = 2;
        for (size_t k = 0; k < 20; k++)
            r += 0.5 / std::pow(1.6, static_cast<double>(k)) *
                 std::sin(std::floor(std::pow(1.7, static_cast<double>(k))) * angle + phase[k]);
        ring.push_back(x + size * r * std::cos(angle));
        ring.push_back(y + size * r * std::sin(angle));
    }
    return ring;
}

PolygonScene make(const std::string &name, std::mt19937_64 &random)
{
    if (name == "parcels") return parcels(200, random);
    if (name == "coast") return {{coast(100000, 0, 0, 1, random)}, {-4, -4}, {4, 4}};
    if (name == "overlaps") { // each over a hundred others
        PolygonScene s = {{}, {0, 0}, {100, 100}};
        for (int i = 0; i < 2000; i++) {
            double x = 100 * uniform(random), y = 100 * uniform(random);
            s.rings.push_back(coast(50, x, y, 2, random));
        }
        return s;
    }
    fail("no such scene: " + name);
}

// --- ours ---

struct Ours {
    mw_polygons *polygons = nullptr;
    mw_locator *locator = nullptr;
    std::vector<mw_location> at;

    ~Ours()
    {
        mw_locator_destroy(locator);
        mw_polygons_destroy(polygons);
    }
    double build(const PolygonScene &s)
    {
        std::vector<double> points;
        std::vector<uint32_t> segments, polygon;
        mw_error error;
        Stopwatch watch;
        for (size_t p = 0; p < s.rings.size(); p++) {
            auto first = static_cast<uint32_t>(points.size() / 2),
                 n = static_cast<uint32_t>(s.rings[p].size() / 2);
            points.insert(points.end(), s.rings[p].begin(), s.rings[p].end());
            for (uint32_t i = 0; i < n; i++) {
                segments.push_back(first + i);
                segments.push_back(first + (i + 1) % n);
                polygon.push_back(static_cast<uint32_t>(p));
            }
        }
        mw_constraints rings = {};
        rings.points = points.data();
        rings.point_count = points.size() / 2;
        rings.segments = segments.data();
        rings.segment_count = polygon.size();
        rings.polygon = polygon.data();
        mw_polygons_options options = {};
        mw_locator_options locating = {};
        options.threads = locating.threads = 1;
        if (mw_polygons_create(&rings, &options, &polygons, &error) != MW_OK ||
            mw_locator_create(mw_polygons_mesh(polygons), &locating, &locator, &error) != MW_OK)
            fail(error.message);
        return watch.seconds();
    }
    double query(const std::vector<double> &queries, size_t &hits)
    {
        size_t n = queries.size() / 2;
        mw_query_options options = {};
        mw_error error;
        mw_polygon_hit found[256];
        options.threads = 1;
        at.resize(n);
        hits = 0;
        Stopwatch watch;
        if (mw_locate_batch(locator, queries.data(), n, 2, &options, at.data(), nullptr, &error) !=
            MW_OK)
            fail(error.message);
        for (size_t i = 0; i < n; i++)
            hits += mw_polygons_at(polygons, &queries[2 * i], &at[i], found, 256);
        return watch.seconds();
    }
    size_t bytes() const
    {
        mw_polygons_info info;
        mw_locator_info located;
        mw_polygons_describe(polygons, &info);
        mw_locator_describe(locator, &located);
        return info.bytes + located.bytes + mw_mesh_bytes(mw_polygons_mesh(polygons));
    }
};

// --- GEOS ---

class Peer
{
    GEOSContextHandle_t handle = GEOS_init_r();
    GEOSSTRtree *tree = nullptr;
    std::vector<GEOSGeometry *> geometry;
    std::vector<const GEOSPreparedGeometry *> prepared;

    struct Search {
        const Peer *peer;
        const GEOSGeometry *point;
        size_t hits;
    };

    static void look(void *item, void *self)
    {
        Search &search = *static_cast<Search *>(self);
        auto *polygon = static_cast<const GEOSPreparedGeometry *>(item);
        if (GEOSPreparedIntersects_r(search.peer->handle, polygon, search.point) == 1)
            search.hits++;
    }

    void add(const std::vector<double> &ring)
    {
        std::vector<double> closed = ring;
        closed.push_back(ring[0]);
        closed.push_back(ring[1]);
        GEOSCoordSequence *line = GEOSCoordSeq_copyFromBuffer_r(
            handle, closed.data(), static_cast<unsigned>(closed.size() / 2), 0, 0);
        GEOSGeometry *shell = GEOSGeom_createLinearRing_r(handle, line);
        geometry.push_back(GEOSGeom_createPolygon_r(handle, shell, nullptr, 0));
        prepared.push_back(GEOSPrepare_r(handle, geometry.back()));
        GEOSSTRtree_insert_r(handle, tree, geometry.back(),
                             const_cast<GEOSPreparedGeometry *>(prepared.back()));
    }

  public:
    Peer() = default;
    Peer(const Peer &) = delete;
    Peer &operator=(const Peer &) = delete;
    ~Peer()
    {
        if (tree) GEOSSTRtree_destroy_r(handle, tree);
        for (auto *p : prepared) GEOSPreparedGeom_destroy_r(handle, p);
        for (auto *g : geometry) GEOSGeom_destroy_r(handle, g);
        GEOS_finish_r(handle);
    }

    // The first query of each polygon makes its index, that of the tree the tree.
    double build(const PolygonScene &s)
    {
        size_t hits = 0;
        Stopwatch watch;
        tree = GEOSSTRtree_create_r(handle, 10);
        for (const auto &ring : s.rings) add(ring);
        for (const auto &ring : s.rings) query({ring[0], ring[1]}, hits);
        return watch.seconds();
    }

    double query(const std::vector<double> &queries, size_t &hits)
    {
        Search search = {this, nullptr, 0};
        Stopwatch watch;
        for (size_t i = 0; i < queries.size(); i += 2) {
            GEOSGeometry *point = GEOSGeom_createPointFromXY_r(handle, queries[i], queries[i + 1]);
            search.point = point;
            GEOSSTRtree_query_r(handle, tree, point, look, &search);
            GEOSGeom_destroy_r(handle, point);
        }
        hits = search.hits;
        return watch.seconds();
    }
};

// --- all together ---

void measure(const std::string &name, const PolygonScene &s, const ProgramOptions &options,
             std::mt19937_64 &random, TextTable &table)
{
    std::vector<double> queries;
    for (size_t i = 0; i < 2 * options.queries; i++)
        queries.push_back(s.low[i % 2] + (s.high[i % 2] - s.low[i % 2]) * uniform(random));
    std::unique_ptr<Ours> ours;
    std::unique_ptr<Peer> peer;
    size_t hits[2], points = 0;
    for (const auto &ring : s.rings) points += ring.size() / 2;
    Competitors building, asking;
    size_t our_build =
        building.enter([&] { return ours = std::make_unique<Ours>(), ours->build(s); });
    size_t peer_build =
        building.enter([&] { return peer = std::make_unique<Peer>(), peer->build(s); });
    building.measure(options.rounds < 3 ? options.rounds : 3, 0);
    size_t our_query = asking.enter([&] { return ours->query(queries, hits[0]); });
    size_t peer_query = asking.enter([&] { return peer->query(queries, hits[1]); });
    asking.measure(options);
    if (hits[0] != hits[1])
        fail(name + ": " + std::to_string(hits[0]) + " hits, GEOS has " + std::to_string(hits[1]));
    double each = 1e9 / static_cast<double>(options.queries);
    table.row(
        {name, std::to_string(s.rings.size()), std::to_string(points),
         number(static_cast<double>(hits[0]) / static_cast<double>(options.queries), 2),
         number(static_cast<double>(ours->bytes()) / static_cast<double>(points), 0),
         number(1e3 * building.median(our_build), 1), number(1e3 * building.median(peer_build), 1),
         number(each * asking.median(our_query), 0), number(each * asking.median(peer_query), 0),
         number(asking.median(our_query) / asking.median(peer_query), 3)});
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.rounds = 5;
    defaults.queries = 100000;
    defaults.data = {"parcels", "coast", "overlaps"};
    ProgramOptions options = parse_options(
        argc, argv, defaults, "point in polygon beside GEOS; --data: scenes; --queries: points");
    print_machine(options.tsv, std::string("GEOS ") + GEOS_VERSION);
    TextTable table({"scene", "polygons", "points", "hits", "bytes/point", "build ms", "(GEOS)",
                     "ns/query", "(GEOS)", "ratio"});
    for (const auto &name : options.data) {
        std::mt19937_64 random(options.seed);
        measure(name, make(name, random), options, random, table);
    }
    table.print(options.tsv);
}
