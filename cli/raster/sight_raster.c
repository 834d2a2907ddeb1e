#include "cli/raster/sight_raster.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "src/base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* So many rows for each thread are computed together, then written. */
enum { SIGHT_ROWS = 16 };

typedef struct sight_block {
    const sight_raster *raster;
    void *pixels;
    uint32_t first, end; /* rows */
    atomic_uint next;    /* the row to go on with */
    atomic_uint_fast64_t visible, hidden;
    atomic_bool failed; /* memory ran out */
} sight_block;

raster_type sight_raster_type(const sight_raster *s)
{
    return s->count > SIGHT_MOST_BYTES ? RASTER_INT32 : RASTER_BYTE;
}

double sight_raster_none(const sight_raster *s)
{
    return s->count > SIGHT_MOST_BYTES ? -1 : 255;
}

/* How many viewpoints see a place; -1 where there is no ground. */
static int64_t sight_count(mw_viewpoint *views, size_t count, const mw_sight_end *to)
{
    int64_t seen = 0;
    for (size_t i = 0; i < count; i++) {
        mw_sight sight = mw_sight_to(&views[i], to);
        if (sight.state == MW_SIGHT_UNKNOWN) return -1;
        seen += sight.state == MW_SIGHT_VISIBLE;
    }
    return seen;
}

static void sight_store(const sight_block *block, size_t i, int64_t seen)
{
    const sight_raster *s = block->raster;
    double value = seen < 0 ? sight_raster_none(s) : (double)seen;
    if (sight_raster_type(s) == RASTER_BYTE)
        ((uint8_t *)block->pixels)[i] = (uint8_t)value;
    else
        ((int32_t *)block->pixels)[i] = (int32_t)value;
}

static void sight_work(void *work, uint32_t member)
{
    sight_block *block = work;
    const sight_raster *s = block->raster;
    const raster_grid *g = s->grid;
    mw_viewpoint *views = malloc(s->count * sizeof *views);
    uint64_t visible = 0, hidden = 0;
    (void)member;
    if (views)
        memcpy(views, s->views, s->count * sizeof *views);
    else
        atomic_store(&block->failed, true);
    for (uint32_t row; views && (row = atomic_fetch_add(&block->next, 1)) < block->end;)
        for (uint32_t i = 0; i < g->columns; i++) {
            mw_sight_end to = {.x = g->x[i], .y = g->y[row], .height = s->height};
            int64_t seen = sight_count(views, s->count, &to);
            visible += seen > 0;
            hidden += seen == 0;
            sight_store(block, (size_t)(row - block->first) * g->columns + i, seen);
        }
    free(views);
    atomic_fetch_add(&block->visible, visible);
    atomic_fetch_add(&block->hidden, hidden);
}

int sight_raster_write(sight_raster *s, gdal_raster *raster)
{
    const raster_grid *g = s->grid;
    uint32_t team = mw__team(s->threads, g->rows), step = SIGHT_ROWS * team;
    size_t size = gdal_raster_size(sight_raster_type(s));
    sight_block block = {.raster = s, .pixels = malloc((size_t)step * g->columns * size)};
    int end = block.pixels ? 0 : fail_memory();
    for (uint32_t row = 0; end == 0 && row < g->rows; row += step) {
        block.first = row;
        block.end = g->rows - row < step ? g->rows : row + step;
        atomic_store(&block.next, row);
        mw__team_run(mw__team(team, block.end - row), sight_work, &block);
        if (atomic_load(&block.failed)) end = fail_memory();
        if (end == 0) end = gdal_raster_write(raster, 0, row, block.end - row, block.pixels);
        progress_points((uint64_t)block.end * g->columns, (double)block.end / g->rows);
    }
    free(block.pixels);
    s->visible = atomic_load(&block.visible);
    s->hidden = atomic_load(&block.hidden);
    return end;
}
