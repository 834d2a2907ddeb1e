/* gdal_transform.h - points brought from one coordinate system to another, by PROJ through GDAL. */
#ifndef MW_CLI_GDAL_GDAL_TRANSFORM_H
#define MW_CLI_GDAL_GDAL_TRANSFORM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct gdal_transform gdal_transform;

/* Check before long work that points can be transformed, as `what` requires. Returns 0, or an exit
 * code after a complaint. */
int gdal_transform_check(const char *what);

/* What points are transformed from and to: two systems that are not the same, and the files that
 * have them, for messages. */
typedef struct gdal_transform_ends {
    const char *of, *from; /* "points.csv", its system */
    const char *in, *to;   /* "mesh.ply", its system */
} gdal_transform_ends;

/* Prepare a transformation, of x and y: heights do not count. Sets `*rough` if only a rough
 * transformation is known, one without a datum shift. Returns 0, or an exit code after a complaint;
 * close it in both cases. */
int gdal_transform_open(gdal_transform **transform, const gdal_transform_ends *ends, bool *rough);
void gdal_transform_close(gdal_transform *transform); /* NULL is allowed */

/* Transform points that are `stride` doubles apart, on up to so many threads (0: all). A point
 * without a position in the other system becomes NaN. Returns how many of the finite ones did. */
uint64_t gdal_transform_points(gdal_transform *transform, double *points, size_t count,
                               size_t stride, uint32_t threads);

#endif
