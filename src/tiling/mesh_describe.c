/* mesh_describe.c - the public description of a mesh. */
#include "mesh/compensated_sum.h"
#include "base/options.h"
#include "tiling/tiling_create.h"
#include "topology/topology_counts.h"

/* --- counts --- */

/* Did the user give the two triangles at edge k of t in different orientations? */
static bool orientations_clash(const mw_mesh *mesh, uint32_t t, uint32_t k)
{
    const mw_triangle *a = &mesh->tri[t], *b = &mesh->tri[mw__link_triangle(a->link[k])];
    bool same_way = a->v[k] == b->v[mw__link_edge(a->link[k])];
    return same_way != ((a->user & MW_REVERSED) != (b->user & MW_REVERSED));
}

static void mesh_count_edges(const mw_mesh *mesh, mw_mesh_info *info)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = mesh->tri[t].link[k];
            if (link == MW_NONE)
                info->border_edges++;
            else if (mw__link_triangle(link) > t && orientations_clash(mesh, t, k))
                info->clashing_edges++;
        }
    info->oriented = info->clashing_edges == 0;
}

static void mesh_sum_areas(const mw_mesh *mesh, mw_mesh_info *info)
{
    mw_sum sum = {0};
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const uint32_t *v = mesh->tri[t].v;
        mw__sum_add(&sum,
                    mw__orient2d(mesh->point[v[0]], mesh->point[v[1]], mesh->point[v[2]]) / 2);
    }
    info->area = mw__sum_value(&sum);
}

static void mesh_find_extent(const mw_mesh *mesh, mw_mesh_info *info)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        for (int k = 0; k < 3; k++) {
            mw_point p = mesh->point[mesh->tri[t].v[k]];
            const double at[2] = {p.x, p.y};
            for (int i = 0; i < 2 && mw__is_finite(p); i++) {
                /* Fmin and fmax ignore the NaN that is there at first. */
                info->low[i] = fmin(info->low[i], at[i]);
                info->high[i] = fmax(info->high[i], at[i]);
            }
        }
}

/* Returns false when out of memory. */
static bool mesh_count_components(const mw_mesh *mesh, mw_mesh_info *info)
{
    uint32_t used;
    if (!mw__count_components(mesh->tri, mesh->tri_count, mesh->point_count, NULL, &used,
                              &info->components))
        return false;
    info->unused_vertices = mesh->point_count - used;
    return mw__count_border_loops(mesh->tri, mesh->tri_count, NULL, &info->border_loops);
}

/* --- from the tiling --- */

static bool tiling_is_delaunay(const mw_tiling *tiling)
{
    if (tiling->cut) return false; /* a vertex inside an edge lies in the circle of the triangle */
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *a = &tiling->tri[t];
        for (uint32_t k = 0; k < 3 && !(a->user & MW_GHOST); k++) {
            if (a->link[k] == MW_NONE || mw__link_triangle(a->link[k]) < t) continue;
            const mw_triangle *b = &tiling->tri[mw__link_triangle(a->link[k])];
            mw_point apex = tiling->point[b->v[mw__prev(mw__link_edge(a->link[k]))]];
            if (b->user & MW_GHOST) continue;
            if (mw__incircle(tiling->point[a->v[0]], tiling->point[a->v[1]], tiling->point[a->v[2]],
                             apex) > 0)
                return false;
        }
    }
    return true;
}

static mw_status mesh_describe_tiling(const mw_mesh *mesh, mw_job *job, mw_mesh_info *info,
                                      mw_error *error)
{
    mw_tiling tiling;
    mw_status status =
        mw__tiling_create(mesh, (mw_tiling_options){.any = true}, job, &tiling, error);
    if (status) return status;
    info->embedding = tiling.embedding;
    if (tiling.embedding && tiling.tri_count > 0) {
        info->holes = tiling.hole_count;
        info->convex = tiling.ghost_count == 0;
        info->delaunay = tiling_is_delaunay(&tiling);
    }
    mw__tiling_release(&tiling);
    return MW_OK;
}

mw_status mw_mesh_describe(const mw_mesh *mesh, const mw_check_options *options, mw_mesh_info *info,
                           mw_error *error)
{
    static const mw_check_options defaults;
    if (!mesh || !info)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the mesh or the pointer to its description is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_check_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    *info = (mw_mesh_info){.vertices = mesh->point_count,
                           .triangles = mesh->tri_count,
                           .flat_triangles = mesh->flat_count,
                           .clockwise_triangles = mesh->reversed_count,
                           .low = {NAN, NAN},
                           .high = {NAN, NAN}};
    mw__job_stage(&job, "measuring the mesh", 0.1);
    mesh_count_edges(mesh, info);
    mesh_sum_areas(mesh, info);
    mesh_find_extent(mesh, info);
    if (!mesh_count_components(mesh, info)) return mw__fail_memory(error);
    mw_job_span outer = mw__job_part(&job, 0.9);
    status = mesh_describe_tiling(mesh, &job, info, error);
    mw__job_part_end(&job, outer);
    return mw__job_end(&job, status, error);
}
