#include "io/netcdf/netcdf_source.h"

#include "io/netcdf/classic_header.h"

#include <stdlib.h>
#include <string.h>

/* Everything that a source still holds. */
static mw_status netcdf_source_contents(mw_source *source, char **contents, size_t *size,
                                        mw_error *error)
{
    size_t room = 0, used = 0, count = 1;
    *contents = NULL;
    while (count > 0) {
        const char *bytes;
        mw_status status = mw__source_peek(source, MW_BYTES_LIMIT, &bytes, &count, error);
        if (!status && used + count > room) {
            room = 2 * room + MW_BYTES_LIMIT;
            char *larger = mw__realloc(*contents, room, 1);
            if (!larger) status = mw__fail_memory(error);
            if (larger) *contents = larger;
        }
        if (status) return status;
        if (count > 0) memcpy(*contents + used, bytes, count);
        used += count;
        status = mw__source_skip(source, count, error);
        if (status) return status;
    }
    *size = used;
    return MW_OK;
}

static mw_status netcdf_source_check(const char *name, const char *contents, size_t size,
                                     mw_error *error)
{
    mw_source memory;
    mw_status status = mw__source_memory(&memory, name, contents, size, error);
    if (status) return status;
    status = mw__classic_header_check(&memory, error);
    mw__source_close(&memory);
    return status;
}

mw_status mw__netcdf_open_source(mw_source *source, mw_netcdf **out, void **memory, mw_error *error)
{
    *out = NULL;
    *memory = NULL;
    if (mw__source_is_plain_file(source)) {
        mw_status checked = mw__classic_header_check(source, error);
        return checked ? checked : mw__netcdf_open(source->path, out, error);
    }
    char *contents;
    size_t size;
    source->binary = true;
    mw_status status = netcdf_source_contents(source, &contents, &size, error);
    if (!status) status = netcdf_source_check(mw__source_name(source), contents, size, error);
    if (!status)
        status = mw__netcdf_open_memory(mw__source_name(source), contents, size, out, error);
    if (status) {
        free(contents);
        return status;
    }
    *memory = contents;
    return MW_OK;
}

mw_status mw__netcdf_open_path(const char *path, mw_netcdf **out, void **memory, mw_error *error)
{
    enum { HEAD = 8 };
    mw_source source;
    const char *head;
    size_t size;
    *out = NULL;
    *memory = NULL;
    mw_status status = mw__source_open(&source, path, error);
    if (status) return status;
    status = mw__source_peek(&source, HEAD, &head, &size, error);
    if (!status && !mw__netcdf_begins(head, size))
        status = mw__fail(error, MW_ERROR_INPUT, "%.240s: this is not a netCDF file", path);
    if (!status) status = mw__netcdf_open_source(&source, out, memory, error);
    mw__source_close(&source);
    return status;
}
