/* Any bytes as values over time, or as a file of weights: the first byte chooses the name of the
 * file, by which some kinds are known. netCDF-4 is left out: damaged files bring HDF5 down. */
#include "reader.h"

#include <meshwalk/series.h>
#include <meshwalk/weights.h>

#include <stdio.h>
#include <unistd.h>

static const char *const names[] = {"fort.63",    "fort.64",   "maxele.63",
                                    "values.dat", "v_els.dat", "values.slf",
                                    "values.nc",  "fort.74",   "weights.nc"};
enum { NAME_COUNT = sizeof names / sizeof *names, WEIGHTS = 8, LARGEST = 1 << 20 };

/* Series are read by their paths: a file in memory, where there is such a place. */
static const char *series_path(uint8_t choice)
{
    static char folder[64], path[128];
    if (!*folder) {
        snprintf(folder, sizeof folder, "%s/meshwalk_fuzz_XXXXXX",
                 access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
        require(mkdtemp(folder) != NULL);
    }
    snprintf(path, sizeof path, "%s/%s", folder, names[choice % NAME_COUNT]);
    return path;
}

static void series_write(const char *path, const uint8_t *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    require(file && fwrite(data, 1, size, file) == size && fclose(file) == 0);
}

/* The first step and the last, and the first once more. */
static void require_steps(mw_series *series, size_t field, const char *path)
{
    const mw_series_info *info = mw_series_describe(series);
    const size_t count = info->fields[field].value_count,
                 last = info->step_count > 0 ? info->step_count - 1 : 0;
    const size_t steps[] = {0, last, 0};
    if (count > LARGEST) return;
    double *values = malloc(count * sizeof *values + 1);
    require(values != NULL);
    for (int k = 0; k < 3; k++) {
        mw_error error = {0};
        const mw_status status = mw_series_read(series, field, steps[k], values, &error);
        if (status)
            require_error(status, &error, path);
        else
            require_values(values, count);
    }
    free(values);
}

static void require_series(mw_series *series, const char *path)
{
    const mw_series_info *info = mw_series_describe(series);
    require(info->field_count > 0 && info->field_count < 1 << 20);
    require(info->time_unit && info->calendar);
    for (size_t s = 1; s < info->step_count; s++) require(info->times[s] > info->times[s - 1]);
    for (size_t f = 0; f < info->field_count; f++) {
        require(info->fields[f].name && info->fields[f].unit);
        require(mw_series_find(series, info->fields[f].name) <= f);
        if (f < 4 || f + 1 == info->field_count) require_steps(series, f, path);
    }
}

/* Each row of a field of ones is the sum of its weights. */
static void require_weights(const mw_operator *weights)
{
    mw_operator_info info;
    mw_error error = {0};
    mw_operator_describe(weights, &info);
    if (info.rows > LARGEST || info.columns > LARGEST) return;
    double *ones = malloc(info.columns * sizeof *ones + 1),
           *sums = malloc(info.rows * sizeof *sums + 1);
    require(ones && sums);
    for (uint32_t v = 0; v < info.columns; v++) ones[v] = 1;
    const mw_value_table table = {.values = ones, .count = 1};
    const mw_operator_apply_options options = {.threads = 1};
    require(mw_operator_apply(weights, &table, &options, sums, &error) == MW_OK);
    require_values(sums, info.rows);
    free(ones);
    free(sums);
}

static mw_status series_read(const char *path, mw_error *error)
{
    mw_series *series;
    const mw_status status = mw_series_open(path, NULL, &series, error);
    if (status == MW_OK) require_series(series, path);
    mw_series_close(series);
    return status;
}

static mw_status weights_read(const char *path, mw_error *error)
{
    mw_operator *weights;
    const mw_status status = mw_read_weights(path, NULL, &weights, error);
    if (status == MW_OK) require_weights(weights);
    mw_operator_destroy(weights);
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    mw_error error = {0};
    if (size < 2 || memcmp(data + 1, "\211HDF", size < 5 ? size - 1 : 4) == 0) return 0;
    if (size > 3 && data[1] == 0x1f && data[2] == 0x8b) return 0; /* it may hold such a file */
    const bool weights = data[0] % NAME_COUNT == WEIGHTS;
    const char *path = series_path(data[0]);
    series_write(path, data + 1, size - 1);
    const mw_status status = weights ? weights_read(path, &error) : series_read(path, &error);
    if (status && status != MW_ERROR_SYSTEM) /* there is no libnetcdf */
        require_error(status, &error, path);
    unlink(path);
    return 0;
}
