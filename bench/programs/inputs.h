// inputs.h - what the programs measure with: sets of points, surfaces in space, queries.
#ifndef MW_BENCH_PROGRAMS_INPUTS_H
#define MW_BENCH_PROGRAMS_INPUTS_H

#include <meshwalk/meshwalk.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench
{

using Coordinates = std::vector<double>; // x0 y0 x1 y1 ...; in space x0 y0 z0 ...

// The sets of data/dataset.h by name: uniform, grid, gaussian, clusters, arcs, rectangle, rings,
// .... Any other name is a file of points, or a mesh whose vertices are taken, and n its largest
// number. Ends the program if there is no such file.
Coordinates make_points(const std::string &name, size_t n, uint64_t seed);

// n points, uniform in the extent of others.
Coordinates make_queries(const Coordinates &points, size_t n, uint64_t seed);

struct Model {
    std::string name;
    Coordinates points;
    std::vector<uint32_t> triangles;

    size_t vertex_count() const { return points.size() / 3; }
    size_t triangle_count() const { return triangles.size() / 3; }
    mw_arrays arrays() const;
};

// "star:100000" is a polyhedron of data/polyhedra.h (icosahedron, star, bumps, knot) of so many
// vertices; anything else the name of a file that the library reads. Ends the program if there is
// no such file.
Model make_model(const std::string &name, uint64_t seed);

// n directions, uniform on the unit sphere: x y z each.
Coordinates make_directions(size_t n, uint64_t seed);

// Points in an order in which neighbours are near each other (Morton's).
Coordinates in_morton_order(const Coordinates &points);

} // namespace bench

#endif
