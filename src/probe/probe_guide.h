/* probe_guide.h - a coarse grid that leads walks to a first triangle. Private. */
#ifndef MW_SRC_PROBE_PROBE_GUIDE_H
#define MW_SRC_PROBE_PROBE_GUIDE_H

#include "base/job.h"
#include "surface/surface.h"

/* A grid over the box of the surface, of about as many cells as half of its triangles. It is a
 * guide only: it stays as it was made while the surface changes. */
typedef struct mw_probe_guide {
    uint32_t *cell; /* a triangle near each cell; NULL: there is no guide */
    uint32_t side;  /* cells along each axis */
    double low[3];
    double per_cell[3]; /* cells a unit of length, along each axis */
    double near2;       /* the square of the longest edge of a cell */
} mw_probe_guide;

/* A stage of the present part of the job. Returns false when out of memory, or cancelled. */
bool mw__probe_guide_create(mw_probe_guide *guide, const mw_surface *surface, mw_job *job);
void mw__probe_guide_release(mw_probe_guide *guide);
size_t mw__probe_guide_bytes(const mw_probe_guide *guide);

/* The triangle of the cell nearest to q, which is finite. It may be gone by now. */
uint32_t mw__probe_guide_triangle(const mw_probe_guide *guide, const double q[3]);

#endif
