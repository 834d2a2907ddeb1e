#include "io/layouts/corner_table.h"

#include "io/netcdf/netcdf_values.h"

#include <inttypes.h>
#include <stdlib.h>

/* Numbers that are read at a time. */
enum { BLOCK_NUMBERS = 1 << 17 };

typedef struct corner_reading {
    const mw_netcdf *file;
    const mw_layout *layout;
    mw_corner_table *table;
    mw_netcdf_packing packing;
    double *block; /* numbers as they stand in the file */
    size_t lowest_face, highest_face;
    int64_t lowest, highest; /* of all corners */
} corner_reading;

static bool corner_is_missing(const corner_reading *reading, double number)
{
    if (!(number >= 0)) return true; /* also NaN: no vertex has such a number */
    if (number == 0 && reading->layout->zero_missing) return true;
    for (size_t m = 0; m < reading->packing.missing_count; m++)
        if (number == reading->packing.missing[m]) return true;
    return false;
}

static mw_status corner_refuse(const corner_reading *reading, size_t face, mw_error *error,
                               const char *what, int64_t number)
{
    return mw__netcdf_fail(reading->file, reading->layout->corners, error,
                           "face %" PRIu64 " (from %d): %s %" PRId64,
                           (uint64_t)face + (uint64_t)reading->layout->first_number,
                           reading->layout->first_number, what, number);
}

static mw_status corner_add(corner_reading *reading, size_t face, size_t column, double number,
                            mw_error *error)
{
    if (number >= INT32_MAX || number != (double)(int64_t)number)
        return mw__netcdf_fail(reading->file, reading->layout->corners, error,
                               "face %" PRIu64 " (from %d): %g is not a vertex number",
                               (uint64_t)face + (uint64_t)reading->layout->first_number,
                               reading->layout->first_number, number);
    int64_t corner = (int64_t)number;
    if (corner < reading->lowest) {
        reading->lowest = corner;
        reading->lowest_face = face;
    }
    if (corner > reading->highest) {
        reading->highest = corner;
        reading->highest_face = face;
    }
    reading->table->corners[face * reading->table->width + column] = (int32_t)corner;
    return MW_OK;
}

/* One face of a block, whose numbers are `stride` apart. */
static mw_status corner_face(corner_reading *reading, size_t face, const double *numbers,
                             size_t stride, mw_error *error)
{
    size_t width = reading->table->width, used = 0;
    int32_t *corners = reading->table->corners + face * width;
    for (size_t k = 0; k < width; k++) {
        double number = numbers[k * stride];
        corners[k] = MW_NO_CORNER;
        if (corner_is_missing(reading, number)) continue;
        if (used < k && !reading->layout->open_dropped)
            return corner_refuse(reading, face, error, "a corner is missing before vertex",
                                 number < 1e18 ? (int64_t)number : INT64_MAX);
        mw_status status = corner_add(reading, face, used++, number, error);
        if (status) return status;
    }
    return MW_OK;
}

static mw_status corner_read_block(corner_reading *reading, size_t from, size_t count,
                                   mw_error *error)
{
    const mw_layout *layout = reading->layout;
    size_t width = reading->table->width;
    bool across = layout->corner_first;
    size_t starts[2] = {across ? 0 : from, across ? from : 0};
    size_t counts[2] = {across ? width : count, across ? count : width};
    mw_status status =
        mw__netcdf_doubles(reading->file, layout->corners, starts, counts, reading->block, error);
    for (size_t i = 0; i < count && !status; i++)
        status = corner_face(reading, from + i, reading->block + (across ? i : i * width),
                             across ? count : 1, error);
    return status;
}

