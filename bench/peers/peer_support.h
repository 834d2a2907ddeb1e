// peer_support.h - what the peers of 'meshwalk bench peers' share: memory that a library takes,
// queries for several threads, and a structure that a constructor builds.
#ifndef MW_BENCH_PEERS_PEER_SUPPORT_H
#define MW_BENCH_PEERS_PEER_SUPPORT_H

#include "bench/core/stopwatch.h"
#include "bench/peers/engine.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <malloc.h>
#include <thread>
#include <vector>

namespace bench
{

// Memory in use, of libraries that do not tell how much they take; and how much more it is than
// before.
inline size_t heap_bytes()
{
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}
inline size_t heap_growth(size_t before)
{
    return std::max(heap_bytes(), before) - before;
}

// Call work(begin, end) for parts of 0 to n, on so many threads.
template <class Work> void in_parts(size_t n, unsigned threads, const Work &work)
{
    std::vector<std::thread> others;
    size_t part = (n + threads - 1) / threads;
    for (unsigned k = 1; k < threads; k++)
        others.emplace_back([&, k] { work(std::min(n, k * part), std::min(n, (k + 1) * part)); });
    work(0, std::min(n, part));
    for (std::thread &other : others) other.join();
}

inline bool triangle_contains(const engine_mesh &mesh, size_t triangle, const double *q)
{
    const uint32_t *v = mesh.triangles + 3 * triangle;
    return engine_contains(mesh.points + 2 * size_t(v[0]), mesh.points + 2 * size_t(v[1]),
                           mesh.points + 2 * size_t(v[2]), q);
}

// A structure made of a mesh by its constructor, with a member `bytes`: what is on the heap then.
template <class Built> struct BuiltStructure {
    static double build(const engine_mesh *mesh, unsigned, void **self)
    try {
        size_t before = heap_bytes();
        Stopwatch watch;
        auto *built = new Built(*mesh);
        double seconds = watch.seconds();
        built->bytes = heap_growth(before);
        *self = built;
        return seconds;
    } catch (const std::exception &) {
        *self = nullptr;
        return ENGINE_FAILED;
    }
    static size_t bytes(const void *self) { return static_cast<const Built *>(self)->bytes; }
    static void destroy(void *self) { delete static_cast<Built *>(self); }
};

} // namespace bench

#endif
