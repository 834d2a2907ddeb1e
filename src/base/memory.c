/* memory.c - allocation of arrays, checked on machines of any word size. The program is linked with
 * this file, too. */
#include "base/base.h"
#include "base/posix.h"

#include <stdlib.h>

void *mw__alloc(uint64_t count, size_t size)
{
    return mw__realloc(NULL, count, size);
}

static void *alloc_aligned(size_t alignment, size_t bytes)
{
    if (bytes > SIZE_MAX - alignment) return NULL;
    return aligned_alloc(alignment, (bytes / alignment + 1) * alignment);
}

/* Queries read arrays at random positions: with pages of 4 KiB nearly every miss of the cache is
 * one of the table of pages, too. So an array that is large enough asks for large pages. The
 * request is only advice: a system without large pages ignores it. */
void *mw__alloc_lines(uint64_t count, size_t size)
{
    enum { LINE = 64, PAGE = 1 << 21, PAGES = 2 };
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) return NULL;
    if (bytes < (size_t)PAGES * PAGE) return alloc_aligned(LINE, bytes);
    void *lines = alloc_aligned(PAGE, bytes);
#ifdef MADV_HUGEPAGE
    if (lines) (void)madvise(lines, bytes, MADV_HUGEPAGE);
#endif
    return lines;
}

void *mw__calloc(uint64_t count, size_t size)
{
    if (count > SIZE_MAX) return NULL;
    return calloc(count ? (size_t)count : 1, size);
}

void *mw__realloc(void *old, uint64_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) return NULL;
    return realloc(old, bytes ? bytes : 1);
}
