/* surface_compact.h - renumbers an edited surface without gaps. Private. */
#ifndef MW_SRC_SURFACE_EDIT_SURFACE_COMPACT_H
#define MW_SRC_SURFACE_EDIT_SURFACE_COMPACT_H

#include "surface/edit/edited_surface.h"

/* As mw_surface_editor_compact, within an update. Afterwards the boxes of the prober fit. */
mw_status mw__surface_compact(mw_surface_editor *e, uint32_t *triangles, uint32_t *vertices,
                              mw_error *error);

#endif
