/* hole_numbers.h - which hole each ghost lies in after an edit. Private. */
#ifndef MW_SRC_DYNAMIC_MOVE_HOLE_NUMBERS_H
#define MW_SRC_DYNAMIC_MOVE_HOLE_NUMBERS_H

#include "dynamic/dynamic_tiling.h"

/* Give the ghosts of the edit under way, and those connected to them, the numbers of the holes that
 * they lie in now. There must be as many holes as before. False when out of memory. */
bool mw__hole_numbers_update(mw_dynamic_tiling *dynamic);

#endif
