// peer_geos.cpp - GEOS: its STRtree [Leutenegger, Lopez, Edgington 1997] over the boxes of the
// triangles, by the C interface, and an exact orientation test of each triangle whose box holds the
// point.
#include "bench/peers/peer_list.h"
#include "bench/peers/peer_support.h"

#include <geos_c.h>

#include <new>
#include <string>

namespace peer_geos
{
namespace
{

using namespace bench;

// Each thread has a handle of its own.
class GeosHandle
{
    GEOSContextHandle_t handle = GEOS_init_r();

  public:
    GeosHandle()
    {
        if (!handle) throw std::bad_alloc();
    }
    ~GeosHandle() { GEOS_finish_r(handle); }
    GeosHandle(const GeosHandle &) = delete;
    GeosHandle &operator=(const GeosHandle &) = delete;
    operator GEOSContextHandle_t() const { return handle; }
};

void *number_to_item(size_t triangle)
{
    return reinterpret_cast<void *>(triangle + 1);
}

size_t item_to_number(const void *item)
{
    return reinterpret_cast<size_t>(item) - 1;
}

struct GeosSearch {
    const engine_mesh *mesh;
    const double *query;
    uint64_t answer;
};

void look(void *item, void *self)
{
    GeosSearch &search = *static_cast<GeosSearch *>(self);
    size_t triangle = item_to_number(item);
    if (search.answer == ENGINE_NONE && triangle_contains(*search.mesh, triangle, search.query))
        search.answer = triangle;
}

class GeosBoxes
{
    engine_mesh mesh;
    GeosHandle handle;
    GEOSSTRtree *tree;

    // The tree takes the box of a geometry: here of the broken line through the corners.
    void insert(size_t triangle)
    {
        double corners[6];
        const uint32_t *v = mesh.triangles + 3 * triangle;
        for (size_t k = 0; k < 6; k++) corners[k] = mesh.points[2 * size_t(v[k / 2]) + k % 2];
        GEOSCoordSequence *line = GEOSCoordSeq_copyFromBuffer_r(handle, corners, 3, 0, 0);
        GEOSGeometry *geometry = line ? GEOSGeom_createLineString_r(handle, line) : nullptr;
        if (!geometry) throw std::bad_alloc();
        GEOSSTRtree_insert_r(handle, tree, geometry, number_to_item(triangle));
        GEOSGeom_destroy_r(handle, geometry);
    }

  public:
    size_t bytes = 0;

    explicit GeosBoxes(const engine_mesh &of) : mesh(of), tree(GEOSSTRtree_create_r(handle, 10))
    {
        if (!tree) throw std::bad_alloc();
        for (size_t t = 0; t < mesh.triangle_count; t++) insert(t);
        find(handle, mesh.points); // the first query makes the tree
    }
    ~GeosBoxes() { GEOSSTRtree_destroy_r(handle, tree); }
    GeosBoxes(const GeosBoxes &) = delete;
    GeosBoxes &operator=(const GeosBoxes &) = delete;

    uint64_t find(const GeosHandle &of_thread, const double *query) const
    {
        GeosSearch search = {&mesh, query, ENGINE_NONE};
        GEOSGeometry *point = GEOSGeom_createPointFromXY_r(of_thread, query[0], query[1]);
        GEOSSTRtree_query_r(of_thread, tree, point, look, &search);
        GEOSGeom_destroy_r(of_thread, point);
        return search.answer;
    }
};

const char *version()
{
    static const std::string name = std::string("GEOS ") + GEOS_VERSION;
    return name.c_str();
}

double locate(void *self, const double *queries, size_t n, unsigned threads, uint64_t *answers)
{
    const GeosBoxes &boxes = *static_cast<const GeosBoxes *>(self);
    Stopwatch watch;
    in_parts(n, threads, [&](size_t begin, size_t end) {
        GeosHandle handle;
        for (size_t i = begin; i < end; i++) answers[i] = boxes.find(handle, queries + 2 * i);
    });
    return watch.seconds();
}

} // namespace
} // namespace peer_geos

const engine_code *peer_geos_engine(engine_id id)
{
    using namespace peer_geos;
    static const engine_structure tree = {version, BuiltStructure<GeosBoxes>::build,
                                          BuiltStructure<GeosBoxes>::bytes, nullptr,
                                          BuiltStructure<GeosBoxes>::destroy};
    static const engine_code code = {&tree, locate, nullptr};
    return id == ENGINE_GEOS ? &code : nullptr;
}
