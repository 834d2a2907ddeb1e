/* curve.h - points in order along a Hilbert curve, however crowded they are. Private. */
#ifndef MW_SRC_CURVE_H
#define MW_SRC_CURVE_H

#include "base/hilbert.h"
#include "predicates/predicates.h"

typedef struct mw_extent {
    double low[2], high[2];
} mw_extent;

/* Of those points that are finite; *all_finite: they all are. Empty, low > high, where none is. */
mw_extent mw__find_extent(const mw_point *points, uint32_t n, uint32_t threads, bool *all_finite);

/* More points than this with one key are sorted again, on a finer curve through their own extent. */
#define MW_LONG_RUN 256

/* Sort the numbers of n points, in keys[i].item, along a curve through an extent; keys[i].key is the place on that curve. `scratch` has room for
 * n keys too. The same for any number of threads (0: as OpenMP gives). Returns false when out of memory. */
bool mw__curve_sort(const mw_point *points, uint32_t n, const mw_extent *extent, uint32_t threads, mw_key *keys,
                    mw_key *scratch);

/* The keys of the points keys[i].item along the curve through the extent of these points. */
void mw__set_keys(const mw_point *points, mw_key *keys, size_t n);

/* Fill order[n] with the numbers of the points along a curve through their extent; points that are not finite come anywhere. Threads, and
 * false, as above. */
bool mw__curve_order(const mw_point *points, uint32_t n, uint32_t threads, uint32_t *order);

#endif