/* Corners beyond the number in `counts` do not exist. */
static mw_status corner_apply_counts(corner_reading *reading, mw_error *error)
{
    const mw_netcdf_variable *counts = reading->layout->counts;
    mw_corner_table *table = reading->table;
    double *numbers = mw__alloc(table->face_count, sizeof *numbers);
    if (!numbers) return mw__fail_memory(error);
    mw_status status = mw__netcdf_column(reading->file, counts, numbers, error);
    for (size_t f = 0; f < table->face_count && !status; f++) {
        if (!(numbers[f] >= 3 && numbers[f] <= (double)table->width))
            status = mw__netcdf_fail(reading->file, counts, error,
                                     "face %" PRIu64 " has %g corners; 3 to %zu are possible",
                                     (uint64_t)f + 1, numbers[f], table->width);
        else
            for (size_t k = (size_t)numbers[f]; k < table->width; k++)
                table->corners[f * table->width + k] = MW_NO_CORNER;
    }
    free(numbers);
    return status;
}

/* Choose the first number such that all corners are vertices. */
static mw_status corner_settle(corner_reading *reading, size_t vertex_count, mw_error *error)
{
    const mw_layout *layout = reading->layout;
    int64_t first = layout->first_number, other = 1 - first, count = (int64_t)vertex_count;
    bool empty = reading->highest < reading->lowest;
    bool fits = empty || (reading->lowest >= first && reading->highest < first + count);
    bool other_fits = !empty && reading->lowest >= other && reading->highest < other + count;
    reading->table->first_number = first;
    if (fits) return MW_OK;
    if (!layout->first_stated && other_fits) {
        reading->table->first_number = other;
        return MW_OK;
    }
    bool low = reading->lowest < first;
    int64_t number = low ? reading->lowest : reading->highest;
    size_t face = low ? reading->lowest_face : reading->highest_face;
    return mw__netcdf_fail(reading->file, layout->corners, error,
                           "face %" PRIu64 " names vertex %" PRId64
                           ", which does not exist: there are %zu, counted from %d%s",
                           (uint64_t)face + (uint64_t)first, number, vertex_count, (int)first,
                           !other_fits ? ""
                           : other == 0
                               ? " as start_index tells; the layout 'NAME:0' counts from 0"
                               : " as start_index tells; the layout 'NAME:1' counts from 1");
}

static mw_status corner_read_all(corner_reading *reading, mw_job *job, mw_error *error)
{
    mw_corner_table *table = reading->table;
    size_t at_once = BLOCK_NUMBERS / table->width;
    if (at_once == 0) at_once = 1;
    if (at_once > table->face_count) at_once = table->face_count; /* 0: of whatever width */
    reading->block = mw__alloc(at_once * table->width, sizeof *reading->block);
    table->corners = mw__alloc((uint64_t)table->face_count * table->width, sizeof *table->corners);
    if (!reading->block || !table->corners) return mw__fail_memory(error);
    mw_status status = MW_OK;
    for (size_t from = 0; from < table->face_count && !status; from += at_once) {
        size_t left = table->face_count - from;
        status = corner_read_block(reading, from, left < at_once ? left : at_once, error);
        if (!mw__job_step(job, from, table->face_count)) return MW_ERROR_MEMORY;
    }
    if (!status && reading->layout->counts) status = corner_apply_counts(reading, error);
    return status;
}

mw_status mw__corner_table_read(const mw_netcdf *file, const mw_layout *layout, size_t vertex_count,
                                mw_job *job, mw_corner_table *table, mw_error *error)
{
    *table = (mw_corner_table){.face_count = layout->face_count, .width = layout->corner_count};
    corner_reading reading = {.file = file,
                              .layout = layout,
                              .table = table,
                              .lowest = INT64_MAX,
                              .highest = -1,
                              .packing = mw__netcdf_packing(file, layout->corners)};
    mw_status status = mw__netcdf_check_size(file, layout->corners, error);
    if (!status && table->face_count > MW_MAX_TRIANGLES)
        status = mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " faces",
                          mw__netcdf_name(file), MW_MAX_TRIANGLES);
    if (!status) status = corner_read_all(&reading, job, error);
    free(reading.block);
    if (!status) status = corner_settle(&reading, vertex_count, error);
    if (status) mw__corner_table_release(table);
    return status;
}

void mw__corner_table_release(mw_corner_table *table)
{
    free(table->corners);
    table->corners = NULL;
}
