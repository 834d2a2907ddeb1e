/* vertex_buckets.c - the bucketing of Su and Drysdale as published [Su, Drysdale 1997; thesis App.
 * E, sec. 4.1; App. D, sec. 3.2].
 *
 *      . . . . .
 *      . 2 2 2 .
 *      . 2 1 2 .
 *      . 2 2 2 .
 *      . . . . .
 *
 * Each cell of a uniform grid, a bucket, holds at most one of the vertices in it. A query begins at
 * the vertex in its own bucket, in any tile that has it. If that bucket is empty, the query
 * searches the rings of buckets round it until one is not: the spiral search. So building takes
 * only a pass over the vertices, and a query looks at all empty buckets that are nearer: few if
 * vertices are spread evenly, up to all buckets if most of the extent is empty. The grid of this
 * library (grid.c) fills empty cells once, and names the tile at the middle of each cell; this is
 * what it is measured against. */
#include "start/vertex_buckets.h"

#include "start/start.h"

#include <stdlib.h>

bool mw__vertex_buckets_create(mw_vertex_buckets *buckets, const mw_tiling *tiling,
                               const double low[2], const double high[2], uint32_t cells,
                               mw_job *job)
{
    enum { SOME = 1 << 12 }; /* vertices between two steps of the job */
    mw__job_stage(job, "filling buckets", 1);
    buckets->lattice = mw__lattice(low, high, cells ? cells : mw__lattice_choose(tiling));
    uint32_t count = mw__lattice_cells(&buckets->lattice), *at = mw__tile_of_vertices(tiling);
    buckets->tile = mw__alloc_lines(count, sizeof *buckets->tile);
    bool done = at && buckets->tile;
    for (uint32_t c = 0; done && c < count; c++) buckets->tile[c] = MW_NONE;
    for (uint32_t v = 0; done && v < tiling->point_count; v++) {
        if (v % SOME == 0) done = mw__job_step(job, v, tiling->point_count);
        if (at[v] == MW_NONE) continue;
        uint32_t *tile = &buckets->tile[mw__lattice_cell(&buckets->lattice, tiling->point[v])];
        if (*tile == MW_NONE) *tile = at[v];
    }
    free(at);
    return done;
}

void mw__vertex_buckets_release(mw_vertex_buckets *buckets)
{
    free(buckets->tile);
}

size_t mw__vertex_buckets_bytes(const mw_vertex_buckets *buckets)
{
    return mw__lattice_cells(&buckets->lattice) * sizeof *buckets->tile;
}

/* --- the spiral --- */

/* A ring: the cells whose columns or rows are `far` off those of the middle, others no farther. */
typedef struct mw_ring {
    const mw_lattice *lattice;
    uint32_t x, y, far;
    mw_cell_holds *holds;
    const void *self;
} mw_ring;

/* Of column x + dx from row y - reach to y + reach, or of a row likewise: the first cell that holds
 * something. */
static uint32_t ring_side(const mw_ring *r, bool column, int64_t off, int64_t reach)
{
    int64_t lines = column ? r->lattice->columns : r->lattice->rows;
    int64_t along = column ? r->lattice->rows : r->lattice->columns;
    int64_t line = (column ? r->x : r->y) + off, middle = column ? r->y : r->x;
    if (line < 0 || line >= lines) return MW_NONE;
    int64_t begin = middle - reach > 0 ? middle - reach : 0,
            end = middle + reach < along ? middle + reach : along - 1;
    for (int64_t i = begin; i <= end; i++) {
        uint32_t cell =
            (uint32_t)(column ? i * r->lattice->columns + line : line * r->lattice->columns + i);
        if (r->holds(r->self, cell)) return cell;
    }
    return MW_NONE;
}

static uint32_t ring_search(const mw_ring *r)
{
    int64_t far = r->far;
    uint32_t cell = ring_side(r, false, -far, far);
    if (cell == MW_NONE) cell = ring_side(r, false, far, far);
    if (cell == MW_NONE) cell = ring_side(r, true, -far, far - 1);
    return cell == MW_NONE ? ring_side(r, true, far, far - 1) : cell;
}

uint32_t mw__lattice_spiral(const mw_lattice *lattice, mw_point q, mw_cell_holds *holds,
                            const void *self)
{
    uint32_t cell = mw__lattice_cell(lattice, q),
             most = lattice->columns > lattice->rows ? lattice->columns : lattice->rows;
    if (holds(self, cell)) return cell;
    mw_ring ring = {lattice, cell % lattice->columns, cell / lattice->columns, 0, holds, self};
    for (cell = MW_NONE; cell == MW_NONE && ++ring.far < most;) cell = ring_search(&ring);
    return cell;
}

static bool bucket_has_vertex(const void *self, uint32_t cell)
{
    return ((const mw_vertex_buckets *)self)->tile[cell] != MW_NONE;
}

uint32_t mw__vertex_buckets_first(const mw_vertex_buckets *buckets, mw_point q)
{
    uint32_t cell = mw__lattice_spiral(&buckets->lattice, q, bucket_has_vertex, buckets);
    return cell == MW_NONE ? 0 : buckets->tile[cell];
}
