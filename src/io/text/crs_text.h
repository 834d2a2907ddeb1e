/* crs_text.h - coordinate systems as the texts that name them: WKT, or "EPSG:2056". Private. */
#ifndef MW_SRC_IO_TEXT_CRS_TEXT_H
#define MW_SRC_IO_TEXT_CRS_TEXT_H

#include "base/base.h"

/* Longest text that is taken. */
#define MW_CRS_LIMIT ((size_t)1 << 16)

/* Copy a text that names a coordinate system as one line: every gap becomes a blank. *crs is
 * released by the caller with free(); NULL if the text is empty, too long, or holds control
 * characters. */
mw_status mw__crs_copy(const char *bytes, size_t size, char **crs, mw_error *error);

#endif
