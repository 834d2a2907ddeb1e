/* page_inflater.c - the page's own inflater, compiled for this machine beside zlib: all its names
 * are changed, and zlib's header stays out. */
#define ZLIB_H
#define adler32 page_adler32
#define crc32 page_crc32
#define inflate page_inflate
#define inflateEnd page_inflate_end
#define inflateInit2 page_inflate_init
#define gzbuffer page_gzbuffer
#define gzclose page_gzclose
#define gzdirect page_gzdirect
#define gzdopen page_gzdopen
#define gzerror page_gzerror
#define gzoffset page_gzoffset
#define gzread page_gzread
#define gzseek page_gzseek

#include "web/platform/zlib.h"

#include "web/platform/gzip_file.c"
#include "web/platform/inflate.c"
#include "unpack_both.h"

void page_unpack_stream(unpacked *u, const uint8_t *data, size_t size, int window_bits, size_t room)
{
    unpack_stream(u, data, size, window_bits, room);
}

void page_unpack_file(unpacked *u, const uint8_t *data, size_t size, size_t room)
{
    unpack_file(u, data, size, room);
}
