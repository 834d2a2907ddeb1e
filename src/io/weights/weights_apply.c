/* weights_apply.c - fields of a netCDF file, interpolated by a file of weights into another. A few
 * rows are in memory at a time. */
#include "base/job.h"
#include "base/options.h"
#include "io/netcdf/netcdf_output.h"
#include "io/netcdf/netcdf_source.h"
#include "io/netcdf/netcdf_values.h"
#include "io/weights/esmf_read.h"

#include <math.h>
#include <meshwalk/weights.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 8 }; /* rows of a field that are in memory at a time */

/* A variable of the input and its counterpart in the output. */
typedef struct applied_variable {
    const mw_netcdf_variable *in;
    int out;    /* its number in the output */
    bool field; /* to be interpolated, not copied */
    double fill, missing, scale, offset;
    bool has_fill, has_missing;
} applied_variable;

typedef struct applied_file {
    const mw_operator *weights;
    mw_operator_info size;
    mw_netcdf *in;
    void *in_memory; /* the unpacked values; NULL: it is read from its file */
    mw_netcdf_output *out;
    mw_missing_rule rule;
    int source;       /* the dimension that is replaced by the points */
    int *dimension;   /* the number in the output of each dimension of the input; -1: not there */
    int point;        /* the dimension of the output in its place */
    int x, y;         /* variables with the positions of the points; -1: not known */
    const double *xy; /* all x, then all y */
    applied_variable *variable;
    size_t count;
    uint64_t done, total; /* rows */
    double *values, *result;
    mw_job *job;
} applied_file;

/* --- which variables -------------------------------------------------------------------------- */

static bool variable_is_number(const mw_netcdf_variable *v)
{
    return v->rank <= MW_NETCDF_RANK && v->type != MW_NETCDF_CHAR && v->type < MW_NETCDF_STRING;
}

/* Does the last dimension of a variable have the length of the columns? */
static bool variable_fits(const applied_file *f, const mw_netcdf_variable *v)
{
    return variable_is_number(v) && v->rank > 0 && v->lengths[v->rank - 1] == f->size.columns;
}

