#include "cli/gdal/gdal_directory.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/signals.h"
#include "src/base/posix.h"

#include <errno.h>
#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int gdal_directory_check(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0 || S_ISREG(info.st_mode)) return files_try_output(path, NULL);
    complain("%s: is not a regular file, which GDAL needs", path);
    return END_RESOURCE;
}

int gdal_directory_open(gdal_directory *d, const char *path)
{
    mw_error error;
    *d = (gdal_directory){0};
    if (mw_output_resolve(path, &d->path, &error) != MW_OK) return fail_writing(&error);
    const char *slash = strrchr(d->path, '/');
    const char *name = slash ? slash + 1 : d->path;
    int length = (int)(name - d->path);
    size_t size = strlen(d->path) + 64;
    d->directory = malloc(size);
    d->temporary = malloc(2 * size);
    if (!d->directory || !d->temporary) return fail_memory();
    snprintf(d->directory, size, "%.*s.meshwalk-XXXXXX", length, d->path);
    if (!mkdtemp(d->directory)) {
        complain("%s: %s", d->path, strerror(errno));
        *d->directory = 0;
        return END_RESOURCE;
    }
    signals_set_temporary(d->directory);
    snprintf(d->temporary, 2 * size, "%s/%s", d->directory, name);
    return 0;
}

static int directory_commit(const gdal_directory *d)
{
    DIR *directory = opendir(d->directory);
    int end = directory ? 0 : END_RESOURCE;
    int stem = (int)(strlen(d->path) - strlen(strrchr(d->temporary, '/') + 1));
    for (struct dirent *entry; end == 0 && (entry = readdir(directory));) {
        char from[4096], to[4096];
        if (entry->d_name[0] == '.') continue;
        bool fits =
            snprintf(from, sizeof from, "%s/%s", d->directory, entry->d_name) < (int)sizeof from &&
            snprintf(to, sizeof to, "%.*s%s", stem, d->path, entry->d_name) < (int)sizeof to;
        if (!fits || rename(from, to) != 0) end = END_RESOURCE;
    }
    if (end) complain("%s: %s", d->path, strerror(errno));
    if (directory) closedir(directory);
    return end;
}

int gdal_directory_close(gdal_directory *d, bool commit)
{
    int end = commit ? directory_commit(d) : 0;
    if (d->directory && *d->directory) signals_remove_temporaries();
    free(d->temporary);
    free(d->directory);
    free(d->path);
    *d = (gdal_directory){0};
    return end;
}
