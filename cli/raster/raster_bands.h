/* raster_bands.h - what the bands of a raster hold, computed strip by strip by several threads. */
#ifndef MW_CLI_RASTER_RASTER_BANDS_H
#define MW_CLI_RASTER_RASTER_BANDS_H

#include "cli/gdal/gdal_raster.h"
#include "cli/raster/raster_mesh.h"
#include "cli/raster/raster_scan.h"

typedef enum raster_band {
    BAND_VALUE = 0, /* that of the field */
    BAND_CELL,      /* that of the face of the triangle: raster_mesh.cells */
    BAND_SLOPE,     /* of the triangle's plane, in degrees */
    BAND_ASPECT,    /* the azimuth that the plane falls to, from 0 (north) to 360 (clockwise) */
    BAND_HILLSHADE, /* 1 .. 255, the sun in the north west at 45 degrees */
    BAND_TRIANGLE,  /* the number of the triangle */
    BAND_COUNT
} raster_band;

const char *raster_band_name(raster_band band);

/* Take a list of names, "slope,aspect". Returns how many; 0 after a complaint. */
uint32_t raster_bands_parse(const char *list, raster_band bands[BAND_COUNT]);

typedef struct raster_bands {
    const raster_mesh *mesh;
    const raster_grid *grid;
    raster_scan *scan;
    raster_band bands[BAND_COUNT];
    uint32_t count;
    uint32_t offset; /* so many bands of the raster come before these */
    raster_type type;
    double nodata;
    bool nearest; /* outside pixels have the value at the nearest point of the border */
    uint32_t threads;
    /* What was found. */
    uint64_t filled;     /* pixels that have a value in the first band */
    uint64_t mistakable; /* of these, those whose value is that of nodata */
} raster_bands;

/* What a band has in a triangle: of BAND_CELL and those that are derived; NaN: nothing. */
double raster_bands_property(const raster_mesh *m, raster_band band, uint32_t triangle);

/* Store values in the type of the raster, NaN as nodata, and count as `filled` and `mistakable`. */
void raster_bands_store(const raster_bands *b, const double *values, size_t count, void *pixels,
                        uint64_t found[2]);

/* Compute and write all bands. Returns 0, or an exit code after a complaint. */
int raster_bands_write(raster_bands *b, gdal_raster *raster);

#endif
