/* field_rows.c - rows are whole cache lines, and are written past the caches. */
#include "operator/field_rows.h"

#include "operator/four_doubles.h"

enum {
    RUN = 512, /* bytes of a field: its rows stay in the nearest cache for field after field */
    DOUBLES = MW_CACHE_LINE / sizeof(double), /* of a row */
    FLOATS = MW_CACHE_LINE / sizeof(float)
};

/* --- from fields to rows --- */

/* The first value of each field. What a row has room for beyond them repeats the last. */
static MW_INLINE void fields_at(const mw_field_rows *f, const void **at, size_t width)
{
    for (size_t k = 0; k < width; k++)
        at[k] = f->fields + (k < f->count ? k : f->count - 1) * f->step * f->size;
}

static void gather_doubles(const mw_field_rows *f, size_t from, size_t to)
{
    const void *at[DOUBLES];
    double *rows = (double *)(void *)f->rows;
    fields_at(f, at, DOUBLES);
    for (size_t i = from; i < to; i++) {
        double *row = &rows[f->place[i] * (size_t)DOUBLES];
        const size_t v = i * f->stride;
        for (size_t k = 0; k < DOUBLES; k += 2)
            mw__pass_doubles(&row[k], ((const double *)at[k])[v], ((const double *)at[k + 1])[v]);
    }
}

static void gather_floats(const mw_field_rows *f, size_t from, size_t to)
{
    const void *at[FLOATS];
    float *rows = (float *)(void *)f->rows;
    fields_at(f, at, FLOATS);
    for (size_t i = from; i < to; i++) {
        float *row = &rows[f->place[i] * (size_t)FLOATS];
        const size_t v = i * f->stride;
        for (size_t k = 0; k < FLOATS; k += 4)
            mw__pass_floats(&row[k], ((const float *)at[k])[v], ((const float *)at[k + 1])[v],
                            ((const float *)at[k + 2])[v], ((const float *)at[k + 3])[v]);
    }
}

static void gather_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    if (f->size == sizeof(double))
        gather_doubles(f, from, to);
    else
        gather_floats(f, from, to);
    mw__past_caches_end();
}

/* --- from rows to fields --- */

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

/* Rows of a few lines at a time, so that each field is written in whole lines. */
static void spread_range(void *work, uint64_t from, uint64_t to)
{
    const mw_field_rows *f = work;
    const bool doubles = f->size == sizeof(double);
    const size_t run = doubles ? RUN / sizeof(double) : RUN / sizeof(float);
    for (size_t begin = from; begin < to; begin += run) {
        const size_t n = to - begin < run ? to - begin : run;
        for (size_t k = 0; k < f->count; k++) {
            const void *row = f->rows + begin * MW_CACHE_LINE + k * f->size;
            void *field = f->fields + (begin + k * f->step) * f->size;
            if (doubles)
                spread_line_of_doubles(row, n, field);
            else
                spread_line_of_floats(row, n, field);
        }
    }
    mw__past_caches_end();
}

bool mw__field_rows_copy(const mw_field_rows *f, mw_job *job)
{
    return mw__job_ranges(job, f->n, f->place ? gather_range : spread_range, (void *)f);
}
