#include "cli/raster/raster_grid.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST_PIXELS 2147483647.0 /* in a row or a column, for GDAL */
#define MOST_OF_ALL 1e12         /* in a raster: more is a slip, and fills the disk */

static bool extent_parse(const char *text, double box[4])
{
    const char *p = text;
    for (int k = 0; k < 4; k++) {
        char *end;
        box[k] = strtod(p, &end);
        if (end == p || !isfinite(box[k]) || *end != (k < 3 ? ',' : 0)) return false;
        p = end + 1;
    }
    return box[0] < box[2] && box[1] < box[3];
}

int raster_grid_check(const raster_grid_wish *wish)
{
    double box[4];
    if (!wish->extent || extent_parse(wish->extent, box)) return 0;
    complain("option '--extent' must be XMIN,YMIN,XMAX,YMAX, not '%.80s'", wish->extent);
    return END_USAGE;
}

double raster_grid_resolution(double area, uint64_t vertices)
{
    double distance = sqrt(area / (double)(vertices > 0 ? vertices : 1));
    double power = pow(10, floor(log10(distance)));
    for (int digit = 5; digit > 1; digit -= 3)
        if (digit * power <= distance) return digit * power;
    return power;
}

static int grid_fail_size(const raster_grid_wish *wish)
{
    complain("a raster with pixels of %g would have too many pixels, or pixels too small for its "
             "coordinates; --resolution sets their size",
             wish->resolution);
    return END_RESOURCE;
}

int raster_grid_complete(raster_grid *g)
{
    if ((double)g->columns * g->rows > MOST_OF_ALL) {
        complain("a raster of %u times %u pixels is too large", (unsigned)g->columns,
                 (unsigned)g->rows);
        return END_RESOURCE;
    }
    g->x = calloc((size_t)g->columns + RASTER_GRID_SPARE, sizeof *g->x);
    g->y = calloc((size_t)g->rows + RASTER_GRID_SPARE, sizeof *g->y);
    if (!g->x || !g->y) return fail_memory();
    bool sorted = true;
    for (uint32_t i = 0; i < g->columns; i++) {
        g->x[i] = g->west + (i + 0.5) * g->width;
        sorted = sorted && isfinite(g->x[i]) && (i == 0 || g->x[i] > g->x[i - 1]);
    }
    for (uint32_t j = 0; j < g->rows; j++) {
        g->y[j] = g->north - (j + 0.5) * g->height;
        sorted = sorted && isfinite(g->y[j]) && (j == 0 || g->y[j] < g->y[j - 1]);
    }
    return sorted ? 0 : grid_fail_size(&(raster_grid_wish){.resolution = g->width});
}

int raster_grid_make(raster_grid *g, const raster_grid_wish *wish, const double mesh[4])
{
    double box[4], size = wish->resolution;
    *g = (raster_grid){.width = size, .height = size};
    if (wish->extent) {
        extent_parse(wish->extent, box);
    } else {
        for (int k = 0; k < 2; k++) box[k] = floor(mesh[k] / size) * size;
        for (int k = 2; k < 4; k++) box[k] = ceil(mesh[k] / size) * size;
        /* A mesh whose side is a line has no pixel, except for this. */
        for (int k = 0; k < 2; k++)
            if (box[k] == box[k + 2]) box[k + 2] += size;
    }
    /* An extent given need be no multiple: then the last pixels reach beyond it. */
    double columns = ceil((box[2] - box[0]) / size - 1e-9),
           rows = ceil((box[3] - box[1]) / size - 1e-9);
    if (!(columns >= 1 && columns <= MOST_PIXELS && rows >= 1 && rows <= MOST_PIXELS &&
          columns * rows <= MOST_OF_ALL))
        return grid_fail_size(wish);
    g->west = box[0];
    g->north = box[3];
    g->columns = (uint32_t)columns;
    g->rows = (uint32_t)rows;
    return raster_grid_complete(g);
}

void raster_grid_release(raster_grid *g)
{
    free(g->x);
    free(g->y);
    *g = (raster_grid){0};
}
