#include "cli/series/series_values.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int series_values_open(series_values *v, const series_choice *choice, const series_points *at)
{
    const size_t vertices = mw_mesh_vertex_count(at->mesh),
                 most = at->face_count > vertices ? at->face_count : vertices;
    mw_error error;
    *v = (series_values){.choice = choice, .at = at};
    v->values = malloc(most * sizeof *v->values + 1);
    v->vertices = malloc(vertices * sizeof *v->vertices + 1);
    if (!v->values || !v->vertices) return fail_memory();
    const mw_operator_options options = {.threads = at->threads};
    if (mw_operator_create(at->mesh, at->located, at->count, &options, &v->weights, &error) !=
        MW_OK)
        return fail_query(&error);
    return 0;
}

void series_values_release(series_values *v)
{
    mw_operator_destroy(v->weights);
    free(v->values);
    free(v->vertices);
}

static size_t values_face(const series_points *at, uint32_t triangle)
{
    return at->face ? at->face[triangle] : triangle;
}

static int values_weigh(const series_values *v, const double *vertices, double *result)
{
    mw_error error;
    const mw_value_table table = {.values = vertices, .count = 1};
    const mw_operator_apply_options options = {.threads = v->at->threads};
    return mw_operator_apply(v->weights, &table, &options, result, &error) == MW_OK
               ? 0
               : fail_query(&error);
}

int series_values_read(series_values *v, size_t k, size_t step, double *result)
{
    mw_error error;
    const series_points *at = v->at;
    const bool faces = series_field(v->choice, k)->location == MW_SERIES_FACE;
    if (mw_series_read(v->choice->series, v->choice->field[k], step, v->values, &error) != MW_OK)
        return fail_reading(&error);
    if (!faces) return values_weigh(v, v->values, result);
    if (at->recover) {
        if (mw_recover_vertex_values(at->mesh, v->values, at->face, v->vertices, &error) != MW_OK)
            return fail_query(&error);
        return values_weigh(v, v->vertices, result);
    }
    for (size_t i = 0; i < at->count; i++) {
        const uint32_t t = at->located[i].triangle;
        result[i] = t == MW_NONE ? NAN : v->values[values_face(at, t)];
    }
    return 0;
}

/* --- points with times of their own ----------------------------------------------------------- */

/* Set the values of the points whose times lie between step and step + 1. */
static void values_between(const series_values *v, size_t step, const double *before,
                           const double *after, const double *times, size_t stride, double *result)
{
    const double *t = v->choice->info->times;
    for (size_t i = 0; i < v->at->count; i++) {
        const double at = times[i * stride];
        if (!(at >= t[step] && at <= t[step + 1])) continue;
        const double share = (at - t[step]) / (t[step + 1] - t[step]);
        /* At the time of a step only this step counts, even if a value of the other step is
         * missing. */
        result[i] = share == 0   ? before[i]
                    : share == 1 ? after[i]
                                 : before[i] + share * (after[i] - before[i]);
    }
}

int series_values_follow(series_values *v, size_t k, const double *times, size_t stride,
                         double *result)
{
    const series_choice *c = v->choice;
    const size_t n = v->at->count;
    double *before = malloc(n * sizeof *before + 1), *after = malloc(n * sizeof *after + 1);
    int end = before && after ? 0 : fail_memory();
    for (size_t i = 0; i < n; i++) result[i] = NAN;
    if (end == 0) end = series_values_read(v, k, c->first, before);
    for (size_t i = 0; i < n && end == 0; i++)
        if (times[i * stride] == c->info->times[c->first]) result[i] = before[i];
    for (size_t step = c->first; step < c->last && end == 0; step++) {
        end = series_values_read(v, k, step + 1, after);
        if (end == 0) values_between(v, step, before, after, times, stride, result);
        double *swap = before;
        before = after;
        after = swap;
    }
    free(before);
    free(after);
    return end;
}
