/* stand_ins.h - sets of points made in the place of the thesis' own data, which are not to be had:
 * the land registers of cities and laser scans. */
#ifndef MW_BENCH_DATA_STAND_INS_H
#define MW_BENCH_DATA_STAND_INS_H

#include <stddef.h>
#include <stdint.h>

/* A city of blocks of parcels with streets between them, small in the middle and large outside,
 * turned against the axes. The points are corners and other points of the borders of building
 * sites, about seven each. *random goes on. */
void stand_in_parcels(double *points, size_t n, uint64_t *random);

/* Five flight strips, side by side and turned against the axes, of scan lines whose points lie
 * almost regularly; none lie on a few lakes. */
void stand_in_strips(double *points, size_t n, uint64_t *random);

#endif
