/* operator_apply.c - an operator times a table of values.
 *
 * Rows with three entries are the common case and have loops of their own. All others, and missing
 * values that are left out, go value by value. If the values of a column lie side by side and the
 * result is larger than the caches, results are written past the caches: they are not read again
 * soon, and a normal write would first read each cache line. */
#include "base/job.h"
#include "base/options.h"
#include "operator/field_rows.h"
#include "operator/operator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum {
    TILE = 256,      /* values of a row that are summed together                               */
    RANGE = 1 << 14, /* ranks of a chunk of work */
    STRIP = 2048,    /* ranks whose entries stay in the cache while field after field is read */
    AHEAD = 3,       /* ranks between one whose values are asked for and one that is summed    */
    LINE = 64,       /* bytes of a cache line, of which the processor finds more by itself after */
    LINES = 32,      /* so many                                                                 */
    /* bytes of results that are more than most caches hold, and of a row that repay writing it past
     * them: */
    LARGE = 1 << 24,
    LONG = 128
};

/* One call. Value k of column v is at v * stride + k * step, value k of row i at i * row + k *
 * field. */
typedef struct apply_call {
    const mw_operator *o;
    const void *values;
    void *result;
    size_t count, stride, step, row, field;
    mw_missing_rule missing;
    double empty; /* the result of a row without entries */
    bool narrow, past_caches;
    size_t ranges, fields; /* a chunk of work is one of these ranges of ranks, of so many fields */
} apply_call;

typedef struct apply_part {
    size_t from, to, field, field_end;
} apply_part;

/* The entries of a rank. */
typedef struct apply_entries {
    const uint32_t *column;
    const double *weight;
    uint64_t count;
} apply_entries;

static MW_INLINE apply_entries entries_of(const mw_operator *o, size_t rank)
{
    const uint64_t first = mw__operator_first(o, rank);
    return (apply_entries){&o->column[first], &o->weight[first],
                           mw__operator_first(o, rank + 1) - first};
}

/* `narrow` is a literal where this is stamped: floats and doubles are one code. */
static MW_INLINE double operand_load(const void *values, size_t i, bool narrow)
{
    return narrow ? (double)((const float *)values)[i] : ((const double *)values)[i];
}

static MW_INLINE void operand_store(void *values, size_t i, double value, bool narrow)
{
    if (narrow)
        ((float *)values)[i] = (float)value;
    else
        ((double *)values)[i] = value;
}

static MW_INLINE const void *operand_at(const void *values, size_t i, bool narrow)
{
    return (const char *)values + i * (narrow ? sizeof(float) : sizeof(double));
}

/* --- any row, value by value ------------------------------------------------------------------ */

static MW_INLINE double sum_present(const apply_call *c, apply_entries e, size_t k, bool narrow)
{
    double sum = 0, present = 0, all = 0;
    bool left_out = false;
    for (uint64_t i = 0; i < e.count; i++) {
        if (e.weight[i] == 0) continue;
        const double value = operand_load(c->values, e.column[i] * c->stride + k * c->step, narrow);
        all += e.weight[i];
        if (isnan(value)) {
            left_out = true;
            continue;
        }
        sum += e.weight[i] * value;
        present += e.weight[i];
    }
    if (!left_out) return sum;
    return present != 0 ? sum / present * all : NAN;
}

static MW_INLINE double sum_all(const apply_call *c, apply_entries e, size_t k, bool narrow)
{
    double sum = 0;
    for (uint64_t i = 0; i < e.count; i++)
        if (e.weight[i] != 0)
            sum += e.weight[i] *
                   operand_load(c->values, e.column[i] * c->stride + k * c->step, narrow);
    return sum;
}

static MW_INLINE bool entries_none(apply_entries e)
{
    for (uint64_t i = 0; i < e.count; i++)
        if (e.weight[i] != 0) return false;
    return true;
}

static MW_INLINE double sum_any(const apply_call *c, apply_entries e, size_t k, bool narrow)
{
    if (entries_none(e)) return c->empty;
    return c->missing == MW_MISSING_LEFT_OUT ? sum_present(c, e, k, narrow)
                                             : sum_all(c, e, k, narrow);
}

