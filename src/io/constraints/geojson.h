/* geojson.h - constraints from GeoJSON. Private. */
#ifndef MW_SRC_IO_CONSTRAINTS_GEOJSON_H
#define MW_SRC_IO_CONSTRAINTS_GEOJSON_H

#include "io/constraints/constraint_builder.h"

/* Begins at the start of the source; what was read on failure the caller releases. */
mw_status mw__read_geojson(mw_source *source, mw_constraint_builder *builder, mw_error *error);

/* Was the library built with Jansson? */
bool mw__geojson_known(void);

#endif
