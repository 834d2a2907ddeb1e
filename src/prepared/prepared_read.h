/* prepared_read.h - a prepared file as any other mesh in a file. Private. */
#ifndef MW_SRC_PREPARED_PREPARED_READ_H
#define MW_SRC_PREPARED_PREPARED_READ_H

#include "io/mesh/mesh_builder.h"

/* Is this the beginning of a prepared file? */
bool mw__prepared_begins(const char *head, size_t size);

/* Read the mesh of a prepared file, which is checked, with all that is kept beside it. */
mw_status mw__read_prepared(mw_source *source, mw_mesh_builder *builder, mw_error *error);

#endif
