// models.h - the surfaces in space to measure with.
#ifndef MW_BENCH_MODELS_H
#define MW_BENCH_MODELS_H

#include "bench/programs/datasets.h"

#include <meshwalk/meshwalk.h>

namespace bench
{

struct Model {
    std::string name;
    Coordinates points; // x0 y0 z0 x1 y1 z1 ...
    std::vector<uint32_t> triangles;

    size_t vertex_count() const { return points.size() / 3; }
    size_t triangle_count() const { return triangles.size() / 3; }
    mw_arrays arrays() const;
};

// "star:100000" is a polyhedron of cli/polyhedra.h (icosahedron, star, bumps, knot) of so many vertices; anything else
// the name of a file that the library reads. Ends the program if there is no such file.
Model make_model(const std::string &name, uint64_t seed);

// n directions, uniform on the unit sphere: x y z each.
Coordinates make_directions(size_t n, uint64_t seed);

// Points in an order in which neighbours are near each other (Morton's).
Coordinates in_spatial_order(const Coordinates &points);

} // namespace bench

#endif
