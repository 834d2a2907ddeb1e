/* star_check.c - what keeps arrays from being a star-shaped polyhedron. */
#include "star/prepare/kernel_check.h"
#include "base/options.h"

#include <stdlib.h>
#include <string.h>

/* The arrays make a surface. Add the defects that keep it from being star-shaped. */
static mw_status star_check_kernel(const mw_arrays *arrays, int weld,
                                   const mw_star_options *options, mw_job *job, mw_defects *defects,
                                   bool *sound, mw_error *error)
{
    mw_surface_options how = {.weld = weld};
    mw_surface *surface;
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = mw__surface_create(arrays, &how, job, &surface, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.5);
    if (status) return status;
    size_t before = defects->count;
    mw_star star = {
        .surface = surface, .tri_count = surface->tri_count, .point_count = surface->point_count};
    memcpy(star.centre, options->centre, sizeof star.centre);
    star.tri = mw__alloc_lines(star.tri_count, sizeof *star.tri);
    if (star.tri) memcpy(star.tri, surface->tri, star.tri_count * sizeof *star.tri);
    if (!star.tri || !mw__star_kernel_check(&star, job, defects)) status = mw__fail_memory(error);
    mw__job_part_end(job, outer);
    *sound = defects->count == before && star.area_count > 0;
    free(star.tri);
    mw_surface_destroy(surface);
    return status;
}

/* The defects of the arrays as a surface, then those that keep it from being star-shaped. */
static mw_status star_check_run(const mw_arrays *arrays, int weld, const mw_star_options *options,
                                mw_job *job, mw_check *check, mw_error *error)
{
    mw_job_span outer = mw__job_part(job, 0.5);
    mw_status status = mw__surface_check(arrays, weld, job, check, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    mw_defects defects = {0};
    bool usable = true, sound = false;
    for (size_t i = 0; i < check->defect_count && status == MW_OK; i++) {
        mw_defect_kind kind = check->defects[i].kind;
        usable = usable && (kind == MW_DEFECT_FLAT || kind == MW_DEFECT_CLASHING);
        if (kind != MW_DEFECT_CLASHING && !mw__defects_add(&defects, check->defects[i]))
            status = mw__fail_memory(error);
    }
    outer = mw__job_part(job, 0.5);
    if (status == MW_OK && usable)
        status = star_check_kernel(arrays, weld, options, job, &defects, &sound, error);
    mw__job_part_end(job, outer);
    mw_check_release(check);
    if (status) {
        mw__defects_release(&defects);
        return status;
    }
    mw__defects_sort(&defects);
    *check = (mw_check){.defects = defects.list, .defect_count = defects.count, .valid = sound};
    return MW_OK;
}

mw_status mw_star_check_arrays(const mw_arrays *arrays, int weld, const mw_star_options *options,
                               mw_check *check, mw_error *error)
{
    static const mw_star_options defaults;
    if (!check) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the report is NULL");
    *check = (mw_check){0};
    if (!options) options = &defaults;
    if (!mw__is_finite3(options->centre))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the centre is not finite");
    mw_status status = MW_RESERVED_CHECK(mw_star_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__job_end(&job, star_check_run(arrays, weld, options, &job, check, error), error);
    if (status) mw_check_release(check);
    return status;
}