static bool name_is_among(const char *name, const char *const *names, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/* The dimension of the right length that the first named field has last; without names, the one
 * that most variables have last. */
static int applied_source(const applied_file *f, const mw_apply_weights_options *options)
{
    const mw_netcdf_variable *named =
        options->field_count ? mw__netcdf_find(f->in, options->fields[0]) : NULL;
    if (named && variable_fits(f, named)) return named->dimensions[named->rank - 1];
    int best = -1;
    size_t most = 0;
    for (size_t i = 0; i < mw__netcdf_variable_count(f->in); i++) {
        const mw_netcdf_variable *v = mw__netcdf_variable_at(f->in, i);
        if (!variable_fits(f, v)) continue;
        size_t same = 0;
        for (size_t k = 0; k < mw__netcdf_variable_count(f->in); k++) {
            const mw_netcdf_variable *w = mw__netcdf_variable_at(f->in, k);
            same += variable_fits(f, w) && w->dimensions[w->rank - 1] == v->dimensions[v->rank - 1];
        }
        if (same > most) {
            most = same;
            best = v->dimensions[v->rank - 1];
        }
    }
    return best;
}

static void variable_learn(const applied_file *f, applied_variable *v)
{
    v->scale = 1;
    v->has_fill = mw__netcdf_number(f->in, v->in, "_FillValue", &v->fill);
    v->has_missing = mw__netcdf_number(f->in, v->in, "missing_value", &v->missing);
    mw__netcdf_number(f->in, v->in, "scale_factor", &v->scale);
    mw__netcdf_number(f->in, v->in, "add_offset", &v->offset);
}

/* A field whose other dimensions do not hold the interpolated one. */
static bool variable_is_field(const applied_file *f, const mw_netcdf_variable *v)
{
    if (!variable_fits(f, v) || v->dimensions[v->rank - 1] != f->source) return false;
    for (size_t i = 0; i + 1 < v->rank; i++)
        if (v->dimensions[i] == f->source) return false;
    return true;
}

static mw_status applied_check_names(const applied_file *f, const mw_apply_weights_options *options,
                                     mw_error *error)
{
    for (size_t i = 0; i < options->field_count; i++) {
        const mw_netcdf_variable *v;
        mw_status status = mw__netcdf_need(f->in, options->fields[i], &v, error);
        if (status) return status;
        if (!variable_is_field(f, v))
            return mw__netcdf_fail(f->in, v, error,
                                   "has no last dimension of the %u values that the weights need",
                                   f->size.columns);
    }
    return MW_OK;
}

static mw_status applied_choose(applied_file *f, const mw_apply_weights_options *options,
                                mw_error *error)
{
    const size_t count = mw__netcdf_variable_count(f->in);
    f->variable = mw__calloc(count, sizeof *f->variable);
    if (!f->variable) return mw__fail_memory(error);
    f->source = applied_source(f, options);
    mw_status status = applied_check_names(f, options, error);
    for (size_t i = 0; i < count && !status; i++) {
        const mw_netcdf_variable *v = mw__netcdf_variable_at(f->in, i);
        if (!variable_is_field(f, v) ||
            (options->fields && !name_is_among(v->name, options->fields, options->field_count)))
            continue;
        f->variable[f->count] = (applied_variable){.in = v, .field = true};
        variable_learn(f, &f->variable[f->count++]);
    }
    if (!status && f->count == 0)
        status = mw__netcdf_fail(
            f->in, NULL, error,
            "has no field whose last dimension has the %u values that the weights need",
            f->size.columns);
    return status;
}

/* Variables of one dimension, which a field has too: time, depth. */
static void applied_choose_axes(applied_file *f)
{
    const size_t fields = f->count;
    for (size_t i = 0; i < mw__netcdf_variable_count(f->in); i++) {
        const mw_netcdf_variable *v = mw__netcdf_variable_at(f->in, i);
        bool wanted = false;
        if (!variable_is_number(v) || v->rank != 1 || v->dimensions[0] == f->source) continue;
        for (size_t k = 0; k < fields; k++)
            for (size_t d = 0; d + 1 < f->variable[k].in->rank; d++)
                wanted = wanted || f->variable[k].in->dimensions[d] == v->dimensions[0];
        if (wanted) f->variable[f->count++] = (applied_variable){.in = v};
    }
}

/* --- definitions ------------------------------------------------------------------------------ */

static void applied_define_dimensions(applied_file *f)
{
    f->point = mw__netcdf_output_dimension(f->out, "point", f->size.rows);
    for (size_t i = 0; i < f->count; i++)
        for (size_t d = 0; d + f->variable[i].field < f->variable[i].in->rank; d++) {
            const int in = f->variable[i].in->dimensions[d];
            size_t length;
            const char *name = mw__netcdf_dimension_at(f->in, in, &length);
            if (f->dimension[in] < 0)
                f->dimension[in] = mw__netcdf_output_dimension(
                    f->out, strcmp(name, "point") ? name : "point_of_input", length);
        }
}

static mw_status applied_copy_texts(const applied_file *f, const applied_variable *v,
                                    mw_error *error)
{
    static const char *const kept[] = {"units",    "long_name", "standard_name",
                                       "calendar", "positive",  "axis"};
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        char *text;
        mw_status status = mw__netcdf_text(f->in, v->in, kept[i], &text, error);
        if (status) return status;
        if (text) mw__netcdf_output_text(f->out, v->out, kept[i], text);
        free(text);
    }
    return MW_OK;
}

static mw_netcdf_type variable_type(const applied_variable *v)
{
    return v->field && v->in->type == MW_NETCDF_FLOAT ? MW_NETCDF_FLOAT : MW_NETCDF_DOUBLE;
}

