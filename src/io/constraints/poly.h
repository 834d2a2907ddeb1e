/* poly.h - constraints from Triangle's .poly. Private. */
#ifndef MW_SRC_IO_CONSTRAINTS_POLY_H
#define MW_SRC_IO_CONSTRAINTS_POLY_H

#include "io/constraints/constraint_builder.h"

/* Begins at the start of the source; what was read on failure the caller releases. */
mw_status mw__read_poly(mw_source *source, mw_constraint_builder *builder, mw_error *error);

#endif
