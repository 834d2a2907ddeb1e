/* row_sums.c - rows of values, summed four values at a time.
 *
 * Most of the time is spent waiting for the values of columns, which lie anywhere in memory. So the
 * values of later ranks are prefetched. The fewer instructions a rank takes, the more ranks the
 * processor works on at a time; therefore this file is compiled a second time, for processors with
 * AVX2. The bits are the same: each value is the sum that mw_interpolate makes, in its order. */
#include "operator/row_sums.h"

#include "operator/four_doubles.h"

enum {
    LINES = 32, /* asked for in each column; the processor finds those after them by itself */
    /* Ranks between one whose values are asked for and one that is summed: so many bytes of a
     * column, within these bounds. */
    AHEAD_BYTES = 6144,
    AHEAD_LEAST = 6,
    AHEAD_MOST = 64
};

static MW_INLINE void values_sum(const double w[3], const void *const from[3], size_t k, size_t end,
                                 void *restrict to, bool narrow)
{
    for (; k < end; k++) {
        double sum = 0 + w[0] * mw__operand_load(from[0], k, narrow);
        sum += w[1] * mw__operand_load(from[1], k, narrow);
        sum += w[2] * mw__operand_load(from[2], k, narrow);
        mw__operand_store(to, k, sum, narrow);
    }
}

/* The n values of a rank with three entries. */
static MW_INLINE void row_sum_plain(const double w[3], const void *const from[3], size_t n,
                                    void *restrict to, bool narrow, bool pass)
{
    const mw_four_doubles x = {w[0], w[0], w[0], w[0]}, y = {w[1], w[1], w[1], w[1]},
                          z = {w[2], w[2], w[2], w[2]}, zero = {0, 0, 0, 0};
    size_t k = pass ? mw__pass_begin(to) / mw__operand_size(narrow) : 0;
    if (k > n) k = n;
    if (pass) values_sum(w, from, 0, k, to, narrow);
    for (; k + MW_FOUR <= n; k += MW_FOUR) {
        mw_four_doubles a, b, c;
        mw__four_load(&a, from[0], k, narrow);
        mw__four_load(&b, from[1], k, narrow);
        mw__four_load(&c, from[2], k, narrow);
        mw_four_doubles sum = zero + x * a;
        sum += y * b;
        sum += z * c;
        mw__four_store(to, k, &sum, narrow, pass);
    }
    values_sum(w, from, k, n, to, narrow);
}

static MW_INLINE void row_sum(const mw_apply_call *c, size_t rank, bool narrow, bool pass)
{
    const mw_apply_entries e = mw__entries_of(c->o, rank);
    void *to = (char *)c->result + mw__operator_row(c->o, rank) * c->row * mw__operand_size(narrow);
    if (MW_UNLIKELY(c->o->first || !mw__entries_plain(c, e.weight))) {
        for (size_t k = 0; k < c->count; k++)
            mw__operand_store(to, k, mw__sum_any(c, e, k, narrow), narrow);
        return;
    }
    const void *from[3];
    for (int i = 0; i < 3; i++)
        from[i] = mw__operand_at(c->values, e.column[i] * c->stride, narrow);
    row_sum_plain(e.weight, from, c->count, to, narrow, pass);
}

static MW_INLINE size_t row_bytes(const mw_apply_call *c)
{
    return c->count * mw__operand_size(c->narrow);
}

/* Have the values of a rank on their way. */
static MW_INLINE void row_ask(const mw_apply_call *c, size_t rank, bool narrow)
{
    const mw_apply_entries e = mw__entries_of(c->o, rank);
    const size_t most = LINES * MW_CACHE_LINE, row = row_bytes(c), bytes = row < most ? row : most;
    for (uint64_t i = 0; i < e.count && i < MW_NARROW_ROW; i++) {
        const char *values = mw__operand_at(c->values, e.column[i] * c->stride, narrow);
        for (size_t at = 0; at < bytes; at += MW_CACHE_LINE) __builtin_prefetch(values + at, 0, 2);
        __builtin_prefetch(values + bytes - 1, 0, 2);
    }
}

static MW_INLINE size_t rows_ahead(const mw_apply_call *c)
{
    const size_t ahead = AHEAD_BYTES / row_bytes(c);
    return ahead < AHEAD_LEAST ? AHEAD_LEAST : ahead > AHEAD_MOST ? AHEAD_MOST : ahead;
}

static MW_INLINE void ranks_sum(const mw_apply_call *c, size_t from, size_t to, bool narrow,
                                bool pass)
{
    const size_t ahead = rows_ahead(c);
    for (size_t rank = from; rank < to; rank++) {
        if (rank + ahead < to) row_ask(c, rank + ahead, narrow);
        row_sum(c, rank, narrow, pass);
    }
    if (pass) mw__past_caches_end();
}

static MW_INLINE void ranks_sum_stamped(const mw_apply_call *c, size_t from, size_t to)
{
    if (c->narrow && c->past_caches)
        ranks_sum(c, from, to, true, true);
    else if (c->narrow)
        ranks_sum(c, from, to, true, false);
    else if (c->past_caches)
        ranks_sum(c, from, to, false, true);
    else
        ranks_sum(c, from, to, false, false);
}

static void ranks_sum_portable(const mw_apply_call *c, size_t from, size_t to)
{
    ranks_sum_stamped(c, from, to);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void ranks_sum_avx2(const mw_apply_call *c, size_t from,
                                                           size_t to)
{
    ranks_sum_stamped(c, from, to);
}

#endif

void mw__row_sums(const mw_apply_call *c, size_t from, size_t to)
{
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2")) {
        ranks_sum_avx2(c, from, to);
        return;
    }
#endif
    ranks_sum_portable(c, from, to);
}
