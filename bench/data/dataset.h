/* dataset.h - sets of points to measure with, made from a seed. */
#ifndef MW_BENCH_DATA_DATASET_H
#define MW_BENCH_DATA_DATASET_H

#include "bench/data/dataset_random.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dataset_kind {
    DATASET_UNIFORM, /* uniform in the unit square */
    /* the integers of a square, row by row: every cell's four corners on a circle */
    DATASET_GRID,
    DATASET_GAUSSIAN, /* normal in x and y, about the origin, deviation 1 */
    /* in the unit square, 100 normal clusters of deviation 0.01 at random positions */
    DATASET_CLUSTERS,
    /* in the unit square, on 30 random arcs of circles, off them by a normal 0.001 */
    DATASET_ARCS,
    DATASET_RECTANGLE, /* uniform in a rectangle 2 by 1, turned by pi/6 */
    DATASET_RINGS,     /* on circles round one centre, as many on each: cocircular up to rounding */
    /* ten rows, each 1e-9 wide, turned by pi/6: needles between the rows, caps within them */
    DATASET_SLIVERS,
    /* ten kilometres of a country in metres, 5e6 from 0: doubles are 2^-30 apart */
    DATASET_OFFSET,
    DATASET_CADASTRE, /* borders of building sites in a city: stand_ins.h */
    DATASET_LIDAR,    /* flight strips of a laser scan: stand_ins.h */
    DATASET_KINDS
} dataset_kind;

/* "uniform", ...; NULL for another number. */
const char *dataset_name(int kind);
/* The kind of that name; DATASET_KINDS if there is none. */
int dataset_named(const char *name);

/* Points, and the domain that queries are drawn from: the parallelogram of all
 * origin + s * u + t * v with s and t from 0 to 1. */
typedef struct dataset {
    double *points; /* x0 y0 x1 y1 ... */
    size_t count;
    double origin[2], u[2], v[2];
} dataset;

/* Make n points, the same for the same seed. With `enclose` the last four of them are the corners
 * of the domain (n is at least 5). The domain is the square, or the turned rectangle; of a grid the
 * square of its cells; of normal points, slivers, cadastre and lidar their extent. Returns false
 * when memory runs out; the set is then empty. */
bool dataset_make(dataset *d, dataset_kind kind, size_t n, bool enclose, uint64_t seed);
void dataset_release(dataset *d);

/* Make the domain the extent of the first n points. Returns false if they are so far apart that it
 * overflows. */
bool dataset_bound(dataset *d, size_t n);
/* Write the corners of the domain over the last four points. */
void dataset_enclose(dataset *d);

/* n points uniform in the domain; *random goes on from call to call. */
void dataset_draw(const dataset *d, double *points, size_t n, uint64_t *random);

#ifdef __cplusplus
}
#endif

#endif
