// peer_embree.cpp - Embree: the mesh lies in the plane z = 0, and rays come down from z = 1. Single
// precision: what goes in is moved by the middle of the mesh, then rounded.
#include "bench/core/embree_device.h"
#include "bench/peers/peer_list.h"
#include "bench/peers/peer_support.h"
#include "bench/peers/spatial_order.h"

#include <limits>
#include <memory>

namespace peer_embree
{
namespace
{

using namespace bench;

class EmbreePlane
{
    EmbreeDevice device;
    RTCGeometry geometry;
    double middle[2];

    float rounded(double value, size_t k) const { return static_cast<float>(value - middle[k]); }

    void fill(const engine_mesh &mesh)
    {
        auto *xyz = static_cast<float *>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.point_count));
        void *triangles =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(uint32_t), mesh.triangle_count);
        if (!xyz || !triangles) throw std::bad_alloc();
        for (size_t i = 0; i < mesh.point_count; i++) {
            for (size_t k = 0; k < 2; k++) xyz[3 * i + k] = rounded(mesh.points[2 * i + k], k);
            xyz[3 * i + 2] = 0;
        }
        std::copy(mesh.triangles, mesh.triangles + 3 * mesh.triangle_count,
                  static_cast<uint32_t *>(triangles));
    }

    void find_middle(const engine_mesh &mesh)
    {
        for (size_t k = 0; k < 2; k++) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (size_t i = k; i < 2 * mesh.point_count; i += 2) {
                low = std::min(low, mesh.points[i]);
                high = std::max(high, mesh.points[i]);
            }
            middle[k] = low / 2 + high / 2;
        }
    }

  public:
    RTCScene scene;

    EmbreePlane(const engine_mesh &mesh, unsigned threads)
        : device(threads, nullptr), geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)),
          scene(rtcNewScene(device))
    {
        find_middle(mesh);
        fill(mesh);
        rtcSetSceneFlags(scene,
                         RTC_SCENE_FLAG_ROBUST); // no ray is to slip through between triangles
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
            throw std::runtime_error("Embree has failed");
    }
    ~EmbreePlane()
    {
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
    }
    EmbreePlane(const EmbreePlane &) = delete;
    EmbreePlane &operator=(const EmbreePlane &) = delete;

    size_t bytes() const { return device.bytes(); }
    float x(const double *query) const { return rounded(query[0], 0); }
    float y(const double *query) const { return rounded(query[1], 1); }
};

double build(const engine_mesh *mesh, unsigned threads, void **self)
try {
    Stopwatch watch;
    *self = new EmbreePlane(*mesh, threads);
    return watch.seconds();
} catch (const std::exception &) {
    *self = nullptr;
    return ENGINE_FAILED;
}

size_t bytes(const void *self)
{
    return static_cast<const EmbreePlane *>(self)->bytes();
}

void destroy(void *self)
{
    delete static_cast<EmbreePlane *>(self);
}

RTCIntersectContext context_for(bool coherent)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

uint64_t answer_of(unsigned triangle)
{
    return triangle == RTC_INVALID_GEOMETRY_ID ? ENGINE_NONE : triangle;
}

double locate_single(void *self, const double *queries, size_t n, unsigned threads,
                     uint64_t *answers)
{
    const EmbreePlane &plane = *static_cast<const EmbreePlane *>(self);
    Stopwatch watch;
    in_parts(n, threads, [&](size_t begin, size_t end) {
        RTCIntersectContext context = context_for(false);
        for (size_t i = begin; i < end; i++) {
            RTCRayHit ray = {};
            ray.ray.org_x = plane.x(queries + 2 * i);
            ray.ray.org_y = plane.y(queries + 2 * i);
            ray.ray.org_z = 1;
            ray.ray.dir_z = -1;
            ray.ray.tfar = std::numeric_limits<float>::infinity();
            ray.ray.mask = ~0u;
            ray.hit.geomID = ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(plane.scene, &context, &ray);
            answers[i] = answer_of(ray.hit.primID);
        }
    });
    return watch.seconds();
}

constexpr size_t width = 8;

// The queries `number(i)` for i from `begin` to `end`.
template <class Number>
void locate_packets(const EmbreePlane &plane, const double *queries, size_t begin, size_t end,
                    bool coherent, const Number &number, uint64_t *answers)
{
    RTCIntersectContext context = context_for(coherent);
    RTCRayHit8 rays = {};
    for (size_t first = begin; first < end; first += width) {
        alignas(32) int valid[width];
        for (size_t k = 0; k < width; k++) {
            bool used = first + k < end;
            const double *query = queries + 2 * number(used ? first + k : first);
            valid[k] = used ? -1 : 0;
            rays.ray.org_x[k] = plane.x(query);
            rays.ray.org_y[k] = plane.y(query);
            rays.ray.org_z[k] = 1;
            rays.ray.dir_z[k] = -1;
            rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
            rays.ray.mask[k] = ~0u;
            rays.hit.geomID[k] = rays.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, plane.scene, &context, &rays);
        for (size_t k = 0; k < width && first + k < end; k++)
            answers[number(first + k)] = answer_of(rays.hit.primID[k]);
    }
}

double locate_in_packets(void *self, const double *queries, size_t n, unsigned threads,
                         bool coherent, uint64_t *answers)
{
    const EmbreePlane &plane = *static_cast<const EmbreePlane *>(self);
    Stopwatch watch;
    in_parts(n, threads, [&](size_t begin, size_t end) {
        locate_packets(
            plane, queries, begin, end, coherent, [](size_t i) { return i; }, answers);
    });
    return watch.seconds();
}

double locate_packets_any(void *self, const double *queries, size_t n, unsigned threads,
                          uint64_t *answers)
{
    return locate_in_packets(self, queries, n, threads, false, answers);
}

double locate_coherent(void *self, const double *queries, size_t n, unsigned threads,
                       uint64_t *answers)
{
    return locate_in_packets(self, queries, n, threads, true, answers);
}

double locate_sorted(void *self, const double *queries, size_t n, unsigned threads,
                     uint64_t *answers)
{
    const EmbreePlane &plane = *static_cast<const EmbreePlane *>(self);
    Stopwatch watch;
    std::unique_ptr<uint32_t[]> order(new (std::nothrow) uint32_t[n]);
    if (!order || !spatial_order(queries, n, order.get())) return ENGINE_FAILED;
    in_parts(n, threads, [&](size_t begin, size_t end) {
        locate_packets(
            plane, queries, begin, end, true, [&](size_t i) { return size_t(order[i]); }, answers);
    });
    return watch.seconds();
}

} // namespace
} // namespace peer_embree

const engine_code *peer_embree_engine(engine_id id)
{
    using namespace peer_embree;
    static const engine_structure tree = {embree_version, build, bytes, nullptr, destroy};
    static const engine_code single = {&tree, locate_single, nullptr},
                             packets = {&tree, locate_packets_any, nullptr};
    static const engine_code sorted = {&tree, locate_sorted, nullptr},
                             coherent = {&tree, locate_coherent, nullptr};
    switch (id) {
    case ENGINE_EMBREE_SINGLE: return &single;
    case ENGINE_EMBREE_PACKETS: return &packets;
    case ENGINE_EMBREE_SORTED: return &sorted;
    case ENGINE_EMBREE_COHERENT: return &coherent;
    default: return nullptr;
    }
}
