/* weight_file.c - writes an operator; the name of the file decides the format. */
#include "base/options.h"
#include "base/posix.h"
#include "io/weights/weight_rows.h"

#include <stdlib.h>
#include <string.h>

static bool path_ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

static bool rows_copy(mw_weight_rows *rows, const mw_operator *weights)
{
    mw_operator_describe(weights, &rows->info);
    rows->first = mw__alloc((uint64_t)rows->info.rows + 1, sizeof *rows->first);
    rows->column = mw__alloc(rows->info.entries, sizeof *rows->column);
    rows->weight = mw__alloc(rows->info.entries, sizeof *rows->weight);
    const bool made = rows->first && rows->column && rows->weight;
    if (made) mw_operator_copy(weights, rows->first, rows->column, rows->weight);
    return made;
}

static mw_status rows_check(const char *path, const mw_operator *weights, mw_error *error)
{
    mw_operator_info info;
    mw_operator_describe(weights, &info);
    if (info.rows > INT32_MAX || info.columns > INT32_MAX || info.entries > INT32_MAX)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "%.240s: files of weights have 32-bit numbers: no more than %d rows, "
                        "columns or weights",
                        path, INT32_MAX);
    return MW_OK;
}

mw_status mw_write_weights(const char *path, const mw_operator *weights,
                           const mw_weight_positions *positions, const mw_file_options *options,
                           mw_error *error)
{
    static const mw_file_options plain;
    static const mw_weight_positions unknown;
    if (!options) options = &plain;
    if (!positions) positions = &unknown;
    if (!path || !weights)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the path or the operator is NULL");
    mw_status status = MW_RESERVED_CHECK(mw_file_options, options, error);
    if (!status) status = rows_check(path, weights, error);
    if (status) return status;
    mw_weight_rows rows = {0};
    mw_job job = mw__job(1, options->progress);
    mw__job_stage(&job, "writing weights", 1);
    if (!rows_copy(&rows, weights))
        status = mw__fail_memory(error);
    else if (path_ends_in(path, ".npz"))
        status = mw__npz_write(path, &rows, &job, error);
    else
        status = mw__esmf_write(path, &rows, positions, &job, error);
    free(rows.first);
    free(rows.column);
    free(rows.weight);
    return mw__job_end(&job, status, error);
}