static mw_status applied_define_variable(applied_file *f, applied_variable *v, mw_error *error)
{
    int dimensions[MW_NETCDF_RANK];
    const size_t rank = v->in->rank;
    for (size_t d = 0; d < rank; d++) dimensions[d] = f->dimension[v->in->dimensions[d]];
    if (v->field) dimensions[rank - 1] = f->point;
    v->out = mw__netcdf_output_variable(f->out, v->in->name, variable_type(v), rank, dimensions);
    if (v->field) {
        mw__netcdf_output_number(f->out, v->out, "_FillValue", variable_type(v), NAN);
        if (f->x >= 0) mw__netcdf_output_text(f->out, v->out, "coordinates", "point_y point_x");
    }
    return applied_copy_texts(f, v, error);
}

static void applied_define_positions(applied_file *f, bool degrees)
{
    f->x = f->y = -1;
    if (!f->xy) return;
    f->x = mw__netcdf_output_variable(f->out, "point_x", MW_NETCDF_DOUBLE, 1, &f->point);
    f->y = mw__netcdf_output_variable(f->out, "point_y", MW_NETCDF_DOUBLE, 1, &f->point);
    if (!degrees) return;
    mw__netcdf_output_text(f->out, f->x, "standard_name", "longitude");
    mw__netcdf_output_text(f->out, f->x, "units", "degrees_east");
    mw__netcdf_output_text(f->out, f->y, "standard_name", "latitude");
    mw__netcdf_output_text(f->out, f->y, "units", "degrees_north");
}

static mw_status applied_define(applied_file *f, bool degrees, mw_error *error)
{
    mw_status status = MW_OK;
    applied_define_dimensions(f);
    applied_define_positions(f, degrees);
    for (size_t i = 0; i < f->count && !status; i++)
        status = applied_define_variable(f, &f->variable[i], error);
    mw__netcdf_output_text(f->out, MW_NETCDF_OUTPUT_FILE, "Conventions", "CF-1.8");
    mw__netcdf_output_text(f->out, MW_NETCDF_OUTPUT_FILE, "title",
                           "fields at points, by meshwalk apply");
    mw__netcdf_output_defined(f->out);
    return status;
}

/* --- values ----------------------------------------------------------------------------------- */

/* As CF says: missing values become NaN, packed ones are unpacked. */
static void values_decode(const applied_variable *v, double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const bool missing =
            (v->has_fill && values[i] == v->fill) || (v->has_missing && values[i] == v->missing);
        values[i] = missing ? NAN : values[i] * v->scale + v->offset;
    }
}

/* Interpolate `rows` rows that begin at `starts`; they follow each other in the dimension before
 * the last. */
static mw_status applied_rows(const applied_file *f, const applied_variable *v,
                              const size_t *starts, size_t rows, mw_error *error)
{
    size_t counts[MW_NETCDF_RANK];
    const size_t rank = v->in->rank;
    for (size_t d = 0; d < rank; d++) counts[d] = 1;
    if (rank > 1) counts[rank - 2] = rows;
    counts[rank - 1] = f->size.columns;
    mw_status status = mw__netcdf_doubles(f->in, v->in, starts, counts, f->values, error);
    if (status) return status;
    values_decode(v, f->values, rows * f->size.columns);
    const mw_value_table table = {
        .values = f->values, .count = rows, .stride = 1, .step = f->size.columns};
    /* For a single row the step does not matter. */
    const mw_value_table one = {.values = f->values, .count = 1};
    const mw_operator_apply_options options = {.threads = f->job->threads, .missing = f->rule};
    status = mw_operator_apply(f->weights, rows > 1 ? &table : &one, &options, f->result, error);
    if (status) return status;
    counts[rank - 1] = f->size.rows;
    mw__netcdf_output_doubles(f->out, v->out, starts, counts, f->result);
    return MW_OK;
}

