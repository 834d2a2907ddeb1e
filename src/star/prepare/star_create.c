/* star_create.c - makes a surface ready for rays from a centre. */
#include "base/options.h"
#include "star/prepare/star_prepare.h"
#include "star/prepare/star_track.h"
#include "star/star_hubs.h"

#include <stdlib.h>
#include <string.h>

static mw_status star_check_options(const mw_star_options *options, mw_error *error)
{
    if (!mw__is_finite3(options->centre))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the centre is not finite");
    if (options->unchecked && !options->borrow)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the option 'unchecked' needs 'borrow'");
    if (options->angles && options->borrow)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the option 'angles' cannot be used with 'borrow'");
    return MW_RESERVED_CHECK(mw_star_options, options, error);
}

mw_status mw_star_create(const mw_surface *surface, const mw_star_options *options, mw_star **out,
                         mw_error *error)
{
    static const mw_star_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new star is NULL");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (!options) options = &defaults;
    mw_status status = star_check_options(options, error);
    if (status) return status;
    mw_star *star = mw__calloc(1, sizeof *star);
    if (!star) return mw__fail_memory(error);
    star->surface = surface;
    star->angles = options->angles != 0;
    star->borrowed = options->borrow != 0;
    star->unchecked = options->unchecked != 0;
    memcpy(star->centre, options->centre, sizeof star->centre);
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__star_allocate(star, options->angles) ? mw__star_prepare(star, &job, error)
                                                      : mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    if (status)
        mw_star_destroy(star);
    else
        *out = star;
    return status;
}

void mw_star_destroy(mw_star *star)
{
    if (!star) return;
    mw__star_release_arrays(star);
    mw__star_hubs_release(&star->hubs);
    free(star->own_coincident);
    free(star);
}

void mw_star_describe(const mw_star *star, mw_star_info *info)
{
    size_t coincident = star->own_coincident ? star->point_count * sizeof *star->own_coincident : 0;
    size_t guide = star->guide ? ((size_t)1 << star->guide_bits) * sizeof *star->guide : 0,
           curve = star->curve ? sizeof *star->curve : 0;
    size_t angles = star->angle ? star->point_room * 2 * sizeof *star->angle : 0;
    size_t facets = star->tri_room * sizeof *star->facet,
           owners = star->point_room * sizeof *star->owner;
    *info = (mw_star_info){
        .bytes = sizeof *star + curve + facets + owners + mw__star_track_bytes(star) + guide +
                 angles + coincident + mw__star_hubs_bytes(&star->hubs),
        .angle_bytes = angles,
        .flat_facets = star->unchecked ? 0 : star->tri_count - star->area_count - star->freed_count,
        .centre = {star->centre[0], star->centre[1], star->centre[2]},
    };
}
