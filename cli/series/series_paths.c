#include "cli/series/series_paths.h"

#include "src/base/posix.h"

#include <stdlib.h>
#include <string.h>

bool series_paths_split(series_paths *p, const char *list)
{
    size_t room = 1;
    const bool whole = access(list, F_OK) == 0;
    for (const char *s = list; *s; s++) room += *s == ',';
    *p = (series_paths){.list = strdup(list), .paths = malloc(room * sizeof *p->paths)};
    if (!p->list || !p->paths) return false;
    p->paths[p->count++] = p->list;
    for (char *s = p->list; *s && !whole; s++) {
        if (*s != ',') continue;
        *s = 0;
        p->paths[p->count++] = s + 1;
    }
    return true;
}

void series_paths_release(series_paths *p)
{
    free(p->list);
    free(p->paths);
    *p = (series_paths){0};
}
