#include "cli/raster/raster_mean.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdlib.h>

/* So many pixels are computed at a time, or one row: some 100 bytes each. Each strip looks at all
 * triangles. */
#define MEAN_PIXELS ((uint32_t)1 << 20)

/* Means, whose rows have no entries where the mesh covers nothing. */
static int mean_of_strip(raster_mean *m, const mw_remap *remap, double *result, size_t count)
{
    mw_error error;
    const raster_bands *b = m->bands;
    const mw_value_table table = {.values = b->mesh->values, .type = MW_FLOAT64, .count = 1};
    const mw_operator_apply_options apply = {.threads = b->threads};
    if (mw_operator_apply(remap->weights, &table, &apply, result, &error) != MW_OK)
        return fail_query(&error);
    for (size_t i = 0; i < count; i++) {
        double area = remap->target_fraction[i] * remap->target_area[i];
        if (isnan(result[i])) continue;
        m->area += area;
        m->integral += result[i] * area;
    }
    return 0;
}

int raster_mean_write(raster_mean *m, gdal_raster *raster)
{
    mw_error error;
    raster_bands *b = m->bands;
    const raster_grid *g = b->grid;
    uint32_t step = g->columns < MEAN_PIXELS ? MEAN_PIXELS / g->columns : 1;
    uint64_t found[2] = {0};
    const mw_remap_mesh source = {.locator = b->mesh->locator};
    const mw_remap_options options = {
        .threads = b->threads, .vertices = 1, .degrees = m->degrees, .covered = 1};
    double *values = malloc((size_t)step * g->columns * sizeof *values);
    void *pixels = malloc((size_t)step * g->columns * sizeof *values);
    int end = values && pixels ? 0 : fail_memory();
    for (uint32_t row = 0; end == 0 && row < g->rows; row += step) {
        mw_remap remap = {0};
        uint32_t rows = g->rows - row < step ? g->rows - row : step;
        size_t count = (size_t)rows * g->columns;
        const mw_remap_pixels strip = {.west = g->west,
                                       .north = g->north - row * g->height,
                                       .width = g->width,
                                       .height = g->height,
                                       .columns = g->columns,
                                       .rows = rows};
        if (mw_remap_to_pixels(&source, &strip, &options, &remap, &error) != MW_OK)
            end = fail_query(&error);
        if (end == 0) end = mean_of_strip(m, &remap, values, count);
        mw_remap_release(&remap);
        if (end == 0) raster_bands_store(b, values, count, pixels, found);
        if (end == 0) end = gdal_raster_write(raster, 0, row, rows, pixels);
        progress_points((uint64_t)(row + rows) * g->columns, (double)(row + rows) / g->rows);
    }
    b->filled = found[0];
    b->mistakable = found[1];
    free(values);
    free(pixels);
    return end;
}
