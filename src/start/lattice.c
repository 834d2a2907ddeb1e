/* lattice.c - cells over an extent, and the nearest one that is not empty for each that is. */
#include "start/lattice.h"

mw_lattice mw__lattice(const double low[2], const double high[2], uint32_t cells)
{
    /* halves, so that an extent of the whole range of doubles does not overflow */
    double half[2] = {high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2};
    double columns = sqrt(cells * (half[0] / half[1]));
    mw_lattice lattice = {.columns = columns > 1 ? columns < cells ? (uint32_t)columns : cells : 1};
    lattice.rows = cells / lattice.columns;
    if (half[1] == 0) lattice.rows = 1;
    for (int k = 0; k < 2; k++) {
        uint32_t lines = k == 0 ? lattice.columns : lattice.rows;
        double scale = lines / 2.0 / half[k];
        lattice.middle[k] = low[k] / 2 + high[k] / 2;
        /* no width, or too little: all in the line in the middle */
        lattice.along[k][k] = isfinite(scale) ? scale : 0;
        lattice.half[k] = lines / 2.0;
    }
    return lattice;
}

mw_point mw__lattice_middle(const mw_lattice *lattice, uint32_t column, uint32_t row)
{
    const double *a = lattice->along[0], *b = lattice->along[1];
    double u = column + 0.5 - lattice->half[0], v = row + 0.5 - lattice->half[1];
    double x = a[0] != 0 ? u / a[0] : 0, y = b[1] != 0 ? v / b[1] : 0;
    if (a[1] != 0 || b[0] != 0) { /* the axes are at right angles */
        double aa = a[0] * a[0] + a[1] * a[1], bb = b[0] * b[0] + b[1] * b[1];
        x = u * a[0] / aa + v * b[0] / bb;
        y = u * a[1] / aa + v * b[1] / bb;
    }
    return (mw_point){lattice->middle[0] + x, lattice->middle[1] + y};
}

/* --- cells in the shape of the tiles --- */

/* Add the tensor of a tile's edges, the sum of e e^T, to xx, xy, yy. It is divided by its trace and
 * multiplied by the tile's area, so that each part of the mesh counts by its area. Edges are
 * multiplied by `unit`, so that no square over- or underflows. */
