/* grid.c - a uniform grid of buckets [Su, Drysdale 1997; thesis App. E, sec. 4.1].
 *
 * In Su and Drysdale's grid a cell holds at most one of the vertices in it, by a tile at that
 * vertex, and a query begins there. If its cell is empty, each query searches the rings of cells
 * round it, in a spiral. Here a cell holds the tile whose middle is nearest to the cell's middle,
 * so that queries visit 2.3 tiles instead of 3.5 (uniform points). Empty cells are filled once, by
 * a walk to their middle from a neighbouring cell that is filled already. Where many cells are
 * empty, tiles are large and these walks are short. So the cost of a query is bounded even if most
 * of the extent is empty. Walking to the middle of every cell would lower the mean to 2.2 tiles,
 * but building would take 2.7 times as long.
 *
 * Beyond the extent lies a margin: a frame of cells that hold no middle of a tile. The walk to the
 * middle of such a cell ends at an edge of the hull that separates the cell from the mesh. To the
 * right of the extent no such edge faces left, so it also separates everything farther to the
 * right; and likewise on the other sides. So nearly every query outside ends in its first tile.
 * Without the margin it would walk there from inside the mesh, over 7 to 12 tiles that get ever
 * longer: 112 and 147 ns (10^4 and 10^6 uniform points, in batches) instead of 46.
 *
 * From a cell of k tiles a walk visits about 1 + 0.6 sqrt(k) tiles. If k is large, a sample along
 * the curve (curve.c) leads nearer: 4 to 5 tiles for any k. But it takes longer to look up, and in
 * large triangles between clusters it leads astray. So where vertices are crowded the guide of a
 * locator is both: a grid whose crowded cells ask the curve. 10^6 points in 100 clusters of a
 * deviation of a thousandth, alone and in a batch: at random points 1300 ns and 450 by the curve,
 * 74 and 31 by both; at random triangles 3370 and 765 by the grid, 630 and 117 by the curve, 630
 * and 124 by both.
 *
 * Number of cells: more cells make walks shorter, but hardly save time, since the grid itself has
 * to come from memory. 10^6 uniform points, one thread, ns per query, cells per vertex:
 *     1/8  alone 519, in a batch 82
 *     1/2  alone 453, in a batch 69
 *     1    alone 430, in a batch 63
 * So one cell for two vertices: 2 bytes a vertex. */
#include "start/grid.h"

#include "start/start.h"
#include "walk/walk.h"

#include <stdlib.h>

enum {
    WORTHWHILE = 1 << 15, /* tiles for a thread to be worth it          */
    MOST_SHARES = 8,      /* of the tiles: each has its sites for all cells */
    /* tiles in a cell from which on the curve is better */
    CROWDED = 48,
    /* the same, so much so that it pays to have it, if one tile in SHARE is in such a cell */
    CROWD = 128,
    SHARE = 4
};

/* Of every few tiles, put the one nearest to the middle of a cell into it, and count them: share i,
 * with sites of its own. */
static void shares_look(const mw_grid *grid, const mw_grid_plan *plan, uint32_t i, uint32_t shares)
{
    uint32_t cells = mw__lattice_cells(&grid->lattice);
    uint64_t looks = ((uint64_t)plan->tiling->tri_count + plan->stride - 1) / plan->stride;
    uint64_t end = looks * (i + 1) / shares;
    mw_grid_site *sites = plan->site + (size_t)i * cells;
    for (uint32_t c = 0; c < cells; c++) sites[c] = (mw_grid_site){INFINITY, MW_NONE, 0};
    for (uint64_t look = looks * i / shares; look < end; look++) {
        float off;
        uint32_t t = (uint32_t)(look * plan->stride);
        mw_grid_site *site =
            &sites[mw__lattice_cell_off(&grid->lattice, mw__tile_middle(plan->tiling, t), &off)];
        site->count++;
        /* no jump: every other one would be guessed wrong */
        const uint32_t nearer = 0 - (uint32_t)(off < site->off);
        site->tile ^= (site->tile ^ t) & nearer;
        site->off = off < site->off ? off : site->off;
    }
}

