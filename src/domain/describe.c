/* describe.c - what kind of mesh it is. */
#include "domain/tiling.h"

#include <stdlib.h>

/* --- counts --- */

/* Are the two triangles at edge k of t given in different orientations? */
static bool clashes(const mw_mesh *mesh, uint32_t t, uint32_t k)
{
    const mw_triangle *a = &mesh->tri[t], *b = &mesh->tri[mw__link_triangle(a->link[k])];
    bool same_way = a->v[k] == b->v[mw__link_edge(a->link[k])];
    return same_way != ((a->user & MW_FLIPPED) != (b->user & MW_FLIPPED));
}

static void count_edges(const mw_mesh *mesh, mw_mesh_info *info)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = mesh->tri[t].link[k];
            if (link == MW_NONE)
                info->border_edges++;
            else if (mw__link_triangle(link) > t && clashes(mesh, t, k))
                info->clashing_edges++;
        }
    info->oriented = info->clashing_edges == 0;
}

/* The sum with the rounding errors added up beside it [Neumaier 1974]. */
static void sum_areas(const mw_mesh *mesh, mw_mesh_info *info)
{
    double sum = 0, lost = 0;
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const uint32_t *v = mesh->tri[t].v;
        double area = mw__orient2d(mesh->point[v[0]], mesh->point[v[1]], mesh->point[v[2]]) / 2;
        double next = sum + area;
        lost += fabs(sum) >= fabs(area) ? sum - next + area : area - next + sum;
        sum = next;
    }
    info->area = isfinite(lost) ? sum + lost : sum;
}

static void widen(mw_mesh_info *info, mw_point p)
{
    const double at[2] = {p.x, p.y};
    if (!isfinite(p.x) || !isfinite(p.y)) return;
    for (int i = 0; i < 2; i++) {
        info->low[i] = fmin(info->low[i], at[i]); /* fmin and fmax pass over the NaN they begin with */
        info->high[i] = fmax(info->high[i], at[i]);
    }
}

/* --- pieces: union-find over vertices --- */

static uint32_t root_of(uint32_t *parent, uint32_t v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

/* Counts used vertices and components, and finds the extent. Returns false when out of memory. */
static bool count_components(const mw_mesh *mesh, mw_mesh_info *info)
{
    uint32_t *parent = mw__alloc(mesh->point_count, sizeof *parent);
    if (!parent) return false;
    for (uint32_t v = 0; v < mesh->point_count; v++) parent[v] = MW_NONE;
    info->unused_vertices = mesh->point_count;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (parent[v] == MW_NONE) {
                parent[v] = v;
                widen(info, mesh->point[v]);
                info->unused_vertices--;
                info->components++;
            }
            uint32_t a = root_of(parent, v), b = root_of(parent, mesh->tri[t].v[0]);
            if (a == b) continue;
            parent[a < b ? b : a] = a < b ? a : b;
            info->components--;
        }
    free(parent);
    return true;
}

/* --- border loops --- */

/* A border edge and one of its ends: the corner of its triangle there is `edge` itself (its start) or the next. */
typedef struct border_end {
    uint32_t half;
    bool start;
} border_end;

/* The border edge that meets this one at its end, turning through the triangles between; and its end there. Works for
 * any orientation, and is its own inverse, so that border edges form closed loops. */
static border_end meet(const mw_mesh *mesh, border_end e)
{
    for (;;) {
        uint32_t t = mw__link_triangle(e.half), k = mw__link_edge(e.half);
        uint32_t corner = e.start ? k : mw__next(k), vertex = mesh->tri[t].v[corner];
        k = e.start ? mw__prev(k) : mw__next(k);
        uint32_t link = mesh->tri[t].link[k];
        if (link == MW_NONE) return (border_end){mw__link(t, k), !e.start};
        e.half = link;
        e.start = mesh->tri[mw__link_triangle(link)].v[mw__link_edge(link)] == vertex;
    }
}

static bool count_loops(const mw_mesh *mesh, mw_mesh_info *info)
{
    uint8_t *seen = mw__calloc(mesh->tri_count, sizeof *seen); /* a bit per edge */
    if (!seen) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            if (mesh->tri[t].link[k] != MW_NONE || seen[t] >> k & 1) continue;
            info->border_loops++;
            border_end e = {mw__link(t, k), false};
            while (!(seen[mw__link_triangle(e.half)] >> mw__link_edge(e.half) & 1)) {
                seen[mw__link_triangle(e.half)] |= (uint8_t)(1u << mw__link_edge(e.half));
                e = meet(mesh, e);
                e.start = !e.start; /* go on from the other end */
            }
        }
    free(seen);
    return true;
}

/* --- what the tiling tells --- */

static bool is_delaunay(const mw_tiling *tiling)
{
    if (tiling->cut) return false; /* a vertex inside an edge lies in the circle of its triangle */
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *a = &tiling->tri[t];
        for (uint32_t k = 0; k < 3 && !(a->user & MW_GHOST); k++) {
            if (a->link[k] == MW_NONE || mw__link_triangle(a->link[k]) < t) continue;
            const mw_triangle *b = &tiling->tri[mw__link_triangle(a->link[k])];
            mw_point apex = tiling->point[b->v[mw__prev(mw__link_edge(a->link[k]))]];
            if (b->user & MW_GHOST) continue;
            if (mw__incircle(tiling->point[a->v[0]], tiling->point[a->v[1]], tiling->point[a->v[2]], apex) > 0)
                return false;
        }
    }
    return true;
}

static mw_status describe_tiling(const mw_mesh *mesh, mw_mesh_info *info, mw_error *error)
{
    mw_tiling tiling;
    mw_status status = mw__tiling_create(mesh, true, &tiling, error);
    if (status) return status;
    info->embedding = tiling.embedding;
    if (tiling.embedding && tiling.tri_count > 0) {
        info->holes = tiling.hole_count;
        info->convex = tiling.ghost_count == 0;
        info->delaunay = is_delaunay(&tiling);
    }
    mw__tiling_release(&tiling);
    return MW_OK;
}

mw_status mw_mesh_describe(const mw_mesh *mesh, mw_mesh_info *info, mw_error *error)
{
    if (!mesh || !info) return mw__fail(error, MW_ERROR_ARGUMENT, "no mesh, or no place for its description");
    *info = (mw_mesh_info){.vertices = mesh->point_count,
                           .triangles = mesh->tri_count,
                           .flat_triangles = mesh->flat_count,
                           .clockwise_triangles = mesh->flipped_count,
                           .low = {NAN, NAN},
                           .high = {NAN, NAN}};
    count_edges(mesh, info);
    sum_areas(mesh, info);
    if (!count_components(mesh, info) || !count_loops(mesh, info)) return mw__fail_memory(error);
    return describe_tiling(mesh, info, error);
}
