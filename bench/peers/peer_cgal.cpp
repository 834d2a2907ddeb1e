// peer_cgal.cpp - CGAL: locates in its own Delaunay triangulation of the points, in which an answer
// is the address of a face. Predicates are exact.
#include "bench/core/cgal.h"
#include "bench/peers/peer_list.h"
#include "bench/peers/peer_support.h"

#include <cmath>
#include <numeric>
#include <random>

namespace peer_cgal
{
namespace
{

using namespace bench;

// A triangulation, and the memory that it took.
template <class Triangulation> struct CgalBuilt {
    Triangulation triangulation;
    size_t bytes = 0;
    std::vector<typename Triangulation::Face_handle> sample; // random faces for jump and walk
};

using CgalPlain = CgalBuilt<Delaunay>;

template <class Triangulation>
double insert(CgalBuilt<Triangulation> &built, const double *coordinates, size_t n)
{
    std::vector<Point> points = cgal_points(coordinates, n);
    size_t before = heap_bytes();
    Stopwatch watch;
    built.triangulation.insert(points.begin(), points.end());
    double seconds = watch.seconds();
    built.bytes = heap_growth(before);
    return seconds;
}

// As many faces as the cube root of the vertices [Devroye, Muecke, Zhu 1998].
template <class Triangulation> void take_sample(CgalBuilt<Triangulation> &built)
{
    std::mt19937_64 random(1);
    std::vector<typename Triangulation::Face_handle> faces;
    for (auto face : built.triangulation.finite_face_handles()) faces.push_back(face);
    auto n = static_cast<size_t>(std::cbrt(double(built.triangulation.number_of_vertices())));
    for (size_t i = 0; i < std::max<size_t>(1, n) && !faces.empty(); i++)
        built.sample.push_back(faces[random() % faces.size()]);
}

template <class Triangulation> double build(const engine_mesh *mesh, unsigned, void **self)
try {
    auto built = std::make_unique<CgalBuilt<Triangulation>>();
    double seconds = insert(*built, mesh->points, mesh->point_count);
    take_sample(*built);
    *self = built.release();
    return seconds;
} catch (const std::exception &) {
    *self = nullptr;
    return ENGINE_FAILED;
}

template <class Triangulation> size_t bytes(const void *self)
{
    return static_cast<const CgalBuilt<Triangulation> *>(self)->bytes;
}

template <class Triangulation> void destroy(void *self)
{
    delete static_cast<CgalBuilt<Triangulation> *>(self);
}

template <class Triangulation> void corners(const void *, uint64_t answer, double xy[6])
{
    auto *face = reinterpret_cast<const typename Triangulation::Face *>(answer);
    for (int k = 0; k < 3; k++) {
        xy[2 * k] = face->vertex(k)->point().x();
        xy[2 * k + 1] = face->vertex(k)->point().y();
    }
}

// What surrounds the convex hull are faces, too.
template <class Triangulation>
void take_infinite(const Triangulation &t, size_t n, uint64_t *answers)
{
    for (size_t i = 0; i < n; i++) {
        auto *face = reinterpret_cast<const typename Triangulation::Face *>(answers[i]);
        for (int k = 0; k < 3 && answers[i] != ENGINE_NONE; k++)
            if (face->vertex(k) == t.infinite_vertex()) answers[i] = ENGINE_NONE;
    }
}

Point point(const double *queries, size_t i)
{
    return Point(queries[2 * i], queries[2 * i + 1]);
}

template <class Face> uint64_t address(Face face)
{
    return reinterpret_cast<uint64_t>(&*face);
}

// locate(i) is the face of query i.
template <class Triangulation, class Locate>
double locate_each(const Triangulation &t, size_t n, uint64_t *answers, const Locate &locate)
{
    Stopwatch watch;
    for (size_t i = 0; i < n; i++) answers[i] = address(locate(i));
    double seconds = watch.seconds();
    take_infinite(t, n, answers);
    return seconds;
}

template <class Triangulation>
double locate_plainly(void *self, const double *queries, size_t n, unsigned, uint64_t *answers)
{
    const Triangulation &t = static_cast<CgalBuilt<Triangulation> *>(self)->triangulation;
    return locate_each(t, n, answers, [&](size_t i) { return t.locate(point(queries, i)); });
}

double locate_last(void *self, const double *queries, size_t n, unsigned, uint64_t *answers)
{
    const Delaunay &t = static_cast<CgalPlain *>(self)->triangulation;
    Delaunay::Face_handle face = t.infinite_face();
    return locate_each(t, n, answers,
                       [&](size_t i) { return face = t.locate(point(queries, i), face); });
}

double locate_jumping(void *self, const double *queries, size_t n, unsigned, uint64_t *answers)
{
    const CgalPlain &built = *static_cast<CgalPlain *>(self);
    return locate_each(built.triangulation, n, answers, [&](size_t i) {
        Point query = point(queries, i);
        auto distance = [&](Delaunay::Face_handle face) {
            const Point &p = face->vertex(0)->point();
            double dx = p.x() - query.x(), dy = p.y() - query.y();
            return dx * dx + dy * dy;
        };
        Delaunay::Face_handle nearest;
        double least = std::numeric_limits<double>::infinity();
        for (Delaunay::Face_handle face : built.sample) {
            double d = distance(face);
            if (d < least) {
                least = d;
                nearest = face;
            }
        }
        return built.triangulation.locate(query, nearest);
    });
}

// The points of numbers, for CGAL's sort.
struct NumberedQueries {
    using key_type = size_t;
    using value_type = Point;
    using reference = Point;
    using category = boost::readable_property_map_tag;
    const double *queries;
    friend Point get(const NumberedQueries &map, size_t i) { return point(map.queries, i); }
};

double locate_sorted(void *self, const double *queries, size_t n, unsigned, uint64_t *answers)
{
    const Delaunay &t = static_cast<CgalPlain *>(self)->triangulation;
    Stopwatch watch;
    std::vector<size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    CGAL::hilbert_sort(
        order.begin(), order.end(),
        CGAL::Spatial_sort_traits_adapter_2<Kernel, NumberedQueries>(NumberedQueries{queries}));
    Delaunay::Face_handle face = t.infinite_face();
    for (size_t i : order) {
        face = t.locate(point(queries, i), face);
        answers[i] = address(face);
    }
    double seconds = watch.seconds();
    take_infinite(t, n, answers);
    return seconds;
}

double triangulate(const double *points, size_t n, unsigned, size_t *size)
try {
    CgalPlain built;
    double seconds = insert(built, points, n);
    *size = built.bytes;
    return seconds;
} catch (const std::exception &) {
    return ENGINE_FAILED;
}

} // namespace
} // namespace peer_cgal

