/* One block of the input in a buffer that is refilled from zlib (which hands plain files
 * through) or from memory. */
#include "io/text/byte_source.h"
#include "base/posix.h"
#include "io/text/descriptor.h"
#include "io/text/system_error.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { BLOCK = 1 << 18, PACKED_BLOCK = 1 << 16, MEMORY_BLOCK = 64 };

bool mw__source_is_plain_file(mw_source *source)
{
    return source->size > 0 && strcmp(source->path, "-") != 0 &&
           (!source->gz || gzdirect(source->gz) == 1);
}

size_t mw__source_left(mw_source *source)
{
    const bool known = mw__source_is_plain_file(source) && source->offset <= source->size;
    const uint64_t left = known ? source->size - source->offset : 0;
    return left <= SIZE_MAX ? (size_t)left : 0;
}

const char *mw__source_name(const mw_source *source)
{
    return strcmp(source->path, "-") == 0 ? "standard input" : source->path;
}

bool mw__path_ends(const char *path, const char *ending)
{
    size_t length = strlen(path), wanted = strlen(ending);
    if (length > 3 && strcasecmp(path + length - 3, ".gz") == 0) length -= 3;
    return length > wanted && strncasecmp(path + length - wanted, ending, wanted) == 0;
}

uint64_t mw__source_position(const mw_source *source)
{
    if (source->binary) return source->offset;
    return source->line > 0 ? (uint64_t)source->line : 1;
}

