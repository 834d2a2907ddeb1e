// peer.h - CGAL's Delaunay triangulation, with exact predicates.
#ifndef MW_BENCH_PEER_H
#define MW_BENCH_PEER_H

#include "bench/programs/datasets.h"

#include <string>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/version.h>
#pragma GCC diagnostic pop

namespace bench
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;

inline const char *peer_version()
{
    return "CGAL " CGAL_VERSION_STR;
}

inline std::vector<Point> peer_points(const double *coordinates, size_t n)
{
    std::vector<Point> points;
    points.reserve(n);
    for (size_t i = 0; i < n; i++) points.emplace_back(coordinates[2 * i], coordinates[2 * i + 1]);
    return points;
}

inline std::vector<Point> peer_points(const Coordinates &coordinates)
{
    return peer_points(coordinates.data(), coordinates.size() / 2);
}

} // namespace bench

#endif
