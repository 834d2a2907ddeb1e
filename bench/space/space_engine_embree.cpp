// space_engine_embree.cpp - Embree 3: a tree of boxes in single precision, with its robust flag.
// Rays come as doubles and are rounded within the time, as those who hold doubles have to.
#include "bench/core/embree_device.h"
#include "bench/core/stopwatch.h"
#include "bench/space/space_engine.h"
extern "C" {
#include "cli/frame/message.h"
}

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <vector>

namespace
{

using namespace bench;

enum Way { single, packets, stream };
enum Following { refit, rebuild, never };

// One tree over the triangles, which can be refitted, rebuilt quickly, or stays.
class Tree
{
    RTCScene scene;
    RTCGeometry geometry;
    float *vertices;
    size_t coordinates;

  public:
    Tree(const EmbreeDevice &device, const space_model *m, Following how)
        : scene(rtcNewScene(device)), geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)),
          coordinates(3 * m->point_count)
    {
        vertices = static_cast<float *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), m->point_count));
        void *triangles =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(uint32_t), m->triangle_count);
        show(m);
        std::copy(m->triangles, m->triangles + 3 * m->triangle_count,
                  static_cast<uint32_t *>(triangles));
        int flags = RTC_SCENE_FLAG_ROBUST;
        if (how != never) { // the quality of a geometry counts where that of the scene is low
            flags |= RTC_SCENE_FLAG_DYNAMIC;
            rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
            rtcSetGeometryBuildQuality(geometry, how == refit ? RTC_BUILD_QUALITY_REFIT
                                                              : RTC_BUILD_QUALITY_LOW);
        }
        rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(flags));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcCommitScene(scene);
    }
    ~Tree()
    {
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
    }
    Tree(const Tree &) = delete;
    Tree &operator=(const Tree &) = delete;
    operator RTCScene() const { return scene; }

    void show(const space_model *m)
    {
        std::transform(m->points, m->points + coordinates, vertices,
                       [](double x) { return static_cast<float>(x); });
    }
    void update()
    {
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry);
        rtcCommitScene(scene);
    }
};

// The tree as built; those that follow moves are made when first needed.
struct Scene {
    EmbreeDevice device;
    std::unique_ptr<Tree> tree[3];
    Following current = never;

    Scene(const space_model *m, unsigned threads) : device(threads)
    {
        tree[never].reset(new Tree(device, m, never));
    }
    RTCScene answering() const { return *tree[current]; }
};

const char *version()
{
    return embree_version();
}

void *build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    try {
        // The device, with the threads of its own, is there before the clock runs.
        std::unique_ptr<Scene> scene(new Scene(m, threads));
        scene->tree[never].reset();
        size_t before = scene->device.bytes();
        Stopwatch watch;
        scene->tree[never].reset(new Tree(scene->device, m, never));
        *seconds = watch.seconds();
        *bytes = scene->device.bytes() - before;
        return scene.release();
    } catch (const std::exception &e) {
        complain("Embree: %s", e.what());
        return nullptr;
    }
}

uint32_t found_triangle(unsigned geometry, unsigned triangle)
{
    return geometry == RTC_INVALID_GEOMETRY_ID ? SPACE_NOTHING : triangle;
}

RTCRayHit ray_of(const double *q)
{
    RTCRayHit r = {};
    r.ray.org_x = static_cast<float>(q[0]);
    r.ray.org_y = static_cast<float>(q[1]);
    r.ray.org_z = static_cast<float>(q[2]);
    r.ray.dir_x = static_cast<float>(q[3]);
    r.ray.dir_y = static_cast<float>(q[4]);
    r.ray.dir_z = static_cast<float>(q[5]);
    r.ray.tfar = INFINITY;
    r.ray.mask = ~0u;
    r.hit.geomID = r.hit.primID = RTC_INVALID_GEOMETRY_ID;
    return r;
}

void cast_single(RTCScene scene, RTCIntersectContext &context, const space_rays *rays,
                 uint32_t *found)
{
    for (size_t i = 0; i < rays->count; i++) {
        RTCRayHit r = ray_of(rays->ray + 6 * i);
        rtcIntersect1(scene, &context, &r);
        found[i] = found_triangle(r.hit.geomID, r.hit.primID);
    }
}

void cast_packets(RTCScene scene, RTCIntersectContext &context, const space_rays *rays,
                  uint32_t *found)
{
    for (size_t i = 0; i < rays->count; i += 8) {
        RTCRayHit8 p = {};
        alignas(32) int valid[8];
        for (size_t k = 0; k < 8; k++) {
            valid[k] = i + k < rays->count ? -1 : 0;
            RTCRayHit r = ray_of(rays->ray + 6 * (valid[k] ? i + k : i));
            p.ray.org_x[k] = r.ray.org_x;
            p.ray.org_y[k] = r.ray.org_y;
            p.ray.org_z[k] = r.ray.org_z;
            p.ray.dir_x[k] = r.ray.dir_x;
            p.ray.dir_y[k] = r.ray.dir_y;
            p.ray.dir_z[k] = r.ray.dir_z;
            p.ray.tfar[k] = r.ray.tfar;
            p.ray.mask[k] = r.ray.mask;
            p.hit.geomID[k] = p.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, scene, &context, &p);
        for (size_t k = 0; k < 8 && i + k < rays->count; k++)
            found[i + k] = found_triangle(p.hit.geomID[k], p.hit.primID[k]);
    }
}

void cast_stream(RTCScene scene, RTCIntersectContext &context, const space_rays *rays,
                 uint32_t *found)
{
    const size_t at_a_time = 1024;
    std::vector<RTCRayHit> some(at_a_time);
    for (size_t i = 0; i < rays->count; i += at_a_time) {
        size_t n = std::min(at_a_time, rays->count - i);
        for (size_t k = 0; k < n; k++) some[k] = ray_of(rays->ray + 6 * (i + k));
        rtcIntersect1M(scene, &context, some.data(), static_cast<unsigned>(n), sizeof some[0]);
        for (size_t k = 0; k < n; k++)
            found[i + k] = found_triangle(some[k].hit.geomID, some[k].hit.primID);
    }
}

double cast(void *self, unsigned way, const space_rays *rays, space_rays_kind kind, uint32_t,
            uint32_t *found)
{
    RTCScene scene = static_cast<Scene *>(self)->answering();
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (kind == SPACE_STREAM || kind == SPACE_SWEEP)
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    Stopwatch watch;
    if (way == single)
        cast_single(scene, context, rays, found);
    else if (way == packets)
        cast_packets(scene, context, rays, found);
    else
        cast_stream(scene, context, rays, found);
    return watch.seconds();
}

double follow(void *self, unsigned way, const space_model *m, size_t, double, uint32_t)
{
    Scene *scene = static_cast<Scene *>(self);
    std::unique_ptr<Tree> &tree = scene->tree[way];
    scene->current = static_cast<Following>(way);
    if (!tree) tree.reset(new Tree(scene->device, m, scene->current));
    tree->show(m);
    Stopwatch watch;
    tree->update();
    return watch.seconds();
}

void destroy(void *self)
{
    delete static_cast<Scene *>(self);
}

} // namespace

const space_engine space_engine_embree = {
    "Embree",
    {"single", "packets", "stream", nullptr},
    {"refit", "rebuild", nullptr, nullptr},
    false,
    false,
    0,
    0,
    version,
    build,
    cast,
    follow,
    destroy,
};