/* The next block of rows; false after the last. */
static bool starts_next(const mw_netcdf_variable *v, size_t *starts, size_t rows)
{
    for (size_t d = v->rank - 1; d-- > 0; rows = 1) {
        starts[d] += rows;
        if (starts[d] < v->lengths[d]) return true;
        starts[d] = 0;
    }
    return false;
}

static mw_status applied_field(applied_file *f, const applied_variable *v, mw_error *error)
{
    size_t starts[MW_NETCDF_RANK] = {0}, rows;
    mw_status status = MW_OK;
    for (size_t d = 0; d + 1 < v->in->rank; d++)
        if (v->in->lengths[d] == 0) return MW_OK;
    do {
        const size_t left =
            v->in->rank > 1 ? v->in->lengths[v->in->rank - 2] - starts[v->in->rank - 2] : 1;
        rows = left < ROWS ? left : ROWS;
        status = applied_rows(f, v, starts, rows, error);
        f->done += rows;
        if (!status && !mw__job_step(f->job, f->done, f->total)) status = MW_ERROR_MEMORY;
    } while (!status && !mw__netcdf_output_failed(f->out) && starts_next(v->in, starts, rows));
    return status;
}

static mw_status applied_axis(const applied_file *f, const applied_variable *v, mw_error *error)
{
    const size_t start = 0, count = v->in->lengths[0];
    double *values = mw__alloc(count, sizeof *values);
    mw_status status = values ? MW_OK : mw__fail_memory(error);
    if (!status) status = mw__netcdf_doubles(f->in, v->in, &start, &count, values, error);
    if (!status && count) mw__netcdf_output_doubles(f->out, v->out, &start, &count, values);
    free(values);
    return status;
}

static void applied_positions(const applied_file *f)
{
    const size_t start = 0, count = f->size.rows;
    if (f->x < 0 || count == 0) return;
    mw__netcdf_output_doubles(f->out, f->x, &start, &count, f->xy);
    mw__netcdf_output_doubles(f->out, f->y, &start, &count, f->xy + count);
}

static mw_status applied_values(applied_file *f, mw_error *error)
{
    f->values = mw__alloc(f->size.columns, ROWS * sizeof *f->values);
    f->result = mw__alloc(f->size.rows, ROWS * sizeof *f->result);
    mw_status status = f->values && f->result ? MW_OK : mw__fail_memory(error);
    for (size_t i = 0; i < f->count && !status; i++)
        status = f->variable[i].field ? applied_field(f, &f->variable[i], error)
                                      : applied_axis(f, &f->variable[i], error);
    free(f->values);
    free(f->result);
    return status;
}

/* Is the file as long as its header says? Otherwise nothing is written. A netCDF-4 file need not
 * hold values that were never written. */
static mw_status applied_check_sizes(const applied_file *f, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < f->count && !status; i++)
        if (!f->variable[i].field || mw__netcdf_is_classic(f->in))
            status = mw__netcdf_check_size(f->in, f->variable[i].in, error);
    return status;
}

static void applied_count(applied_file *f, mw_apply_weights_info *info)
{
    *info = (mw_apply_weights_info){.points = f->size.rows, .unmapped = f->size.empty_rows};
    for (size_t i = 0; i < f->count; i++) {
        const mw_netcdf_variable *v = f->variable[i].in;
        size_t rows = 1;
        for (size_t d = 0; d + 1 < v->rank; d++) rows *= v->lengths[d];
        info->fields += f->variable[i].field;
        info->slabs += f->variable[i].field ? rows : 0;
    }
    f->total = info->slabs;
}

/* --- positions of the points ------------------------------------------------------------------ */

/* All x, then all y, of the rows of a file of weights; *xy is NULL if the file does not have them.
 */
