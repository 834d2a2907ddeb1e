/* options.c - the checks that every structure of options needs. */
#include "base/options.h"

mw_status mw__reserved_check(const char *type, const void *reserved, size_t bytes, mw_error *error)
{
    const unsigned char *byte = reserved;
    for (size_t i = 0; i < bytes; i++)
        if (byte[i])
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "%s.reserved is not zero: initialise the structure with = {0}", type);
    return MW_OK;
}

uint32_t mw__cells_bound(uint32_t asked, uint32_t triangles)
{
    const uint64_t each = 64, least = 65536;
    uint64_t bound = each * triangles < least ? least : each * triangles;
    return asked < bound ? asked : (uint32_t)bound;
}
