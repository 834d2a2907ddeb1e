/* surface_check.c - the public check of a surface that is still arrays, with any damage. */
#include "base/options.h"
#include "mesh/array_defects.h"
#include "topology/coincident.h"
#include "surface/surface.h"

/* Add the defects that make triangle t unusable, or that it is flat. The functions here return
 * false when out of memory. */
static bool surface_check_triangle(const mw_surface *surface, uint32_t t, mw_defects *defects)
{
    const double *corner[3];
    bool usable, finite[3];
    for (uint32_t k = 0; k < 3; k++) {
        corner[k] = mw__surface_corner(surface, t, k);
        finite[k] = mw__is_finite3(corner[k]);
    }
    if (!mw__find_unusable(surface->tri[t].v, finite, t, defects, &usable)) return false;
    if (!usable || !mw__collinear3(corner[0], corner[1], corner[2])) return true;
    return mw__defects_add(defects, mw__defect(MW_DEFECT_FLAT, t));
}

static bool surface_check_orientation(const mw_surface *surface, uint32_t t, mw_defects *defects)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = surface->tri[t].link[k];
        if (link == MW_NONE || mw__link_triangle(link) < t ||
            mw__surface_orientations_agree(surface, t, k))
            continue;
        mw_defect defect = mw__defect(MW_DEFECT_CLASHING, t);
        defect.edge = (uint8_t)k;
        defect.other = mw__link_triangle(link);
        defect.other_edge = (uint8_t)mw__link_edge(link);
        if (!mw__defects_add(defects, defect)) return false;
    }
    return true;
}

/* Coincident vertices are equal here: representatives stand for the vertices from here on. */
static bool surface_check_sharing(mw_surface *surface, mw_defects *defects)
{
    if (!surface->tolerant) return true;
    for (uint32_t t = 0; t < surface->tri_count && surface->coincident; t++)
        for (uint32_t k = 0; k < 4; k++)
            surface->tri[t].v[k] = surface->coincident[surface->tri[t].v[k]];
    return mw__find_non_manifold_edges(surface->tri, surface->tri_count, defects);
}

/* Find all defects, except those of replaced triangles (NULL: none are replaced), which have no
 * links. Afterwards the triangles name the representatives of their vertices. */
static mw_status surface_find_defects(mw_surface *surface, const uint8_t *replaced, mw_job *job,
                                      mw_defects *defects, mw_error *error)
{
    mw__job_stage(job, "looking for defects", 0.5);
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (replaced && replaced[t]) continue;
        if (!mw__job_step(job, t, surface->tri_count)) return mw__fail_memory(error);
        if (!surface_check_triangle(surface, t, defects) ||
            !surface_check_orientation(surface, t, defects))
            return mw__fail_memory(error);
    }
    return surface_check_sharing(surface, defects) ? MW_OK : mw__fail_memory(error);
}

/* Check arrays that mw_surface_create refuses: list the unusable triangles, and make a tolerant
 * surface of the rest. */
static mw_status surface_check_damaged(const mw_arrays *arrays, int weld, mw_job *job,
                                       mw_defects *defects, mw_error *error)
{
    mw_repair repair;
    mw_surface *surface = NULL;
    mw_surface_options options = {.tolerant = 1, .weld = weld};
    mw_status status = mw__repair_create(&repair, arrays, defects, error);
    if (!status && arrays->point_count > 0) {
        mw_job_span outer = mw__job_part(job, 0.5);
        status = mw__surface_create(&repair.arrays, &options, job, &surface, error);
        mw__job_part_end(job, outer);
        if (!status) status = surface_find_defects(surface, repair.replaced, job, defects, error);
    }
    mw_surface_destroy(surface);
    mw__repair_release(&repair);
    return status;
}

mw_status mw__surface_check(const mw_arrays *arrays, int weld, mw_job *job, mw_check *check,
                            mw_error *error)
{
    mw_defects defects = {0};
    mw_surface *surface = NULL;
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status =
        mw__surface_create(arrays, &(mw_surface_options){.weld = weld}, job, &surface, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.5);
    if (status == MW_OK)
        status = surface_find_defects(surface, NULL, job, &defects, error);
    else if (status == MW_ERROR_INPUT)
        status = surface_check_damaged(arrays, weld, job, &defects, error);
    mw__job_part_end(job, outer);
    mw_surface_destroy(surface);
    if (status) {
        mw__defects_release(&defects);
        return status;
    }
    mw__defects_sort(&defects);
    *check = (mw_check){.defects = defects.list, .defect_count = defects.count, .valid = 1};
    for (size_t i = 0; i < defects.count; i++)
        check->valid &= defects.list[i].kind == MW_DEFECT_FLAT;
    return MW_OK;
}

mw_status mw_surface_check_arrays(const mw_arrays *arrays, int weld,
                                  const mw_check_options *options, mw_check *check, mw_error *error)
{
    static const mw_check_options defaults;
    if (!check) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the report is NULL");
    *check = (mw_check){0};
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_check_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__job_end(&job, mw__surface_check(arrays, weld, &job, check, error), error);
    if (status) mw_check_release(check);
    return status;
}
