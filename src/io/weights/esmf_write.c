/* esmf_write.c - weights in the layout of ESMF's weight files, by libnetcdf. */
#include "io/netcdf/netcdf_output.h"
#include "io/weights/weight_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 16 }; /* numbers that are made at a time */

/* Variables that have a number for each entry, column or row. */
typedef enum esmf_part {
    PART_ROW, /* of entries */
    PART_COLUMN,
    PART_WEIGHT,
    PART_X_A, /* of columns */
    PART_Y_A,
    PART_MASK_A,
    PART_AREA_A,
    PART_FRAC_A,
    PART_X_B, /* of rows */
    PART_Y_B,
    PART_MASK_B,
    PART_AREA_B,
    PART_FRAC_B,
    PART_STATUS_B,
    PARTS
} esmf_part;

typedef enum esmf_dimension { DIMENSION_S, DIMENSION_A, DIMENSION_B, DIMENSIONS } esmf_dimension;

static const struct {
    const char *name;
    esmf_dimension dimension;
    mw_netcdf_type type;
} esmf_parts[PARTS] = {
    [PART_ROW] = {"row", DIMENSION_S, MW_NETCDF_INT},
    [PART_COLUMN] = {"col", DIMENSION_S, MW_NETCDF_INT},
    [PART_WEIGHT] = {"S", DIMENSION_S, MW_NETCDF_DOUBLE},
    [PART_X_A] = {"xc_a", DIMENSION_A, MW_NETCDF_DOUBLE},
    [PART_Y_A] = {"yc_a", DIMENSION_A, MW_NETCDF_DOUBLE},
    [PART_MASK_A] = {"mask_a", DIMENSION_A, MW_NETCDF_INT},
    [PART_AREA_A] = {"area_a", DIMENSION_A, MW_NETCDF_DOUBLE},
    [PART_FRAC_A] = {"frac_a", DIMENSION_A, MW_NETCDF_DOUBLE},
    [PART_X_B] = {"xc_b", DIMENSION_B, MW_NETCDF_DOUBLE},
    [PART_Y_B] = {"yc_b", DIMENSION_B, MW_NETCDF_DOUBLE},
    [PART_MASK_B] = {"mask_b", DIMENSION_B, MW_NETCDF_INT},
    [PART_AREA_B] = {"area_b", DIMENSION_B, MW_NETCDF_DOUBLE},
    [PART_FRAC_B] = {"frac_b", DIMENSION_B, MW_NETCDF_DOUBLE},
    [PART_STATUS_B] = {"status_b", DIMENSION_B, MW_NETCDF_BYTE},
};

typedef struct esmf_file {
    const mw_weight_rows *rows;
    const mw_weight_positions *positions;
    mw_netcdf_output *output;
    unsigned char *used; /* 1 for each column that some row uses */
    uint32_t *entry_row; /* the row of each entry */
    double *block;       /* BLOCK numbers */
    int dimension[DIMENSIONS], variable[PARTS];
} esmf_file;

static size_t esmf_length(const esmf_file *f, esmf_dimension dimension)
{
    return dimension == DIMENSION_S   ? f->rows->info.entries
           : dimension == DIMENSION_A ? f->rows->info.columns
                                      : f->rows->info.rows;
}

static bool esmf_has(const esmf_file *f, esmf_part part)
{
    if (part == PART_X_A || part == PART_Y_A) return f->positions->columns != NULL;
    if (part == PART_X_B || part == PART_Y_B) return f->positions->rows != NULL;
    return part != PART_STATUS_B || f->positions->located != NULL;
}

/* --- numbers ---------------------------------------------------------------------------------- */

static double esmf_row_sum(const mw_weight_rows *rows, size_t i)
{
    double sum = 0;
    for (uint64_t e = rows->first[i]; e < rows->first[i + 1]; e++) sum += rows->weight[e];
    return sum;
}

static double esmf_place(const double *at, size_t stride, size_t i, size_t axis)
{
    return at[i * (stride ? stride : 2) + axis];
}

static double esmf_number(const esmf_file *f, esmf_part part, size_t i)
{
    const mw_weight_positions *p = f->positions;
    switch (part) {
    case PART_ROW: return (double)f->entry_row[i] + 1;
    case PART_COLUMN: return (double)f->rows->column[i] + 1;
    case PART_WEIGHT: return f->rows->weight[i];
    case PART_X_A: return esmf_place(p->columns, p->column_stride, i, 0);
    case PART_Y_A: return esmf_place(p->columns, p->column_stride, i, 1);
    case PART_X_B: return esmf_place(p->rows, p->row_stride, i, 0);
    case PART_Y_B: return esmf_place(p->rows, p->row_stride, i, 1);
    case PART_MASK_A: return 1;
    case PART_AREA_A: return p->column_areas ? p->column_areas[i] : 0;
    case PART_AREA_B: return p->row_areas ? p->row_areas[i] : 0;
    case PART_FRAC_A: return p->column_fractions ? p->column_fractions[i] : f->used[i];
    case PART_MASK_B: return f->rows->first[i + 1] > f->rows->first[i];
    case PART_FRAC_B: return p->row_fractions ? p->row_fractions[i] : esmf_row_sum(f->rows, i);
    case PART_STATUS_B: return p->located[i].where;
    default: return 0;
    }
}

