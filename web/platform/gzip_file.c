/* gzip_file.c - reads gzip files [RFC 1952], one member after another, and hands other files
 * through. A browser's files are in memory anyway, so a packed one is read as a whole; one of 2 GiB
 * and more from a pipe, or of 4 GiB, is out of memory for it. */
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

enum { HEAD = 10, HAS_SUM = 2, HAS_EXTRA = 4, HAS_NAME = 8, HAS_COMMENT = 16, RESERVED = 224 };
enum { MAGIC = 2, ROOM = 1 << 16 };

typedef struct gzFile_s {
    int descriptor, error, system_error; /* zlib's number; errno, if that is Z_ERRNO */
    bool packed, open;                   /* open: in a member */
    Bytef magic[MAGIC];                  /* the first bytes; a single one stands at the end */
    unsigned waiting; /* how many of them, at the end, a reader of a pipe has not got yet */
    Bytef *bytes;
    size_t size;
    z_off_t position; /* in what is unpacked */
    z_stream stream;
    uint32_t crc, made;
} gzip_file;

/* --- plain or packed -------------------------------------------------------------------------- */

/* Read until there is no more, or no more room: a pipe gives what it has. -1: an error. */
static ssize_t descriptor_read(int descriptor, void *bytes, size_t room)
{
    size_t size = 0;
    while (size < room) {
        ssize_t got = read(descriptor, (Bytef *)bytes + size, room - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        size += (size_t)got;
    }
    return (ssize_t)size;
}

/* The bytes from here to the end, and one more; of a pipe, some. */
static size_t descriptor_room(int descriptor)
{
    off_t here = lseek(descriptor, 0, SEEK_CUR);
    off_t end = here < 0 ? -1 : lseek(descriptor, 0, SEEK_END);
    if (here >= 0) lseek(descriptor, here, SEEK_SET);
    return end > here ? (size_t)(end - here) + MAGIC + 1 : ROOM;
}

/* Read all of a packed file. Returns what gzread() will tell if this was not possible. */
static int gzip_file_read_all(gzip_file *file)
{
    size_t room = descriptor_room(file->descriptor), size = file->waiting;
    file->bytes = malloc(room);
    if (!file->bytes) return Z_MEM_ERROR;
    memcpy(file->bytes, file->magic, size);
    for (;;) {
        ssize_t got = descriptor_read(file->descriptor, file->bytes + size, room - size);
        if (got < 0) return Z_ERRNO;
        size += (size_t)got;
        if (size < room) break;
        Bytef *larger = room > UINT_MAX / 2 ? NULL : realloc(file->bytes, 2 * room);
        if (!larger) return Z_MEM_ERROR;
        file->bytes = larger;
        room *= 2;
    }
    if (size > UINT_MAX) return Z_MEM_ERROR;
    file->size = size;
    file->stream.next_in = file->bytes;
    file->stream.avail_in = (uInt)size;
    return Z_OK;
}

gzFile gzdopen(int descriptor, const char *mode)
{
    (void)mode;
    gzip_file *file = calloc(1, sizeof *file);
    if (!file) return NULL;
    file->descriptor = descriptor;
    ssize_t got = descriptor_read(descriptor, file->magic, MAGIC);
    if (got == 1) file->magic[1] = file->magic[0];
    if (got < 0) file->error = Z_ERRNO;
    if (got > 0 && lseek(descriptor, -(off_t)got, SEEK_CUR) < 0) file->waiting = (unsigned)got;
    file->packed = got == MAGIC && file->magic[0] == 0x1f && file->magic[1] == 0x8b;
    if (file->packed) file->error = gzip_file_read_all(file);
    file->system_error = errno;
    return file;
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

static int plain_read(gzip_file *file, Bytef *bytes, unsigned count)
{
    unsigned first = file->waiting < count ? file->waiting : count;
    if (file->error == Z_ERRNO) errno = file->system_error;
    if (file->error) return -1;
    if (first > 0) memcpy(bytes, file->magic + MAGIC - file->waiting, first);
    file->waiting -= first;
    ssize_t got = descriptor_read(file->descriptor, bytes + first, count - first);
    if (got < 0) {
        file->error = Z_ERRNO;
        file->system_error = errno;
    }
    return got < 0 ? -1 : (int)((unsigned)got + first);
}

int gzread(gzFile file, void *bytes, unsigned count)
{
    if (!file->packed) return plain_read(file, bytes, count);
    if (file->error == Z_ERRNO) errno = file->system_error;
    file->stream.next_out = bytes;
    file->stream.avail_out = count;
    int result = file->error;
    while (result == Z_OK && file->stream.avail_out > 0) result = member_unpack(file);
    if (result != Z_OK && result != Z_STREAM_END) file->error = result;
    file->position += (z_off_t)(count - file->stream.avail_out);
    if (file->error && file->error != Z_BUF_ERROR) return -1;
    return (int)(count - file->stream.avail_out);
}

/* In packed files only onward, from their begin: what is passed over is unpacked, too. */
z_off_t gzseek(gzFile file, z_off_t offset, int whence)
{
    Bytef passed[4096];
    if (!file->packed) return (z_off_t)lseek(file->descriptor, offset, whence);
    while (file->position < offset) {
        z_off_t left = offset - file->position, room = sizeof passed;
        if (gzread(file, passed, (unsigned)(left < room ? left : room)) <= 0) return -1;
    }
    return file->position == offset ? offset : -1;
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
