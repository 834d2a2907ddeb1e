/* polygons_label.h - the set of polygons that covers each triangle. Private. */
#ifndef MW_SRC_POLYGONS_POLYGONS_LABEL_H
#define MW_SRC_POLYGONS_POLYGONS_LABEL_H

#include "base/job.h"
#include "polygons/polygons.h"

/* Fill p->set and p->sets. The other members are complete, except for the mesh: its triangles and
 * points are given, and fill a convex hull. Steps of the present stage. False when out of memory,
 * or cancelled. */
bool mw__polygons_label(mw_polygons *p, const mw_triangle *tri, uint32_t tri_count,
                        const mw_point *point, mw_job *job);

#endif