static void esmf_write_part(const esmf_file *f, esmf_part part, mw_job *job)
{
    const size_t n = esmf_length(f, esmf_parts[part].dimension);
    for (size_t from = 0; from < n && mw__job_step(job, part * n + from, PARTS * n);) {
        const size_t count = n - from < BLOCK ? n - from : BLOCK;
        for (size_t i = 0; i < count; i++) f->block[i] = esmf_number(f, part, from + i);
        mw__netcdf_output_doubles(f->output, f->variable[part], &from, &count, f->block);
        from += count;
    }
}

/* --- what is in the file ---------------------------------------------------------------------- */

static void esmf_define_status(esmf_file *f)
{
    char names[120] = "";
    for (int i = 0; i < MW_WHERE_COUNT; i++) {
        const size_t at = strlen(names);
        snprintf(names + at, sizeof names - at, "%s%d %s", i ? ", " : "", i,
                 mw_where_name((mw_where)i));
    }
    mw__netcdf_output_text(f->output, f->variable[PART_STATUS_B], "long_name",
                           "where the point lies");
    mw__netcdf_output_text(f->output, f->variable[PART_STATUS_B], "comment", names);
}

static void esmf_define_units(esmf_file *f, esmf_part part)
{
    const bool position =
        part == PART_X_A || part == PART_Y_A || part == PART_X_B || part == PART_Y_B;
    if (position && f->positions->degrees)
        mw__netcdf_output_text(f->output, f->variable[part], "units", "degrees");
    if (part == PART_ROW || part == PART_COLUMN)
        mw__netcdf_output_number(f->output, f->variable[part], "start_index", MW_NETCDF_INT, 1);
}

static void esmf_define(esmf_file *f)
{
    static const char *const names[DIMENSIONS] = {"n_s", "n_a", "n_b"};
    for (int i = 0; i < DIMENSIONS; i++)
        f->dimension[i] =
            mw__netcdf_output_dimension(f->output, names[i], esmf_length(f, (esmf_dimension)i));
    for (int i = 0; i < PARTS; i++) {
        if (!esmf_has(f, (esmf_part)i)) continue;
        f->variable[i] =
            mw__netcdf_output_variable(f->output, esmf_parts[i].name, esmf_parts[i].type, 1,
                                       &f->dimension[esmf_parts[i].dimension]);
        esmf_define_units(f, (esmf_part)i);
    }
    if (esmf_has(f, PART_STATUS_B)) esmf_define_status(f);
    mw__netcdf_output_text(f->output, MW_NETCDF_OUTPUT_FILE, "title",
                           f->positions->title ? f->positions->title : "weights, by meshwalk");
    mw__netcdf_output_text(f->output, MW_NETCDF_OUTPUT_FILE, "map_method",
                           f->positions->method ? f->positions->method
                                                : "linear interpolation in triangles");
    mw__netcdf_output_text(f->output, MW_NETCDF_OUTPUT_FILE, "Conventions", "CF-1.8");
    mw__netcdf_output_defined(f->output);
}

/* --- all -------------------------------------------------------------------------------------- */

static bool esmf_prepare(esmf_file *f)
{
    const mw_weight_rows *rows = f->rows;
    f->used = mw__calloc(rows->info.columns, 1);
    f->entry_row = mw__alloc(rows->info.entries, sizeof *f->entry_row);
    f->block = mw__alloc(BLOCK, sizeof *f->block);
    if (!f->used || !f->entry_row || !f->block) return false;
    for (uint32_t i = 0; i < rows->info.rows; i++)
        for (uint64_t e = rows->first[i]; e < rows->first[i + 1]; e++) {
            f->entry_row[e] = i;
            f->used[rows->column[e]] = 1;
        }
    return true;
}

mw_status mw__esmf_write(const char *path, const mw_weight_rows *rows,
                         const mw_weight_positions *positions, mw_job *job, mw_error *error)
{
    esmf_file f = {.rows = rows, .positions = positions};
    mw_status status = MW_OK;
    if (!esmf_prepare(&f))
        status = mw__fail_memory(error);
    else
        status = mw__netcdf_output_open(path, &f.output, error);
    if (!status) {
        esmf_define(&f);
        for (int i = 0; i < PARTS; i++)
            if (esmf_has(&f, (esmf_part)i)) esmf_write_part(&f, (esmf_part)i, job);
        status = mw__netcdf_output_close(f.output, !mw__job_stopped(job), error);
    }
    free(f.used);
    free(f.entry_row);
    free(f.block);
    return status;
}
