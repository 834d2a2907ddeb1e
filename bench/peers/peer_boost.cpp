// peer_boost.cpp - Boost's R-tree over the boxes of the triangles, packed [Leutenegger, Lopez,
// Edgington 1997], and an exact orientation test of each triangle whose box holds the point.
#include "bench/peers/peer_list.h"
#include "bench/peers/peer_support.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <boost/function_output_iterator.hpp>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/version.hpp>
#pragma GCC diagnostic pop

#include <string>

namespace peer_boost
{
namespace
{

using namespace bench;

namespace bg = boost::geometry;
using BoostPoint = bg::model::point<double, 2, bg::cs::cartesian>;
using BoostBox = bg::model::box<BoostPoint>;
using BoostEntry = std::pair<BoostBox, uint32_t>;
using BoostTree = bg::index::rtree<BoostEntry, bg::index::rstar<16>>;

const char *version()
{
    static const std::string name = "Boost " + std::to_string(BOOST_VERSION / 100000) + "." +
                                    std::to_string(BOOST_VERSION / 100 % 1000) + "." +
                                    std::to_string(BOOST_VERSION % 100);
    return name.c_str();
}

BoostBox box_of(const engine_mesh &mesh, size_t triangle)
{
    const uint32_t *v = mesh.triangles + 3 * triangle;
    double low[2], high[2];
    for (size_t k = 0; k < 2; k++) {
        auto [least, most] =
            std::minmax({mesh.points[2 * size_t(v[0]) + k], mesh.points[2 * size_t(v[1]) + k],
                         mesh.points[2 * size_t(v[2]) + k]});
        low[k] = least;
        high[k] = most;
    }
    return BoostBox(BoostPoint(low[0], low[1]), BoostPoint(high[0], high[1]));
}

struct BoostBoxes {
    engine_mesh mesh;
    BoostTree tree;
    size_t bytes = 0;

    explicit BoostBoxes(const engine_mesh &of) : mesh(of)
    {
        std::vector<BoostEntry> entries(mesh.triangle_count);
        for (size_t t = 0; t < mesh.triangle_count; t++)
            entries[t] = {box_of(mesh, t), static_cast<uint32_t>(t)};
        tree = BoostTree(entries.begin(), entries.end());
    }
};

uint64_t find(const BoostBoxes &boxes, const double *query)
{
    uint64_t answer = ENGINE_NONE;
    auto look = [&](const BoostEntry &entry) {
        if (answer == ENGINE_NONE && triangle_contains(boxes.mesh, entry.second, query))
            answer = entry.second;
    };
    boxes.tree.query(bg::index::intersects(BoostPoint(query[0], query[1])),
                     boost::make_function_output_iterator(look));
    return answer;
}

double locate(void *self, const double *queries, size_t n, unsigned threads, uint64_t *answers)
{
    const BoostBoxes &boxes = *static_cast<const BoostBoxes *>(self);
    Stopwatch watch;
    in_parts(n, threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; i++) answers[i] = find(boxes, queries + 2 * i);
    });
    return watch.seconds();
}

} // namespace
} // namespace peer_boost

const engine_code *peer_boost_engine(engine_id id)
{
    using namespace peer_boost;
    static const engine_structure tree = {version, BuiltStructure<BoostBoxes>::build,
                                          BuiltStructure<BoostBoxes>::bytes, nullptr,
                                          BuiltStructure<BoostBoxes>::destroy};
    static const engine_code code = {&tree, locate, nullptr};
    return id == ENGINE_BOOST ? &code : nullptr;
}
