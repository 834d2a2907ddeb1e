#include "io/text/crs_text.h"
#include "base/posix.h"
#include "io/text/descriptor.h"

#include <meshwalk/io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool crs_gap(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == 0;
}

mw_status mw__crs_copy(const char *bytes, size_t size, char **crs, mw_error *error)
{
    *crs = NULL;
    while (size > 0 && crs_gap(bytes[size - 1])) size--;
    while (size > 0 && crs_gap(*bytes)) bytes++, size--;
    if (size == 0 || size > MW_CRS_LIMIT) return MW_OK;
    char *copy = mw__alloc(size + 1, 1);
    if (!copy) return mw__fail_memory(error);
    size_t length = 0;
    for (size_t i = 0; i < size; i++) {
        bool gap = crs_gap(bytes[i]) && bytes[i] != 0;
        if (gap && copy[length - 1] == ' ') continue;
        copy[length++] = gap ? ' ' : bytes[i];
        if (gap || ((unsigned char)bytes[i] >= 0x20 && bytes[i] != 0x7f)) continue;
        free(copy);
        return MW_OK;
    }
    copy[length] = 0;
    *crs = copy;
    return MW_OK;
}

/* Only WKT and EPSG:n are accepted, because other programs use files of this name for other things.
 */
static bool crs_begins_as_wkt(const char *text)
{
    static const char *const words[] = {
        "PROJCS",      "GEOGCS",       "GEOCCS",  "COMPD_CS",       "LOCAL_CS",      "FITTED_CS",
        "PROJCRS",     "PROJECTEDCRS", "GEOGCRS", "GEOGRAPHICCRS",  "GEODCRS",       "GEODETICCRS",
        "COMPOUNDCRS", "BOUNDCRS",     "ENGCRS",  "ENGINEERINGCRS", "DERIVEDPROJCRS"};
    if (strncasecmp(text, "EPSG:", 5) == 0) return true;
    size_t length = strcspn(text, " [(");
    const char *rest = text + length + strspn(text + length, " ");
    for (size_t i = 0; (*rest == '[' || *rest == '(') && i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == length && strncasecmp(words[i], text, length) == 0) return true;
    return false;
}

/* The name of the file beside; its ending is as given. */
static bool crs_name_beside(const char *path, const char *ending, char *name, size_t size)
{
    size_t length = strlen(path);
    if (length > 3 && strcasecmp(path + length - 3, ".gz") == 0) length -= 3;
    size_t stem = length;
    while (stem > 0 && path[stem - 1] != '.' && path[stem - 1] != '/') stem--;
    bool has_ending = stem > 1 && path[stem - 1] == '.' && path[stem - 2] != '/';
    if (has_ending) length = stem - 1;
    return length > 0 && snprintf(name, size, "%.*s%s", (int)length, path, ending) < (int)size;
}

/* Open the file beside, if it is a regular one. */
static int crs_open_beside(const char *path)
{
    static const char *const endings[] = {".prj", ".PRJ"};
    char name[4096];
    struct stat what;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (crs_name_beside(path, endings[i], name, sizeof name) && stat(name, &what) == 0 &&
            S_ISREG(what.st_mode))
            return mw__descriptor_open(name, O_RDONLY, 0);
    return -1;
}

/* Read up to `room` bytes. */
static size_t crs_read_bytes(int fd, char *bytes, size_t room)
{
    size_t size = 0;
    for (ssize_t more; size < room && (more = read(fd, bytes + size, room - size)) > 0;)
        size += (size_t)more;
    return size;
}

mw_status mw_read_prj(const char *path, char **crs, mw_error *error)
{
    if (crs) *crs = NULL;
    if (!path || !crs)
        return mw__fail(error, MW_ERROR_ARGUMENT, "mw_read_prj: the path or the result is NULL");
    int fd = strcmp(path, "-") == 0 ? -1 : crs_open_beside(path);
    if (fd < 0) return MW_OK;
    char *bytes = mw__alloc(MW_CRS_LIMIT + 1, 1);
    size_t size = bytes ? crs_read_bytes(fd, bytes, MW_CRS_LIMIT + 1) : 0;
    size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    close(fd);
    mw_status status =
        bytes ? mw__crs_copy(bytes + mark, size - mark, crs, error) : mw__fail_memory(error);
    free(bytes);
    if (*crs && !crs_begins_as_wkt(*crs)) {
        free(*crs);
        *crs = NULL;
    }
    return status;
}
