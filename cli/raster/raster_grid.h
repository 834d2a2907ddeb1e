/* raster_grid.h - the pixels of a raster and where their centres are. */
#ifndef MW_CLI_RASTER_RASTER_GRID_H
#define MW_CLI_RASTER_RASTER_GRID_H

#include <stdbool.h>
#include <stdint.h>

/* Row 0 is the northernmost, column 0 the westernmost. */
typedef struct raster_grid {
    double west, north;     /* the outer corner of pixel (0, 0) */
    double width, height;   /* of a pixel, positive */
    uint32_t columns, rows; /* at most 2^31 - 1 */
    double *x, *y;          /* the centres of columns, rising, and of rows, falling; owned */
} raster_grid;

/* Centres are read many at a time: behind the last there are so many more, which mean nothing. */
enum { RASTER_GRID_SPARE = 32 };

/* What the user asks for. All zero selects the defaults. */
typedef struct raster_grid_wish {
    double resolution;  /* 0: not given */
    const char *extent; /* "XMIN,YMIN,XMAX,YMAX"; NULL: that of the mesh */
} raster_grid_wish;

/* Functions with a result of type int return 0, or an exit code after a complaint. */

/* Refuse an extent that is none, before anything is read. */
int raster_grid_check(const raster_grid_wish *wish);

/* A size of pixels for a mesh, of which `area` has `vertices`: the mean distance of neighbours,
 * rounded down to 1, 2 or 5 times a power of ten. */
double raster_grid_resolution(double area, uint64_t vertices);

/* Lay out the requested grid over a mesh with this xmin, ymin, xmax, ymax. Without an extent it is
 * that of the mesh, enlarged to multiples of the resolution. Release it in any case.
 */
int raster_grid_make(raster_grid *g, const raster_grid_wish *wish, const double mesh[4]);

/* Compute the centres of a grid whose other members are set. */
int raster_grid_complete(raster_grid *g);
void raster_grid_release(raster_grid *g);

#endif