/* Whether a rank has three entries, and nothing is to be left out. */
static MW_INLINE bool entries_plain(const apply_call *c, const double w[3])
{
    return w[0] != 0 && w[1] != 0 && w[2] != 0 && c->missing == MW_MISSING_SPREADS;
}

/* --- values of a column side by side ---------------------------------------------------------- */

typedef double two_doubles __attribute__((vector_size(16), aligned(8)));
typedef float two_floats __attribute__((vector_size(8), aligned(4)));

static MW_INLINE two_doubles two_load(const void *values, size_t i, bool narrow)
{
    if (!narrow) return *(const two_doubles *)&((const double *)values)[i];
    return __builtin_convertvector(*(const two_floats *)&((const float *)values)[i], two_doubles);
}

static MW_INLINE void two_store(void *values, size_t i, two_doubles value, bool narrow)
{
    if (narrow)
        *(two_floats *)&((float *)values)[i] = __builtin_convertvector(value, two_floats);
    else
        *(two_doubles *)&((double *)values)[i] = value;
}

/* Sums in the order of mw_interpolate: the bits are the same. */
static MW_INLINE void tile_plain(const double w[3], const void *const from[3], size_t n,
                                 void *restrict to, bool narrow)
{
    const two_doubles x = {w[0], w[0]}, y = {w[1], w[1]}, z = {w[2], w[2]}, zero = {0, 0};
    size_t k = 0;
    for (; k + 2 <= n; k += 2) {
        two_doubles sum = zero + x * two_load(from[0], k, narrow);
        sum += y * two_load(from[1], k, narrow);
        sum += z * two_load(from[2], k, narrow);
        two_store(to, k, sum, narrow);
    }
    for (; k < n; k++) {
        double sum = 0 + w[0] * operand_load(from[0], k, narrow);
        sum += w[1] * operand_load(from[1], k, narrow);
        sum += w[2] * operand_load(from[2], k, narrow);
        operand_store(to, k, sum, narrow);
    }
}

/* Values k .. k + n - 1 of a rank. */
static MW_INLINE void tile_sum(const apply_call *c, apply_entries e, size_t k, size_t n,
                               void *restrict to, bool narrow)
{
    if (c->o->first || !entries_plain(c, e.weight)) {
        for (size_t i = 0; i < n; i++) operand_store(to, i, sum_any(c, e, k + i, narrow), narrow);
        return;
    }
    const void *from[3];
    for (int i = 0; i < 3; i++)
        from[i] = operand_at(c->values, e.column[i] * c->stride + k, narrow);
    tile_plain(e.weight, from, n, to, narrow);
}

/* Copy bytes past the caches; all addresses are multiples of 4. */
static void bytes_pass(char *restrict to, const char *restrict from, size_t bytes)
{
#ifdef __SSE2__
    const size_t odd = -(uintptr_t)to % sizeof(__m128i), head = odd < bytes ? odd : bytes;
    memcpy(to, from, head);
    size_t at = head;
    for (; at + sizeof(__m128i) <= bytes; at += sizeof(__m128i))
        _mm_stream_si128((__m128i *)(void *)(to + at),
                         _mm_loadu_si128((const __m128i *)(const void *)(from + at)));
    memcpy(to + at, from + at, bytes - at);
#else
    memcpy(to, from, bytes);
#endif
}

static void passed_end(void)
{
#ifdef __SSE2__
    _mm_sfence(); /* before other threads may read what this one has written past the caches */
#endif
}

static MW_INLINE void row_sum(const apply_call *c, size_t rank, bool narrow)
{
    const apply_entries e = entries_of(c->o, rank);
    const size_t row = mw__operator_row(c->o, rank) * c->row, size = narrow ? 4 : 8;
    double tile[TILE];
    for (size_t k = 0; k < c->count; k += TILE) {
        const size_t n = c->count - k < TILE ? c->count - k : TILE;
        char *to = (char *)c->result + (row + k) * size;
        tile_sum(c, e, k, n, c->past_caches ? (void *)tile : (void *)to, narrow);
        if (c->past_caches) bytes_pass(to, (const char *)tile, n * size);
    }
}

