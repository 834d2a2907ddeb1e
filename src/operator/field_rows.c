#include "operator/field_rows.h"

static void gather_doubles(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const double *fields = (const double *)(const void *)f->fields;
    double *rows = (double *)(void *)f->rows;
    for (size_t i = from; i < to; i++)
        for (size_t k = 0; k < f->count; k++)
            rows[i * f->count + k] = fields[i * f->stride + k * f->step];
}

static void gather_floats(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const float *fields = (const float *)(const void *)f->fields;
    float *rows = (float *)(void *)f->rows;
    for (size_t i = from; i < to; i++)
        for (size_t k = 0; k < f->count; k++)
            rows[i * f->count + k] = fields[i * f->stride + k * f->step];
}

static void gather_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    if (f->size == sizeof(double))
        gather_doubles(f, from, to);
    else
        gather_floats(f, from, to);
}

/* Rows of a few lines at a time, so that each field is written in whole lines. */
static void spread_doubles(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    enum { ROWS = 64 };
    const double *rows = (const double *)(const void *)f->rows;
    double *fields = (double *)(void *)f->fields;
    for (size_t begin = from; begin < to; begin += ROWS)
        for (size_t k = 0; k < f->count; k++)
            for (size_t i = begin; i < to && i < begin + ROWS; i++)
                fields[i * f->stride + k * f->step] = rows[i * f->count + k];
}

static void spread_floats(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    enum { ROWS = 64 };
    const float *rows = (const float *)(const void *)f->rows;
    float *fields = (float *)(void *)f->fields;
    for (size_t begin = from; begin < to; begin += ROWS)
        for (size_t k = 0; k < f->count; k++)
            for (size_t i = begin; i < to && i < begin + ROWS; i++)
                fields[i * f->stride + k * f->step] = rows[i * f->count + k];
}

static void spread_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    if (f->size == sizeof(double))
        spread_doubles(f, from, to);
    else
        spread_floats(f, from, to);
}

bool mw__field_rows_gather(const mw_field_rows *f, mw_job *job)
{
    return mw__job_ranges(job, f->n, gather_range, (void *)f);
}

bool mw__field_rows_spread(const mw_field_rows *f, mw_job *job)
{
    return mw__job_ranges(job, f->n, spread_range, (void *)f);
}
