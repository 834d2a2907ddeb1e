/* gzip_file.c - reads gzip files [RFC 1952], one member after another, and hands other files
 * through. A browser's files are in memory anyway, so a packed one is read as a whole. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

enum { HEAD = 10, HAS_SUM = 2, HAS_EXTRA = 4, HAS_NAME = 8, HAS_COMMENT = 16, RESERVED = 224 };

typedef struct gzFile_s {
    int descriptor, error;
    bool packed, open; /* open: in a member */
    Bytef *bytes;
    size_t size;
    z_stream stream;
    uint32_t crc, made;
} gzip_file;

/* --- plain or packed -------------------------------------------------------------------------- */

static bool gzip_file_read_all(gzip_file *file)
{
    size_t room = (size_t)lseek(file->descriptor, 0, SEEK_END);
    lseek(file->descriptor, 0, SEEK_SET);
    file->bytes = malloc(room ? room : 1);
    if (!file->bytes) return false;
    while (file->size < room) {
        ssize_t got = read(file->descriptor, file->bytes + file->size, room - file->size);
        if (got <= 0) break;
        file->size += (size_t)got;
    }
    file->stream.next_in = file->bytes;
    file->stream.avail_in = (uInt)file->size;
    return true;
}

gzFile gzdopen(int descriptor, const char *mode)
{
    Bytef magic[2] = {0};
    (void)mode;
    gzip_file *file = calloc(1, sizeof *file);
    if (!file) return NULL;
    file->descriptor = descriptor;
    file->packed = read(descriptor, magic, 2) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
    lseek(descriptor, 0, SEEK_SET);
    if (!file->packed || gzip_file_read_all(file)) return file;
    free(file);
    return NULL;
}

/* --- members ---------------------------------------------------------------------------------- */

static bool member_skip(z_stream *s, size_t count)
{
    if (s->avail_in < count) return false;
    s->next_in += count;
    s->avail_in -= (uInt)count;
    return true;
}

static bool member_skip_text(z_stream *s)
{
    const Bytef *end = memchr(s->next_in, 0, s->avail_in);
    return end && member_skip(s, (size_t)(end - s->next_in) + 1);
}

static uint32_t member_number(const Bytef *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* Z_STREAM_END: no further member; bytes that begin none are passed over, as zlib does. */
static int member_open(gzip_file *file)
{
    z_stream *s = &file->stream;
    const Bytef *head = s->next_in;
    bool first = head == file->bytes;
    if (!first && (s->avail_in < 2 || head[0] != 0x1f || head[1] != 0x8b)) return Z_STREAM_END;
    if (s->avail_in < 4) return Z_BUF_ERROR;
    if (head[2] != 8 || head[3] & RESERVED) return Z_DATA_ERROR;
    if (!member_skip(s, HEAD)) return Z_BUF_ERROR;
    if (head[3] & HAS_EXTRA &&
        (s->avail_in < 2 || !member_skip(s, s->next_in[0] + 256u * s->next_in[1] + 2)))
        return Z_BUF_ERROR;
    if (head[3] & HAS_NAME && !member_skip_text(s)) return Z_BUF_ERROR;
    if (head[3] & HAS_COMMENT && !member_skip_text(s)) return Z_BUF_ERROR;
    uint32_t sum = (uint32_t)crc32(0, head, (uInt)(s->next_in - head));
    if (head[3] & HAS_SUM && !member_skip(s, 2)) return Z_BUF_ERROR;
    if (head[3] & HAS_SUM && (s->next_in[-2] | (uint32_t)s->next_in[-1] << 8) != (sum & 0xffff))
        return Z_DATA_ERROR;
    file->crc = file->made = 0;
    file->open = true;
    return inflateInit2(s, -MAX_WBITS);
}

static int member_close(gzip_file *file)
{
    z_stream *s = &file->stream;
    const uint32_t sums[] = {file->crc, file->made};
    inflateEnd(s);
    file->open = false;
    for (int i = 0; i < 2; i++) {
        if (!member_skip(s, 4)) return Z_BUF_ERROR;
        if (member_number(s->next_in - 4) != sums[i]) return Z_DATA_ERROR;
    }
    return Z_OK;
}

/* Unpack what fits, of one member. */
static int member_unpack(gzip_file *file)
{
    z_stream *s = &file->stream;
    Bytef *begin = s->next_out;
    int result = file->open ? Z_OK : member_open(file);
    if (result) return result;
    result = inflate(s, Z_NO_FLUSH);
    uInt made = (uInt)(s->next_out - begin);
    file->crc = (uint32_t)crc32(file->crc, begin, made);
    file->made += made;
    return result == Z_STREAM_END ? member_close(file) : result;
}

/* --- zlib's interface ------------------------------------------------------------------------- */

int gzread(gzFile file, void *bytes, unsigned count)
{
    if (!file->packed) {
        ssize_t got = read(file->descriptor, bytes, count);
        if (got < 0) file->error = Z_ERRNO;
        return (int)got;
    }
    file->stream.next_out = bytes;
    file->stream.avail_out = count;
    int result = file->error;
    while (result == Z_OK && file->stream.avail_out > 0) result = member_unpack(file);
    if (result != Z_OK && result != Z_STREAM_END) file->error = result;
    if (file->error && file->error != Z_BUF_ERROR) return -1;
    return (int)(count - file->stream.avail_out);
}

/* Only in files that are not packed: what stands behind the points of packed LAS is not read. */
z_off_t gzseek(gzFile file, z_off_t offset, int whence)
{
    return file->packed ? -1 : (z_off_t)lseek(file->descriptor, offset, whence);
}

z_off_t gzoffset(gzFile file)
{
    if (!file->packed) return (z_off_t)lseek(file->descriptor, 0, SEEK_CUR);
    return (z_off_t)(file->size - file->stream.avail_in);
}

int gzbuffer(gzFile file, unsigned size)
{
    (void)file;
    (void)size;
    return 0;
}

int gzdirect(gzFile file)
{
    return !file->packed;
}

const char *gzerror(gzFile file, int *number)
{
    *number = file->error;
    return "";
}

int gzclose(gzFile file)
{
    if (file->open) inflateEnd(&file->stream);
    close(file->descriptor);
    free(file->bytes);
    free(file);
    return Z_OK;
}
