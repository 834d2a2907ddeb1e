/* Any bytes as packed data: the page's own inflater makes of them what zlib makes, and refuses what
 * zlib refuses. Of data that are sound, it says that they are too short if their end is missing. */
#include <zlib.h>

#include "unpack_both.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { DEFLATE, ZLIB, GZIP, KINDS };

static void require(bool right)
{
    if (!right) abort();
}

static void page_unpack(unpacked *u, int kind, const uint8_t *data, size_t size, size_t room)
{
    if (kind == GZIP)
        page_unpack_file(u, data, size, room);
    else
        page_unpack_stream(u, data, size, kind == ZLIB ? MAX_WBITS : -MAX_WBITS, room);
}

static void zlib_unpack(unpacked *u, int kind, const uint8_t *data, size_t size, size_t room)
{
    if (kind == GZIP)
        unpack_file(u, data, size, room);
    else
        unpack_stream(u, data, size, kind == ZLIB ? MAX_WBITS : -MAX_WBITS, room);
}

/* The first byte chooses the kind of the data, the second one how much is made at a time. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static unpacked page, zlib;
    if (size < 2) return 0;
    int kind = data[0] % KINDS;
    size_t room = 1 + 61u * data[1];
    data += 2;
    size -= 2;
    zlib_unpack(&zlib, kind, data, size, room);
    page_unpack(&page, kind, data, size, room);
    if (page.end == UNPACK_DAMAGED && zlib.end == UNPACK_SHORT) return 0; /* it knows sooner */
    require(page.end == zlib.end);
    if (zlib.end == UNPACK_DAMAGED) return 0;
    if (kind == GZIP && zlib.end == UNPACK_SHORT) return 0; /* zlib gives a part of what there is */
    require(page.size == zlib.size && memcmp(page.bytes, zlib.bytes, zlib.size) == 0);
    if (zlib.end != UNPACK_WHOLE) return 0;
    require(page.used == zlib.used);
    if (kind == GZIP || zlib.used == 0) return 0;
    page_unpack(&page, kind, data, zlib.used - 1 - (room + size) % zlib.used, room);
    require(page.end == UNPACK_SHORT);
    return 0;
}
