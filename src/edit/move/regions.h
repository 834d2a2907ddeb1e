/* regions.h - which hole each ghost lies in after an edit. Private. */
#ifndef MW_SRC_EDIT_MOVE_REGIONS_H
#define MW_SRC_EDIT_MOVE_REGIONS_H

#include "edit/dynamic_tiling.h"

/* Give the ghosts of the edit under way, and those connected to them, the numbers of the holes that
 * they lie in now. There must be as many holes as before. False when out of memory. */
bool mw__regions_number(mw_dynamic_tiling *f);

#endif
