// space_engine_cgal.cpp - CGAL's AABB tree, with exact predicates.
#include "bench/core/stopwatch.h"
#include "bench/space/space_engine.h"
extern "C" {
#include "cli/frame/message.h"
}

#include <array>
#include <exception>
#include <memory>
#include <vector>

#include <malloc.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>
#pragma GCC diagnostic pop

namespace
{

using bench::Stopwatch;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Scene {
    Triangles triangles;
    Tree tree;

    void make(const space_model *m)
    {
        auto corner = [m](size_t t, size_t k) {
            const double *p = m->points + 3 * static_cast<size_t>(m->triangles[3 * t + k]);
            return Kernel::Point_3(p[0], p[1], p[2]);
        };
        tree.clear();
        triangles.clear();
        triangles.reserve(m->triangle_count);
        for (size_t t = 0; t < m->triangle_count; t++)
            triangles.emplace_back(corner(t, 0), corner(t, 1), corner(t, 2));
        tree.rebuild(triangles.cbegin(), triangles.cend());
        tree.build();
    }
};

const char *version()
{
    return "CGAL " CGAL_VERSION_STR;
}

void *build(const space_model *m, uint32_t, double *seconds, size_t *bytes)
{
    try {
        auto in_use = [] {
            struct mallinfo2 info = mallinfo2();
            return info.uordblks + info.hblkhd;
        };
        size_t before = in_use();
        Stopwatch watch;
        std::unique_ptr<Scene> scene(new Scene);
        scene->make(m);
        *seconds = watch.seconds();
        *bytes = in_use() - before;
        return scene.release();
    } catch (const std::exception &e) {
        complain("CGAL: %s", e.what());
        return nullptr;
    }
}

double cast(void *self, unsigned, const space_rays *rays, space_rays_kind, uint32_t,
            uint32_t *found)
{
    const Scene *scene = static_cast<Scene *>(self);
    Stopwatch watch;
    for (size_t i = 0; i < rays->count; i++) {
        const double *r = rays->ray + 6 * i;
        Kernel::Ray_3 ray(Kernel::Point_3(r[0], r[1], r[2]), Kernel::Vector_3(r[3], r[4], r[5]));
        auto hit = scene->tree.first_intersected_primitive(ray);
        found[i] = hit ? static_cast<uint32_t>(*hit - scene->triangles.cbegin()) : SPACE_NOTHING;
    }
    return watch.seconds();
}

double follow(void *self, unsigned, const space_model *m, size_t, double, uint32_t)
{
    Stopwatch watch;
    static_cast<Scene *>(self)->make(m);
    return watch.seconds();
}

void destroy(void *self)
{
    delete static_cast<Scene *>(self);
}

} // namespace

const space_engine space_engine_cgal = {
    "CGAL",
    {"single", nullptr, nullptr, nullptr},
    {"rebuild", nullptr, nullptr, nullptr},
    false,
    false,
    0,
    2000000,
    version,
    build,
    cast,
    follow,
    destroy,
};
