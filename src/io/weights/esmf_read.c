/* esmf_read.c - weights in the layout of ESMF's weight files, whoever wrote them. */
#include "io/weights/esmf_read.h"

#include "base/options.h"
#include "io/netcdf/netcdf_source.h"
#include "io/netcdf/netcdf_values.h"

#include <meshwalk/weights.h>
#include <stdlib.h>

enum { BLOCK = 1 << 16 }; /* numbers that are read at a time */

typedef struct esmf_reading {
    const mw_netcdf *file;
    const mw_netcdf_variable *row, *column, *weight;
    mw_operator_entries entries;
    uint32_t *rows, *columns;
    double *weights;
    mw_job *job;
} esmf_reading;

/* The length of a dimension that has to be there. No variable need be of that length: where a file
 * tells more than it can be about, it is damaged, and memory for so many rows is not asked for. */
static mw_status esmf_size(const esmf_reading *r, const char *name, uint32_t *size, mw_error *error)
{
    const uint64_t most = 1024 * (mw__netcdf_file_size(r->file) + 1024);
    size_t length;
    if (mw__netcdf_dimension_find(r->file, name, &length) < 0)
        return mw__netcdf_fail(r->file, NULL, error,
                               "has no dimension %s: a file of weights in ESMF's layout tells the "
                               "size of the matrix by it (ESMF's --weight_only leaves it out)",
                               name);
    if (length >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "%.240s: dimension %s has %zu members; at most %u are possible",
                        mw__netcdf_name(r->file), name, length, MW_NONE - 1);
    if (length > most)
        return mw__netcdf_fail(r->file, NULL, error,
                               "dimension %s has %zu members, more than a file of this size has",
                               name, length);
    *size = (uint32_t)length;
    return MW_OK;
}

/* A variable with one number for each entry. */
static mw_status esmf_find(esmf_reading *r, const char *name, const mw_netcdf_variable **out,
                           mw_error *error)
{
    mw_status status = mw__netcdf_need(r->file, name, out, error);
    if (status) return status;
    if ((*out)->rank != 1 || (*out)->lengths[0] != r->entries.count)
        return mw__netcdf_fail(r->file, *out, error, "has no value for each of the %zu entries",
                               r->entries.count);
    return MW_OK;
}

static mw_status esmf_find_base(esmf_reading *r, mw_error *error)
{
    double row = 1, column = 1;
    mw__netcdf_number(r->file, r->row, "start_index", &row);
    mw__netcdf_number(r->file, r->column, "start_index", &column);
    if (row != column || (row != 0 && row != 1))
        return mw__netcdf_fail(
            r->file, r->row, error,
            "its start_index is %g and that of col is %g; both must be 0 or both 1", row, column);
    r->entries.base = (uint32_t)row;
    return MW_OK;
}

static mw_status esmf_open(esmf_reading *r, mw_error *error)
{
    uint32_t count = 0;
    mw_status status = esmf_size(r, "n_a", &r->entries.columns, error);
    if (!status) status = esmf_size(r, "n_b", &r->entries.rows, error);
    if (!status) status = esmf_size(r, "n_s", &count, error);
    r->entries.count = count;
    if (!status) status = esmf_find(r, "row", &r->row, error);
    if (!status) status = esmf_find(r, "col", &r->column, error);
    if (!status) status = esmf_find(r, "S", &r->weight, error);
    if (!status) status = mw__netcdf_check_size(r->file, r->row, error);
    if (!status) status = mw__netcdf_check_size(r->file, r->column, error);
    if (!status) status = mw__netcdf_check_size(r->file, r->weight, error);
    return status ? status : esmf_find_base(r, error);
}

static mw_status esmf_read_numbers(esmf_reading *r, const mw_netcdf_variable *variable,
                                   uint32_t *numbers, size_t from, size_t count, int64_t *block,
                                   mw_error *error)
{
    mw_status status = mw__netcdf_integers(r->file, variable, &from, &count, block, error);
    for (size_t i = 0; i < count && !status; i++) {
        if (block[i] < 0 || block[i] >= MW_NONE)
            return mw__netcdf_fail(r->file, variable, error,
                                   "entry %zu is %lld, which is out of range", from + i,
                                   (long long)block[i]);
        numbers[from + i] = (uint32_t)block[i];
    }
    return status;
}

static mw_status esmf_read_blocks(esmf_reading *r, int64_t *block, mw_error *error)
{
    mw_status status = MW_OK;
    const size_t n = r->entries.count;
    for (size_t from = 0; from < n && !status; from += BLOCK) {
        const size_t count = n - from < BLOCK ? n - from : BLOCK;
        status = esmf_read_numbers(r, r->row, r->rows, from, count, block, error);
        if (!status)
            status = esmf_read_numbers(r, r->column, r->columns, from, count, block, error);
        if (!status)
            status =
                mw__netcdf_doubles(r->file, r->weight, &from, &count, r->weights + from, error);
        if (!status && !mw__job_step(r->job, from + count, n)) status = MW_ERROR_MEMORY;
    }
    return status;
}

static mw_status esmf_read_entries(esmf_reading *r, mw_error *error)
{
    const size_t n = r->entries.count;
    r->rows = mw__alloc(n, sizeof *r->rows);
    r->columns = mw__alloc(n, sizeof *r->columns);
    r->weights = mw__alloc(n, sizeof *r->weights);
    int64_t *block = mw__alloc(BLOCK, sizeof *block);
    mw_status status = r->rows && r->columns && r->weights && block
                           ? esmf_read_blocks(r, block, error)
                           : mw__fail_memory(error);
    free(block);
    r->entries.row = r->rows;
    r->entries.column = r->columns;
    r->entries.weight = r->weights;
    return status;
}

/* Entries that fit no matrix are told with the file's name. */
static mw_status esmf_make(const esmf_reading *r, mw_operator **out, mw_error *error)
{
    mw_error inner;
    mw_status status = mw_operator_create_from_entries(&r->entries, NULL, out, &inner);
    if (!status) return MW_OK;
    return mw__fail(error, status, "%.200s: %.200s", mw__netcdf_name(r->file), inner.message);
}

mw_status mw__esmf_read(const mw_netcdf *file, mw_job *job, mw_operator **out, mw_error *error)
{
    esmf_reading r = {.file = file, .job = job};
    *out = NULL;
    mw_status status = esmf_open(&r, error);
    if (!status) status = esmf_read_entries(&r, error);
    if (!status) status = esmf_make(&r, out, error);
    free(r.rows);
    free(r.columns);
    free(r.weights);
    return status;
}

mw_status mw_read_weights(const char *path, const mw_file_options *options, mw_operator **out,
                          mw_error *error)
{
    static const mw_file_options plain;
    mw_netcdf *file;
    void *memory;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new operator is NULL");
    *out = NULL;
    if (!options) options = &plain;
    if (!path) return mw__fail(error, MW_ERROR_ARGUMENT, "the path of the file of weights is NULL");
    mw_status status = MW_RESERVED_CHECK(mw_file_options, options, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    mw__job_stage(&job, "reading weights", 1);
    status = mw__netcdf_open_path(path, &file, &memory, error);
    if (!status) status = mw__esmf_read(file, &job, out, error);
    mw__netcdf_close(file);
    free(memory);
    status = mw__job_end(&job, status, error);
    if (status) {
        mw_operator_destroy(*out);
        *out = NULL;
    }
    return status;
}
