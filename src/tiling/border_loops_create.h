/* border_loops_create.h - finds the loops of the border and the connected components. Private. */
#ifndef MW_SRC_TILING_BORDER_LOOPS_CREATE_H
#define MW_SRC_TILING_BORDER_LOOPS_CREATE_H

#include "tiling/tiling.h"

/* Find loops and components from the border edges (count > 0; this sorts them), once the tiles have
 * their final order. Returns false when out of memory. Release in either case. */
bool mw__border_loops_create(mw_border_loops *loops, const mw_tiling *tiling, mw_loop_edge *edges,
                             uint32_t count);

#endif