void mw__message_clean(char *message)
{
    for (char *c = message; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
}

static mw_status source_fail_at(const mw_source *source, uint64_t position, mw_error *error,
                                const char *format, va_list arguments)
{
    if (!error) return MW_ERROR_INPUT;
    char message[256];
    vsnprintf(message, sizeof message, format, arguments);
    mw__message_clean(message);
    const char *name = mw__source_name(source);
    if (source->placeless) return mw__fail(error, MW_ERROR_INPUT, "%.240s: %s", name, message);
    if (source->binary)
        mw__fail(error, MW_ERROR_INPUT, "%.240s: at byte %" PRIu64 ": %s", name, position, message);
    else
        mw__fail(error, MW_ERROR_INPUT, "%.240s:%" PRIu64 ": %s", name, position, message);
    if (!source->binary) error->line = (int64_t)position;
    return MW_ERROR_INPUT;
}

mw_status mw__source_fail(const mw_source *source, mw_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    source_fail_at(source, mw__source_position(source), error, format, arguments);
    va_end(arguments);
    return MW_ERROR_INPUT;
}

mw_status mw__source_fail_at(const mw_source *source, uint64_t position, mw_error *error,
                             const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    source_fail_at(source, position, error, format, arguments);
    va_end(arguments);
    return MW_ERROR_INPUT;
}

mw_excerpt mw__excerpt_of(const char *text, size_t length)
{
    mw_excerpt excerpt;
    size_t room = sizeof excerpt.text - 4, n = length < room ? length : room;
    memcpy(excerpt.text, text, n);
    strcpy(excerpt.text + n, length > room ? "..." : "");
    return excerpt;
}

mw_excerpt mw__excerpt(const char *text)
{
    return mw__excerpt_of(text, strcspn(text, " \t"));
}

mw_status mw__source_fail_large(const mw_source *source, const char *number, const char *end,
                                mw_error *error)
{
    return mw__source_fail(source, error, "the number %s is too large",
                           mw__excerpt_of(number, (size_t)(end - number)).text);
}

static mw_status source_start(mw_source *source, const char *path, size_t block, mw_error *error)
{
    *source = (mw_source){.path = strdup(path), .capacity = block};
    source->buffer = mw__alloc(source->capacity + 1, 1);
    if (source->path && source->buffer) return MW_OK;
    mw__source_close(source);
    return mw__fail_memory(error);
}

/* A descriptor to read from; standard input is duplicated, so that closing the source leaves it
 * open. */
static int source_descriptor(const char *path)
{
    if (strcmp(path, "-") == 0) return mw__descriptor_duplicate(STDIN_FILENO);
    int fd = mw__descriptor_open(path, O_RDONLY, 0);
    struct stat status;
    if (fd >= 0 && fstat(fd, &status) == 0 && S_ISDIR(status.st_mode)) {
        close(fd);
        errno = EISDIR;
        return -1;
    }
    return fd;
}

mw_status mw__source_open(mw_source *source, const char *path, mw_error *error)
{
    mw_status status = source_start(source, path, BLOCK, error);
    if (status) return status;
    int fd = source_descriptor(path);
    if (fd < 0) {
        status = mw__fail_system(mw__source_name(source), errno, error);
        mw__source_close(source);
        return status;
    }
    struct stat file;
    if (fstat(fd, &file) == 0 && S_ISREG(file.st_mode)) source->size = (uint64_t)file.st_size;
    source->gz = gzdopen(fd, "rb");
    if (!source->gz || gzbuffer(source->gz, PACKED_BLOCK) != 0) {
        if (!source->gz) close(fd);
        mw__source_close(source);
        return mw__fail_memory(error);
    }
    return MW_OK;
}

mw_status mw__source_memory(mw_source *source, const char *name, const void *bytes, size_t size,
                            mw_error *error)
{
    mw_status status = source_start(source, name, MEMORY_BLOCK, error);
    if (status) return status;
    source->memory = bytes;
    source->memory_left = size;
    return MW_OK;
}

void mw__source_watch(mw_source *source, mw_job *job)
{
    source->job = job;
}

void mw__source_close(mw_source *source)
{
    if (source->gz) gzclose(source->gz);
    free(source->buffer);
    free(source->path);
    *source = (mw_source){0};
}

/* Check zlib's state after a read that returned fewer bytes than wanted. Damage is reported only
 * when the data before it are used up, so that the error names the right line. */
static mw_status source_zlib_error(mw_source *source, int got, mw_error *error)
{
    int number = Z_OK, system_number = errno;
    gzerror(source->gz, &number);
    if (number == Z_ERRNO) return mw__fail_system(mw__source_name(source), system_number, error);
    if (number == Z_MEM_ERROR) return mw__fail_memory(error);
    if (number == Z_BUF_ERROR)
        source->damage = "the gzip data end early";
    else if (got < 0)
        source->damage = "the gzip data are damaged";
    return MW_OK;
}

/* Bytes of the file, packed or not, that have been read. */
static uint64_t source_bytes_read(const mw_source *source)
{
    z_off_t at = source->gz ? gzoffset(source->gz) : 0;
    return at > 0 ? (uint64_t)at : 0;
}

double mw__source_fraction(const mw_source *source)
{
    if (source->size == 0) return -1;
    double fraction = (double)source_bytes_read(source) / (double)source->size;
    return fraction < 1 ? fraction : 1;
}

/* Tell the job how much has been read. Returns false if it is to stop. */
static bool source_step(mw_source *source)
{
    enum { MORE = 1 << 26 }; /* an estimate of the bytes to come, for an input of unknown size */
    if (!source->job) return true;
    uint64_t done = source_bytes_read(source);
    return mw__job_step(source->job, done, source->size ? source->size : done + MORE);
}

/* Move what is left to the front of the buffer and read more behind it; a full buffer grows. */
static mw_status source_fill(mw_source *source, mw_error *error)
{
    size_t left = source->end - source->begin;
    if (source->begin > 0) {
        memmove(source->buffer, source->buffer + source->begin, left);
        source->no_newline_below -=
            source->no_newline_below < source->begin ? source->no_newline_below : source->begin;
        source->begin = 0;
        source->end = left;
    }
    if (left == source->capacity) {
        char *larger = mw__realloc(source->buffer, 2 * source->capacity + 1, 1);
        if (!larger) return mw__fail_memory(error);
        source->buffer = larger;
        source->capacity *= 2;
    }
    size_t room = source->capacity - left;
    if (source->gz) {
        errno = 0;
        int got = gzread(source->gz, source->buffer + left, (unsigned)room);
        if (got > 0) source->end += (size_t)got;
        source->ended = got < (int)room;
        if (!source_step(source)) return mw__fail_memory(error);
        return source->ended ? source_zlib_error(source, got, error) : MW_OK;
    }
    size_t got = room < source->memory_left ? room : source->memory_left;
    if (got > 0) { /* else there may be no memory at all */
        memcpy(source->buffer + left, source->memory, got);
        source->memory += got;
    }
    source->memory_left -= got;
    source->end += got;
    source->ended = source->memory_left == 0;
    return MW_OK;
}

mw_status mw__source_peek(mw_source *source, size_t wanted, const char **bytes, size_t *count,
                          mw_error *error)
{
    while (!source->ended && source->end - source->begin < wanted) {
        mw_status status = source_fill(source, error);
        if (status) return status;
    }
    *bytes = source->buffer + source->begin;
    *count = source->end - source->begin < wanted ? source->end - source->begin : wanted;
    return MW_OK;
}

static void source_advance(mw_source *source, size_t count)
{
    source->begin += count;
    source->offset += count;
}

mw_status mw__source_bytes(mw_source *source, size_t count, const unsigned char **bytes,
                           mw_error *error)
{
    if (MW_UNLIKELY(source->end - source->begin < count)) {
        const char *have;
        size_t have_count;
        mw_status status = mw__source_peek(source, count, &have, &have_count, error);
        if (status) return status;
        if (have_count < count)
            return mw__source_fail_at(source, source->offset + have_count, error, "%s",
                                      source->damage ? source->damage : "the data end early");
    }
    *bytes = (const unsigned char *)source->buffer + source->begin;
    source_advance(source, count);
    return MW_OK;
}

mw_status mw__source_skip(mw_source *source, uint64_t count, mw_error *error)
{
    while (count > 0) {
        size_t step = count < MW_BYTES_LIMIT ? (size_t)count : MW_BYTES_LIMIT;
        const unsigned char *bytes;
        mw_status status = mw__source_bytes(source, step, &bytes, error);
        if (status) return status;
        count -= step;
    }
    return MW_OK;
}

mw_status mw__source_check_end(mw_source *source, uint64_t count, const char *what, mw_error *error)
{
    for (;;) {
        const char *bytes;
        size_t have;
        mw_status status = mw__source_peek(source, MW_BYTES_LIMIT, &bytes, &have, error);
        if (status) return status;
        for (size_t i = 0; i < have; i++)
            if (bytes[i] != 0 && bytes[i] != ' ' && (bytes[i] < '\t' || bytes[i] > '\r'))
                return mw__source_fail_at(source, source->offset + i, error,
                                          "there are more data after the %" PRIu64 " %s announced",
                                          count, what);
        if (have == 0 && source->damage)
            return mw__source_fail(source, error, "%s", source->damage);
        if (have == 0) return MW_OK;
        source_advance(source, have);
    }
}

/* The next line end in the buffer, or NULL. What was found out about '\n' is kept, since a file
 * may have only '\r'. */
static char *source_find_line_end(mw_source *source, size_t from)
{
    char *stop = source->buffer + source->end, *newline = NULL;
    size_t unknown = source->no_newline_below > from ? source->no_newline_below : from;
    if (unknown < source->end)
        newline = memchr(source->buffer + unknown, '\n', source->end - unknown);
    source->no_newline_below = (size_t)((newline ? newline : stop) - source->buffer);
    char *begin = source->buffer + from;
    char *limit = newline ? newline : stop;
    char *carriage = limit > begin ? memchr(begin, '\r', (size_t)(limit - begin)) : NULL;
    return carriage ? carriage : newline;
}

/* Hand out the line that ends before `stop`; its end takes up `stop_bytes` bytes there. The first
 * `checked` bytes hold no NUL. */
static mw_status source_take_line(mw_source *source, char *stop, size_t stop_bytes, size_t checked,
                                  char **line, mw_error *error)
{
    char *begin = source->buffer + source->begin;
    source->line_begin = source->begin;
    source->line_length = (size_t)(stop - begin);
    source->line_bytes = source->line_length + stop_bytes;
    source->line_stop = *stop;
    *stop = 0;
    source->line++;
    source->line_count = 1;
    source_advance(source, source->line_bytes);
    if (memchr(begin + checked, 0, source->line_length - checked))
        return mw__source_fail(source, error,
                               "a NUL byte: this is not a text file, or not of the expected kind");
    *line = begin;
    return MW_OK;
}

static mw_status source_skip_byte_order_mark(mw_source *source, mw_error *error)
{
    const char *head;
    size_t count;
    mw_status status = mw__source_peek(source, 3, &head, &count, error);
    if (status) return status;
    if (count >= 2 && (memcmp(head, "\xff\xfe", 2) == 0 || memcmp(head, "\xfe\xff", 2) == 0))
        return mw__source_fail_at(source, 1, error, "this is UTF-16 text: save it as UTF-8");
    if (count == 3 && memcmp(head, "\xef\xbb\xbf", 3) == 0) source_advance(source, 3);
    return MW_OK;
}

/* Hand out the line that begins at source->begin and ends behind its first `kept` bytes; NULL if
 * no more than those is left. */
static mw_status source_read_line(mw_source *source, size_t kept, char **line, mw_error *error)
{
    /* bytes after begin that hold no line end, or one that is passed over */
    size_t searched = kept;
    mw_status status = MW_OK;
    while (!status) {
        char *stop = source_find_line_end(source, source->begin + searched);
        size_t length =
            stop ? (size_t)(stop - source->buffer) - source->begin : source->end - source->begin;
        if (length > MW_LINE_LIMIT)
            return mw__source_fail_at(source, (uint64_t)source->line + 1, error,
                                      "a line is longer than %zu bytes", MW_LINE_LIMIT);
        /* a CR at the end of the buffer may belong to an LF behind it */
        if (stop && (*stop == '\n' || stop + 1 < source->buffer + source->end || source->ended)) {
            bool pair = *stop == '\r' && stop + 1 < source->buffer + source->end && stop[1] == '\n';
            return source_take_line(source, stop, pair ? 2 : 1, kept, line, error);
        }
        if (source->ended && source->damage)
            return mw__source_fail_at(source, (uint64_t)source->line + 1, error, "%s",
                                      source->damage);
        if (source->ended && length <= kept) return MW_OK;
        if (source->ended)
            return source_take_line(source, source->buffer + source->end, 0, kept, line, error);
        searched = length;
        status = source_fill(source, error);
    }
    return status;
}

mw_status mw__source_line(mw_source *source, char **line, mw_error *error)
{
    *line = NULL;
    mw_status status = source->line == 0 ? source_skip_byte_order_mark(source, error) : MW_OK;
    return status ? status : source_read_line(source, 0, line, error);
}

/* Put the bytes of the line read last back before those that are not read yet. */
static void source_restore_line(mw_source *source)
{
    source->buffer[source->line_begin + source->line_length] = source->line_stop;
    source->begin = source->line_begin;
    source->offset -= source->line_bytes;
    source->no_newline_below = 0;
}

mw_status mw__source_join_line(mw_source *source, char **line, mw_error *error)
{
    *line = NULL;
    int64_t joined = source->line_count;
    source_restore_line(source);
    mw_status status = source_read_line(source, source->line_bytes, line, error);
    source->line_count += joined;
    return status;
}

void mw__source_unread_line(mw_source *source)
{
    source_restore_line(source);
    source->line -= source->line_count;
}

mw_status mw__source_content_line(mw_source *source, char **line, mw_error *error)
{
    for (;;) {
        mw_status status = mw__source_line(source, line, error);
        if (status || !*line) return status;
        char *comment = strchr(*line, '#');
        if (comment) *comment = 0;
        *line = mw__skip_blanks(*line);
        if (**line) return MW_OK;
    }
}
