/* star_index.h - the index of a start: plain numbers of facets, 4 bytes a cell. Private. */
#ifndef MW_SRC_STAR_STAR_INDEX_H
#define MW_SRC_STAR_STAR_INDEX_H

#include "star/star.h"

#define MW_STAR_MAX_CELLS (UINT32_C(1) << 30)

/* Rows of equal height in polar angle, each with cells of equal width in longitude. */
typedef struct mw_star_grid {
    uint32_t rows;
    uint32_t *first; /* first cell of each row, and the number of cells at the end */
    uint32_t *facet; /* of each cell: the facet that the ray through its middle meets */
} mw_star_grid;

/* Wu's subdivided octahedron. */
typedef struct mw_star_octahedron {
    uint32_t levels; /* subdivisions */
    uint32_t *facet; /* of each finest triangle: the facet that the ray through its middle meets */
} mw_star_octahedron;

struct mw_star_index {
    mw_star_start_kind start; /* tells which member of the union is valid */
    double seconds;           /* time to build it */
    union {
        mw_star_grid grid;
        mw_star_octahedron octahedron;
    };
};

/* The start that an index belongs to. */
mw_star_start_kind mw__star_index_start(const mw_star_index *index);

/* Make a grid of about `cells` cells, 1 to MW_STAR_MAX_CELLS. Steps of the present stage. Returns
 * false when out of memory, or cancelled. */
bool mw__star_grid_create(mw_star_grid *grid, const mw_star *star, uint32_t cells, bool uniform,
                          mw_job *job);
void mw__star_grid_release(mw_star_grid *grid);
uint32_t mw__star_grid_cell(const mw_star_grid *grid, double phi, double theta);

/* Make an octahedron with `levels` subdivisions, 0 to MW_STAR_MAX_LEVELS. Steps of the present
 * stage. Returns false when out of memory, or cancelled. */
bool mw__star_octahedron_create(mw_star_octahedron *octahedron, const mw_star *star,
                                uint32_t levels, mw_job *job);
void mw__star_octahedron_release(mw_star_octahedron *octahedron);
/* The finest triangle that the ray along d meets. Counts triangles and tests in *work, unless that
 * is NULL. */
uint32_t mw__star_octahedron_cell(const mw_star_octahedron *octahedron, const double d[3],
                                  mw_star_work *work);

static MW_INLINE uint32_t mw__star_octahedron_cells(uint32_t levels)
{
    return UINT32_C(8) << (2 * levels);
}

#endif
