// peers.h - what the peers of `meshwalk bench peers` share. Each is a file of its own, and gives its engines by number;
// peers.cpp asks those that were built.
#ifndef MW_BENCH_PEERS_H
#define MW_BENCH_PEERS_H

#include "bench/edits/editing.h"
#include "bench/peers/engine.h"
#include "bench/programs/harness.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <malloc.h>
#include <thread>
#include <vector>

namespace bench
{

// Each is nullptr for an engine of another peer.
const engine_code *cgal_engine(engine_id id);
const engine_code *embree_engine(engine_id id);
const engine_code *geos_engine(engine_id id);
const engine_code *boost_engine(engine_id id);
const engine_code *python_engine(engine_id id);

// Of 'meshwalk bench edit'.
const editing_code *cgal_editor(editor_id id);

// Memory in use, of libraries that do not tell how much they take; and how much more it is than before.
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

inline bool contains(const engine_mesh &mesh, size_t triangle, const double *q)
{
    const uint32_t *v = mesh.triangles + 3 * triangle;
    return engine_contains(mesh.points + 2 * size_t(v[0]), mesh.points + 2 * size_t(v[1]),
                           mesh.points + 2 * size_t(v[2]), q);
}

// A structure made of a mesh by its constructor, with a member `bytes`: what is on the heap then.
template <class Built> struct Keeper {
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