/* Have the values of a rank on their way. */
static MW_INLINE void row_ask(const apply_call *c, size_t rank, bool narrow)
{
    const apply_entries e = entries_of(c->o, rank);
    const size_t row = c->count * (narrow ? 4 : 8), bytes = row < LINES * LINE ? row : LINES * LINE;
    for (uint64_t i = 0; i < e.count && i < MW_NARROW_ROW; i++) {
        const char *values = operand_at(c->values, e.column[i] * c->stride, narrow);
        for (size_t at = 0; at < bytes; at += LINE) __builtin_prefetch(values + at);
        __builtin_prefetch(values + bytes - 1);
    }
}

static MW_INLINE void rows_apply(const apply_call *c, size_t from, size_t to, bool narrow)
{
    for (size_t rank = from; rank < to; rank++) {
        if (rank + AHEAD < to) row_ask(c, rank + AHEAD, narrow);
        row_sum(c, rank, narrow);
    }
    if (c->past_caches) passed_end();
}

/* --- values field by field -------------------------------------------------------------------- */

static MW_INLINE double value_of_rank(const apply_call *c, size_t rank, size_t k, bool narrow)
{
    const uint32_t *v = &c->o->column[MW_NARROW_ROW * rank];
    const double *w = &c->o->weight[MW_NARROW_ROW * rank];
    if (c->o->first || MW_UNLIKELY(!entries_plain(c, w)))
        return sum_any(c, entries_of(c->o, rank), k, narrow);
    const size_t at = k * c->step;
    double sum = 0 + w[0] * operand_load(c->values, v[0] * c->stride + at, narrow);
    sum += w[1] * operand_load(c->values, v[1] * c->stride + at, narrow);
    return sum + w[2] * operand_load(c->values, v[2] * c->stride + at, narrow);
}

static MW_INLINE void fields_apply(const apply_call *c, apply_part part, bool narrow)
{
    for (size_t strip = part.from; strip < part.to; strip += STRIP) {
        const size_t end = part.to - strip < STRIP ? part.to : strip + STRIP;
        for (size_t k = part.field; k < part.field_end; k++)
            for (size_t rank = strip; rank < end; rank++)
                operand_store(c->result, mw__operator_row(c->o, rank) * c->row + k * c->field,
                              value_of_rank(c, rank, k, narrow), narrow);
    }
}

/* --- all -------------------------------------------------------------------------------------- */

static apply_part part_of(const apply_call *c, uint64_t chunk)
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
    const apply_call *c = work;
    const apply_part part = part_of(c, chunk);
    const bool rows = c->step == 1 && c->count > 1;
    (void)member;
    if (rows && c->narrow)
        rows_apply(c, part.from, part.to, true);
    else if (rows)
        rows_apply(c, part.from, part.to, false);
    else if (c->narrow)
        fields_apply(c, part, true);
    else
        fields_apply(c, part, false);
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
        return mw__fail(error, MW_ERROR_ARGUMENT, "a stride of %zu for %zu values", table->stride,
                        table->count);
    if (options->missing != MW_MISSING_SPREADS && options->missing != MW_MISSING_LEFT_OUT)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown rule for missing values: %d",
                        (int)options->missing);
    return MW_RESERVED_CHECK(mw_operator_apply_options, options, error);
}

