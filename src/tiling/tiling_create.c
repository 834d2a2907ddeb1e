/* tiling_create.c - makes the tiling of a mesh: borrows the arrays of the mesh or makes new ones.
 */
#include "tiling/tiling_create.h"

#include "tiling/ghosts.h"
#include "tiling/border_loops_create.h"
#include "tiling/loop_edges.h"

#include <stdlib.h>

/* For each vertex, find the lowest-numbered triangle of the user with an area among the tiles from
 * `tile` up to, not including, `end`. */
static void tiling_find_lowest(const mw_tiling *tiling, uint32_t tile, uint32_t end,
                               uint32_t *lowest)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) lowest[v] = MW_NONE;
    for (uint32_t t = tile; t < end; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        if (tri->user & MW_GHOST || (!tiling->embedding && !mw__has_area(tiling->point, tri)))
            continue;
        uint32_t user = tri->user & MW_USER_MASK;
        for (int k = 0; k < 3; k++) {
            uint32_t known = lowest[tri->v[k]];
            /* A branch would often be mispredicted, so this always writes. */
            lowest[tri->v[k]] = user < known ? user : known;
        }
    }
}

typedef struct owner_search {
    mw_tiling *tiling;
    uint32_t shares;
    uint32_t *others; /* what the shares from 1 on have found */
} owner_search;

static void owner_search_share(void *work, uint64_t i, uint32_t member)
{
    const owner_search *s = work;
    const mw_tiling *tiling = s->tiling;
    (void)member;
    tiling_find_lowest(tiling, (uint32_t)(tiling->tri_count * i / s->shares),
                       (uint32_t)(tiling->tri_count * (i + 1) / s->shares),
                       i == 0 ? tiling->owner : s->others + (i - 1) * tiling->point_count);
}

static void owner_search_join(void *work, uint64_t from, uint64_t to)
{
    const owner_search *s = work;
    uint32_t *owner = s->tiling->owner;
    for (uint32_t i = 1; i < s->shares; i++) {
        const uint32_t *other = s->others + (size_t)(i - 1) * s->tiling->point_count;
        for (uint64_t v = from; v < to; v++) owner[v] = other[v] < owner[v] ? other[v] : owner[v];
    }
}

/* Each thread finds the lowest triangles in its share of the tiles. The lowest of these are the
 * owners. Returns false when out of memory, or cancelled. */
static bool tiling_find_owners(mw_tiling *tiling, mw_job *job)
{
    enum { WORTHWHILE = 1 << 15, MOST_SHARES = 8 }; /* each share has an array over all vertices */
    uint32_t n = tiling->point_count,
             shares = mw__job_team(job, tiling->tri_count / WORTHWHILE + 1);
    if (shares > MOST_SHARES) shares = MOST_SHARES;
    mw__job_stage(job, "finding the owners of vertices", 0.2);
    tiling->owner = mw__alloc(n, sizeof *tiling->owner);
    owner_search search = {tiling, shares,
                           mw__alloc((size_t)(shares - 1) * n, sizeof *search.others)};
    bool done = tiling->owner && search.others &&
                mw__job_chunks(job, shares, shares, owner_search_share, &search) &&
                (shares == 1 || mw__job_ranges(job, n, owner_search_join, &search));
    free(search.others);
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
    return mw__fail_at(error, first->triangle,
                       first->vertex == MW_NONE ? -1 : (int64_t)first->vertex, "%s", text);
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

static mw_status tiling_make_without_ghosts(const mw_embedding_check *check, mw_job *job,
                                            mw_tiling *tiling, mw_error *error)
{
    if (mesh_is_own_tiling(check)) {
        tiling_borrow(check->mesh, tiling);
    } else {
        mw_status status = mw__ghosts_fill(check, false, job, tiling, error);
        if (status) return status;
    }
    tiling->hole_count = check->regions.hole_count;
    tiling->loop_edges = mw__loop_edges_create(check, tiling, &tiling->loop_edge_count);
    return tiling->loop_edges ? MW_OK : mw__fail_memory(error);
}

static mw_status tiling_make(const mw_embedding_check *check, mw_tiling_options options,
                             mw_job *job, mw_tiling *tiling, mw_error *error)
{
    tiling->embedding = check->embedding;
    if (!check->embedding && !options.any) return tiling_refuse(check, error);
    if (check->embedding && !check->convex)
        return !options.without_ghosts || mw__ghosts_count(&check->coverage) == 0
                   ? mw__ghosts_fill(check, true, job, tiling, error)
                   : tiling_make_without_ghosts(check, job, tiling, error);
    tiling_borrow(check->mesh, tiling);
    if (!check->embedding) tiling->defect = check->defects.list[0];
    return MW_OK;
}

mw_status mw__tiling_create(const mw_mesh *mesh, mw_tiling_options options, mw_job *job,
                            mw_tiling *tiling, mw_error *error)
{
    *tiling = (mw_tiling){0};
    mw_embedding_check check;
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = mw__embedding_check_create(&check, mesh, job, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.3);
    if (!status) status = tiling_make(&check, options, job, tiling, error);
    mw__job_part_end(job, outer);
    mw__embedding_check_release(&check);
    if (!status && !tiling_find_owners(tiling, job)) status = mw__fail_memory(error);
    if (status) mw__tiling_release(tiling);
    return status;
}

mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error)
{
    if (!tiling->loop_edges) return MW_OK;
    tiling->border_loops = mw__calloc(1, sizeof *tiling->border_loops);
    bool done = tiling->border_loops &&
                mw__border_loops_create(tiling->border_loops, tiling, tiling->loop_edges,
                                        tiling->loop_edge_count);
    free(tiling->loop_edges);
    tiling->loop_edges = NULL;
    return done ? MW_OK : mw__fail_memory(error);
}
