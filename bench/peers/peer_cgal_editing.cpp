// peer_cgal_editing.cpp - CGAL: its Delaunay triangulation and its hierarchy,
// whose points come, go and move.
#include "bench/programs/harness.h"
#include "bench/programs/peer.h"
#include "bench/peers/peers.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <CGAL/Triangulation_hierarchy_2.h>
#pragma GCC diagnostic pop

#include <numeric>

namespace bench
{
namespace
{

using Levels = CGAL::Triangulation_hierarchy_2<CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<Kernel>>,
                CGAL::Triangulation_face_base_2<Kernel>>>>;

// The numbers of points in an order of space.
using Order =
    CGAL::Spatial_sort_traits_adapter_2<Kernel,
                                        decltype(CGAL::make_property_map(std::declval<std::vector<Point> &>()))>;

template <class Triangulation> struct Editor {
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

// Points go in as CGAL has them fastest, all at once; then their vertices are
// looked up.
template <class Triangulation> void *build(const script *s)
try {
    auto editor = std::make_unique<Editor<Triangulation>>();
    std::vector<Point> points = peer_points(s->points, s->point_count);
    std::vector<size_t> order(s->point_count);
    std::iota(order.begin(), order.end(), 0);
    CGAL::spatial_sort(order.begin(), order.end(), Order(CGAL::make_property_map(points)));
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

// CGAL sorts points given at once, too; those that come sorted it takes faster
// one by one, with hints.
template <class Triangulation> double insert_points(Triangulation &t, const script *s)
{
    std::vector<Point> points;
    points.reserve(s->count);
    for (const script_step *step = s->steps; step < s->steps + s->count; step++)
        points.emplace_back(step->point[0], step->point[1]);
    Stopwatch watch;
    t.insert(points.begin(), points.end());
    return watch.seconds();
}

template <class Triangulation> double run(void *self, const script *s, double *corners)
try {
    auto &editor = *static_cast<Editor<Triangulation> *>(self);
    Triangulation &t = editor.triangulation;
    typename Triangulation::Face_handle hint;
    if (s->at_once && !s->hinted) return insert_points(t, s);
    Stopwatch watch;
    for (const script_step *step = s->steps; step < s->steps + s->count; step++) {
        Point p(step->point[0], step->point[1]);
        switch (step->kind) {
        case SCRIPT_INSERT: {
            auto vertex = s->hinted ? t.insert(p, hint) : t.insert(p);
            editor.vertex.push_back(vertex);
            hint = vertex->face();
            break;
        }
        case SCRIPT_REMOVE: t.remove(editor.vertex[step->vertex]); break;
        case SCRIPT_MOVE: editor.vertex[step->vertex] = t.move_if_no_collision(editor.vertex[step->vertex], p); break;
        case SCRIPT_LOCATE: {
            auto face = t.locate(p);
            if (!t.is_infinite(face)) corners_of(face, corners);
            corners += 6;
            break;
        }
        }
    }
    return watch.seconds();
} catch (const std::exception &) {
    return EDITING_FAILED;
}

template <class Triangulation> uint64_t sum(const void *self)
{
    uint64_t sum = 0;
    double corners[6];
    for (auto face : static_cast<const Editor<Triangulation> *>(self)->triangulation.finite_face_handles()) {
        corners_of(face, corners);
        sum += editing_sum(corners);
    }
    return sum;
}

template <class Triangulation> void destroy(void *self)
{
    delete static_cast<Editor<Triangulation> *>(self);
}

template <class Triangulation>
const editing_code code = {peer_version, build<Triangulation>, run<Triangulation>, sum<Triangulation>,
                           destroy<Triangulation>};

} // namespace

const editing_code *cgal_editor(editor_id id)
{
    return id == EDITOR_CGAL ? &code<Delaunay> : id == EDITOR_CGAL_HIERARCHY ? &code<Levels> : nullptr;
}

} // namespace bench
