/* lonlat_cut.h - faces in longitudes and latitudes are cut as they lie on the globe. Private. */
#ifndef MW_SRC_IO_MESH_LONLAT_CUT_H
#define MW_SRC_IO_MESH_LONLAT_CUT_H

#include "base/base.h"

/* As mw__face_cut. The longitudes of a face across 180 degrees seem to differ by more than 180; it
 * is cut as if all were on one side. If the face is not convex then, it is cut in the plane that
 * touches the globe in its middle. The longitude of a corner at a pole is ignored. */
bool mw__lonlat_cut(const double *points, const uint32_t *corners, size_t count,
                    uint32_t *triangles);

#endif
