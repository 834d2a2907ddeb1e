/* operator_apply.c - an operator times a table of values.
 *
 * Values of a column that lie side by side are summed by row_sums.c, fields one after another by
 * field_sums.c, eight or more of them by window_sums.c where it can; many fields of scattered
 * columns are brought side by side first (field_rows.c). */
#include "base/job.h"
#include "base/options.h"
#include "operator/field_groups.h"
#include "operator/field_sums.h"
#include "operator/past_caches.h"
#include "operator/row_sums.h"
#include "operator/window_sums.h"

#include <stdlib.h>

enum {
    RANGE = MW_WINDOW_RANKS, /* ranks of a chunk of work */
    /* results with more bytes are written past the caches, if a row has at least so many: */
    LARGE = 1 << 24,
    LONG = 128
};

typedef struct apply_part {
    size_t from, to, field, field_end;
} apply_part;

/* --- all -------------------------------------------------------------------------------------- */

static apply_part part_of(const mw_apply_call *c, uint64_t chunk)
{
    const uint64_t group = chunk / c->ranges, from = chunk % c->ranges * RANGE,
                   field = group * c->fields;
    return (apply_part){.from = from,
                        .to = c->o->rows - from < RANGE ? c->o->rows : from + RANGE,
                        .field = field,
                        .field_end = c->count - field < c->fields ? c->count : field + c->fields};
}

static void apply_chunk(void *work, uint64_t chunk, uint32_t member)
{
    const mw_apply_call *c = work;
    const apply_part part = part_of(c, chunk);
    if (c->windows)
        mw__window_sums(c, member, part.from, part.to);
    else if (c->step == 1 && c->count > 1)
        mw__row_sums(c, part.from, part.to);
    else
        mw__field_sums(c, part.from, part.to, part.field, part.field_end);
}

static mw_status apply_check(const mw_operator *o, const mw_value_table *table,
                             const mw_operator_apply_options *options, const void *result,
                             mw_error *error)
{
    if (!o || !table || (table->count && ((o->columns && !table->values) || (o->rows && !result))))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the operator, the values or the result is NULL");
    if (table->type != MW_FLOAT64 && table->type != MW_FLOAT32)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of values: %d", (int)table->type);
    if (table->step <= 1 && table->stride && table->stride < table->count)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride %zu is less than the %zu values of a column", table->stride,
                        table->count);
    if (options->missing != MW_MISSING_SPREADS && options->missing != MW_MISSING_LEFT_OUT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown rule for missing values: %d",
                        (int)options->missing);
    return MW_RESERVED_CHECK(mw_operator_apply_options, options, error);
}

static mw_apply_call apply_begin(const mw_operator *o, const mw_value_table *table,
                                 const mw_operator_apply_options *options, void *result)
{
    const bool fields = table->step > 1;
    mw_apply_call c = {.o = o,
                       .values = table->values,
                       .result = result,
                       .count = table->count,
                       .stride = table->stride,
                       .step = fields ? table->step : 1,
                       .row = fields ? 1 : table->count,
                       .field = fields ? o->rows : 1,
                       .missing = options->missing,
                       .empty = options->zero_empty ? 0 : NAN,
                       .narrow = table->type == MW_FLOAT32};
    if (!c.stride) c.stride = fields ? 1 : table->count;
    const size_t row = c.count * mw__operand_size(c.narrow);
    c.ranges = (o->rows + (size_t)RANGE - 1) / RANGE;
    /* If ranks are not rows, only the results of one field at a time stay in the caches until each
     * cache line is complete. */
    c.fields = fields && o->row ? 1 : c.count;
    c.past_caches = (fields || row >= LONG) && row > 0 && o->rows >= LARGE / row;
    return c;
}

static void chunks_apply(mw_apply_call *c, mw_job *job)
{
    const uint64_t chunks = c->ranges * ((c->count + c->fields - 1) / c->fields);
    const uint32_t team = mw__job_team(job, chunks);
    c->windows = mw__windows_create(c, team);
    mw__job_chunks(job, team, chunks, apply_chunk, c);
    free(c->windows);
}

mw_status mw_operator_apply(const mw_operator *weights, const mw_value_table *table,
                            const mw_operator_apply_options *options, void *result, mw_error *error)
{
    static const mw_operator_apply_options plain;
    if (!options) options = &plain;
    mw_status status = apply_check(weights, table, options, result, error);
    if (status || table->count == 0) return status;
    mw_apply_call call = apply_begin(weights, table, options, result);
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "applying weights", 1);
    if (!mw__field_groups_repay(&call) || !mw__field_groups_apply(&call, &job))
        chunks_apply(&call, &job);
    return mw__job_end(&job, MW_OK, error);
}
