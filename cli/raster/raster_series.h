/* raster_series.h - values over time as the bands of a raster: one for each field and step. */
#ifndef MW_CLI_RASTER_RASTER_SERIES_H
#define MW_CLI_RASTER_RASTER_SERIES_H

#include "cli/raster/raster_bands.h"
#include "cli/series/series_choice.h"

typedef struct raster_series {
    series_choice choice;
    char **names; /* of the bands: FIELD@TIME */
    uint32_t bands;
} raster_series;

/* Functions with a result of type int return 0, or an exit code after a complaint. */

/* Open the values and choose the steps. Close it in any case. */
int raster_series_open(raster_series *s, const series_request *request, const raster_mesh *mesh,
                       bool quiet);
void raster_series_close(raster_series *s);

/* Room in the mesh for the values of cells, and its end. */
int raster_series_begin(raster_mesh *mesh);
void raster_series_end(raster_mesh *mesh);

/* Read the values of a band into the mesh: into its `cells` if *cells becomes true, else into
 * `values`. */
int raster_series_read(raster_series *s, raster_mesh *mesh, uint32_t band, bool *cells);

/* Read, compute and write band after band: step by step, and of each the fields. `b` is as for
 * raster_bands_write, for the bands of one step; its mesh is `mesh`, whose values change. It counts
 * the pixels that have a value in the first band. */
int raster_series_write(raster_series *s, raster_bands *b, raster_mesh *mesh, gdal_raster *raster);

#endif
