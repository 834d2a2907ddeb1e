/* tiling_create.c - makes the tiling of a mesh: borrows the arrays of the mesh or makes new ones. */
#include "tiling/tiling_create.h"

#include "base/threads.h"
#include "tiling/ghosts.h"
#include "tiling/border_loops_create.h"
#include "tiling/loop_edges.h"

#include <stdlib.h>

/* For each vertex, find the lowest-numbered triangle of the user with an area among the tiles from
 * `tile` up to, not including, `end`. */
static void tiling_find_lowest(const mw_tiling *tiling, uint32_t tile, uint32_t end, uint32_t *lowest)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) lowest[v] = MW_NONE;
    for (uint32_t t = tile; t < end; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        if (tri->user & MW_GHOST || (!tiling->embedding && !mw__has_area(tiling->point, tri))) continue;
        uint32_t user = tri->user & MW_USER_MASK;
        for (int k = 0; k < 3; k++) {
            uint32_t known = lowest[tri->v[k]];
            /* A branch would often be mispredicted, so this always writes. */
            lowest[tri->v[k]] = user < known ? user : known;
        }
    }
}

/* Each thread finds the lowest triangles in its share of the tiles. The lowest of these are the
 * owners. */
static bool tiling_find_owners(mw_tiling *tiling)
{
    enum { WORTHWHILE = 1 << 15, MOST_SHARES = 8 }; /* each share has an array over all vertices */
    uint32_t n = tiling->point_count, tiles = tiling->tri_count;
    int shares = mw__team(tiling->threads, tiles / WORTHWHILE + 1);
    if (shares > MOST_SHARES) shares = MOST_SHARES;
    tiling->owner = mw__alloc(n, sizeof *tiling->owner);
    uint32_t *others = mw__alloc((size_t)(shares - 1) * n, sizeof *others);
    bool done = tiling->owner && others;
#ifdef _OPENMP
#pragma omp parallel num_threads(shares) if (shares > 1 && done)
#endif
    if (done) {
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
        for (int i = 0; i < shares; i++)
            tiling_find_lowest(tiling, (uint32_t)((uint64_t)tiles * (uint32_t)i / (uint32_t)shares),
                               (uint32_t)((uint64_t)tiles * (uint32_t)(i + 1) / (uint32_t)shares),
                               i == 0 ? tiling->owner : others + (size_t)(i - 1) * n);
#ifdef _OPENMP
#pragma omp for schedule(static)
#endif
        for (uint32_t v = 0; v < n; v++)
            for (int i = 1; i < shares; i++) {
                uint32_t other = others[(size_t)(i - 1) * n + v];
                if (other < tiling->owner[v]) tiling->owner[v] = other;
            }
    }
    free(others);
    return done;
}

static void tiling_borrow(const mw_mesh *mesh, mw_tiling *tiling)
{
    tiling->point = mesh->point;
    tiling->tri = mesh->tri;
    tiling->point_count = mesh->point_count;
    tiling->tri_count = mesh->tri_count;
    tiling->borrowed = true;
}

/* Returns MW_ERROR_INPUT; the error names the first defect. */
static mw_status tiling_refuse(const mw_embedding_check *check, mw_error *error)
{
    const mw_defect *first = check->defects.list;
    char text[256];
    mw_defect_describe(first, text, sizeof text);
    return mw__fail_at(error, first->triangle, first->vertex == MW_NONE ? -1 : (int64_t)first->vertex, "%s", text);
}

/* Without ghosts, is the mesh its own tiling: no flat triangles, and no coincident vertices on the
 * outline? */
static bool mesh_is_own_tiling(const mw_embedding_check *check)
{
    const mw_outline *o = &check->outline;
    if (o->mesh->flat_count > 0) return false; /* edges are only cut beside flat triangles */
    for (uint32_t v = 0; v < o->mesh->point_count; v++)
        if (o->node[v] != MW_NONE && o->vertex[o->node[v]] != v) return false;
    return true;
}

static mw_status tiling_make_without_ghosts(const mw_embedding_check *check, mw_tiling *tiling, mw_error *error)
{
    if (mesh_is_own_tiling(check)) {
        tiling_borrow(check->mesh, tiling);
    } else {
        mw_status status = mw__ghosts_fill(check, false, tiling, error);
        if (status) return status;
    }
    tiling->hole_count = check->regions.hole_count;
    tiling->loop_edges = mw__loop_edges_create(check, tiling, &tiling->loop_edge_count);
    return tiling->loop_edges ? MW_OK : mw__fail_memory(error);
}

static mw_status tiling_make(const mw_embedding_check *check, bool any, bool fill, mw_tiling *tiling, mw_error *error)
{
    tiling->embedding = check->embedding;
    if (!check->embedding && !any) return tiling_refuse(check, error);
    if (check->embedding && !check->convex)
        return fill || mw__ghosts_count(&check->coverage) == 0 ? mw__ghosts_fill(check, true, tiling, error)
                                                               : tiling_make_without_ghosts(check, tiling, error);
    tiling_borrow(check->mesh, tiling);
    if (!check->embedding) tiling->defect = check->defects.list[0];
    return MW_OK;
}

mw_status mw__tiling_create_with(const mw_mesh *mesh, mw_tiling_options options, mw_tiling *tiling, mw_error *error)
{
    *tiling = (mw_tiling){.threads = options.threads};
    mw_embedding_check check;
    mw_status status = mw__embedding_check_create(&check, mesh, error);
    if (!status) status = tiling_make(&check, options.any, !options.without_ghosts, tiling, error);
    mw__embedding_check_release(&check);
    if (!status && !tiling_find_owners(tiling)) status = mw__fail_memory(error);
    if (status) mw__tiling_release(tiling);
    return status;
}

mw_status mw__tiling_create(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error)
{
    return mw__tiling_create_with(mesh, (mw_tiling_options){.any = any, .threads = 1}, tiling, error);
}

mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error)
{
    if (!tiling->loop_edges) return MW_OK;
    tiling->border_loops = mw__calloc(1, sizeof *tiling->border_loops);
    bool done = tiling->border_loops &&
                mw__border_loops_create(tiling->border_loops, tiling, tiling->loop_edges, tiling->loop_edge_count);
    free(tiling->loop_edges);
    tiling->loop_edges = NULL;
    return done ? MW_OK : mw__fail_memory(error);
}
