/* Values over time in one file or several: which kind of file, and which of them has a step. */
#include <meshwalk/series.h>

#include "base/options.h"
#include "io/series/series_kind.h"
#include "io/text/file_head.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const mw_series_kind *const kinds[] = {&mw__netcdf_series, &mw__selafin_series,
                                              &mw__adcirc_series, &mw__sms_series};
enum { KIND_COUNT = sizeof kinds / sizeof *kinds };

struct mw_series {
    mw_series_info info;
    double *times; /* of all parts */
    mw_series_part *parts;
    size_t part_count;
};

static mw_status series_open_source(mw_source *source, const mw_series_options *options,
                                    mw_series_part *part, mw_error *error)
{
    const char *head;
    size_t size;
    mw_status status = mw__source_peek(source, MW_HEAD_SIZE, &head, &size, error);
    if (status) return status;
    for (size_t k = 0; k < KIND_COUNT && !part->kind; k++)
        if (kinds[k]->is(source->path, head, size)) part->kind = kinds[k];
    if (part->kind) return part->kind->open(source, options, part, error);
    return mw__fail(error, MW_ERROR_INPUT,
                    "%.240s: not values over time in a known format (netCDF, Selafin, fort.63 and "
                    "others of ADCIRC, .dat of SMS)",
                    mw__source_name(source));
}

static mw_status series_open_part(const char *path, const mw_series_options *options,
                                  mw_series_part *part, mw_error *error)
{
    mw_source source;
    mw_status status = mw__source_open(&source, path, error);
    if (status) return status;
    status = series_open_source(&source, options, part, error);
    mw__source_close(&source);
    return status;
}

static bool texts_are_equal(const char *a, const char *b)
{
    return strcmp(a ? a : "", b ? b : "") == 0;
}

/* A further file has the fields of the first and counts its times as the first does. */
static mw_status series_compare(const char *path, const mw_series_part *first,
                                const mw_series_part *part, mw_error *error)
{
    if (!texts_are_equal(first->time_unit, part->time_unit) ||
        !texts_are_equal(first->calendar, part->calendar))
        return mw__fail(
            error, MW_ERROR_INPUT, "%.200s: its times are '%.60s', those of the first file '%.60s'",
            path, part->time_unit ? part->time_unit : "", first->time_unit ? first->time_unit : "");
    for (size_t f = 0; f < first->field_count; f++) {
        const mw_series_field *a = &first->fields[f], *b = &part->fields[f];
        if (f < part->field_count && strcmp(a->name, b->name) == 0 && a->location == b->location &&
            a->value_count == b->value_count)
            continue;
        return mw__fail(error, MW_ERROR_INPUT,
                        "%.240s: it does not have the field '%.80s' as the first file has it", path,
                        a->name);
    }
    return MW_OK;
}

/* The times of all parts, one behind the other. */
static mw_status series_join_times(mw_series *series, const char *const *paths, mw_error *error)
{
    size_t count = 0, at = 0;
    for (size_t p = 0; p < series->part_count; p++) count += series->parts[p].step_count;
    series->times = mw__alloc(count, sizeof *series->times);
    if (!series->times) return mw__fail_memory(error);
    for (size_t p = 0; p < series->part_count; p++) {
        const mw_series_part *part = &series->parts[p];
        if (at > 0 && part->step_count > 0 && !(part->times[0] > series->times[at - 1]))
            return mw__fail(
                error, MW_ERROR_INPUT,
                "%.240s: its first time, %g, is not later than the last one of the file before, %g",
                paths[p], part->times[0], series->times[at - 1]);
        for (size_t s = 0; s < part->step_count; s++) series->times[at++] = part->times[s];
    }
    series->info.step_count = count;
    series->info.times = series->times;
    return MW_OK;
}

static mw_status series_open_parts(mw_series *series, const char *const *paths,
                                   const mw_series_options *options, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t p = 0; p < series->part_count && !status; p++) {
        status = series_open_part(paths[p], options, &series->parts[p], error);
        if (!status && p > 0)
            status = series_compare(paths[p], &series->parts[0], &series->parts[p], error);
    }
    if (!status) status = series_join_times(series, paths, error);
    if (status) return status;
    const mw_series_part *first = &series->parts[0];
    series->info.time_unit = first->time_unit ? first->time_unit : "";
    series->info.calendar = first->calendar ? first->calendar : "";
    series->info.fields = first->fields;
    series->info.field_count = first->field_count;
    return MW_OK;
}

static mw_status series_open_all(const char *path, const mw_series_options *options,
                                 mw_series **out, mw_error *error)
{
    size_t count = 1 + options->more_count;
    mw_series *series = mw__calloc(1, sizeof *series);
    const char **paths = mw__alloc(count, sizeof *paths);
    if (series) series->parts = mw__calloc(count, sizeof *series->parts);
    mw_status status = MW_OK;
    if (!series || !paths || !series->parts) {
        status = mw__fail_memory(error);
    } else {
        series->part_count = count;
        paths[0] = path;
        for (size_t p = 1; p < count; p++) paths[p] = options->more_paths[p - 1];
        status = series_open_parts(series, paths, options, error);
    }
    free((void *)paths);
    if (status)
        mw_series_close(series);
    else
        *out = series;
    return status;
}

mw_status mw_series_open(const char *path, const mw_series_options *options, mw_series **out,
                         mw_error *error)
{
    static const mw_series_options defaults;
    if (out) *out = NULL;
    if (!path || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_series_open: a path or the pointer to the new series is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_series_options, options, error);
    if (status) return status;
    for (size_t p = 0; p < options->more_count; p++)
        if (!options->more_paths || !options->more_paths[p])
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "mw_series_open: a path or the pointer to the new series is NULL");
    return series_open_all(path, options, out, error);
}

const mw_series_info *mw_series_describe(const mw_series *series)
{
    return &series->info;
}

size_t mw_series_find(const mw_series *series, const char *name)
{
    for (size_t f = 0; f < series->info.field_count; f++)
        if (strcmp(series->info.fields[f].name, name) == 0) return f;
    return SIZE_MAX;
}

mw_status mw_series_read(mw_series *series, size_t field, size_t step, double *values,
                         mw_error *error)
{
    if (!series || !values)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_series_read: the series or the values are NULL");
    if (field >= series->info.field_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_series_read: there is no field %zu", field);
    bool constant = series->info.fields[field].constant;
    if (!constant && step >= series->info.step_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_series_read: there is no step %zu", step);
    size_t p = 0;
    while (!constant && step >= series->parts[p].step_count) step -= series->parts[p++].step_count;
    return series->parts[p].kind->read(series->parts[p].content, field, constant ? 0 : step, values,
                                       error);
}

void mw_series_close(mw_series *series)
{
    if (!series) return;
    for (size_t p = 0; p < series->part_count && series->parts; p++)
        mw__series_part_release(&series->parts[p]);
    free(series->parts);
    free(series->times);
    free(series);
}
