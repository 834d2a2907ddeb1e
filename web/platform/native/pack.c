/* pack.c - zlib's format [RFC 1950] without packing: what the program writes in a build without
 * zlib is larger, and can be read by all that reads zlib's. */
#include <string.h>
#include <zlib.h>

enum { BLOCK = 65535, BLOCK_HEAD = 5, HEAD_AND_SUM = 6 };

uLong compressBound(uLong size)
{
    return size + BLOCK_HEAD * (size / BLOCK + 1) + HEAD_AND_SUM;
}

static Bytef *pack_byte(Bytef *at, unsigned value)
{
    *at = (Bytef)value;
    return at + 1;
}

static Bytef *pack_block(Bytef *at, const Bytef *bytes, uInt count, bool last)
{
    at = pack_byte(at, last);
    for (unsigned shift = 0; shift < 16; shift += 8) at = pack_byte(at, count >> shift);
    for (unsigned shift = 0; shift < 16; shift += 8) at = pack_byte(at, ~count >> shift);
    if (count > 0) memcpy(at, bytes, count);
    return at + count;
}

int compress2(Bytef *packed, uLong *packed_size, const Bytef *bytes, uLong size, int level)
{
    (void)level;
    if (*packed_size < compressBound(size)) return Z_BUF_ERROR;
    Bytef *at = pack_byte(pack_byte(packed, 0x78), 0x01);
    uLong done = 0, sum = adler32(0, NULL, 0);
    do {
        uInt count = (uInt)(size - done < BLOCK ? size - done : BLOCK);
        at = pack_block(at, bytes + done, count, done + count == size);
        if (count > 0) sum = adler32(sum, bytes + done, count);
        done += count;
    } while (done < size);
    for (unsigned shift = 32; shift > 0; shift -= 8)
        at = pack_byte(at, (unsigned)(sum >> (shift - 8)));
    *packed_size = (uLong)(at - packed);
    return Z_OK;
}
