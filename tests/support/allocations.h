/* allocations.h - one allocation fails on demand.
 *
 * A test that uses this needs the line
 *     wrap: malloc calloc realloc aligned_alloc
 * in a comment of its own at the start of a line (see CMakeLists.txt). The linker then sends all
 * calls of these functions here: those of the test, of the library and of the support library. */
#ifndef MW_TESTS_SUPPORT_ALLOCATIONS_H
#define MW_TESTS_SUPPORT_ALLOCATIONS_H

#include <stddef.h>

/* How many more allocations succeed before one fails; -1: none fails. After the failure it is -1
 * again. Not for tests that allocate in several threads while it counts. */
extern long allocations_left;

/* The C library's calloc, which is not counted and does not fail on demand. */
void *__real_calloc(size_t count, size_t size);

#endif
