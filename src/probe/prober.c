/* prober.c - a surface prepared for probes, and its BVH, which follows the surface when it moves.
 *
 * As long as the vertices are known to have moved little, the boxes stay as they are: if no vertex
 * has moved farther than `slack` since they were fitted, boxes that are widened by `slack` on all
 * sides still contain their triangles. */
#include "probe/prober.h"
#include "base/options.h"

#include "base/clock.h"

#include <stdlib.h>

/* Boxes widened by a quarter of their edges on both sides have 1.5 times the edges, and 2.25 times
 * as many lines meet them. Beyond that, fitting them again pays after few queries. */
#define SLACK_LIMIT 0.25

static bool prober_fit(mw_prober *prober, mw_job *job)
{
    double start = mw__seconds();
    if (!mw__bvh_fit(&prober->bvh, prober->surface, job)) return false;
    prober->fit_seconds = mw__seconds() - start;
    prober->fits++;
    prober->slack = 0;
    prober->joined = mw__surface_is_joined(prober->surface);
    prober->slack_limit = SLACK_LIMIT * mw__bvh_triangle_size(&prober->bvh);
    return true;
}

static mw_status prober_make_boxes(mw_prober *prober, mw_job *job, mw_error *error)
{
    mw_job_span outer = mw__job_part(job, 0.6);
    bool done = mw__bvh_create(&prober->bvh, prober->surface, job);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.4);
    done = done && prober_fit(prober, job);
    mw__job_part_end(job, outer);
    return done ? MW_OK : mw__fail_memory(error);
}

bool mw__prober_remake(mw_prober *prober, mw_job *job, mw_prober *former)
{
    *former = *prober;
    bool done = prober_make_boxes(prober, job, NULL) == MW_OK &&
                (!former->bvh.parent || mw__bvh_follow(&prober->bvh, prober->surface));
    if (!done) {
        mw__bvh_release(&prober->bvh);
        *prober = *former;
        return false;
    }
    prober->closed = mw__surface_is_closed(prober->surface);
    prober->edit_count = prober->surface->edit_count;
    return true;
}

bool mw__prober_rebuild(mw_prober *prober, mw_job *job)
{
    mw_prober former;
    bool done = mw__prober_remake(prober, job, &former);
    if (done) mw__bvh_release(&former.bvh);
    return done;
}

static mw_status prober_make(mw_prober *prober, const mw_prober_options *options, mw_job *job,
                             mw_error *error)
{
    const double boxes = !options->boxes ? 0 : options->guide ? 0.95 : 1;
    mw_status status = MW_OK;
    if (options->boxes) {
        mw_job_span outer = mw__job_part(job, boxes);
        status = prober_make_boxes(prober, job, error);
        mw__job_part_end(job, outer);
    }
    if (status || !options->guide) return status;
    mw_job_span outer = mw__job_part(job, 1 - boxes);
    bool done = mw__probe_guide_create(&prober->guide, prober->surface, job);
    mw__job_part_end(job, outer);
    return done ? MW_OK : mw__fail_memory(error);
}

/* The variance of a sample of corners. It is only a guide: overflow, or a growing surface, makes
 * choices worse, but not answers. */
static double prober_sample_variance(const mw_surface *surface)
{
    enum { CORNERS = 256 };
    uint32_t stride = surface->tri_count / CORNERS + 1, count = 0;
    double sum[3] = {0, 0, 0}, squares = 0;
    for (uint32_t t = 0; t < surface->tri_count; t += stride) {
        const double *p = mw__surface_corner(surface, t, 0),
                     *origin = mw__surface_corner(surface, 0, 0);
        if (!mw__is_finite3(p) || !mw__is_finite3(origin)) continue;
        for (int k = 0; k < 3; k++) {
            double x = p[k] - origin[k];
            sum[k] += x;
            squares += x * x;
        }
        count++;
    }
    double mean2 = count ? (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / count : 0;
    return count ? (squares - mean2) / count : 0;
}

mw_status mw_prober_create(const mw_surface *surface, const mw_prober_options *options,
                           mw_prober **out, mw_error *error)
{
    static const mw_prober_options defaults;
    if (!options) options = &defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new prober is NULL");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (surface->tri_count == 0)
        return mw__fail(error, MW_ERROR_INPUT, "the surface has no triangle");
    mw_status status = MW_RESERVED_CHECK(mw_prober_options, options, error);
    if (status) return status;
    mw_prober *prober = mw__calloc(1, sizeof *prober);
    if (!prober) return mw__fail_memory(error);
    prober->surface = surface;
    prober->version = surface->version;
    prober->edit_count = surface->edit_count;
    prober->has_bvh = options->boxes != 0;
    prober->variance = prober_sample_variance(surface);
    if (prober->has_bvh) prober->closed = mw__surface_is_closed(surface);
    if (options->boxes || options->guide) {
        mw_job job = mw__job(options->threads, options->progress);
        status = mw__job_end(&job, prober_make(prober, options, &job, error), error);
    }
    if (status)
        mw_prober_destroy(prober);
    else
        *out = prober;
    return status;
}

void mw_prober_destroy(mw_prober *prober)
{
    if (!prober) return;
    mw__bvh_release(&prober->bvh);
    mw__probe_guide_release(&prober->guide);
    free(prober);
}

void mw_prober_update(mw_prober *prober, double moved, uint32_t threads)
{
    /* if a version is missing, its movement is not known */
    bool known = moved >= 0 && isfinite(moved) && prober->surface->version - prober->version <= 1;
    mw_job job = mw__job(threads, NULL);
    bool reshaped = prober->has_bvh && prober->edit_count != prober->surface->edit_count;
    if (reshaped && !mw__prober_rebuild(prober, &job)) return; /* it stays out of date */
    prober->version = prober->surface->version;
    if (!prober->has_bvh || reshaped) return;
    if (known && moved > 0) {
        prober->slack = nextafter(prober->slack + moved, INFINITY);
        prober->joined = prober->surface->coincident == NULL;
    }
    if (!known || prober->slack > prober->slack_limit) prober_fit(prober, &job);
}

void mw_prober_describe(const mw_prober *prober, mw_prober_info *info)
{
    *info = (mw_prober_info){
        .bytes = sizeof *prober, .fits = prober->fits, .fit_seconds = prober->fit_seconds};
    if (prober->has_bvh) info->box_bytes = mw__bvh_bytes(&prober->bvh);
    info->guide_bytes = mw__probe_guide_bytes(&prober->guide);
    info->bytes += info->box_bytes + info->guide_bytes;
}