static void tile_add_shape(const mw_tiling *tiling, uint32_t t, double unit, double shape[3])
{
    const mw_point *p = tiling->point;
    const uint32_t *v = tiling->tri[t].v;
    double xx = 0, xy = 0, yy = 0, ax = 0, ay = 0, area = 0;
    for (int k = 0; k < 3; k++) {
        double x = (p[v[k + 1]].x - p[v[k]].x) * unit, y = (p[v[k + 1]].y - p[v[k]].y) * unit;
        if (k == 0) ax = x, ay = y;
        if (k == 1) area = ax * y - ay * x;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    double weight = area / (xx + yy);
    if (!(weight > 0 && weight < INFINITY)) return;
    shape[0] += xx * weight;
    shape[1] += xy * weight;
    shape[2] += yy * weight;
}

/* The direction in which tiles are long, and how many times longer than across. Looks at a few. */
static double tiles_shape(const mw_tiling *tiling, double unit, double direction[2])
{
    enum { PROBES = 1024 };
    double shape[3] = {0};
    for (uint32_t i = 0; i < PROBES && i < tiling->tri_count; i++)
        tile_add_shape(tiling,
                       (uint32_t)((uint64_t)i * tiling->tri_count / PROBES % tiling->tri_count),
                       unit, shape);
    /* beyond the doubles */
    if (!(shape[0] + shape[2] > 0 && shape[0] + shape[2] < INFINITY)) return 1;
    double half = (shape[0] - shape[2]) / 2, root = hypot(half, shape[1]),
           sum = shape[0] + shape[2];
    double angle = atan2(shape[1], half) / 2;
    direction[0] = cos(angle);
    direction[1] = sin(angle);
    /* by the product of both */
    double least = (shape[0] * shape[2] - shape[1] * shape[1]) / (sum / 2 + root);
    return least > 0 ? sqrt((sum / 2 + root) / least) : INFINITY;
}

/* The power of two that makes an extent about 1. */
static double unit_within(const double low[2], const double high[2])
{
    double width = fmax(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);
    return width > 0x1p-1000 ? ldexp(1, -ilogb(width)) : 0x1p1000;
}

static mw_lattice lattice_shape(const mw_tiling *tiling, const double low[2], const double high[2],
                                uint32_t cells, mw_job *job)
{
    /* tiles that are less long than the first are common */
    static const double common = 4, most = 0x1p20;
    mw_lattice lattice = mw__lattice(low, high, cells);
    double d[2], aspect = fmin(tiles_shape(tiling, unit_within(low, high), d), most);
    if (!(aspect > common)) return lattice;
    const double axis[2][2] = {{-d[1] * aspect, d[0] * aspect}, {d[0], d[1]}};
    double least[2], greatest[2];
    mw__tiling_extent(tiling, lattice.middle, axis, job, least, greatest);
    for (int k = 0; k < 2; k++)
        if (!(greatest[k] - least[k] > 0 && greatest[k] - least[k] < INFINITY)) return lattice;
    mw_lattice slanted = mw__lattice(least, greatest, cells);
    double u = slanted.middle[0] / (aspect * aspect), v = slanted.middle[1];
    slanted.middle[0] = lattice.middle[0] + u * axis[0][0] + v * axis[1][0];
    slanted.middle[1] = lattice.middle[1] + u * axis[0][1] + v * axis[1][1];
    for (int k = 0; k < 2; k++) {
        double scale = slanted.along[k][k];
        slanted.along[k][0] = scale * axis[k][0];
        slanted.along[k][1] = scale * axis[k][1];
        if (!isfinite(scale * axis[k][0]) || !isfinite(scale * axis[k][1])) return lattice;
    }
    return slanted;
}

/* A line of cells beyond each side of the extent, unless there are few. */
mw_lattice mw__lattice_of(const mw_tiling *tiling, const double low[2], const double high[2],
                          uint32_t cells, mw_job *job)
{
    enum { FEW = 8 };
    mw_lattice lattice = lattice_shape(tiling, low, high, cells, job);
    for (int k = 0; k < 2; k++) {
        uint32_t *lines = k == 0 ? &lattice.columns : &lattice.rows;
        if (*lines < FEW) continue;
        *lines += 2;
        lattice.half[k]++;
    }
    return lattice;
}

mw_lattice mw__lattice_finer(const mw_lattice *lattice)
{
    mw_lattice finer = *lattice;
    for (int k = 0; k < 2; k++) {
        finer.along[k][0] *= 2;
        finer.along[k][1] *= 2;
        finer.half[k] *= 2;
    }
    finer.columns *= 2;
    finer.rows *= 2;
    return finer;
}

bool mw__lattice_is_finite(const mw_lattice *lattice)
{
    double sum = 0;
    for (int k = 0; k < 2; k++) sum += fabs(lattice->along[k][0]) + fabs(lattice->along[k][1]);
    return isfinite(sum);
}

/* --- what cells hold --- */

/* From the cells that have an entry outwards, ring by ring: each cell is reached first from one at
 * the least distance in rings, which is where a spiral search round it would end. */
void mw__lattice_fill(const mw_lattice *lattice, uint32_t *entry, uint32_t *queue)
{
    uint32_t cells = mw__lattice_cells(lattice), columns = lattice->columns, head = 0, tail = 0;
    for (uint32_t c = 0; c < cells; c++)
        if (entry[c] != MW_NONE) queue[tail++] = c;
    while (tail < cells) {
        uint32_t c = queue[head++], x = c % columns, y = c / columns;
        uint32_t left = x > 0 ? x - 1 : 0, right = x + 1 < columns ? x + 1 : x;
        uint32_t low = y > 0 ? y - 1 : 0, high = y + 1 < lattice->rows ? y + 1 : y;
        for (uint32_t j = low; j <= high; j++)
            for (uint32_t i = left; i <= right; i++) {
                uint32_t other = j * columns + i;
                if (entry[other] != MW_NONE) continue;
                entry[other] = entry[c];
                queue[tail++] = other;
            }
    }
}
