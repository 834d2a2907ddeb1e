/* gdal_raster.h - writes rasters with GDAL, block by block, and reads the grid of an existing one.
 */
#ifndef MW_CLI_GDAL_GDAL_RASTER_H
#define MW_CLI_GDAL_GDAL_RASTER_H

#include <stdbool.h>
#include <stdint.h>

/* What the pixels of a raster are. */
typedef enum raster_type {
    RASTER_FLOAT32 = 0,
    RASTER_FLOAT64,
    RASTER_INT32,
    RASTER_BYTE
} raster_type;

/* A raster to be written. */
typedef struct gdal_raster_form {
    uint32_t columns, rows, bands;
    bool by_band; /* the bands are written one after the other */
    double corner[2],
        size[2]; /* the outer corner of the first pixel; widths of a pixel, positive */
    raster_type type;
    double nodata;
    const char *const *names; /* of the bands */
    const char *crs;          /* NULL: not known */
    const char *driver;       /* NULL: by the ending of the path */
    const char *creation;     /* options of the driver, "COMPRESS=DEFLATE,TILED=YES"; NULL: none */
} gdal_raster_form;

typedef struct gdal_raster gdal_raster;

/* The functions with a result of type int return 0, or an exit code after a complaint. */

/* Refuse a path that cannot be written, before anything is read. */
int gdal_raster_check(const char *path, const char *driver);

/* Close it also after a failure. */
int gdal_raster_create(gdal_raster **raster, const char *path, const gdal_raster_form *form);

/* Write whole rows of a band, from 0, of the type of the raster. */
int gdal_raster_write(gdal_raster *r, uint32_t band, uint32_t row, uint32_t rows, void *pixels);

/* If `commit`, complete the file and give it its name. NULL is allowed. */
int gdal_raster_close(gdal_raster *r, bool commit);

/* The bytes of a pixel. */
uint32_t gdal_raster_size(raster_type type);

/* The grid of a raster, as in gdal_raster_form; its bands are not read. *crs is WKT that the caller
 * frees, or NULL: not known. *nodata is NaN if it has none. */
int gdal_raster_describe(const char *path, gdal_raster_form *form, char **crs);

/* Read a band, from 0, of a raster that has been described: columns * rows values, NaN where it has
 * none, in units of the band. */
int gdal_raster_read(const char *path, const gdal_raster_form *form, uint32_t band, double *values);

#endif
