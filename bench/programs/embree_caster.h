// embree_caster.h - Embree, a ray caster: a tree of boxes over the triangles, in single precision.
// Everything goes in as doubles and is rounded here.
#ifndef MW_BENCH_PROGRAMS_EMBREE_CASTER_H
#define MW_BENCH_PROGRAMS_EMBREE_CASTER_H

#include "bench/core/embree_device.h"
#include "bench/programs/inputs.h"

#include <algorithm>
#include <limits>
#include <string>

namespace bench
{

// How a caster treats a surface that moves: built once and for all, or after each move fitted to
// it, or built anew quickly.
enum class Moving { never, refit, rebuild };

class EmbreeCaster
{
    RTCScene scene;
    RTCGeometry geometry;
    float *vertices;

  public:
    // Robust: rays are not to slip through between triangles. `filter`: NULL, or which hits count.
    EmbreeCaster(const EmbreeDevice &device, const Model &model,
                 RTCFilterFunctionN filter = nullptr, Moving moving = Moving::never)
        : scene(rtcNewScene(device)), geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE))
    {
        vertices = static_cast<float *>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), model.vertex_count()));
        void *triangles =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(uint32_t), model.triangle_count());
        set_points(model.points);
        std::copy(model.triangles.begin(), model.triangles.end(),
                  static_cast<uint32_t *>(triangles));
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        if (moving == Moving::never) {
            rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        } else { // the quality of a geometry counts where that of the scene is low
            rtcSetSceneFlags(
                scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
            rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
            rtcSetGeometryBuildQuality(geometry, moving == Moving::refit ? RTC_BUILD_QUALITY_REFIT
                                                                         : RTC_BUILD_QUALITY_LOW);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcCommitScene(scene);
    }
    ~EmbreeCaster()
    {
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
    }
    EmbreeCaster(const EmbreeCaster &) = delete;
    EmbreeCaster &operator=(const EmbreeCaster &) = delete;
    operator RTCScene() const { return scene; }

    // New coordinates of all vertices, and what then has to be done before the next ray.
    void set_points(const Coordinates &points)
    {
        std::transform(points.begin(), points.end(), vertices,
                       [](double x) { return static_cast<float>(x); });
    }
    void update()
    {
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(geometry);
        rtcCommitScene(scene);
    }
};

// The ray from a point along `sign` times a vector, at most `reach` of its lengths.
inline RTCRayHit ray_from(const double from[3], const double along[3], double sign = 1,
                          double reach = std::numeric_limits<double>::infinity())
{
    RTCRayHit ray = {};
    ray.ray.org_x = static_cast<float>(from[0]);
    ray.ray.org_y = static_cast<float>(from[1]);
    ray.ray.org_z = static_cast<float>(from[2]);
    ray.ray.dir_x = static_cast<float>(sign * along[0]);
    ray.ray.dir_y = static_cast<float>(sign * along[1]);
    ray.ray.dir_z = static_cast<float>(sign * along[2]);
    ray.ray.tfar = static_cast<float>(reach);
    ray.ray.mask = ~0u;
    ray.hit.geomID = ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

} // namespace bench

#endif
