// device.h - Embree's device: the threads that build, and how much memory there is in use.
#ifndef MW_BENCH_DEVICE_H
#define MW_BENCH_DEVICE_H

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace bench
{

inline const char *caster_version()
{
    return "Embree " RTC_VERSION_STRING;
}

class Device
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
    explicit Device(unsigned threads, RTCErrorFunction report = end_program)
        : handle(rtcNewDevice(("threads=" + std::to_string(threads) + ",user_threads=0").c_str()))
    {
        if (!handle) throw std::runtime_error("Embree does not run here");
        if (report) rtcSetDeviceErrorFunction(handle, report, nullptr);
        rtcSetDeviceMemoryMonitorFunction(
            handle,
            [](void *self, ssize_t bytes, bool) {
                static_cast<Device *>(self)->in_use += bytes;
                return true;
            },
            this);
    }
    ~Device() { rtcReleaseDevice(handle); }
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;
    operator RTCDevice() const { return handle; }
    size_t bytes() const { return static_cast<size_t>(in_use.load()); }
};

} // namespace bench

#endif
