/* scan_vector.h - four doubles at a time, for the rows and pixels of a triangle. Vectors go by
 * pointers: how a function takes them depends on the processor. */
#ifndef MW_CLI_RASTER_SCAN_VECTOR_H
#define MW_CLI_RASTER_SCAN_VECTOR_H

#include <stdint.h>

/* Each set of instructions has a copy of what is marked so. */
#define SCAN_INLINE inline __attribute__((always_inline))

enum { SCAN_FOUR = 4 };

typedef double scan_doubles __attribute__((vector_size(32), aligned(8)));
typedef int64_t scan_mask __attribute__((vector_size(32), aligned(8))); /* 0 or all bits */
typedef float scan_floats __attribute__((vector_size(16), aligned(4)));
typedef int32_t scan_ints __attribute__((vector_size(16), aligned(4)));

/* *a where the mask is set, else `other`. */
static SCAN_INLINE void scan_choose(const scan_mask *mask, scan_doubles *a,
                                    const scan_doubles *other)
{
    *a = (scan_doubles)((*mask & (scan_mask)*a) | (~*mask & (scan_mask)*other));
}

#endif
