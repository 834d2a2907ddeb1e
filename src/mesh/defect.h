/* defect.h - a growing list of defects. Private. */
#ifndef MW_SRC_MESH_DEFECT_H
#define MW_SRC_MESH_DEFECT_H

#include "base/base.h"

#include <meshwalk/mesh.h>

typedef struct mw_defects {
    mw_defect *list;
    size_t count, capacity;
} mw_defects;

/* A defect of a triangle. All other fields do not apply. */
mw_defect mw__defect(mw_defect_kind kind, uint32_t triangle);

/* Returns false when out of memory. */
bool mw__defects_add(mw_defects *defects, mw_defect defect);

/* By kind, then triangle, then the other fields. */
void mw__defects_sort(mw_defects *defects);

void mw__defects_release(mw_defects *defects);

#endif
