/* zlib.h - what the library uses of zlib's interface, for WebAssembly, where Debian has no zlib:
 * reading of packed data, by inflate.c and gzip_file.c. The names and their meaning are zlib's. */
#ifndef MW_WEB_ZLIB_H
#define MW_WEB_ZLIB_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h> /* SEEK_SET */

typedef unsigned char Bytef;
typedef unsigned int uInt;
typedef unsigned long uLong;
typedef int64_t z_off_t;

enum {
    Z_OK = 0,
    Z_STREAM_END = 1,
    Z_ERRNO = -1,
    Z_DATA_ERROR = -3,
    Z_MEM_ERROR = -4,
    Z_BUF_ERROR = -5,
    Z_NO_FLUSH = 0,
    MAX_WBITS = 15
};

uLong crc32(uLong crc, const Bytef *bytes, uInt count);
uLong adler32(uLong adler, const Bytef *bytes, uInt count);

/* All of the packed data stands at next_in when the first call of inflate() is made, and only what
 * it makes may be taken in parts. */
typedef struct z_stream {
    const Bytef *next_in;
    uInt avail_in;
    Bytef *next_out;
    uInt avail_out;
    struct inflater *state;
} z_stream;

int inflateInit2(z_stream *stream, int window_bits); /* -15: bare; 15: zlib's header and sum */
int inflate(z_stream *stream, int flush);
int inflateEnd(z_stream *stream);

/* A file that may be packed; one that is not is handed through. */
typedef struct gzFile_s *gzFile;

gzFile gzdopen(int descriptor, const char *mode);
int gzbuffer(gzFile file, unsigned size);
int gzread(gzFile file, void *bytes, unsigned count);
z_off_t gzseek(gzFile file, z_off_t offset, int whence);
z_off_t gzoffset(gzFile file);
int gzdirect(gzFile file);
const char *gzerror(gzFile file, int *number);
int gzclose(gzFile file);

#endif
