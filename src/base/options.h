/* options.h - the checks that every structure of options needs. Private. */
#ifndef MW_SRC_BASE_OPTIONS_H
#define MW_SRC_BASE_OPTIONS_H

#include "base/base.h"

/* MW_ERROR_ARGUMENT unless all `bytes` of the reserved member of structure `type` are zero. A later
 * version gives these bytes a meaning, so no caller may leave anything in them today. */
mw_status mw__reserved_check(const char *type, const void *reserved, size_t bytes, mw_error *error);

#define MW_RESERVED_CHECK(type, options, error)                                                    \
    mw__reserved_check(#type, (options)->reserved, sizeof((const type *)0)->reserved, error)

/* The number of cells that a grid over `triangles` triangles may have if `asked` are asked for: at
 * most 64 for each triangle, or 65,536 if that is more. More cells make no start better: they only
 * take time and memory. */
uint32_t mw__cells_bound(uint32_t asked, uint32_t triangles);

#endif
