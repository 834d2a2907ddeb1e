/* A file that appears under its name only when it is complete.
 *
 * If the system can make a file without a name (O_TMPFILE), the data go there, and at the end the
 * file is linked to its name: an interrupted program leaves nothing behind. Otherwise they go to
 * ".NAME.xxxxxxxx" in the same directory, which is renamed at the end. A file that exists is
 * replaced in one step by rename, and its permissions are kept. Symbolic links are followed and
 * stay, also one to a file that does not exist yet. An output that is not a regular file (a pipe, a
 * terminal, /dev/null) is written directly. */
#define _GNU_SOURCE /* O_TMPFILE */
#include "io/text/output.h"
#include "base/posix.h"
#include "base/random.h"
#include "io/text/descriptor.h"
#include "io/text/system_error.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 1 << 16, NAME_ATTEMPTS = 100, MAX_LINKS = 40, PATH_SIZE = 4096 };

struct mw_output {
    int fd;
    int error;     /* errno of the first failure, 0 if none */
    bool standard; /* standard output, which stays open */
    /* the data stand in `temporary`, which has to be renamed or removed */
    bool named;
    bool nameless;              /* the data stand in a file without a name */
    char *shown;                /* the path as given, for messages */
    char *path;                 /* the final name, symbolic links followed */
    char *temporary;            /* room for a temporary name beside it */
    mw_job *job;                /* NULL, or has a step for each block that is written */
    uint64_t written, expected; /* bytes */
    size_t used;
    char buffer[ROOM];
};

static void output_release(mw_output *output)
{
    if (!output) return;
    free(output->shown);
    free(output->path);
    free(output->temporary);
    free(output);
}

/* The length of the directory part of a path, with its last '/'. */
static size_t directory_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Put a new name ".NAME.xxxxxxxx" into output->temporary. */
static void output_invent_name(mw_output *output, uint64_t *state)
{
    size_t directory = directory_length(output->path);
    struct timespec time;
    clock_gettime(CLOCK_REALTIME, &time);
    *state += (uint64_t)time.tv_nsec + ((uint64_t)getpid() << 32);
    sprintf(output->temporary, "%.*s.%.200s.%08x", (int)directory, output->path,
            output->path + directory, (unsigned)mw__random(state));
}

/* A file without a name in the directory of the output; it can get one only through /proc. */
static int output_open_nameless(mw_output *output)
{
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) != 0) return -1;
    size_t length = directory_length(output->path);
    memcpy(output->temporary, output->path, length);
    strcpy(output->temporary + length, ".");
    return mw__descriptor_open(output->temporary, O_TMPFILE | O_WRONLY, 0666);
#else
    (void)output;
    return -1;
#endif
}

static int output_open_named(mw_output *output)
{
    uint64_t state = (uintptr_t)output;
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        output_invent_name(output, &state);
        int fd = mw__descriptor_open(output->temporary, O_CREAT | O_EXCL | O_WRONLY, 0666);
        if (fd >= 0 || errno != EEXIST) return fd;
    }
    return -1;
}

/* Where a path leads if its last part is a symbolic link: the target of the link, taken from its
 * directory unless it begins with '/'. NULL with errno; EINVAL: it is no link. */
static char *link_target(const char *path)
{
    char target[PATH_SIZE];
    ssize_t length = readlink(path, target, sizeof target);
    if (length < 0) return NULL;
    size_t directory = target[0] == '/' ? 0 : directory_length(path);
    char *next =
        (size_t)length < sizeof target ? mw__alloc(directory + (size_t)length + 1, 1) : NULL;
    if (!next) {
        errno = (size_t)length < sizeof target ? ENOMEM : ENAMETOOLONG;
        return NULL;
    }
    memcpy(next, path, directory);
    memcpy(next + directory, target, (size_t)length);
    next[directory + (size_t)length] = 0;
    return next;
}

/* The path that symbolic links lead to, whether there is a file or not. NULL with errno. */
static char *link_end(const char *path)
{
    char *at = strdup(path);
    if (!at) errno = ENOMEM;
    for (int i = 0; at && i < MAX_LINKS; i++) {
        char *next = link_target(at);
        if (!next && (errno == EINVAL || errno == ENOENT)) return at;
        int number = errno;
        free(at);
        errno = number;
        at = next;
    }
    if (!at) return NULL;
    free(at);
    errno = ELOOP;
    return NULL;
}

mw_status mw_output_resolve(const char *path, char **name, mw_error *error)
{
    if (!path || !name)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_output_resolve: the path or the result is NULL");
    *name = link_end(path);
    return *name ? MW_OK : mw__fail_system(path, errno, error);
}

/* Opens output->fd, -1 with errno if that fails. `named`: under a temporary name at once. */
static int output_open_target(mw_output *output, const char *path, bool named)
{
    output->standard = strcmp(path, "-") == 0;
    if (output->standard) return STDOUT_FILENO;
    struct stat status;
    bool exists = stat(path, &status) == 0;
    if (exists && !S_ISREG(status.st_mode)) return mw__descriptor_open(path, O_WRONLY, 0);
    if (exists && access(path, W_OK) != 0) return -1; /* a file that is protected stays */
    output->path = exists ? realpath(path, NULL) : link_end(path);
    if (!output->path) return -1;
    output->temporary = mw__alloc(strlen(output->path) + 16, 1);
    if (!output->temporary) {
        errno = ENOMEM;
        return -1;
    }
    int fd = named ? -1 : output_open_nameless(output);
    output->nameless = fd >= 0;
    if (fd < 0) {
        fd = output_open_named(output);
        output->named = fd >= 0;
    }
    if (fd >= 0 && exists) fchmod(fd, status.st_mode & 0777); /* as if written into the old file */
    return fd;
}

