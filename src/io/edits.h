/* edits.h - a stream of edits from a source. Private. */
#ifndef MW_SRC_IO_EDITS_H
#define MW_SRC_IO_EDITS_H

#include "io/source.h"

#include <meshwalk/io.h>

/* Make a reader of a source, which it takes over (it is closed also on failure). */
mw_status mw__edits_start(mw_source source, const mw_edit_text_options *options, mw_edit_reader **out, mw_error *error);

#endif
