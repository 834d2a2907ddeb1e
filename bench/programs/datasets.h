// datasets.h - the points to measure with.
#ifndef MW_BENCH_DATASETS_H
#define MW_BENCH_DATASETS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench
{

using Coordinates = std::vector<double>; // x0 y0 x1 y1 ...

// The sets of cli/datasets.h by name: uniform, grid, gaussian, clusters, arcs, rectangle, rings, .... Any other name is a file of points,
// and n its largest number. Ends the program if there is no such file.
Coordinates make_points(const std::string &name, size_t n, uint64_t seed);

// n points, uniform in the extent of others.
Coordinates make_queries(const Coordinates &points, size_t n, uint64_t seed);

} // namespace bench

#endif
