/* region.h - connected regions of the plane that a mesh does not cover exactly once: pockets, holes, overlaps.
 * Private. */
#ifndef MW_SRC_REGION_H
#define MW_SRC_REGION_H

#include "domain/cover.h"

typedef struct mw_region {
    int32_t degree;  /* triangles over it                                                                      */
    bool open;       /* reaches the outside of the hull                                                        */
    uint32_t hole;   /* degree 0: its number, or MW_POCKET                                                     */
    uint32_t lowest; /* the first outline edge beside it by the user's numbers: its inner side for an overlap (no
                        fold), else its outer side; MW_NONE if there is none                                   */
    uint64_t rank;   /* of that edge                                                                           */
} mw_region;

typedef struct mw_regions {
    uint32_t *of; /* per cell: its region, MW_NONE where one triangle covers it */
    mw_region *list;
    uint32_t count, hole_count;
} mw_regions;

/* The regions of a cover. Holes are numbered in order of the lowest triangle beside them. Returns false when out of
 * memory; release in either case. */
bool mw__regions_create(mw_regions *regions, const mw_cover *cover);
void mw__regions_release(mw_regions *regions);

#endif