static mw_status positions_read(const mw_netcdf *file, uint32_t rows, double **xy, bool *degrees,
                                mw_error *error)
{
    char *units = NULL;
    const size_t start = 0, count = rows;
    mw_status status = MW_OK;
    const mw_netcdf_variable *x = mw__netcdf_find(file, "xc_b"), *y = mw__netcdf_find(file, "yc_b");
    const bool there = x && y && x->rank == 1 && y->rank == 1 && x->lengths[0] == rows &&
                       y->lengths[0] == rows && rows > 0;
    if (there && !(*xy = mw__alloc(rows, 2 * sizeof **xy))) status = mw__fail_memory(error);
    if (there && !status) status = mw__netcdf_doubles(file, x, &start, &count, *xy, error);
    if (there && !status) status = mw__netcdf_doubles(file, y, &start, &count, *xy + rows, error);
    if (there && !status) status = mw__netcdf_text(file, x, "units", &units, error);
    *degrees = units && strncmp(units, "degree", 6) == 0;
    free(units);
    return status;
}

/* --- all -------------------------------------------------------------------------------------- */

static mw_status applied_run(applied_file *f, const char *fields, const char *out, bool degrees,
                             const mw_apply_weights_options *options, mw_apply_weights_info *info,
                             mw_error *error)
{
    mw_status status = mw__netcdf_open_path(fields, &f->in, &f->in_memory, error);
    if (!status) status = applied_choose(f, options, error);
    if (status) return status;
    applied_choose_axes(f);
    status = applied_check_sizes(f, error);
    if (status) return status;
    applied_count(f, info);
    const size_t dimensions = mw__netcdf_dimension_count(f->in);
    f->dimension = mw__alloc(dimensions, sizeof *f->dimension);
    if (!f->dimension) return mw__fail_memory(error);
    for (size_t i = 0; i < dimensions; i++) f->dimension[i] = -1;
    status = mw__netcdf_output_open(out, &f->out, error);
    if (status) return status;
    status = applied_define(f, degrees, error);
    if (!status) applied_positions(f);
    if (!status) status = applied_values(f, error);
    mw_status closed = mw__netcdf_output_close(f->out, !status, status ? NULL : error);
    return status ? status : closed;
}

static mw_status applied_begin(const char *weights, const char *fields, const char *out,
                               const mw_apply_weights_options *options, mw_error *error)
{
    if (!weights || !fields || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the path of the weights, the fields or the output is NULL");
    if (options->field_count && !options->fields)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the names of the fields are NULL");
    return MW_RESERVED_CHECK(mw_apply_weights_options, options, error);
}

/* The weights, and where their points are. */
static mw_status applied_read_weights(applied_file *f, const char *path, mw_operator **kept,
                                      double **xy, bool *degrees, mw_error *error)
{
    mw_netcdf *file;
    void *memory;
    mw_job alone = {.threads = 1};
    mw_status status = mw__netcdf_open_path(path, &file, &memory, error);
    if (!status) status = mw__esmf_read(file, &alone, kept, error);
    if (!status) mw_operator_describe(*kept, &f->size);
    if (!status) status = positions_read(file, f->size.rows, xy, degrees, error);
    mw__netcdf_close(file);
    free(memory);
    f->weights = *kept;
    f->xy = *xy;
    return status;
}

mw_status mw_apply_weights(const char *weights, const char *fields, const char *out,
                           const mw_apply_weights_options *options, mw_apply_weights_info *info,
                           mw_error *error)
{
    static const mw_apply_weights_options plain;
    mw_apply_weights_info unasked;
    mw_operator *kept = NULL;
    double *xy = NULL;
    bool degrees = false;
    if (!options) options = &plain;
    if (!info) info = &unasked;
    *info = (mw_apply_weights_info){0};
    mw_status status = applied_begin(weights, fields, out, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "applying weights", 1);
    applied_file f = {.rule = options->missing, .job = &job};
    status = applied_read_weights(&f, weights, &kept, &xy, &degrees, error);
    if (!status) status = applied_run(&f, fields, out, degrees, options, info, error);
    mw__netcdf_close(f.in);
    free(f.in_memory);
    free(f.variable);
    free(f.dimension);
    free(xy);
    mw_operator_destroy(kept);
    return mw__job_end(&job, status, error);
}