static apply_call apply_begin(const mw_operator *o, const mw_value_table *table,
                              const mw_operator_apply_options *options, void *result)
{
    const bool fields = table->step > 1;
    apply_call c = {.o = o,
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
    const size_t row = c.count * (c.narrow ? sizeof(float) : sizeof(double));
    c.ranges = (o->rows + (size_t)RANGE - 1) / RANGE;
    /* Where ranks are no rows, the results of one field at a time stay in the caches until all
     * numbers of a line are there. */
    c.fields = fields && o->row ? 1 : c.count;
    c.past_caches = row >= LONG && o->rows >= LARGE / row;
    return c;
}

/* --- fields one after another, of scattered rows or columns ----------------------------------- */

/* Does the next rank mostly read far from the last one? */
static bool columns_jump(const mw_operator *o)
{
    enum { LOOKS = 256, FAR = 4096 };
    const size_t apart = o->rows / LOOKS;
    size_t far = 0;
    for (size_t i = 0; i < LOOKS && apart > 1 && o->entries > 0; i++) {
        const uint64_t a = mw__operator_first(o, i * apart),
                       b = mw__operator_first(o, i * apart + 1);
        if (b >= mw__operator_first(o, o->rows)) continue;
        const uint32_t x = o->column[a], y = o->column[b];
        far += (x > y ? x - y : y - x) >= FAR;
    }
    return far > LOOKS / 4;
}

/* Do groups of fields, brought side by side, repay two more passes over their memory? Where most
 * columns are used, and a field is more than the nearest caches hold. */
static bool groups_repay(const apply_call *c)
{
    enum { FEWEST = 4, MANY = 1 << 16 };
    const mw_operator *o = c->o;
    return c->step > 1 && c->count >= FEWEST && o->columns >= MANY && o->rows >= o->columns / 2 &&
           (o->row || columns_jump(o));
}

/* Part `part` of three of a group. */
static bool group_part(apply_call *c, const mw_field_rows *in, const mw_field_rows *out, int part,
                       mw_job *job)
{
    if (part == 0) return mw__field_rows_gather(in, job);
    if (part == 2) return mw__field_rows_spread(out, job);
    return mw__job_chunks(job, mw__job_team(job, c->ranges), c->ranges, apply_chunk, c);
}

static bool groups_of_fields_apply(const apply_call *c, char *values, char *result, size_t most,
                                   mw_job *job)
{
    const size_t size = c->narrow ? sizeof(float) : sizeof(double);
    bool on = true;
    for (size_t k = 0; k < c->count && on; k += most) {
        const size_t n = c->count - k < most ? c->count - k : most;
        apply_call group = *c;
        group.values = values;
        group.result = result;
        group.count = group.fields = group.stride = group.row = n;
        group.step = group.field = 1;
        group.past_caches = n == most && c->o->rows >= LARGE / LINE;
        const mw_field_rows in = {(char *)c->values + k * c->step * size,
                                  values,
                                  c->o->columns,
                                  n,
                                  size,
                                  c->stride,
                                  c->step},
                            out = {(char *)c->result + k * c->field * size,
                                   result,
                                   c->o->rows,
                                   n,
                                   size,
                                   1,
                                   c->field};
        for (int part = 0; part < 3 && on; part++) {
            mw_job_span outer = mw__job_steps_of(job, 3 * k + (uint64_t)part * n, n, 3 * c->count);
            on = group_part(&group, &in, &out, part, job);
            mw__job_steps_end(job, outer);
        }
    }
    return on;
}

static char *line_begin(void *memory)
{
    return (char *)memory + -(uintptr_t)memory % LINE;
}

/* Returns false, and has done nothing, without memory for the groups. */
static bool groups_apply(const apply_call *c, mw_job *job)
{
    const size_t most = LINE / (c->narrow ? sizeof(float) : sizeof(double));
    void *values = mw__alloc((size_t)c->o->columns + 1, LINE),
         *result = mw__alloc((size_t)c->o->rows + 1, LINE);
    const bool there = values && result;
    if (there) groups_of_fields_apply(c, line_begin(values), line_begin(result), most, job);
    free(values);
    free(result);
    return there;
}

mw_status mw_operator_apply(const mw_operator *weights, const mw_value_table *table,
                            const mw_operator_apply_options *options, void *result, mw_error *error)
{
    static const mw_operator_apply_options plain;
    if (!options) options = &plain;
    mw_status status = apply_check(weights, table, options, result, error);
    if (status || table->count == 0) return status;
    apply_call call = apply_begin(weights, table, options, result);
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "applying weights", 1);
    const uint64_t chunks = call.ranges * ((call.count + call.fields - 1) / call.fields);
    if (!groups_repay(&call) || !groups_apply(&call, &job))
        mw__job_chunks(&job, mw__job_team(&job, chunks), chunks, apply_chunk, &call);
    return mw__job_end(&job, MW_OK, error);
}
