/* apply_call.h - one call that applies an operator, and sums of single values. Private; for this
 * room only. */
#ifndef MW_SRC_OPERATOR_APPLY_CALL_H
#define MW_SRC_OPERATOR_APPLY_CALL_H

#include "operator/operator.h"

#include <math.h>

/* Value k of column v is at v * stride + k * step, value k of row i at i * row + k * field. */
typedef struct mw_apply_call {
    const mw_operator *o;
    const void *values;
    void *result;
    size_t count, stride, step, row, field;
    mw_missing_rule missing;
    double empty; /* the result of a row without entries */
    bool narrow, past_caches;
    struct mw_window *windows; /* of each member of the team; NULL: none */
    size_t ranges, fields; /* a chunk of work is one of these ranges of ranks, of so many fields */
} mw_apply_call;

/* The entries of a rank. */
typedef struct mw_apply_entries {
    const uint32_t *column;
    const double *weight;
    uint64_t count;
} mw_apply_entries;

static MW_INLINE mw_apply_entries mw__entries_of(const mw_operator *o, size_t rank)
{
    const uint64_t first = mw__operator_first(o, rank);
    return (mw_apply_entries){&o->column[first], &o->weight[first],
                              mw__operator_first(o, rank + 1) - first};
}

/* `narrow` is a literal where this is stamped: floats and doubles are one code. */
static MW_INLINE double mw__operand_load(const void *values, size_t i, bool narrow)
{
    return narrow ? (double)((const float *)values)[i] : ((const double *)values)[i];
}

static MW_INLINE void mw__operand_store(void *values, size_t i, double value, bool narrow)
{
    if (narrow)
        ((float *)values)[i] = (float)value;
    else
        ((double *)values)[i] = value;
}

static MW_INLINE size_t mw__operand_size(bool narrow)
{
    return narrow ? sizeof(float) : sizeof(double);
}

static MW_INLINE const void *mw__operand_at(const void *values, size_t i, bool narrow)
{
    return (const char *)values + i * mw__operand_size(narrow);
}

/* Whether a rank has three entries, and nothing is to be left out. */
static MW_INLINE bool mw__entries_plain(const mw_apply_call *c, const double w[3])
{
    return w[0] != 0 && w[1] != 0 && w[2] != 0 && c->missing == MW_MISSING_SPREADS;
}

/* --- value k of a rank with any number of entries --- */

static MW_INLINE double mw__sum_present(const mw_apply_call *c, mw_apply_entries e, size_t k,
                                        bool narrow)
{
    double sum = 0, present = 0, all = 0;
    bool left_out = false;
    for (uint64_t i = 0; i < e.count; i++) {
        if (e.weight[i] == 0) continue;
        const double value =
            mw__operand_load(c->values, e.column[i] * c->stride + k * c->step, narrow);
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

static MW_INLINE double mw__sum_all(const mw_apply_call *c, mw_apply_entries e, size_t k,
                                    bool narrow)
{
    double sum = 0;
    for (uint64_t i = 0; i < e.count; i++)
        if (e.weight[i] != 0)
            sum += e.weight[i] *
                   mw__operand_load(c->values, e.column[i] * c->stride + k * c->step, narrow);
    return sum;
}

static MW_INLINE bool mw__entries_none(mw_apply_entries e)
{
    for (uint64_t i = 0; i < e.count; i++)
        if (e.weight[i] != 0) return false;
    return true;
}

static MW_INLINE double mw__sum_any(const mw_apply_call *c, mw_apply_entries e, size_t k,
                                    bool narrow)
{
    if (mw__entries_none(e)) return c->empty;
    return c->missing == MW_MISSING_LEFT_OUT ? mw__sum_present(c, e, k, narrow)
                                             : mw__sum_all(c, e, k, narrow);
}

#endif
