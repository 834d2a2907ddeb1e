/* call_values.c - long calls: values: tables, volumes, weights, operators. */
#include "support/calls/call_runs.h"

#include <math.h>
#include <meshwalk/operator.h>
#include <meshwalk/remap.h>
#include <meshwalk/volume.h>
#include <stdlib.h>

/* --- overlaps and tables ---------------------------------------------------------------------- */

/* Each vertex is as high as its x. */
mw_status run_volume_above(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    mw_volume_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_volume_above(in->locator, in->points, 0.5, &options, &info, error);
    if (!status) call_sum(sum, info.parts), call_sum_number(sum, info.cut);
    return status;
}

mw_status run_volume_between(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    mw_volume_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_volume_between(in->locator, in->points, in->locator, in->points, &options, &info, error);
    if (!status) call_sum(sum, info.parts), call_sum_number(sum, info.cut);
    return status;
}

mw_status run_surface_area(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    mw_surface_area_info info;
    mw_volume_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_surface_area(in->locator, in->points, in->locator, &options, &info, error);
    if (!status) call_sum(sum, info.parts), call_sum_number(sum, info.surface_area);
    return status;
}

static mw_status remap_sum(mw_status status, mw_remap *r, uint64_t *sum)
{
    call_expect(!status == (r->weights != NULL), "there are weights");
    if (!status) call_sum_number(sum, r->common_sum), call_sum_number(sum, r->source_fraction[0]);
    mw_remap_release(r);
    return status;
}

mw_status run_remap_to_mesh(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    mw_remap r;
    mw_remap_mesh mesh = {.locator = in->locator};
    mw_remap_options options = {.threads = how->threads, .progress = how->progress};
    return remap_sum(mw_remap_to_mesh(&mesh, &mesh, &options, &r, error), &r, sum);
}

mw_status run_remap_to_pixels(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    mw_remap r;
    mw_remap_mesh mesh = {.locator = in->locator};
    mw_remap_pixels pixels = {0, 1, 0.1, 0.1, 10, 10};
    mw_remap_options options = {.threads = how->threads, .progress = how->progress};
    return remap_sum(mw_remap_to_pixels(&mesh, &pixels, &options, &r, error), &r, sum);
}

mw_status run_table(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    enum { VALUES = 3 };
    size_t n = in->point_count;
    mw_location *at = malloc(n * sizeof *at);
    double *result = calloc(VALUES * n, sizeof *result);
    /* x, then x of the next vertices */
    mw_value_table table = {.values = in->points, .count = VALUES, .step = 2};
    mw_query_options query = {.threads = how->threads};
    mw_interpolate_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_locate_batch(in->locator, in->points, n, 2, &query, at, NULL, error);
    if (!status) status = mw_interpolate_table(in->mesh, &table, at, n, &options, result, error);
    for (size_t i = 0; i < VALUES * n && !status; i++)
        call_sum(sum, (uint64_t)llrint(result[i] * 1e6));
    free(result);
    free(at);
    return status;
}

/* --- operators -------------------------------------------------------------------------------- */

/* An operator that was made, or was not. */
static mw_status operator_made(mw_status status, mw_operator *weights, uint64_t *sum)
{
    mw_operator_info info;
    call_expect(!status == (weights != NULL), "there is an operator");
    if (status) return status;
    mw_operator_describe(weights, &info);
    call_sum(sum, (uint64_t)info.rows << 32 | info.entries);
    mw_operator_destroy(weights);
    return MW_OK;
}

mw_operator *call_operator_of(const call_inputs *in, const call_setting *how, mw_status *status,
                              mw_error *error)
{
    mw_operator *weights = NULL;
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_query_options alone = {.threads = 1};
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    expect_ok(mw_locate_batch(in->locator, in->points, in->point_count, 2, &alone, at, NULL, error),
              "locations", error);
    *status = mw_operator_create(in->mesh, at, in->point_count, &options, &weights, error);
    free(at);
    return weights;
}

mw_status run_operator(const call_inputs *in, const call_setting *how, uint64_t *sum,
                       mw_error *error)
{
    mw_status status;
    mw_operator *weights = call_operator_of(in, how, &status, error);
    return operator_made(status, weights, sum);
}

mw_status run_transpose(const call_inputs *in, const call_setting *how, uint64_t *sum,
                        mw_error *error)
{
    mw_status status;
    mw_operator *turned = NULL,
                *weights = call_operator_of(in, &(call_setting){.threads = 1}, &status, error);
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    status = mw_operator_transpose(weights, &options, &turned, error);
    mw_operator_destroy(weights);
    return operator_made(status, turned, sum);
}

/* Nearest points of the ball, found beforehand, as places. */
mw_status run_operator_surface(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    const uint32_t n = in->ball.triangles;
    mw_nearest_surface_point *at = malloc(n * sizeof *at + 1);
    mw_operator *weights;
    for (uint32_t i = 0; i < n; i++)
        at[i] = (mw_nearest_surface_point){.triangle = i * 7919u % n, .weight = {0.5, 0.25, 0.25}};
    const mw_hits hits = mw_hits_of_nearest(at, n);
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_operator_create_on_surface(in->surface, &hits, &options, &weights, error);
    free(at);
    return operator_made(status, weights, sum);
}

mw_status run_operator_entries(const call_inputs *in, const call_setting *how, uint64_t *sum,
                               mw_error *error)
{
    mw_operator *weights;
    double *ones = malloc(in->point_count * sizeof *ones);
    uint32_t *number = malloc(in->point_count * sizeof *number);
    for (uint32_t i = 0; i < in->point_count; i++) {
        ones[i] = 1;
        number[i] = i;
    }
    mw_operator_entries entries = {.row = number,
                                   .column = number,
                                   .weight = ones,
                                   .count = in->point_count,
                                   .rows = in->point_count,
                                   .columns = in->point_count};
    mw_operator_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_operator_create_from_entries(&entries, &options, &weights, error);
    free(number);
    free(ones);
    return operator_made(status, weights, sum);
}

mw_status run_operator_apply(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    mw_status status;
    mw_operator *weights = call_operator_of(in, &(call_setting){.threads = 1}, &status, error);
    double *result = malloc(2 * in->point_count * sizeof *result);
    mw_value_table table = {.values = in->points, .count = 2};
    mw_operator_apply_options options = {.threads = how->threads, .progress = how->progress};
    status = mw_operator_apply(weights, &table, &options, result, error);
    for (uint32_t i = 0; i < in->point_count && !status; i++)
        call_sum(sum, (uint64_t)(result[2 * i] * 1e9));
    free(result);
    mw_operator_destroy(weights);
    return status;
}
