/* field_rows.c - whole groups, a cache line for each row, are written past the caches. */
#include "operator/field_rows.h"

#include "operator/past_caches.h"

enum {
    RUN = 64, /* rows that stay in the nearest cache while field after field is written */
    DOUBLES = MW_CACHE_LINE / sizeof(double), /* of a whole group */
    FLOATS = MW_CACHE_LINE / sizeof(float)
};

/* --- from fields to rows --- */

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

static void gather_lines_of_doubles(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const double *fields = (const double *)(const void *)f->fields;
    double *rows = (double *)(void *)f->rows;
    const size_t step = f->step;
    for (size_t i = from; i < to; i++) {
        const double *at = &fields[i * f->stride];
        for (size_t k = 0; k < DOUBLES; k += 2, at += 2 * step)
            mw__pass_doubles(&rows[i * DOUBLES + k], at[0], at[step]);
    }
    mw__past_caches_end();
}

static void gather_lines_of_floats(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const float *fields = (const float *)(const void *)f->fields;
    float *rows = (float *)(void *)f->rows;
    const size_t step = f->step;
    for (size_t i = from; i < to; i++) {
        const float *at = &fields[i * f->stride];
        for (size_t k = 0; k < FLOATS; k += 4, at += 4 * step)
            mw__pass_floats(&rows[i * FLOATS + k], at[0], at[step], at[2 * step], at[3 * step]);
    }
    mw__past_caches_end();
}

static void gather_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    const bool doubles = f->size == sizeof(double);
    if (doubles && f->count == DOUBLES)
        gather_lines_of_doubles(f, from, to);
    else if (doubles)
        gather_doubles(f, from, to);
    else if (f->count == FLOATS)
        gather_lines_of_floats(f, from, to);
    else
        gather_floats(f, from, to);
}

/* --- from rows to fields --- */

/* Rows of a few lines at a time, so that each field is written in whole lines. */
static void spread_doubles(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const double *rows = (const double *)(const void *)f->rows;
    double *fields = (double *)(void *)f->fields;
    for (size_t begin = from; begin < to; begin += RUN)
        for (size_t k = 0; k < f->count; k++)
            for (size_t i = begin; i < to && i < begin + RUN; i++)
                fields[i * f->stride + k * f->step] = rows[i * f->count + k];
}

static void spread_floats(const mw_field_rows *f, uint64_t from, uint64_t to)
{
    const float *rows = (const float *)(const void *)f->rows;
    float *fields = (float *)(void *)f->fields;
    for (size_t begin = from; begin < to; begin += RUN)
        for (size_t k = 0; k < f->count; k++)
            for (size_t i = begin; i < to && i < begin + RUN; i++)
                fields[i * f->stride + k * f->step] = rows[i * f->count + k];
}

/* One field of n rows: `from` is its value in the first of them. */
static void spread_line_of_doubles(const double *from, size_t n, double *to)
{
    size_t i = mw__pass_begin(to) / sizeof(double);
    if (i > n) i = n;
    for (size_t k = 0; k < i; k++) to[k] = from[k * DOUBLES];
    for (; i + 2 <= n; i += 2) mw__pass_doubles(&to[i], from[i * DOUBLES], from[(i + 1) * DOUBLES]);
    for (; i < n; i++) to[i] = from[i * DOUBLES];
}

static void spread_line_of_floats(const float *from, size_t n, float *to)
{
    size_t i = mw__pass_begin(to) / sizeof(float);
    if (i > n) i = n;
    for (size_t k = 0; k < i; k++) to[k] = from[k * FLOATS];
    for (; i + 4 <= n; i += 4)
        mw__pass_floats(&to[i], from[i * FLOATS], from[(i + 1) * FLOATS], from[(i + 2) * FLOATS],
                        from[(i + 3) * FLOATS]);
    for (; i < n; i++) to[i] = from[i * FLOATS];
}

static void spread_lines(const mw_field_rows *f, uint64_t from, uint64_t to, bool doubles)
{
    for (size_t begin = from; begin < to; begin += RUN) {
        const size_t n = to - begin < RUN ? to - begin : RUN;
        for (size_t k = 0; k < f->count; k++) {
            const void *row = f->rows + (begin * f->count + k) * f->size;
            void *field = f->fields + (begin + k * f->step) * f->size;
            if (doubles)
                spread_line_of_doubles(row, n, field);
            else
                spread_line_of_floats(row, n, field);
        }
    }
    mw__past_caches_end();
}

static void spread_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    const bool doubles = f->size == sizeof(double);
    if (f->stride == 1 && f->count * f->size == MW_CACHE_LINE)
        spread_lines(f, from, to, doubles);
    else if (doubles)
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
