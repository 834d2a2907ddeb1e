// cgal.h - CGAL's Delaunay triangulation and hierarchy, with exact predicates. For the peers and
// the programs.
#ifndef MW_BENCH_CORE_CGAL_H
#define MW_BENCH_CORE_CGAL_H

#include <cstddef>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/version.h>
#pragma GCC diagnostic pop

namespace bench
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;
using DelaunayHierarchy = CGAL::Triangulation_hierarchy_2<CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_hierarchy_vertex_base_2<
                                                     CGAL::Triangulation_vertex_base_2<Kernel>>,
                                                 CGAL::Triangulation_face_base_2<Kernel>>>>;

inline const char *cgal_version()
{
    return "CGAL " CGAL_VERSION_STR;
}

// x0 y0 x1 y1 ...
inline std::vector<Point> cgal_points(const double *coordinates, size_t n)
{
    std::vector<Point> points;
    points.reserve(n);
    for (size_t i = 0; i < n; i++) points.emplace_back(coordinates[2 * i], coordinates[2 * i + 1]);
    return points;
}

inline std::vector<Point> cgal_points(const std::vector<double> &coordinates)
{
    return cgal_points(coordinates.data(), coordinates.size() / 2);
}

} // namespace bench

#endif
