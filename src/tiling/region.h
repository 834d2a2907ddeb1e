/* region.h - connected regions of the plane that a mesh does not cover exactly once: pockets,
 * holes, overlaps. Private. */
#ifndef MW_SRC_TILING_REGION_H
#define MW_SRC_TILING_REGION_H

#include "tiling/coverage.h"

typedef struct mw_region {
    int32_t degree; /* number of triangles over it */
    bool unbounded; /* continues outside the hull */
    uint32_t hole;  /* degree 0: the number of the hole, or MW_POCKET */
    /* The first outline edge at its border by the user's numbers: of an overlap, an inner side (no
     * fold), else an outer side; MW_NONE: none. */
    uint32_t lowest;
    uint64_t rank; /* of that edge */
} mw_region;

typedef struct mw_regions {
    uint32_t *of; /* region of a cell; MW_NONE if exactly one triangle covers it */
    mw_region *list;
    uint32_t count, hole_count;
} mw_regions;

/* Find the regions of a coverage. Holes are numbered by the lowest triangles beside them. Returns
 * false when out of memory. Release in either case. */
bool mw__regions_create(mw_regions *regions, const mw_coverage *coverage);
void mw__regions_release(mw_regions *regions);

#endif