/* Of a cell: what all shares have seen, in the order of the tiles. */
static void cell_join(mw_grid *grid, const mw_grid_plan *plan, uint32_t cell, uint32_t shares)
{
    mw_grid_site *site = &plan->site[cell];
    for (uint32_t i = 1; i < shares; i++) {
        const mw_grid_site *other = site + (size_t)i * mw__lattice_cells(&grid->lattice);
        site->count += other->count;
        if (!(other->off < site->off)) continue;
        site->tile = other->tile;
        site->off = other->off;
    }
    grid->tile[cell] = site->tile;
}

typedef struct grid_looking {
    mw_grid *grid;
    const mw_grid_plan *plan;
    uint32_t shares;
} grid_looking;

static void share_look(void *work, uint64_t share, uint32_t member)
{
    const grid_looking *l = work;
    (void)member;
    shares_look(l->grid, l->plan, (uint32_t)share, l->shares);
}

static void cells_join(void *work, uint64_t from, uint64_t to)
{
    const grid_looking *l = work;
    for (uint32_t c = (uint32_t)from; c < to; c++) cell_join(l->grid, l->plan, c, l->shares);
}

static bool cell_has(const mw_grid_plan *plan, uint32_t cell, uint32_t tiles)
{
    return plan->site[cell].count >= tiles / plan->stride;
}

static bool cell_is_gap(const mw_grid_plan *plan, uint32_t cell)
{
    return !(plan->site[cell].off < INFINITY);
}

static void plan_choose(mw_grid_plan *plan, uint32_t cells)
{
    uint32_t taken = 0, seen = 0, crowd = 0;
    for (uint32_t c = 0; c < cells; c++) {
        uint32_t count = plan->site[c].count;
        taken += !cell_is_gap(plan, c);
        seen += count;
        crowd += cell_has(plan, c, CROWD) ? count : 0;
    }
    plan->taken = taken;
    plan->crowded = crowd > seen / SHARE;
}

/* Look at the tiles that are in the cells of a lattice. */
static bool grid_look(mw_grid *grid, mw_grid_plan *plan)
{
    uint32_t count = mw__lattice_cells(&grid->lattice);
    uint32_t shares = mw__job_team(plan->job, plan->tiling->tri_count / WORTHWHILE + 1);
    if (shares > MOST_SHARES) shares = MOST_SHARES;
    grid->tile = mw__alloc_lines(count, sizeof *grid->tile);
    plan->site = mw__alloc_lines((size_t)shares * count, sizeof *plan->site);
    grid_looking looking = {grid, plan, shares};
    bool done = grid->tile && plan->site &&
                mw__job_chunks(plan->job, shares, shares, share_look, &looking) &&
                mw__job_ranges(plan->job, count, cells_join, &looking);
    if (!done) free(plan->site);
    return done;
}

bool mw__grid_begin(mw_grid *grid, mw_grid_plan *plan, const double low[2], const double high[2],
                    uint32_t cells)
{
    if (cells == 0) cells = mw__lattice_choose(plan->tiling);
    mw__job_stage(plan->job, "laying a grid", 0.4);
    grid->lattice = mw__lattice_of(plan->tiling, low, high, cells, plan->job);
    if (!grid_look(grid, plan)) return false;
    plan_choose(plan, mw__lattice_cells(&grid->lattice));
    return true;
}

/* A cell beside this one that has a tile in it, or this one. */
static uint32_t cell_settled(const mw_grid *grid, const mw_grid_plan *plan, uint32_t x, uint32_t y)
{
    uint32_t columns = grid->lattice.columns, cell = y * columns + x;
    if (x > 0 && !cell_is_gap(plan, cell - 1)) return cell - 1;
    if (x + 1 < columns && !cell_is_gap(plan, cell + 1)) return cell + 1;
    if (y > 0 && !cell_is_gap(plan, cell - columns)) return cell - columns;
    if (y + 1 < grid->lattice.rows && !cell_is_gap(plan, cell + columns)) return cell + columns;
    return cell;
}

static bool cell_is_outermost(const mw_lattice *lattice, uint32_t x, uint32_t y)
{
    return x == 0 || y == 0 || x + 1 == lattice->columns || y + 1 == lattice->rows;
}

