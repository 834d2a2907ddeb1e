#include "cli/raster/sight_raster.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "src/base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>

/* So many rows for each thread are computed together, then written. */
enum { SIGHT_ROWS = 16 };

typedef struct sight_block {
    const sight_raster *raster;
    uint8_t *pixels;
    uint32_t first, end; /* rows */
    atomic_uint next;    /* the row to go on with */
    atomic_uint_fast64_t visible, hidden;
} sight_block;

static void sight_work(void *work, uint32_t member)
{
    sight_block *block = work;
    const sight_raster *s = block->raster;
    const raster_grid *g = s->grid;
    mw_viewpoint view = *s->view;
    uint64_t found[3] = {0};
    (void)member;
    for (uint32_t row; (row = atomic_fetch_add(&block->next, 1)) < block->end;)
        for (uint32_t i = 0; i < g->columns; i++) {
            mw_sight_end to = {.x = g->x[i], .y = g->y[row], .height = s->height};
            mw_sight sight = mw_sight_to(&view, &to);
            found[sight.state]++;
            block->pixels[(size_t)(row - block->first) * g->columns + i] =
                sight.state == MW_SIGHT_VISIBLE  ? SIGHT_PIXEL_VISIBLE
                : sight.state == MW_SIGHT_HIDDEN ? SIGHT_PIXEL_HIDDEN
                                                 : SIGHT_PIXEL_NONE;
        }
    atomic_fetch_add(&block->visible, found[MW_SIGHT_VISIBLE]);
    atomic_fetch_add(&block->hidden, found[MW_SIGHT_HIDDEN]);
}

int sight_raster_write(sight_raster *s, gdal_raster *raster)
{
    const raster_grid *g = s->grid;
    uint32_t team = mw__team(s->threads, g->rows), step = SIGHT_ROWS * team;
    sight_block block = {.raster = s, .pixels = malloc((size_t)step * g->columns)};
    int end = block.pixels ? 0 : fail_memory();
    for (uint32_t row = 0; end == 0 && row < g->rows; row += step) {
        block.first = row;
        block.end = g->rows - row < step ? g->rows : row + step;
        atomic_store(&block.next, row);
        mw__team_run(mw__team(team, block.end - row), sight_work, &block);
        end = gdal_raster_write(raster, 0, row, block.end - row, block.pixels);
        progress_points((uint64_t)block.end * g->columns, (double)block.end / g->rows);
    }
    free(block.pixels);
    s->visible = atomic_load(&block.visible);
    s->hidden = atomic_load(&block.hidden);
    return end;
}
