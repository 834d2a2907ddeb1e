/* lattice.c - cells over an extent, the nearest one that is not empty for each that is, and how they follow edits. */
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
        lattice.scale[k] = isfinite(scale) ? scale : 0; /* no width, or too little: all in the line in the middle */
        lattice.half[k] = lines / 2.0;
    }
    return lattice;
}

/* From the cells that have an entry outwards, ring by ring: each cell is reached first from one at the least distance in
 * rings, which is where a spiral search round it would end. */
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

void mw__lattice_offer(const mw_lattice *lattice, uint32_t *entry, const mw_tiling *tiling, uint32_t t,
                       uint64_t changed)
{
    float off;
    uint32_t cell = mw__lattice_cell_off(lattice, mw__tile_middle(tiling, t), &off);
    if (!(changed & mw__name_bit(entry[cell]))) return;
    uint32_t rival = mw__tile_named(tiling, entry[cell]);
    mw_point middle = mw__tile_middle(tiling, rival);
    float rivals = mw__lattice_off(lattice, cell % lattice->columns, cell / lattice->columns, middle);
    if (rival == t || off < rivals) entry[cell] = mw__tile_name(tiling, t);
}
