/* embedding_check.c - finds all defects of a mesh.
 *
 * Why this decides. Let T be the triangles with an area. If their interiors are disjoint, every
 * cell of the coverage has degree 0 or 1, no two outline edges cross, and no two run along each
 * other in one direction. Conversely, the degree of a cell is the number of triangles of T over its
 * points.
 *
 * Vertices inside edges. Let the interiors be disjoint, and let vertex v lie inside an edge e of a
 * triangle t. If the triangles at v closed round it, they would overlap t. So v is on the outline.
 * So is e, since the triangle beyond e would overlap those at v. So v is found when e is forced.
 * Two coincident inner vertices overlap, too. So coincident vertices are all on the outline. */
#include "tiling/embedding_check.h"

#include "tiling/convex.h"
#include "tiling/local_defects.h"

/* Regions that are covered more than once, each with a triangle at its border that overlaps others
 * there. A region without one is bounded by a fold, which is listed as such. */
static bool overlaps_find(mw_embedding_check *s)
{
    const mw_outline *o = &s->outline;
    for (uint32_t i = 0; i < s->regions.count; i++) {
        const mw_region *region = &s->regions.list[i];
        if (region->degree < 2 || region->lowest == MW_NONE) continue;
        uint32_t half = o->half[region->lowest];
        mw_defect defect = mw__defect(MW_DEFECT_OVERLAP, mw__link_triangle(half));
        defect.edge =
            (uint8_t)mw__user_local_edge(o->mesh->tri[defect.triangle].user, mw__link_edge(half));
        if (!mw__defects_add(&s->defects, defect)) return false;
    }
    return true;
}

/* Change slots to the user's numbers. The lower triangle of a fold comes first. */
static void defect_to_user_numbers(const mw_mesh *mesh, mw_defect *d)
{
    d->triangle = mw__triangle_number(mesh, d->triangle);
    if (d->other != MW_NONE) d->other = mw__triangle_number(mesh, d->other);
    if (d->vertex != MW_NONE) d->vertex = mw__vertex_number(mesh, d->vertex);
    if (d->kind != MW_DEFECT_FOLDED || d->triangle < d->other) return;
    mw_defect same = *d;
    d->triangle = same.other;
    d->other = same.triangle;
    d->edge = same.other_edge;
    d->other_edge = same.edge;
}

static bool embedding_has_no_defect(const mw_embedding_check *s)
{
    for (size_t i = 0; i < s->defects.count; i++)
        if (s->defects.list[i].kind != MW_DEFECT_FLAT) return false;
    return true;
}

static mw_status embedding_check_cover(mw_embedding_check *s, mw_job *job, mw_error *error)
{
    mw_job_span outer = mw__job_part(job, 0.7);
    mw_status status = mw__coverage_create(&s->coverage, &s->outline, job, &s->defects, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    mw__job_stage(job, "looking for overlaps", 0.1);
    if (!mw__regions_create(&s->regions, &s->coverage) || !overlaps_find(s))
        return mw__fail_memory(error);
    return MW_OK;
}

mw_status mw__embedding_check_create(mw_embedding_check *check, const mw_mesh *mesh, mw_job *job,
                                     mw_error *error)
{
    *check = (mw_embedding_check){.mesh = mesh};
    mw__job_stage(job, "looking for defects", 0.2);
    check->convex = check->embedding = mw__mesh_is_convex(mesh);
    if (check->convex) return MW_OK;
    if (!mw__outline_create(&check->outline, mesh) ||
        !mw__find_local_defects(&check->outline, &check->defects))
        return mw__fail_memory(error);
    if (check->outline.half_count > 0) {
        mw_status status = embedding_check_cover(check, job, error);
        if (status) return status;
    }
    check->embedding = embedding_has_no_defect(check);
    /* triangles that turn round a vertex more than once overlap: then there is a defect already */
    if (!check->embedding && !mw__find_winding_defects(&check->outline, &check->defects))
        return mw__fail_memory(error);
    for (size_t i = 0; i < check->defects.count; i++)
        defect_to_user_numbers(mesh, &check->defects.list[i]);
    mw__defects_sort(&check->defects);
    return MW_OK;
}

void mw__embedding_check_release(mw_embedding_check *check)
{
    mw__defects_release(&check->defects);
    mw__outline_release(&check->outline);
    mw__coverage_release(&check->coverage);
    mw__regions_release(&check->regions);
    *check = (mw_embedding_check){0};
}
