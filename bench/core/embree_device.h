// embree_device.h - Embree's device: the threads that build, and how much memory there is in use.
// For the peers and the programs.
#ifndef MW_BENCH_CORE_EMBREE_DEVICE_H
#define MW_BENCH_CORE_EMBREE_DEVICE_H

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace bench
{

inline const char *embree_version()
{
    return "Embree " RTC_VERSION_STRING;
}

class EmbreeDevice
{
    RTCDevice handle;
    std::atomic<ssize_t> in_use = 0;

  public:
    static void end_program(void *, RTCError, const char *why)
    {
        std::fprintf(stderr, "Embree: %s\n", why);
        std::exit(1);
    }

    // What goes wrong later is told to `report`; without one it waits for rtcGetDeviceError.
    explicit EmbreeDevice(unsigned threads, RTCErrorFunction report = end_program)
        : handle(rtcNewDevice(("threads=" + std::to_string(threads) + ",user_threads=0").c_str()))
    {
        if (!handle) throw std::runtime_error("Embree does not run here");
        if (report) rtcSetDeviceErrorFunction(handle, report, nullptr);
        rtcSetDeviceMemoryMonitorFunction(
            handle,
            [](void *self, ssize_t bytes, bool) {
                static_cast<EmbreeDevice *>(self)->in_use += bytes;
                return true;
            },
            this);
    }
    ~EmbreeDevice() { rtcReleaseDevice(handle); }
    EmbreeDevice(const EmbreeDevice &) = delete;
    EmbreeDevice &operator=(const EmbreeDevice &) = delete;
    operator RTCDevice() const { return handle; }
    size_t bytes() const { return static_cast<size_t>(in_use.load()); }
};

} // namespace bench

#endif
