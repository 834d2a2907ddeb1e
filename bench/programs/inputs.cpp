#include "bench/programs/inputs.h"

#include "bench/data/dataset.h"
#include "bench/data/dataset_file.h"
#include "bench/data/polyhedra.h"
#include "bench/programs/program.h"

#include <algorithm>
#include <cstdlib>

namespace bench
{

namespace
{

Model copy_model(const std::string &name, const double *points, size_t point_count,
                 const uint32_t *triangles, size_t triangle_count)
{
    return {name, Coordinates(points, points + 3 * point_count),
            std::vector<uint32_t>(triangles, triangles + 3 * triangle_count)};
}

Model model_of_file(const std::string &path)
{
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh(path.c_str(), NULL, &file, &error) != MW_OK) fail(error.message);
    Model model = copy_model(path.substr(path.find_last_of('/') + 1), file.points, file.point_count,
                             file.triangles, file.triangle_count);
    mw_mesh_file_release(&file);
    return model;
}

// The bits of three coordinates of 0 to 1, ten each, interleaved.
uint32_t morton(const double unit[3])
{
    uint32_t key = 0;
    for (int bit = 9; bit >= 0; bit--)
        for (int k = 0; k < 3; k++)
            key = key << 1 | (static_cast<uint32_t>(1023 * unit[k]) >> bit & 1);
    return key;
}

} // namespace

Coordinates make_points(const std::string &name, size_t n, uint64_t seed)
{
    dataset made;
    int kind = dataset_named(name.c_str());
    if (kind == DATASET_KINDS) {
        if (dataset_read(&made, name.c_str(), false) != 0) std::exit(1); // it has complained
    } else if (!dataset_make(&made, static_cast<dataset_kind>(kind), n, false, seed)) {
        fail("out of memory");
    }
    Coordinates points(made.points, made.points + 2 * std::min(n, made.count));
    dataset_release(&made);
    return points;
}

Coordinates make_queries(const Coordinates &points, size_t n, uint64_t seed)
{
    Coordinates copy = points, queries(2 * n);
    dataset extent = {};
    extent.points = copy.data();
    extent.count = copy.size() / 2;
    if (!dataset_bound(&extent, extent.count))
        fail("the extent of the points is too large for a double");
    uint64_t random = ~seed;
    dataset_draw(&extent, queries.data(), n, &random);
    return queries;
}

mw_arrays Model::arrays() const
{
    mw_arrays arrays = {};
    arrays.points = points.data();
    arrays.point_count = vertex_count();
    arrays.point_stride = 3;
    arrays.triangles = triangles.data();
    arrays.triangle_count = triangle_count();
    return arrays;
}

Model make_model(const std::string &name, uint64_t seed)
{
    size_t colon = name.rfind(':');
    for (int kind = 0; kind < POLYHEDRON_KINDS && colon != std::string::npos; kind++) {
        if (name.substr(0, colon) != polyhedron_name(kind)) continue;
        polyhedron made;
        mw_error error;
        if (polyhedron_make(&made, static_cast<polyhedron_kind>(kind),
                            whole(name.substr(colon + 1)), seed, &error) != MW_OK)
            fail(error.message);
        Model model = copy_model(polyhedron_name(kind), made.points, made.point_count,
                                 made.triangles, made.triangle_count);
        polyhedron_release(&made);
        return model;
    }
    return model_of_file(name);
}

Coordinates make_directions(size_t n, uint64_t seed)
{
    Coordinates directions(3 * n);
    uint64_t random = ~seed;
    for (size_t i = 0; i < n; i++) polyhedron_direction(&directions[3 * i], &random);
    return directions;
}

Coordinates in_morton_order(const Coordinates &points)
{
    auto extent = std::minmax_element(points.begin(), points.end());
    double low = *extent.first, size = *extent.second - low;
    std::vector<std::pair<uint32_t, size_t>> order;
    for (size_t i = 0; i < points.size(); i += 3) {
        const double unit[3] = {(points[i] - low) / size, (points[i + 1] - low) / size,
                                (points[i + 2] - low) / size};
        order.emplace_back(morton(unit), i);
    }
    std::sort(order.begin(), order.end());
    Coordinates sorted;
    for (const auto &one : order)
        for (size_t k = 0; k < 3; k++) sorted.push_back(points[one.second + k]);
    return sorted;
}

} // namespace bench
