/* lonlat_cut.h - faces in longitudes and latitudes are cut as they lie on the globe. Private. */
#ifndef MW_SRC_IO_MESH_LONLAT_CUT_H
#define MW_SRC_IO_MESH_LONLAT_CUT_H

#include "base/base.h"

/* As mw__face_cut. A face across 180 degrees, which is wider than that by its numbers, is cut as if
 * all its longitudes were on one side; one that is not convex then, on the plane that touches the
 * globe in its middle. Of a corner at a pole the longitude does not matter. */
bool mw__lonlat_cut(const double *points, const uint32_t *corners, size_t count,
                    uint32_t *triangles);

#endif