const engine_code *peer_cgal_engine(engine_id id)
{
    using namespace peer_cgal;
    static const engine_structure plain = {cgal_version, build<Delaunay>, bytes<Delaunay>,
                                           corners<Delaunay>, destroy<Delaunay>};
    static const engine_structure levels = {cgal_version, build<DelaunayHierarchy>,
                                            bytes<DelaunayHierarchy>, corners<DelaunayHierarchy>,
                                            destroy<DelaunayHierarchy>};
    static const engine_code alone = {&plain, nullptr, triangulate};
    static const engine_code hierarchy = {&levels, locate_plainly<DelaunayHierarchy>, nullptr};
    static const engine_code walk = {&plain, locate_plainly<Delaunay>, nullptr};
    static const engine_code jump = {&plain, locate_jumping, nullptr};
    static const engine_code sorted = {&plain, locate_sorted, nullptr};
    static const engine_code last = {&plain, locate_last, nullptr};
    switch (id) {
    case ENGINE_CGAL: return &alone;
    case ENGINE_CGAL_HIERARCHY: return &hierarchy;
    case ENGINE_CGAL_WALK: return &walk;
    case ENGINE_CGAL_JUMP: return &jump;
    case ENGINE_CGAL_SORTED: return &sorted;
    case ENGINE_CGAL_LAST: return &last;
    default: return nullptr;
    }
}
