// edit_engine_cgal.cpp - CGAL: its Delaunay triangulation and its hierarchy, whose points come, go
// and move.
#include "bench/core/cgal.h"
#include "bench/core/stopwatch.h"
#include "bench/edits/edit_engine.h"
#include "bench/edits/triangle_hash.h"

#include <exception>
#include <memory>
#include <numeric>

namespace edit_engine_cgal
{
namespace
{

using namespace bench;

// The numbers of points in an order of space.
using SpatialOrder =
    CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(CGAL::make_property_map(
                                                    std::declval<std::vector<Point> &>()))>;

template <class Triangulation> struct CgalEditing {
    Triangulation triangulation;
    std::vector<typename Triangulation::Vertex_handle> vertex; // by number
};

template <class Face> void corners_of(const Face &face, double *corners)
{
    for (int k = 0; k < 3; k++) {
        corners[2 * k] = face->vertex(k)->point().x();
        corners[2 * k + 1] = face->vertex(k)->point().y();
    }
}

// Points go in as CGAL has them fastest, all at once; then their vertices are looked up.
template <class Triangulation> void *build(const edit_script *s)
try {
    auto editor = std::make_unique<CgalEditing<Triangulation>>();
    std::vector<Point> points = cgal_points(s->points, s->point_count);
    std::vector<size_t> order(s->point_count);
    std::iota(order.begin(), order.end(), 0);
    CGAL::spatial_sort(order.begin(), order.end(), SpatialOrder(CGAL::make_property_map(points)));
    editor->vertex.reserve(s->point_count + s->inserted);
    editor->vertex.resize(s->point_count);
    typename Triangulation::Face_handle face;
    for (size_t i : order) {
        auto vertex = editor->vertex[i] = editor->triangulation.insert(points[i], face);
        face = vertex->face();
    }
    return editor.release();
} catch (const std::exception &) {
    return nullptr;
}

// CGAL sorts points given at once, too; those that come sorted it takes faster one by one, with
// hints.
template <class Triangulation> double insert_points(Triangulation &t, const edit_script *s)
{
    std::vector<Point> points;
    points.reserve(s->count);
    for (const edit_step *step = s->steps; step < s->steps + s->count; step++)
        points.emplace_back(step->point[0], step->point[1]);
    Stopwatch watch;
    t.insert(points.begin(), points.end());
    return watch.seconds();
}

template <class Triangulation> double run(void *self, const edit_script *s, double *corners)
try {
    auto &editor = *static_cast<CgalEditing<Triangulation> *>(self);
    Triangulation &t = editor.triangulation;
    typename Triangulation::Face_handle hint;
    if (s->at_once && !s->hinted) return insert_points(t, s);
    Stopwatch watch;
    for (const edit_step *step = s->steps; step < s->steps + s->count; step++) {
        Point p(step->point[0], step->point[1]);
        switch (step->kind) {
        case EDIT_STEP_INSERT: {
            auto vertex = s->hinted ? t.insert(p, hint) : t.insert(p);
            editor.vertex.push_back(vertex);
            hint = vertex->face();
            break;
        }
        case EDIT_STEP_REMOVE: t.remove(editor.vertex[step->vertex]); break;
        case EDIT_STEP_MOVE:
            editor.vertex[step->vertex] = t.move_if_no_collision(editor.vertex[step->vertex], p);
            break;
        case EDIT_STEP_LOCATE: {
            auto face = t.locate(p);
            if (!t.is_infinite(face)) corners_of(face, corners);
            corners += 6;
            break;
        }
        }
    }
    return watch.seconds();
} catch (const std::exception &) {
    return EDIT_ENGINE_FAILED;
}

template <class Triangulation> uint64_t hash(const void *self)
{
    uint64_t total = 0;
    double corners[6];
    for (auto face : static_cast<const CgalEditing<Triangulation> *>(self)
                         ->triangulation.finite_face_handles()) {
        corners_of(face, corners);
        total += triangle_hash(corners);
    }
    return total;
}

template <class Triangulation> void destroy(void *self)
{
    delete static_cast<CgalEditing<Triangulation> *>(self);
}

template <class Triangulation>
const edit_engine_code code = {build<Triangulation>, run<Triangulation>, hash<Triangulation>,
                               destroy<Triangulation>};

} // namespace
} // namespace edit_engine_cgal

const edit_engine_code *edit_engine_cgal_code(edit_engine_id id)
{
    using namespace edit_engine_cgal;
    return id == EDIT_ENGINE_CGAL             ? &code<Delaunay>
           : id == EDIT_ENGINE_CGAL_HIERARCHY ? &code<DelaunayHierarchy>
                                              : nullptr;
}
