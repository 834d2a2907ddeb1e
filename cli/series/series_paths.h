/* series_paths.h - the files of --values: one, or several with consecutive times, separated by
 * commas. */
#ifndef MW_CLI_SERIES_SERIES_PATHS_H
#define MW_CLI_SERIES_SERIES_PATHS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct series_paths {
    char *list;         /* its commas are NUL */
    const char **paths; /* in it */
    size_t count;       /* at least 1 */
} series_paths;

/* Split a list; the name of a file that exists is one path, whatever commas it has. Returns false
 * if there is no memory; release it in both cases. */
bool series_paths_split(series_paths *p, const char *list);
void series_paths_release(series_paths *p);

#endif
