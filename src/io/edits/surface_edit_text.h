/* surface_edit_text.h - edits of a surface as lines of text: a stream of them from a source.
 * Private. */
#ifndef MW_SRC_IO_EDITS_SURFACE_EDIT_TEXT_H
#define MW_SRC_IO_EDITS_SURFACE_EDIT_TEXT_H

#include "io/text/byte_source.h"

#include <meshwalk/io.h>

/* Make a reader of a source, which it takes over (it is closed also on failure). */
mw_status mw__surface_edit_reader_start(mw_source source, mw_surface_edit_reader **out,
                                        mw_error *error);

#endif
