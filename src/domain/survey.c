/* survey.c - find all defects of a mesh.
 *
 * Why this decides: let T be the triangles with an area. If their insides are disjoint, every cell of the cover has
 * degree 0 or 1 and no two outline edges cross or run along each other in one direction; and the other way round, the
 * degree of a cell is the number of triangles of T over its points. Vertices inside edges: let the insides be disjoint
 * and let vertex v lie inside an edge e of a triangle t. If the triangles at the place of v closed round it, they would
 * overlap t; so v is on the outline, and so is e, since the triangle beyond e would overlap those at v. So v is found
 * when e is forced in. Two inner vertices at one place overlap, too; so vertices at one place are all on the
 * outline. */
#include "domain/survey.h"

#include "domain/convex.h"
#include "domain/local.h"

/* Regions covered more than once, each with a triangle of its border that overlaps others there. Where there is none, a
 * fold is the border, and is listed as such. */
static bool find_overlaps(mw_survey *s)
{
    const mw_outline *o = &s->outline;
    for (uint32_t i = 0; i < s->regions.count; i++) {
        const mw_region *region = &s->regions.list[i];
        if (region->degree < 2 || region->lowest == MW_NONE) continue;
        uint32_t half = o->half[region->lowest];
        mw_defect defect = mw__defect(MW_DEFECT_OVERLAP, mw__link_triangle(half));
        defect.edge = (uint8_t)mw__user_edge(o->mesh->tri[defect.triangle].user, mw__link_edge(half));
        if (!mw__defects_add(&s->defects, defect)) return false;
    }
    return true;
}

/* Triangles and vertices by the user's numbers; of a fold, the lower triangle first. */
static void name_as_user(const mw_mesh *mesh, mw_defect *d)
{
    d->triangle = mw__users_triangle(mesh, d->triangle);
    if (d->other != MW_NONE) d->other = mw__users_triangle(mesh, d->other);
    if (d->vertex != MW_NONE) d->vertex = mw__users_vertex(mesh, d->vertex);
    if (d->kind != MW_DEFECT_FOLDED || d->triangle < d->other) return;
    mw_defect same = *d;
    d->triangle = same.other;
    d->other = same.triangle;
    d->edge = same.other_edge;
    d->other_edge = same.edge;
}

static bool has_no_defect(const mw_survey *s)
{
    for (size_t i = 0; i < s->defects.count; i++)
        if (s->defects.list[i].kind != MW_DEFECT_FLAT) return false;
    return true;
}

static mw_status cover(mw_survey *s, mw_error *error)
{
    mw_status status = mw__cover_create(&s->cover, &s->outline, &s->defects, error);
    if (status) return status;
    if (!mw__regions_create(&s->regions, &s->cover) || !find_overlaps(s)) return mw__fail_memory(error);
    return MW_OK;
}

mw_status mw__survey_create(mw_survey *survey, const mw_mesh *mesh, mw_error *error)
{
    *survey = (mw_survey){.mesh = mesh};
    survey->convex = survey->embedding = mw__convex(mesh);
    if (survey->convex) return MW_OK;
    if (!mw__outline_create(&survey->outline, mesh) || !mw__find_local_defects(&survey->outline, &survey->defects))
        return mw__fail_memory(error);
    if (survey->outline.half_count > 0) {
        mw_status status = cover(survey, error);
        if (status) return status;
    }
    survey->embedding = has_no_defect(survey);
    /* a vertex with more than one turn has an overlap beside it: a mesh without defect so far has none */
    if (!survey->embedding && !mw__find_turns(&survey->outline, &survey->defects)) return mw__fail_memory(error);
    for (size_t i = 0; i < survey->defects.count; i++) name_as_user(mesh, &survey->defects.list[i]);
    mw__defects_sort(&survey->defects);
    return MW_OK;
}

void mw__survey_release(mw_survey *survey)
{
    mw__defects_release(&survey->defects);
    mw__outline_release(&survey->outline);
    mw__cover_release(&survey->cover);
    mw__regions_release(&survey->regions);
    *survey = (mw_survey){0};
}
