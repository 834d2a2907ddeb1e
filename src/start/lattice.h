/* lattice.h - columns and rows of equal cells over an extent: what the grids are made of.
 * Private. */
#ifndef MW_SRC_START_LATTICE_H
#define MW_SRC_START_LATTICE_H

#include "tiling/tiling.h"

/* Column and row of p: along[k] . (p - middle) + half[k], half[k] being half the number of columns
 * or rows. */
typedef struct mw_lattice {
    double middle[2], along[2][2], half[2];
    uint32_t columns, rows;
} mw_lattice;

/* At most `cells` (1 to MW_MAX_CELLS) about square ones over the extent low..high, which may be
 * flat. */
mw_lattice mw__lattice(const double low[2], const double high[2], uint32_t cells);

/* The same for a tiling of that extent: if tiles are long and thin in one direction, cells are,
 * too. If there are more than a few cells, a margin of further cells surrounds the extent; all
 * points outside the extent belong to the margin. Steps of the present stage. */
mw_lattice mw__lattice_of(const mw_tiling *tiling, const double low[2], const double high[2],
                          uint32_t cells, mw_job *job);

/* The same with cells half as wide and half as high. */
mw_lattice mw__lattice_finer(const mw_lattice *lattice);

/* Are its cells large enough for doubles? */
bool mw__lattice_is_finite(const mw_lattice *lattice);

/* As many as there may be tiles. */
#define MW_MAX_CELLS (UINT32_C(1) << 30)

static MW_INLINE uint32_t mw__lattice_cells(const mw_lattice *lattice)
{
    return lattice->columns * lattice->rows;
}

static MW_INLINE uint32_t mw__lattice_line(double position, uint32_t lines)
{
    /* written so that NaN goes to 0 */
    return position > 0 ? position < lines - 1 ? (uint32_t)position : lines - 1 : 0;
}

/* How far p is off the middle, in cells. Does not overflow within any extent. */
static MW_INLINE void mw__lattice_offset(const mw_lattice *lattice, mw_point p, double offset[2])
{
    double x = p.x - lattice->middle[0], y = p.y - lattice->middle[1];
    offset[0] = x * lattice->along[0][0] + y * lattice->along[0][1];
    offset[1] = x * lattice->along[1][0] + y * lattice->along[1][1];
}

/* The cell of p, row by row. Points beyond the outermost cells belong to these. */
static MW_INLINE uint32_t mw__lattice_cell(const mw_lattice *lattice, mw_point p)
{
    double at[2];
    mw__lattice_offset(lattice, p, at);
    return mw__lattice_line(at[1] + lattice->half[1], lattice->rows) * lattice->columns +
           mw__lattice_line(at[0] + lattice->half[0], lattice->columns);
}

/* Does p lie in a cell, and not beyond the outermost ones? */
static MW_INLINE bool mw__lattice_covers(const mw_lattice *lattice, mw_point p)
{
    double at[2];
    mw__lattice_offset(lattice, p, at);
    return fabs(at[0]) <= lattice->half[0] && fabs(at[1]) <= lattice->half[1];
}

/* The middle of a cell. */
mw_point mw__lattice_middle(const mw_lattice *lattice, uint32_t column, uint32_t row);

/* The cell of p, and the square of how far p is off its middle, in widths of a cell; NaN is as far
 * as can be. */
static MW_INLINE uint32_t mw__lattice_cell_off(const mw_lattice *lattice, mw_point p, float *off)
{
    double at[2];
    mw__lattice_offset(lattice, p, at);
    double x = at[0] + lattice->half[0], y = at[1] + lattice->half[1];
    uint32_t column = mw__lattice_line(x, lattice->columns),
             row = mw__lattice_line(y, lattice->rows);
    float dx = (float)(x - column) - 0.5f, dy = (float)(y - row) - 0.5f;
    *off = dx * dx + dy * dy;
    return row * lattice->columns + column;
}

/* A tile offered to a grid or a lattice by an edit (edit/upkeep.h). */
typedef struct mw_cell_entry {
    mw_point p;    /* a point in or at the tile            */
    uint32_t name; /* its name                             */
    bool anyway;   /* even if p is not near a cell's middle */
} mw_cell_entry;

/* Give the cell of e->p another tile, if that is near its middle: else what it has is likely to be
 * nearer. */
static MW_INLINE void mw__lattice_put(const mw_lattice *lattice, uint32_t *entry,
                                      const mw_cell_entry *e)
{
    const float near = 1.0f / 16; /* a quarter of a cell's width, squared */
    float off;
    uint32_t cell = mw__lattice_cell_off(lattice, e->p, &off);
    if (e->anyway || off < near) entry[cell] = e->name;
}

static MW_INLINE mw_point mw__middle(mw_point a, mw_point b, mw_point c)
{
    const double third = 1.0 / 3;
    return (mw_point){a.x * third + b.x * third + c.x * third,
                      a.y * third + b.y * third + c.y * third};
}

/* The middle of a tile, rounded. */
static MW_INLINE mw_point mw__tile_middle(const mw_tiling *tiling, uint32_t t)
{
    const uint32_t *v = tiling->tri[t].v;
    return mw__middle(tiling->point[v[0]], tiling->point[v[1]], tiling->point[v[2]]);
}

/* The spiral search from every cell at once. There is one entry for each cell, and not all are
 * MW_NONE. An entry that is MW_NONE is set to that of a cell in the first ring of cells round it
 * that has one. queue: room for as many numbers as cells. */
void mw__lattice_fill(const mw_lattice *lattice, uint32_t *entry, uint32_t *queue);

/* The default number of cells for a tiling: one for two vertices, that is, for four tiles. See
 * grid.c. */
static MW_INLINE uint32_t mw__lattice_choose(const mw_tiling *tiling)
{
    return tiling->tri_count / 4 + 1;
}

#endif
