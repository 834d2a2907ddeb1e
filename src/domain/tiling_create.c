/* tiling_create.c - the tiling a mesh needs: its own arrays, or completed ones. */
#include "domain/tiling_create.h"

#include "base/threads.h"
#include "domain/complete.h"
#include "domain/open_create.h"
#include "domain/rim.h"

#include <stdlib.h>

/* The lowest-numbered triangle of the user's, with an area, that has each vertex: of the tiles from `tile` on to before `end`. */
static void find_lowest(const mw_tiling *tiling, uint32_t tile, uint32_t end, uint32_t *lowest)
{
    for (uint32_t v = 0; v < tiling->point_count; v++) lowest[v] = MW_NONE;
    for (uint32_t t = tile; t < end; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        if (tri->user & MW_GHOST || (!tiling->embedding && !mw__has_area(tiling->point, tri))) continue;
        uint32_t user = tri->user & MW_USER_MASK;
        for (int k = 0; k < 3; k++) {
            uint32_t known = lowest[tri->v[k]];
            lowest[tri->v[k]] = user < known ? user : known; /* written anyway: which is lower cannot be foretold */
        }
    }
}

/* Each thread finds the lowest of its share of the tiles; of these the lowest are the owners. */
static bool find_owners(mw_tiling *tiling)
{
    enum { WORTHWHILE = 1 << 15, MOST_SHARES = 8 }; /* each has its own numbers for all vertices */
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
            find_lowest(tiling, (uint32_t)((uint64_t)tiles * (uint32_t)i / (uint32_t)shares),
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

static void borrow(const mw_mesh *mesh, mw_tiling *tiling)
{
    tiling->point = mesh->point;
    tiling->tri = mesh->tri;
    tiling->point_count = mesh->point_count;
    tiling->tri_count = mesh->tri_count;
    tiling->borrowed = true;
}

/* MW_ERROR_INPUT, naming the first defect. */
static mw_status refuse(const mw_survey *survey, mw_error *error)
{
    const mw_defect *first = survey->defects.list;
    char text[256];
    mw_defect_describe(first, text, sizeof text);
    return mw__fail_at(error, first->triangle, first->vertex == MW_NONE ? -1 : (int64_t)first->vertex, "%s", text);
}

/* Is the mesh its own tiling, but for ghosts: no flat triangles, and no two vertices of the outline at one place? */
static bool stands_alone(const mw_survey *survey)
{
    const mw_outline *o = &survey->outline;
    if (o->mesh->flat_count > 0) return false; /* only beside flat triangles are edges cut */
    for (uint32_t v = 0; v < o->mesh->point_count; v++)
        if (o->place[v] != MW_NONE && o->vertex[o->place[v]] != v) return false;
    return true;
}

static mw_status leave_open(const mw_survey *survey, mw_tiling *tiling, mw_error *error)
{
    if (stands_alone(survey)) {
        borrow(survey->mesh, tiling);
    } else {
        mw_status status = mw__complete(survey, false, tiling, error);
        if (status) return status;
    }
    tiling->hole_count = survey->regions.hole_count;
    tiling->rim = mw__rim_create(survey, tiling, &tiling->rim_count);
    return tiling->rim ? MW_OK : mw__fail_memory(error);
}

static mw_status make_tiling(const mw_survey *survey, bool any, bool fill, mw_tiling *tiling, mw_error *error)
{
    tiling->embedding = survey->embedding;
    if (!survey->embedding && !any) return refuse(survey, error);
    if (survey->embedding && !survey->convex)
        return fill || mw__ghosts_wanted(&survey->cover) == 0 ? mw__complete(survey, true, tiling, error)
                                                              : leave_open(survey, tiling, error);
    borrow(survey->mesh, tiling);
    if (!survey->embedding) tiling->defect = survey->defects.list[0];
    return MW_OK;
}

mw_status mw__tiling_create_with(const mw_mesh *mesh, mw_tiling_options options, mw_tiling *tiling, mw_error *error)
{
    *tiling = (mw_tiling){.threads = options.threads};
    mw_survey survey;
    mw_status status = mw__survey_create(&survey, mesh, error);
    if (!status) status = make_tiling(&survey, options.any, !options.open, tiling, error);
    mw__survey_release(&survey);
    if (!status && !find_owners(tiling)) status = mw__fail_memory(error);
    if (status) mw__tiling_release(tiling);
    return status;
}

mw_status mw__tiling_create(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error)
{
    return mw__tiling_create_with(mesh, (mw_tiling_options){.any = any, .threads = 1}, tiling, error);
}

mw_status mw__tiling_finish(mw_tiling *tiling, mw_error *error)
{
    if (!tiling->rim) return MW_OK;
    tiling->open = mw__calloc(1, sizeof *tiling->open);
    bool done = tiling->open && mw__open_create(tiling->open, tiling, tiling->rim, tiling->rim_count);
    free(tiling->rim);
    tiling->rim = NULL;
    return done ? MW_OK : mw__fail_memory(error);
}