/* Does tile t have p? In plain doubles. */
static MW_INLINE bool tile_has_point(const mw_tiling *tiling, uint32_t t, mw_point p)
{
    const uint32_t *v = tiling->tri[t].v;
    const mw_point a = tiling->point[v[0]], b = tiling->point[v[1]], c = tiling->point[v[2]];
    const double ab = mw__orient2d_double(a, b, p), bc = mw__orient2d_double(b, c, p),
                 ca = mw__orient2d_double(c, a, p);
    const double one = ab < bc ? ab : bc, least = one < ca ? one : ca;
    return least > 0;
}

/* Give an empty cell the tile at its middle: walk there from tile t, or as far as the fuel goes. If
 * the walk leaves the hull and a neighbouring cell has tiles, take one of these: the hull may cross
 * the cell, and walks into the mesh from a long tile along the hull are long. */
static void cell_fill_gap(mw_grid *grid, const mw_grid_plan *plan, uint32_t x, uint32_t y,
                          uint32_t t, uint32_t fuel)
{
    uint32_t cell = y * grid->lattice.columns + x, beside = cell;
    mw_point middle = mw__lattice_middle(&grid->lattice, x, y);
    if (tile_has_point(plan->tiling, t, middle)) {
        grid->tile[cell] = t;
        return;
    }
    mw_walk walk = mw__walk_begin(plan->tiling, middle, t, fuel, 0, NULL);
    bool left = isfinite(middle.x) && isfinite(middle.y) &&
                mw__remembering.run[true][false](&walk) == MW_VERDICT_LEFT;
    if (left && !cell_is_outermost(&grid->lattice, x, y)) beside = cell_settled(grid, plan, x, y);
    grid->tile[cell] = beside != cell ? grid->tile[beside] : walk.t;
}

enum {
    BAND = 32,    /* lines of cells whose gaps one thread fills   */
    FUEL = 256,   /* for a walk from the cell beside              */
    FAR = 1 << 12 /* for the first one of a band                 */
};

/* A tile of the cell to the left or below. A cell that was empty, too, is preferred, since tiles
 * are large there. Cells below the band that begins at line `first` are not asked, so that the
 * order in which bands are filled does not matter. MW_NONE: there is no such cell. */
static uint32_t cell_tile_beside(const mw_grid *grid, const mw_grid_plan *plan, uint32_t x,
                                 uint32_t y, uint32_t first)
{
    uint32_t columns = grid->lattice.columns, cell = y * columns + x;
    bool left = x > 1, below = y > first || (y > 1 && !cell_is_gap(plan, cell - columns));
    if (left && (cell_is_gap(plan, cell - 1) || !below || !cell_is_gap(plan, cell - columns)))
        return grid->tile[cell - 1];
    return below ? grid->tile[cell - columns] : MW_NONE;
}

/* A tile of the next cell that has one, or of the first. */
static uint32_t tile_after(const mw_grid *grid, const mw_grid_plan *plan, uint32_t cell)
{
    uint32_t cells = mw__lattice_cells(&grid->lattice), c = cell;
    while (c < cells && cell_is_gap(plan, c)) c++;
    for (c = c < cells ? c : 0; c < cell && cell_is_gap(plan, c);) c++;
    return cell_is_gap(plan, c) ? 0 : grid->tile[c];
}

typedef struct grid_filling {
    mw_grid *grid;
    const mw_grid_plan *plan;
} grid_filling;

/* The cells within the outermost ones. */
static void grid_fill_band(void *work, uint64_t band, uint32_t member)
{
    const grid_filling *filling = work;
    mw_grid *grid = filling->grid;
    const mw_grid_plan *plan = filling->plan;
    uint32_t first = 1 + (uint32_t)band * BAND;
    (void)member;
    uint32_t columns = grid->lattice.columns, rows = grid->lattice.rows;
    for (uint32_t y = first; y < first + BAND && y + 1 < rows; y++)
        for (uint32_t x = 1; x + 1 < columns; x++) {
            if (!cell_is_gap(plan, y * columns + x)) continue;
            uint32_t t = cell_tile_beside(grid, plan, x, y, first);
            bool near = t != MW_NONE;
            cell_fill_gap(grid, plan, x, y, near ? t : tile_after(grid, plan, y * columns + x),
                          near ? FUEL : FAR);
        }
}

