/* open_create.h - the loops and pieces of an open tiling are found. Private. */
#ifndef MW_SRC_OPEN_CREATE_H
#define MW_SRC_OPEN_CREATE_H

#include "domain/tiling.h"

/* Everything from the border (count > 0; sorted on the way), when the tiles have their final order. Returns false when out of memory; release
 * in either case (mw__open_release). */
bool mw__open_create(mw_open *open, const mw_tiling *tiling, mw_rim_edge *rim, uint32_t count);

#endif
