#include "cli/raster/dem.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_raster.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

int dem_read(dem *d, const char *path, uint32_t band)
{
    gdal_raster_form form;
    *d = (dem){.path = path};
    progress_phase("reading", path);
    int end = gdal_raster_describe(path, &form, &d->crs);
    if (end) return end;
    if (band < 1 || band > form.bands) {
        complain("%s: has %u bands; there is no band %u", path, (unsigned)form.bands,
                 (unsigned)band);
        return END_INPUT;
    }
    d->grid = (raster_grid){.west = form.corner[0],
                            .north = form.corner[1],
                            .width = form.size[0],
                            .height = form.size[1],
                            .columns = form.columns,
                            .rows = form.rows};
    end = raster_grid_complete(&d->grid);
    if (end) return end;
    size_t pixels = (size_t)form.columns * form.rows;
    d->z = pixels <= SIZE_MAX / sizeof *d->z ? malloc(pixels * sizeof *d->z) : NULL;
    if (!d->z) return fail_memory();
    end = gdal_raster_read(path, &form, band - 1, d->z);
    for (size_t i = 0; end == 0 && i < pixels; i++)
        if (!isnan(d->z[i])) d->filled++;
    return end;
}

void dem_release(dem *d)
{
    raster_grid_release(&d->grid);
    free(d->z);
    free(d->crs);
    *d = (dem){0};
}

double dem_height(const dem *d, double x, double y)
{
    const raster_grid *g = &d->grid;
    double column = (x - g->west) / g->width - 0.5, row = (g->north - y) / g->height - 0.5;
    if (!(column >= 0 && column <= g->columns - 1 && row >= 0 && row <= g->rows - 1)) return NAN;
    size_t i = (size_t)column, j = (size_t)row;
    double u = column - (double)i, v = row - (double)j, sum = 0;
    for (size_t k = 0; k < 4; k++) {
        double weight = (k & 1 ? u : 1 - u) * (k & 2 ? v : 1 - v);
        if (weight != 0) sum += weight * d->z[(j + (k >> 1)) * g->columns + i + (k & 1)];
    }
    return sum;
}

/* --- the first vertices ----------------------------------------------------------------------- */

typedef struct dem_pixel {
    int64_t column, row;
} dem_pixel;

/* Is there a pixel without a height beside this one? */
static bool pixel_is_at_edge(const dem *d, int64_t column, int64_t row)
{
    const raster_grid *g = &d->grid;
    for (int64_t j = row - 1; j <= row + 1; j++)
        for (int64_t i = column - 1; i <= column + 1; i++)
            if (i >= 0 && j >= 0 && i < g->columns && j < g->rows &&
                isnan(d->z[(size_t)j * g->columns + (size_t)i]))
                return true;
    return false;
}

/* Does the path a, b, c turn left, with rows counted downwards? */
static bool pixels_turn(dem_pixel a, dem_pixel b, dem_pixel c)
{
    return (b.column - a.column) * (c.row - a.row) - (b.row - a.row) * (c.column - a.column) > 0;
}

/* Mark the corners of one side of the hull: the chain of the first, or the last, pixels of all
 * rows. */
static bool hull_mark(const dem *d, bool left, uint8_t *marks)
{
    const raster_grid *g = &d->grid;
    size_t count = 0;
    dem_pixel *chain = malloc(g->rows * sizeof *chain);
    for (int64_t j = 0; chain && j < g->rows; j++) {
        const double *row = d->z + (size_t)j * g->columns;
        int64_t i = left ? 0 : (int64_t)g->columns - 1, step = left ? 1 : -1;
        while (i >= 0 && i < g->columns && isnan(row[i])) i += step;
        if (i < 0 || i >= g->columns) continue;
        dem_pixel p = {i, j};
        while (count >= 2 && !(left ? pixels_turn(p, chain[count - 1], chain[count - 2])
                                    : pixels_turn(chain[count - 2], chain[count - 1], p)))
            count--;
        chain[count++] = p;
    }
    for (size_t k = 0; k < count; k++)
        marks[(size_t)chain[k].row * g->columns + (size_t)chain[k].column] = 1;
    free(chain);
    return chain != NULL;
}

int dem_begin(const dem *d, double **xyz, size_t *count)
{
    const raster_grid *g = &d->grid;
    size_t n = 0, pixels = (size_t)g->columns * g->rows;
    uint8_t *marks = calloc(pixels, 1);
    *xyz = NULL;
    bool done = marks && hull_mark(d, true, marks) && hull_mark(d, false, marks);
    for (size_t i = 0; done && i < pixels; i++) {
        bool edge = d->filled < pixels && !isnan(d->z[i]) &&
                    pixel_is_at_edge(d, (int64_t)(i % g->columns), (int64_t)(i / g->columns));
        if (edge) marks[i] = 1;
        n += marks[i];
    }
    *xyz = done ? malloc((3 * n + 1) * sizeof **xyz) : NULL;
    *count = n;
    n = 0;
    for (size_t i = 0; *xyz && i < pixels; i++) {
        if (!marks[i]) continue;
        (*xyz)[3 * n] = g->x[i % g->columns];
        (*xyz)[3 * n + 1] = g->y[i / g->columns];
        (*xyz)[3 * n++ + 2] = d->z[i];
    }
    free(marks);
    return *xyz ? 0 : fail_memory();
}
