/* probe_guide.c - a coarse grid that leads walks to a first triangle.
 *
 * A cell that holds corners of triangles leads to the lowest of these. All other cells take the
 * triangle of a neighbour, those next to the surface first: so from any place the guide leads to a
 * triangle nearby. */
#include "probe/probe_guide.h"

#include <stdlib.h>

/* With half as many cells as triangles, a surface of a million triangles has 27 in each cell that
 * it passes, and the guide takes 2 bytes a triangle. */
#define TRIANGLES_PER_CELL 2
enum { MOST_SIDE = 512 };

static uint32_t guide_side(uint32_t triangles)
{
    double side = cbrt((double)triangles / TRIANGLES_PER_CELL);
    return side < 1 ? 1 : side < MOST_SIDE ? (uint32_t)side : MOST_SIDE;
}

static uint32_t guide_position(const mw_probe_guide *guide, const double q[3], int axis)
{
    double at = (q[axis] - guide->low[axis]) * guide->per_cell[axis];
    /* NaN, of an extent beyond the doubles, counts as 0 */
    return !(at > 0) ? 0 : at < guide->side ? (uint32_t)at : guide->side - 1;
}

static size_t guide_cell(const mw_probe_guide *guide, const double q[3])
{
    size_t side = guide->side;
    return (guide_position(guide, q, 2) * side + guide_position(guide, q, 1)) * side +
           guide_position(guide, q, 0);
}

/* The box of all finite triangles. */
static void guide_find_box(mw_probe_guide *guide, const mw_surface *surface)
{
    double high[3] = {-INFINITY, -INFINITY, -INFINITY}, longest = 0;
    for (int k = 0; k < 3; k++) guide->low[k] = INFINITY;
    for (uint32_t t = 0; t < surface->tri_count; t++)
        for (uint32_t c = 0; c < 3 && mw__corners_finite(surface, t); c++)
            for (int k = 0; k < 3; k++) {
                double x = mw__surface_corner(surface, t, c)[k];
                guide->low[k] = x < guide->low[k] ? x : guide->low[k];
                high[k] = x > high[k] ? x : high[k];
            }
    for (int k = 0; k < 3; k++) {
        double size = high[k] - guide->low[k];
        guide->per_cell[k] = size > 0 ? guide->side / size : 0;
        longest = fmax(longest, size / guide->side);
    }
    guide->near2 = longest * longest;
}

/* Enter the lowest triangle with a corner in each cell. */
static void guide_enter(mw_probe_guide *guide, const mw_surface *surface, size_t cells)
{
    for (size_t i = 0; i < cells; i++) guide->cell[i] = MW_NONE;
    for (uint32_t t = 0; t < surface->tri_count; t++) {
        if (mw__surface_is_freed(surface, t)) continue;
        for (uint32_t c = 0; c < 3 && mw__corners_finite(surface, t); c++) {
            uint32_t *cell = &guide->cell[guide_cell(guide, mw__surface_corner(surface, t, c))];
            if (*cell == MW_NONE) *cell = t;
        }
    }
}

/* Cells whose neighbours are to be looked at, in the order in which they got their triangle. */
typedef struct cell_queue {
    uint32_t *item, first, end;
} cell_queue;

static void guide_give(mw_probe_guide *guide, cell_queue *queue, uint32_t from, uint32_t to)
{
    if (guide->cell[to] != MW_NONE) return;
    guide->cell[to] = guide->cell[from];
    queue->item[queue->end++] = to;
}

/* Give each empty cell the triangle of a cell nearby. */
static void guide_fill(mw_probe_guide *guide, cell_queue *queue, uint32_t cells)
{
    uint32_t side = guide->side, step[3] = {1, side, side * side};
    for (uint32_t i = 0; i < cells; i++)
        if (guide->cell[i] != MW_NONE) queue->item[queue->end++] = i;
    while (queue->first < queue->end) {
        uint32_t i = queue->item[queue->first++];
        for (int k = 0; k < 3; k++) {
            uint32_t at = i / step[k] % side;
            if (at > 0) guide_give(guide, queue, i, i - step[k]);
            if (at + 1 < side) guide_give(guide, queue, i, i + step[k]);
        }
    }
}

bool mw__probe_guide_create(mw_probe_guide *guide, const mw_surface *surface, mw_job *job)
{
    *guide = (mw_probe_guide){.side = guide_side(surface->tri_count)};
    uint32_t cells = guide->side * guide->side * guide->side;
    cell_queue queue = {.item = mw__alloc(cells, sizeof *queue.item)};
    guide->cell = mw__alloc(cells, sizeof *guide->cell);
    bool done = guide->cell && queue.item;
    if (done) {
        mw__job_stage(job, "making the guide", 1);
        guide_find_box(guide, surface);
        guide_enter(guide, surface, cells);
        guide_fill(guide, &queue, cells);
        /* if no triangle is finite, no cell has one: any will do */
        for (uint32_t i = 0; i < cells && queue.end == 0; i++) guide->cell[i] = 0;
        done = mw__job_step(job, 1, 1);
    }
    free(queue.item);
    return done;
}

void mw__probe_guide_release(mw_probe_guide *guide)
{
    free(guide->cell);
    guide->cell = NULL;
}

size_t mw__probe_guide_bytes(const mw_probe_guide *guide)
{
    size_t side = guide->side;
    return guide->cell ? side * side * side * sizeof *guide->cell : 0;
}

uint32_t mw__probe_guide_triangle(const mw_probe_guide *guide, const double q[3])
{
    return guide->cell[guide_cell(guide, q)];
}
