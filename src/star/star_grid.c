/* star_grid.c - grids in longitude and polar angle, uniform and non-uniform [thesis App. F, sec.
 * 6].
 *
 * A grid has k rows of the same height; row i has l_i cells. A query starts in the facet at the
 * middle of its cell. In the uniform grid each row has 2 k cells, which are squares in the plane of
 * the two angles, as in Fig. 4 a: 2 k^2 cells. In the non-uniform grid l_i is proportional to the
 * area of the row on the sphere (eq. 4), so that cells have about equal areas: k by eq. 5, l_i by
 * eq. 6. Each l_i is rounded, so the number of cells is seldom exactly m. No row is empty. */
#include "star/star_index.h"

#include <stdlib.h>

#define PI 3.14159265358979323846

static uint32_t grid_row_count(uint32_t cells, bool uniform)
{
    double rows = uniform ? sqrt(cells / 2.0) : sqrt(PI * cells / 4);
    return (uint32_t)(rows + 0.5);
}

/* l_i for m cells, eq. 6. The integral of the sine is a difference of cosines, written as a product
 * that keeps its digits. */
static uint32_t grid_row_cells(uint32_t i, uint32_t rows, uint32_t cells, bool uniform)
{
    if (uniform) return 2 * rows;
    double area = 2 * sin((i + 0.5) * PI / rows) * sin(PI / 2 / rows);
    uint32_t count = (uint32_t)(0.5 * cells * area + 0.5);
    return count > 0 ? count : 1;
}

/* The direction to the middle of cell j of row i. */
static void grid_cell_middle(const mw_star_grid *grid, uint32_t i, uint32_t j, double d[3])
{
    uint32_t count = grid->first[i + 1] - grid->first[i];
    double theta = (i + 0.5) * PI / grid->rows, phi = (j + 0.5) * 2 * PI / count - PI;
    d[0] = sin(theta) * cos(phi);
    d[1] = sin(theta) * sin(phi);
    d[2] = cos(theta);
}

/* Fill each cell, starting from the previous one. On the sphere, the last cell of a row is close to
 * the first one of the next row. */
static bool star_grid_fill(mw_star_grid *grid, const mw_star *star, mw_job *job)
{
    uint32_t t = 0;
    for (uint32_t i = 0; i < grid->rows; i++) {
        if (!mw__job_step(job, i, grid->rows)) return false;
        for (uint32_t c = grid->first[i]; c < grid->first[i + 1]; c++) {
            double d[3];
            grid_cell_middle(grid, i, c - grid->first[i], d);
            t = grid->facet[c] = mw__star_facet_along(star, d, t);
        }
    }
    return true;
}

bool mw__star_grid_create(mw_star_grid *grid, const mw_star *star, uint32_t cells, bool uniform,
                          mw_job *job)
{
    grid->rows = grid_row_count(cells, uniform);
    grid->first = mw__calloc((size_t)grid->rows + 1, sizeof *grid->first);
    if (!grid->first) return false;
    for (uint32_t i = 0; i < grid->rows; i++)
        grid->first[i + 1] = grid->first[i] + grid_row_cells(i, grid->rows, cells, uniform);
    grid->facet = mw__alloc(grid->first[grid->rows], sizeof *grid->facet);
    return grid->facet && star_grid_fill(grid, star, job);
}

void mw__star_grid_release(mw_star_grid *grid)
{
    free(grid->first);
    free(grid->facet);
}

/* The interval, of `count` equal ones, that contains a position from 0 to 1. The last one contains
 * 1. */
static uint32_t interval_of(double position, uint32_t count)
{
    double at = count * position;
    return at < count ? (uint32_t)at : count - 1;
}

/* Eq. 7 */
uint32_t mw__star_grid_cell(const mw_star_grid *grid, double phi, double theta)
{
    uint32_t i = interval_of(theta / PI, grid->rows);
    return grid->first[i] + interval_of((phi + PI) / (2 * PI), grid->first[i + 1] - grid->first[i]);
}
