/* curve.h - points in order along a Hilbert curve, however crowded they are. Private. */
#ifndef MW_SRC_CURVE_H
#define MW_SRC_CURVE_H

#include "predicates/predicates.h"

/* Fill order[n] with the numbers of the points along a curve; points that are not finite come anywhere. The same for any
 * number of threads (0: as OpenMP gives). Returns false when out of memory. */
bool mw__curve_order(const mw_point *points, uint32_t n, uint32_t threads, uint32_t *order);

#endif
