/* base.h - what every room uses: errors, memory, small helpers. Private. */
#ifndef MW_SRC_BASE_BASE_H
#define MW_SRC_BASE_BASE_H

#include <meshwalk/base.h>
#include <stdbool.h>

#if defined(__FAST_MATH__)
#error "meshwalk is exact: do not compile it with -ffast-math"
#endif

#define MW_INLINE inline __attribute__((always_inline))
#define MW_LIKELY(x) __builtin_expect(!!(x), 1)
#define MW_UNLIKELY(x) __builtin_expect(!!(x), 0)

/* Fill in an error (NULL allowed) and return its status, so that `return mw__fail(...)` reads well.
 * The fields that say where (triangle, vertex, line) are -1; set them afterwards where they
 * apply. */
mw_status mw__fail(mw_error *error, mw_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
mw_status mw__fail_memory(mw_error *error);
/* As mw__fail with MW_ERROR_INPUT, naming a triangle and a vertex (-1: none). */
mw_status mw__fail_at(mw_error *error, int64_t triangle, int64_t vertex, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Arrays: count * size checked for overflow, on machines of 32 bits too, where counts of 64 are
 * larger than any array; NULL on failure; count 0 gives a valid pointer. Release with free(). */
void *mw__alloc(uint64_t count, size_t size);
void *mw__calloc(uint64_t count, size_t size);
/* As mw__alloc, but begins with a cache line, so that records of a power of two of bytes do not
 * straddle two. */
void *mw__alloc_lines(uint64_t count, size_t size);
void *mw__realloc(void *old, uint64_t count, size_t size);

static inline void mw__swap(uint32_t *a, uint32_t *b)
{
    uint32_t old = *a;
    *a = *b;
    *b = old;
}

#endif
