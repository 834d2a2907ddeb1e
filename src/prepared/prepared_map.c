/* prepared_map.c - prepared files are mapped: read when they are needed, and shared by all
 * processes that map them. */
#include "base/options.h"
#include "base/posix.h"
#include "io/text/descriptor.h"
#include "io/text/system_error.h"
#include "prepared/prepared.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Where the file system has large pages, walks miss fewer translations of addresses, and a file
 * that is not in memory yet is read in larger pieces. */
static void map_ask_large_pages(void *map, size_t size)
{
#ifdef MADV_HUGEPAGE
    enum { LARGE = 4 << 20 };
    if (size >= LARGE) (void)madvise(map, size, MADV_HUGEPAGE);
#else
    (void)map, (void)size;
#endif
}

/* Map an open file; *bytes is NULL on failure, and for an empty file. */
static mw_status file_map(int fd, const char *path, void **bytes, size_t *size, mw_error *error)
{
    struct stat s;
    if (fstat(fd, &s) != 0) return mw__fail_system(path, errno, error);
    if (!S_ISREG(s.st_mode))
        return mw__fail(error, MW_ERROR_INPUT, "%.240s: only a file can be mapped", path);
    if (s.st_size == 0)
        return mw__fail(error, MW_ERROR_INPUT, "%.240s: this is not a prepared mesh (.mwm)", path);
    if ((uint64_t)s.st_size > SIZE_MAX)
        return mw__fail(error, MW_ERROR_LIMIT, "%.240s: too large for this machine", path);
    *size = (size_t)s.st_size;
    void *map = mmap(NULL, *size, PROT_READ, MAP_SHARED, fd, 0);
    if (map == MAP_FAILED) return mw__fail_system(path, errno, error);
    map_ask_large_pages(map, *size);
    *bytes = map;
    return MW_OK;
}

static mw_status path_map(const char *path, void **bytes, size_t *size, mw_error *error)
{
    *bytes = NULL;
    int fd = mw__descriptor_open(path, O_RDONLY, 0);
    if (fd < 0) return mw__fail_system(path, errno, error);
    mw_status status = file_map(fd, path, bytes, size, error);
    close(fd);
    return status;
}

static mw_status prepared_map(const char *path, const mw_map_options *options, mw_job *job,
                              mw_prepared **out, mw_error *error)
{
    void *bytes;
    size_t size = 0;
    mw_status status = path_map(path, &bytes, &size, error);
    if (status) return status;
    mw_prepared *p = mw__calloc(1, sizeof *p);
    if (!p) {
        munmap(bytes, size);
        return mw__fail_memory(error);
    }
    status = mw__prepared_open(p, path, bytes, size, options->trust != 0, job, error);
    if (!status && !options->no_late_chains && !mw__locator_allow_late_chains(&p->locator))
        status = mw__fail_memory(error);
    p->name = NULL;
    p->header.bytes = size; /* of the map, also where the header is wrong */
    *out = p;
    return status;
}

mw_status mw_mesh_map(const char *path, const mw_map_options *options, mw_prepared **out,
                      mw_error *error)
{
    static const mw_map_options defaults;
    if (out) *out = NULL;
    if (!path || !out)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_mesh_map: the path or the pointer to the new map is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_map_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__job_end(&job, prepared_map(path, options, &job, out, error), error);
    if (status) {
        mw_prepared_close(*out);
        *out = NULL;
    }
    return status;
}

void mw_prepared_close(mw_prepared *prepared)
{
    if (!prepared) return;
    mw__prepared_release(prepared);
    munmap((void *)(uintptr_t)prepared->bytes, (size_t)prepared->header.bytes);
    free(prepared);
}

int mw_prepared_known(const char *path)
{
    char mark[8];
    int fd =
        path && strcmp(path, "-") != 0 ? mw__descriptor_open(path, O_RDONLY | O_NONBLOCK, 0) : -1;
    if (fd < 0) return 0;
    struct stat s;
    bool known = fstat(fd, &s) == 0 && S_ISREG(s.st_mode) &&
                 read(fd, mark, sizeof mark) == (ssize_t)sizeof mark &&
                 memcmp(mark, MW_PREPARED_MARK, sizeof mark) == 0;
    close(fd);
    return known;
}