static uint32_t line_inwards(uint32_t line, uint32_t lines)
{
    if (line == 0) return lines > 2 ? 1 : 0;
    return line + 1 == lines && line > 1 ? line - 1 : line;
}

/* The outermost cells come last, each from the one further in: tiles along the hull are long, so
 * that near the one of the last cell there may be none of the next. */
static bool grid_fill_gaps(mw_grid *grid, const mw_grid_plan *plan)
{
    uint32_t columns = grid->lattice.columns, rows = grid->lattice.rows,
             bands = rows > 2 ? (rows - 3) / BAND + 1 : 0;
    uint32_t team = mw__job_team(plan->job, plan->tiling->tri_count / WORTHWHILE + 1);
    grid_filling filling = {grid, plan};
    if (!mw__job_chunks(plan->job, team < bands ? team : bands, bands, grid_fill_band, &filling))
        return false;
    for (uint32_t y = 0; y < rows; y++)
        for (uint32_t x = 0; x < columns; x++) {
            if (!cell_is_outermost(&grid->lattice, x, y) || !cell_is_gap(plan, y * columns + x))
                continue;
            uint32_t t = grid->tile[line_inwards(y, rows) * columns + line_inwards(x, columns)];
            cell_fill_gap(grid, plan, x, y, t == MW_NONE ? 0 : t, FUEL);
        }
    return true;
}

bool mw__grid_end(mw_grid *grid, mw_grid_plan *plan, bool sparse)
{
    mw__job_stage(plan->job, "filling a grid", 0.4);
    bool done = grid_fill_gaps(grid, plan);
    for (uint32_t c = 0, cells = mw__lattice_cells(&grid->lattice); c < cells && done; c++)
        grid->tile[c] = sparse && cell_has(plan, c, CROWDED)
                            ? MW_NONE
                            : mw__tile_name(plan->tiling, grid->tile[c]);
    free(plan->site);
    return done;
}

void mw__grid_refine(mw_grid *grid, const mw_tiling *tiling, uint32_t stride, mw_job *job)
{
    mw_grid fine = {.lattice = mw__lattice_finer(&grid->lattice)};
    mw_grid_plan plan = {.tiling = tiling, .stride = stride, .job = job};
    if (!mw__lattice_is_finite(&fine.lattice)) return;
    if (!grid_look(&fine, &plan)) {
        mw__grid_release(&fine);
        return;
    }
    for (uint32_t y = 0, cell = 0; y < fine.lattice.rows; y++) {
        const uint32_t *coarse = grid->tile + (size_t)(y / 2) * grid->lattice.columns;
        for (uint32_t x = 0; x < fine.lattice.columns; x++, cell++)
            fine.tile[cell] =
                cell_is_gap(&plan, cell) ? coarse[x / 2] : mw__tile_name(tiling, fine.tile[cell]);
    }
    free(plan.site);
    mw__grid_release(grid);
    *grid = fine;
}

bool mw__grid_create(mw_grid *grid, const mw_tiling *tiling, const double low[2],
                     const double high[2], uint32_t cells, mw_job *job)
{
    mw_grid_plan plan = {.tiling = tiling, .stride = 1, .job = job};
    return mw__grid_begin(grid, &plan, low, high, cells) && mw__grid_end(grid, &plan, false);
}

bool mw__grid_keep_corners(mw_grid *grid, const mw_tiling *tiling)
{
    const uint32_t cells = mw__lattice_cells(&grid->lattice);
    grid->corner = mw__alloc(cells, sizeof *grid->corner);
    for (uint32_t c = 0; c < cells && grid->corner; c++)
        for (uint32_t k = 0; k < 3; k++) grid->corner[c][k] = tiling->tri[grid->tile[c]].v[k];
    return grid->corner;
}

void mw__grid_release(mw_grid *grid)
{
    free(grid->corner);
    free(grid->tile);
}

size_t mw__grid_bytes(const mw_grid *grid)
{
    return mw__lattice_cells(&grid->lattice) *
           (sizeof *grid->tile + (grid->corner ? sizeof *grid->corner : 0));
}
