/* unpack_both.h - the body of unpack.h: include it after a zlib.h. */
#include "unpack.h"

static inline void unpack_stream(unpacked *u, const uint8_t *data, size_t size, int window_bits,
                                 size_t room)
{
    z_stream s;
    int result = Z_OK;
    memset(&s, 0, sizeof s);
    s.next_in = (Bytef *)(uintptr_t)data;
    s.avail_in = (uInt)size;
    u->size = 0;
    if (inflateInit2(&s, window_bits) != Z_OK) abort();
    while (result == Z_OK && u->size < UNPACK_LIMIT) {
        size_t left = UNPACK_LIMIT - u->size;
        uInt part = (uInt)(room < left ? room : left);
        s.next_out = u->bytes + u->size;
        s.avail_out = part;
        result = inflate(&s, Z_NO_FLUSH);
        u->size += part - s.avail_out;
    }
    u->used = size - s.avail_in;
    u->end = result == Z_STREAM_END  ? UNPACK_WHOLE
             : result == Z_OK        ? UNPACK_MORE
             : result == Z_BUF_ERROR ? UNPACK_SHORT
                                     : UNPACK_DAMAGED;
    inflateEnd(&s);
}

/* A descriptor from which the bytes can be read. */
static inline int unpack_descriptor(const uint8_t *data, size_t size)
{
    int descriptor = memfd_create("input", 0);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) abort();
    lseek(descriptor, 0, SEEK_SET);
    return descriptor;
}

static inline void unpack_file(unpacked *u, const uint8_t *data, size_t size, size_t room)
{
    gzFile file = gzdopen(unpack_descriptor(data, size), "rb");
    int got = 1, error = Z_OK;
    if (!file) abort();
    u->size = u->used = 0;
    while (got > 0 && error == Z_OK && u->size < UNPACK_LIMIT) {
        size_t left = UNPACK_LIMIT - u->size;
        got = gzread(file, u->bytes + u->size, (unsigned)(room < left ? room : left));
        if (got > 0) u->size += (size_t)got;
        gzerror(file, &error);
    }
    u->end = error == Z_BUF_ERROR                          ? UNPACK_SHORT
             : got < 0 || (error && error != Z_STREAM_END) ? UNPACK_DAMAGED
             : got == 0                                    ? UNPACK_WHOLE
                                                           : UNPACK_MORE;
    gzclose(file);
}
