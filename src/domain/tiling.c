/* tiling.c - the tiling a mesh needs: its own arrays, or completed ones; and its layout in memory. */
#include "domain/tiling.h"

#include "domain/complete.h"
#include "mesh/order.h"

#include <stdlib.h>

/* owner[v]: the lowest-numbered triangle of the user's, with an area, that has vertex v. */
static bool find_owners(mw_tiling *tiling)
{
    tiling->owner = mw__alloc(tiling->point_count, sizeof *tiling->owner);
    if (!tiling->owner) return false;
    for (uint32_t v = 0; v < tiling->point_count; v++) tiling->owner[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        if (tri->user & MW_GHOST || (!tiling->embedding && !mw__has_area(tiling->point, tri))) continue;
        uint32_t user = tri->user & MW_USER_MASK;
        for (int k = 0; k < 3; k++)
            if (user < tiling->owner[tri->v[k]]) tiling->owner[tri->v[k]] = user;
    }
    return true;
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

static mw_status create(const mw_mesh *mesh, bool any, bool fill, mw_tiling *tiling, mw_error *error)
{
    *tiling = (mw_tiling){0};
    mw_survey survey;
    mw_status status = mw__survey_create(&survey, mesh, error);
    if (!status) status = make_tiling(&survey, any, fill, tiling, error);
    mw__survey_release(&survey);
    if (!status && !find_owners(tiling)) status = mw__fail_memory(error);
    if (status) mw__tiling_release(tiling);
    return status;
}

mw_status mw__tiling_create(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error)
{
    return create(mesh, any, true, tiling, error);
}

mw_status mw__tiling_create_open(const mw_mesh *mesh, bool any, mw_tiling *tiling, mw_error *error)
{
    return create(mesh, any, false, tiling, error);
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

static void release_arrays(mw_tiling *tiling)
{
    if (!tiling->borrowed) {
        free(tiling->point);
        free(tiling->tri);
    }
    tiling->point = NULL;
    tiling->tri = NULL;
}

void mw__tiling_release(mw_tiling *tiling)
{
    release_arrays(tiling);
    free(tiling->owner);
    free(tiling->area);
    free(tiling->rim);
    if (tiling->open) mw__open_release(tiling->open);
    free(tiling->open);
    *tiling = (mw_tiling){0};
}

size_t mw__tiling_copy_bytes(const mw_tiling *tiling)
{
    if (tiling->borrowed) return 0;
    return tiling->point_count * sizeof *tiling->point + tiling->tri_count * sizeof *tiling->tri;
}

size_t mw__tiling_bytes(const mw_tiling *tiling)
{
    size_t bytes = tiling->point_count * sizeof *tiling->owner + mw__tiling_copy_bytes(tiling);
    if (tiling->area) bytes += tiling->tri_count * sizeof *tiling->area;
    if (tiling->open) bytes += sizeof *tiling->open + mw__open_bytes(tiling->open, tiling);
    return bytes;
}

/* place[order[i]] = i */
static void invert(const uint32_t *order, uint32_t n, uint32_t *place)
{
    for (uint32_t i = 0; i < n; i++) place[order[i]] = i;
}

static uint32_t renumber_half(uint32_t half, const uint32_t *triangle_place)
{
    return mw__link(triangle_place[mw__link_triangle(half)], mw__link_edge(half));
}

static void renumber(mw_triangle *t, const uint32_t *triangle_place, const uint32_t *vertex_place)
{
    for (int k = 0; k < 4; k++) t->v[k] = vertex_place[t->v[k]];
    for (int k = 0; k < 3; k++)
        if (t->link[k] != MW_NONE) t->link[k] = renumber_half(t->link[k], triangle_place);
}

/* The four permutations of a new layout, and the arrays laid out by them. */
typedef struct layout {
    uint32_t *triangle_order, *triangle_place, *vertex_order, *vertex_place;
    mw_point *point;
    mw_triangle *tri;
    uint32_t *owner;
} layout;

static bool reserve(layout *to, const mw_tiling *from)
{
    to->triangle_order = mw__alloc(from->tri_count, sizeof *to->triangle_order);
    to->triangle_place = mw__alloc(from->tri_count, sizeof *to->triangle_place);
    to->vertex_order = mw__alloc(from->point_count, sizeof *to->vertex_order);
    to->vertex_place = mw__alloc(from->point_count, sizeof *to->vertex_place);
    to->point = mw__alloc_lines(from->point_count, sizeof *to->point);
    to->tri = mw__alloc_lines(from->tri_count, sizeof *to->tri);
    to->owner = mw__alloc(from->point_count, sizeof *to->owner);
    return to->triangle_order && to->triangle_place && to->vertex_order && to->vertex_place && to->point && to->tri &&
           to->owner;
}

static bool order_all(layout *to, const mw_tiling *from)
{
    if (!mw__order_triangles(from->point, from->tri, from->tri_count, to->triangle_order) ||
        !mw__order_vertices(from->tri, to->triangle_order, from->tri_count, from->point_count, to->vertex_order))
        return false;
    invert(to->triangle_order, from->tri_count, to->triangle_place);
    invert(to->vertex_order, from->point_count, to->vertex_place);
    return true;
}

static void fill(layout *to, const mw_tiling *from)
{
    for (uint32_t i = 0; i < from->rim_count; i++) {
        from->rim[i].half = renumber_half(from->rim[i].half, to->triangle_place);
        from->rim[i].next = renumber_half(from->rim[i].next, to->triangle_place);
    }
    for (uint32_t i = 0; i < from->tri_count; i++) {
        to->tri[i] = from->tri[to->triangle_order[i]];
        renumber(&to->tri[i], to->triangle_place, to->vertex_place);
    }
    for (uint32_t i = 0; i < from->point_count; i++) {
        to->point[i] = from->point[to->vertex_order[i]];
        to->owner[i] = from->owner[to->vertex_order[i]];
    }
}

static double double_area(mw_point a, mw_point b, mw_point c)
{
    double bound, area = mw__orient2d_rounded(a, b, c, &bound);
    if (MW_UNLIKELY(!(MW_AREA_ERROR / 2 * area > bound))) area = mw__orient2d_exact(a, b, c);
    return area < DBL_MAX ? area : INFINITY;
}

mw_status mw__tiling_areas(mw_tiling *tiling, mw_error *error)
{
    const mw_point *p = tiling->point;
    tiling->area = mw__alloc(tiling->tri_count, sizeof *tiling->area);
    if (!tiling->area) return mw__fail_memory(error);
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const uint32_t *v = tiling->tri[t].v;
        tiling->area[t] = double_area(p[v[0]], p[v[1]], p[v[2]]);
    }
    return MW_OK;
}

mw_status mw__tiling_order(mw_tiling *tiling, mw_error *error)
{
    layout to = {0};
    bool done = reserve(&to, tiling) && order_all(&to, tiling);
    if (done) {
        fill(&to, tiling);
        release_arrays(tiling);
        free(tiling->owner);
        tiling->point = to.point;
        tiling->tri = to.tri;
        tiling->owner = to.owner;
        tiling->borrowed = false;
    } else {
        free(to.point);
        free(to.tri);
        free(to.owner);
    }
    free(to.triangle_order);
    free(to.triangle_place);
    free(to.vertex_order);
    free(to.vertex_place);
    return done ? MW_OK : mw__fail_memory(error);
}
