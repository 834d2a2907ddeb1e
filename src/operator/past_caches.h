/* past_caches.h - results that are not read again soon are written past the caches: a normal write
 * would first read each cache line. Private; for this room only.
 *
 * A whole cache line should be written at once. Call mw__past_caches_end after the last of them. */
#ifndef MW_SRC_OPERATOR_PAST_CACHES_H
#define MW_SRC_OPERATOR_PAST_CACHES_H

#include "base/base.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { MW_PASSED_BYTES = 16, MW_CACHE_LINE = 64 };

/* `to` is a multiple of MW_PASSED_BYTES. */
static MW_INLINE void mw__pass_doubles(double *to, double a, double b)
{
#ifdef __SSE2__
    _mm_stream_pd(to, _mm_set_pd(b, a));
#else
    to[0] = a;
    to[1] = b;
#endif
}

static MW_INLINE void mw__pass_floats(float *to, float a, float b, float c, float d)
{
#ifdef __SSE2__
    _mm_stream_ps(to, _mm_set_ps(d, c, b, a));
#else
    to[0] = a;
    to[1] = b;
    to[2] = c;
    to[3] = d;
#endif
}

/* Bytes from an address to the next multiple of MW_PASSED_BYTES. */
static MW_INLINE size_t mw__pass_begin(const void *to)
{
    return -(uintptr_t)to % MW_PASSED_BYTES;
}

/* Before other threads may read them. */
static MW_INLINE void mw__past_caches_end(void)
{
#ifdef __SSE2__
    _mm_sfence();
#endif
}

#endif
