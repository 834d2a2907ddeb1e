/* memory.h - allocations that fail on demand. Programs that include this are listed in CMakeLists.txt: the linker sends
 * the library's (and the program's) calls of malloc, calloc and realloc here. */
#ifndef MW_TEST_MEMORY_H
#define MW_TEST_MEMORY_H

#include <stdint.h>
#include <stdlib.h>

/* How many more allocations succeed; -1: all. */
static long allocations_left = -1;

void *__real_malloc(size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_calloc(size_t count, size_t size);

static int allocation_fails(void)
{
    if (allocations_left < 0) return 0;
    if (allocations_left == 0) return 1;
    allocations_left--;
    return 0;
}

void *__wrap_malloc(size_t size)
{
    return allocation_fails() ? NULL : __real_malloc(size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return allocation_fails() ? NULL : __real_realloc(old, size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return allocation_fails() ? NULL : __real_calloc(count, size);
}

#endif
