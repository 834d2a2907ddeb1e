/* line_sums.c - rows of one cache line.
 *
 * The time goes into waiting for memory, so the values of some ranks later are asked for. All this
 * is for processors with AVX2 and rows of at most three entries; otherwise mw__row_sums does the
 * same. The bits are the same, too: each value is the sum that mw_interpolate makes, in its
 * order. */
#include "operator/line_sums.h"

#include "operator/four_doubles.h"
#include "operator/row_sums.h"

#ifdef __x86_64__
#include <immintrin.h>

enum { AHEAD = 48 }; /* ranks between one whose values are asked for and one that is summed */

#define AVX2 __attribute__((target("avx2"))) static

/* Into the second cache: more of them may be on their way than to the first. */
static MW_INLINE void line_ask(const char *values, const uint32_t v[MW_NARROW_ROW])
{
    for (int i = 0; i < MW_NARROW_ROW; i++)
        __builtin_prefetch(values + v[i] * (size_t)MW_CACHE_LINE, 0, 2);
}

/* The sums of four values, from value k on, in each of three lines. */
AVX2 inline void four_line_sum(const mw_four_doubles w[3], const char *const line[3], size_t k,
                               mw_four_doubles *out, bool narrow)
{
    mw_four_doubles sum = {0, 0, 0, 0};
    for (int i = 0; i < MW_NARROW_ROW; i++) {
        mw_four_doubles value;
        if (narrow)
            value = (mw_four_doubles)_mm256_cvtps_pd(_mm_load_ps((const float *)line[i] + k));
        else
            value = (mw_four_doubles)_mm256_load_pd((const double *)line[i] + k);
        sum += w[i] * value;
    }
    *out = sum;
}

AVX2 inline void line_sum_plain(const double w[3], const char *const line[3], char *to, bool narrow)
{
    const size_t n = MW_CACHE_LINE / mw__operand_size(narrow);
    const mw_four_doubles weight[3] = {
        {w[0], w[0], w[0], w[0]}, {w[1], w[1], w[1], w[1]}, {w[2], w[2], w[2], w[2]}};
    for (size_t k = 0; k < n; k += MW_FOUR) {
        mw_four_doubles sum;
        four_line_sum(weight, line, k, &sum, narrow);
        if (narrow)
            _mm_stream_ps((float *)to + k, _mm256_cvtpd_ps((__m256d)sum));
        else
            _mm256_stream_pd((double *)to + k, (__m256d)sum);
    }
}

AVX2 inline void line_sum(const mw_apply_call *c, size_t rank, bool narrow)
{
    const mw_apply_entries e = mw__entries_of(c->o, rank);
    char *to = (char *)c->result + mw__operator_row(c->o, rank) * (size_t)MW_CACHE_LINE;
    const char *line[3];
    if (MW_UNLIKELY(!mw__entries_plain(c, e.weight))) {
        for (size_t k = 0; k < c->count; k++)
            mw__operand_store(to, k, mw__sum_any(c, e, k, narrow), narrow);
        return;
    }
    for (int i = 0; i < MW_NARROW_ROW; i++)
        line[i] = (const char *)c->values + e.column[i] * (size_t)MW_CACHE_LINE;
    line_sum_plain(e.weight, line, to, narrow);
}

AVX2 inline void lines_sum(const mw_apply_call *c, size_t from, size_t to, bool narrow)
{
    const uint32_t *column = c->o->column;
    for (size_t rank = from; rank < to; rank++) {
        if (rank + AHEAD < c->o->rows) line_ask(c->values, &column[MW_NARROW_ROW * (rank + AHEAD)]);
        line_sum(c, rank, narrow);
    }
    mw__past_caches_end();
}

AVX2 void lines_sum_stamped(const mw_apply_call *c, size_t from, size_t to)
{
    if (c->narrow)
        lines_sum(c, from, to, true);
    else
        lines_sum(c, from, to, false);
}

void mw__line_sums(const mw_apply_call *c, size_t from, size_t to)
{
    if (__builtin_cpu_supports("avx2") && !c->o->first)
        lines_sum_stamped(c, from, to);
    else
        mw__row_sums(c, from, to);
}

#else

void mw__line_sums(const mw_apply_call *c, size_t from, size_t to)
{
    mw__row_sums(c, from, to);
}

#endif