static mw_status output_open(const char *path, bool named, mw_output **out, mw_error *error)
{
    *out = NULL;
    mw_output *output = mw__alloc(1, sizeof *output);
    if (!output) return mw__fail_memory(error);
    memset(output, 0, offsetof(mw_output, buffer));
    output->shown = strdup(strcmp(path, "-") == 0 ? "standard output" : path);
    if (!output->shown) {
        output_release(output);
        return mw__fail_memory(error);
    }
    output->fd = output_open_target(output, path, named);
    if (output->fd < 0) {
        mw_status status = mw__fail_system(output->shown, errno, error);
        output_release(output);
        return status;
    }
    *out = output;
    return MW_OK;
}

mw_status mw_output_open(const char *path, mw_output **out, mw_error *error)
{
    if (!path || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_output_open: the path or the pointer to the new output is NULL");
    return output_open(path, false, out, error);
}

mw_status mw__output_open_named(const char *path, mw_output **out, mw_error *error)
{
    return output_open(path, true, out, error);
}

void mw__output_watch(mw_output *output, mw_job *job, uint64_t expected)
{
    output->job = job;
    output->expected = expected;
}

static void output_write_out(mw_output *output, const char *bytes, size_t size)
{
    output->written += size;
    while (size > 0 && !output->error) {
        ssize_t done = write(output->fd, bytes, size);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0)
            output->error = errno;
        else
            bytes += done, size -= (size_t)done;
    }
    if (output->job && !output->error &&
        !mw__job_step(output->job, output->written, output->expected))
        output->error = ECANCELED;
}

void mw__output_flush(mw_output *output)
{
    output_write_out(output, output->buffer, output->used);
    output->used = 0;
}

void mw_output_write(mw_output *output, const void *bytes, size_t size)
{
    if (size == 0) return;
    if (MW_UNLIKELY(size > ROOM - output->used)) {
        mw__output_flush(output);
        if (size > ROOM) {
            output_write_out(output, bytes, size);
            return;
        }
    }
    memcpy(output->buffer + output->used, bytes, size);
    output->used += size;
}

void mw__output_text(mw_output *output, const char *text)
{
    mw_output_write(output, text, strlen(text));
}

void mw__output_char(mw_output *output, char c)
{
    if (MW_UNLIKELY(output->used == ROOM)) mw__output_flush(output);
    output->buffer[output->used++] = c;
}

void mw__output_integer(mw_output *output, uint64_t value)
{
    char digits[20], *p = digits + sizeof digits;
    do *--p = (char)('0' + value % 10);
    while (value /= 10);
    mw_output_write(output, p, (size_t)(digits + sizeof digits - p));
}

void mw_output_double(mw_output *output, double value)
{
    if (MW_UNLIKELY(ROOM - output->used < 32)) mw__output_flush(output);
    output->used += mw_format_double(value, output->buffer + output->used);
}

void mw_output_printf(mw_output *output, const char *format, ...)
{
    char text[1024], *bytes = text;
    va_list arguments;
    va_start(arguments, format);
    int size = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (size >= (int)sizeof text) {
        bytes = mw__alloc((size_t)size + 1, 1);
        if (bytes) {
            va_start(arguments, format);
            vsnprintf(bytes, (size_t)size + 1, format, arguments);
            va_end(arguments);
        }
    }
    if (size < 0 || !bytes)
        output->error = output->error ? output->error : ENOMEM;
    else
        mw_output_write(output, bytes, (size_t)size);
    if (bytes != text) free(bytes);
}

int mw_output_failed(const mw_output *output)
{
    return output->error != 0;
}

const char *mw_output_temporary(const mw_output *output)
{
    return output->named ? output->temporary : NULL;
}

/* Link a file without a name to `to`. Returns 0 or an errno. */
static int output_link_to(const mw_output *output, const char *to)
{
    char from[32];
    snprintf(from, sizeof from, "/proc/self/fd/%d", output->fd);
    return linkat(AT_FDCWD, from, AT_FDCWD, to, AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

/* Give the file its final name. A name that is taken can be replaced by rename only, from a
 * temporary name. */
static int output_put_in_place(mw_output *output)
{
    if (output->nameless) {
        int failure = output_link_to(output, output->path);
        if (failure != EEXIST) return failure;
        uint64_t state = (uintptr_t)output;
        for (int i = 0; i < NAME_ATTEMPTS && failure == EEXIST; i++) {
            output_invent_name(output, &state);
            failure = output_link_to(output, output->temporary);
        }
        if (failure) return failure;
        output->named = true;
    }
    if (output->named) {
        if (rename(output->temporary, output->path) != 0) return errno;
        output->named = false;
    }
    return 0;
}

static void output_close_file(mw_output *output)
{
    if (!output->standard && close(output->fd) != 0 && !output->error) output->error = errno;
}

mw_status mw_output_close(mw_output *output, int commit, mw_error *error)
{
    if (!output) return MW_OK;
    if (commit) mw__output_flush(output);
    /* Some file systems report a failed write only here. A file without a name has to stay open
     * until it is linked. */
    if (!output->nameless) output_close_file(output);
    if (commit && !output->error) output->error = output_put_in_place(output);
    if (output->nameless) output_close_file(output);
    if (output->named) unlink(output->temporary);
    mw_status status =
        commit && output->error ? mw__fail_system(output->shown, output->error, error) : MW_OK;
    output_release(output);
    return status;
}
