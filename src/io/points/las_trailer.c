#include "io/points/las_trailer.h"

#include "base/posix.h"
#include "io/text/byte_order.h"
#include "io/text/crs_text.h"
#include "io/text/descriptor.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { EVLR_HEADER = 60, MOST_RECORDS = 1000, WKT_RECORD = 2112 };

/* zlib's positions may be no more than this. */
#define MOST_OFFSET (UINT64_MAX >> 1)

static bool trailer_read(gzFile file, uint64_t at, void *bytes, size_t size)
{
    return at <= MOST_OFFSET - size && gzseek(file, (z_off_t)at, SEEK_SET) == (z_off_t)at &&
           gzread(file, bytes, (unsigned)size) == (int)size;
}

/* Where the text of the record with WKT stands. Its size is 0 if there is none. */
static size_t trailer_find(gzFile file, const mw_las_trailer *trailer, uint64_t *at)
{
    unsigned char head[EVLR_HEADER];
    *at = trailer->begin;
    for (uint32_t i = 0; i < trailer->count && i < MOST_RECORDS; i++) {
        if (!trailer_read(file, *at, head, sizeof head)) return 0;
        uint64_t length = mw__get_u64(head + 20);
        bool projection =
            memcmp(head + 2, "LASF_Projection", 16) == 0 || memcmp(head + 2, "liblas", 7) == 0;
        *at += EVLR_HEADER;
        if (projection && mw__get_u16(head + 18) == WKT_RECORD)
            return length <= MW_CRS_LIMIT ? (size_t)length : 0;
        if (length > MOST_OFFSET - *at) return 0;
        *at += length;
    }
    return 0;
}

static mw_status trailer_take(gzFile file, const mw_las_trailer *trailer, char **wkt,
                              mw_error *error)
{
    uint64_t at;
    size_t size = trailer_find(file, trailer, &at);
    if (size == 0) return MW_OK;
    char *bytes = mw__alloc(size, 1);
    if (!bytes) return mw__fail_memory(error);
    mw_status status =
        trailer_read(file, at, bytes, size) ? mw__crs_copy(bytes, size, wkt, error) : MW_OK;
    free(bytes);
    return status;
}

mw_status mw__las_trailer_wkt(const char *path, mw_las_trailer trailer, char **wkt, mw_error *error)
{
    *wkt = NULL;
    int fd = mw__descriptor_open(path, O_RDONLY, 0);
    if (fd < 0) return MW_OK;
    gzFile file = gzdopen(fd, "rb");
    if (!file) {
        close(fd);
        return mw__fail_memory(error);
    }
    mw_status status = trailer_take(file, &trailer, wkt, error);
    gzclose(file);
    return status;
}
