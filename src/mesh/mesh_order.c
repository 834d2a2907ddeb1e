/* mesh_order.c - orders of triangles and vertices along a Hilbert curve. */
#include "mesh/mesh_order.h"

#include "base/hilbert.h"

#include <stdlib.h>

static void corners_extent_widen(double low[2], double high[2], mw_point p)
{
    if (p.x < low[0]) low[0] = p.x;
    if (p.x > high[0]) high[0] = p.x;
    if (p.y < low[1]) low[1] = p.y;
    if (p.y > high[1]) high[1] = p.y;
}

void mw__triangles_extent(const mw_point *point, const mw_triangle *tri, uint32_t tri_count,
                          double low[2], double high[2])
{
    low[0] = low[1] = INFINITY;
    high[0] = high[1] = -INFINITY;
    for (uint32_t t = 0; t < tri_count; t++)
        for (int k = 0; k < 3; k++) corners_extent_widen(low, high, point[tri[t].v[k]]);
}

bool mw__triangles_order(const mw_point *point, const mw_triangle *tri, uint32_t tri_count,
                         uint32_t *order)
{
    mw_key *key = mw__alloc(tri_count, sizeof *key),
           *scratch = mw__alloc(tri_count, sizeof *scratch);
    bool done = key && scratch;
    if (done) {
        double low[2], high[2];
        mw__triangles_extent(point, tri, tri_count, low, high);
        mw_hilbert hilbert = mw__hilbert(low, high);
        for (uint32_t t = 0; t < tri_count; t++) {
            mw_point a = point[tri[t].v[0]], b = point[tri[t].v[1]], c = point[tri[t].v[2]];
            key[t].key =
                mw__hilbert_key(&hilbert, a.x / 3 + b.x / 3 + c.x / 3, a.y / 3 + b.y / 3 + c.y / 3);
            key[t].item = t;
        }
        mw__sort_keys(key, scratch, tri_count);
        for (uint32_t t = 0; t < tri_count; t++) order[t] = key[t].item;
    }
    free(key);
    free(scratch);
    return done;
}

bool mw__vertices_order(const mw_triangle *tri, const uint32_t *triangle_order, uint32_t tri_count,
                        uint32_t point_count, uint32_t *order)
{
    uint8_t *used = mw__calloc(point_count, 1);
    if (!used) return false;
    uint32_t next = 0;
    for (uint32_t i = 0; i < tri_count; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = tri[triangle_order[i]].v[k];
            if (!used[v]) order[next++] = v;
            used[v] = 1;
        }
    for (uint32_t v = 0; v < point_count; v++)
        if (!used[v]) order[next++] = v;
    free(used);
    return true;
}

static void order_to_user_numbers(const mw_mesh *mesh, uint32_t *triangles, uint32_t *vertices)
{
    for (uint32_t i = 0; triangles && i < mesh->tri_count; i++)
        triangles[i] = mw__triangle_number(mesh, triangles[i]);
    for (uint32_t i = 0; vertices && i < mesh->point_count; i++)
        vertices[i] = mw__vertex_number(mesh, vertices[i]);
}

mw_status mw_mesh_hilbert_order(const mw_mesh *mesh, uint32_t *triangles, uint32_t *vertices,
                                mw_error *error)
{
    if (!mesh) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh");
    uint32_t *order = triangles ? triangles : mw__alloc(mesh->tri_count, sizeof *order);
    bool done = order && mw__triangles_order(mesh->point, mesh->tri, mesh->tri_count, order);
    if (done && vertices)
        done = mw__vertices_order(mesh->tri, order, mesh->tri_count, mesh->point_count, vertices);
    if (done) order_to_user_numbers(mesh, triangles, vertices);
    if (!triangles) free(order);
    return done ? MW_OK : mw__fail_memory(error);
}
