#include "base/base.h"
#include "base/posix.h"

#include <meshwalk/version.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

const char *mw_status_text(mw_status status)
{
    switch (status) {
    case MW_OK: return "no error";
    case MW_ERROR_ARGUMENT: return "wrong argument";
    case MW_ERROR_INPUT: return "invalid input";
    case MW_ERROR_MEMORY: return "out of memory";
    case MW_ERROR_LIMIT: return "too large";
    case MW_ERROR_SYSTEM: return "system error";
    case MW_CANCELLED: return "cancelled";
    case MW_STATUS_COUNT: break;
    }
    return "unknown status";
}

const char *mw_version(void)
{
    return MW_VERSION_STRING;
}

static mw_status error_fill(mw_error *error, mw_status status, int64_t triangle, int64_t vertex,
                            const char *format, va_list arguments)
{
    if (error) {
        *error = (mw_error){.status = status, .triangle = triangle, .vertex = vertex, .line = -1};
        vsnprintf(error->message, sizeof error->message, format, arguments);
    }
    return status;
}

mw_status mw__fail(mw_error *error, mw_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_fill(error, status, -1, -1, format, arguments);
    va_end(arguments);
    return status;
}

mw_status mw__fail_at(mw_error *error, int64_t triangle, int64_t vertex, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_fill(error, MW_ERROR_INPUT, triangle, vertex, format, arguments);
    va_end(arguments);
    return MW_ERROR_INPUT;
}

mw_status mw__fail_memory(mw_error *error)
{
    return mw__fail(error, MW_ERROR_MEMORY, "out of memory");
}

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
