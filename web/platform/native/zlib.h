/* zlib.h - the project's own unpacking in place of zlib, in a build without zlib. Its functions
 * have names of the library's, so that a program can use zlib beside it. */
#ifndef MW_WEB_NATIVE_ZLIB_H
#define MW_WEB_NATIVE_ZLIB_H

#define adler32 mw__adler32
#define crc32 mw__crc32
#define inflate mw__inflate
#define inflateEnd mw__inflate_end
#define inflateInit2 mw__inflate_init
#define gzbuffer mw__gzip_buffer
#define gzclose mw__gzip_close
#define gzdirect mw__gzip_direct
#define gzdopen mw__gzip_open
#define gzerror mw__gzip_error
#define gzoffset mw__gzip_offset
#define gzread mw__gzip_read
#define gzseek mw__gzip_seek

#include <stdbool.h>

#include "web/platform/zlib.h"

#define compress2 mw__pack
#define compressBound mw__pack_bound

enum { Z_DEFAULT_COMPRESSION = -1 };

uLong compressBound(uLong size);
int compress2(Bytef *packed, uLong *packed_size, const Bytef *bytes, uLong size, int level);

#endif
