/* prober.c - a surface prepared for probes, and how its boxes follow the surface as it moves.
 *
 * While the vertices are known to move little, the boxes are not touched: where no vertex has moved farther than
 * `slack` since they were fitted, boxes larger by that on all sides still hold their triangles. */
#include "surface/prober.h"

#include "base/clock.h"

#include <stdlib.h>

/* Boxes that are larger by a quarter of their edges on either side have 1.5 times the edges, and are met by 2.25 times
 * as many lines: from there on it does not take many queries for a fit to pay. */
#define SLACK_LIMIT 0.25

static void fit(mw_prober *prober, uint32_t threads)
{
    double start = mw__seconds();
    mw__surface_boxes_fit(&prober->boxes, prober->surface, threads);
    prober->fit_seconds = mw__seconds() - start;
    prober->fits++;
    prober->slack = 0;
    prober->slack_limit = SLACK_LIMIT * mw__surface_boxes_leaf_size(&prober->boxes);
}

/* Of a few corners, evenly taken. A guide only: overflow, and surfaces that grow, make choices worse, not answers. */
static double measure_spread(const mw_surface *surface)
{
    enum { CORNERS = 256 };
    uint32_t stride = surface->tri_count / CORNERS + 1, count = 0;
    double sum[3] = {0, 0, 0}, squares = 0;
    for (uint32_t t = 0; t < surface->tri_count; t += stride) {
        const double *p = mw__surface_corner(surface, t, 0), *origin = mw__surface_corner(surface, 0, 0);
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

mw_status mw_prober_create(const mw_surface *surface, const mw_prober_options *options, mw_prober **out,
                           mw_error *error)
{
    static const mw_prober_options defaults;
    if (!options) options = &defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the prober");
    *out = NULL;
    if (!surface) return mw__fail(error, MW_ERROR_ARGUMENT, "no surface");
    if (surface->tri_count == 0) return mw__fail(error, MW_ERROR_INPUT, "the surface has no triangle");
    mw_prober *prober = mw__calloc(1, sizeof *prober);
    if (!prober) return mw__fail_memory(error);
    prober->surface = surface;
    prober->version = surface->version;
    prober->has_boxes = options->boxes != 0;
    prober->spread2 = measure_spread(surface);
    if (prober->has_boxes) {
        if (!mw__surface_boxes_create(&prober->boxes, surface)) {
            mw_prober_destroy(prober);
            return mw__fail_memory(error);
        }
        fit(prober, 0);
    }
    *out = prober;
    return MW_OK;
}

void mw_prober_destroy(mw_prober *prober)
{
    if (!prober) return;
    mw__surface_boxes_release(&prober->boxes);
    free(prober);
}

void mw_prober_update(mw_prober *prober, double moved, uint32_t threads)
{
    /* a version was left out: what happened then is not known */
    bool known = moved >= 0 && isfinite(moved) && prober->surface->version - prober->version <= 1;
    prober->version = prober->surface->version;
    if (!prober->has_boxes) return;
    if (known && moved > 0) prober->slack = nextafter(prober->slack + moved, INFINITY);
    if (!known || prober->slack > prober->slack_limit) fit(prober, threads);
}

void mw_prober_describe(const mw_prober *prober, mw_prober_info *info)
{
    *info = (mw_prober_info){.bytes = sizeof *prober, .fits = prober->fits, .fit_seconds = prober->fit_seconds};
    if (prober->has_boxes) info->box_bytes = mw__surface_boxes_bytes(&prober->boxes);
    info->bytes += info->box_bytes;
}
