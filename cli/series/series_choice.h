/* series_choice.h - values over time: the file that holds them, which fields and which steps are
 * asked for. */
#ifndef MW_CLI_SERIES_SERIES_CHOICE_H
#define MW_CLI_SERIES_SERIES_CHOICE_H

#include "cli/series/series_paths.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* What the user asks for; NULL where an option was not given. */
typedef struct series_request {
    const char *path;   /* of the values, or several; NULL: `mesh` holds them */
    const char *mesh;   /* the path of the mesh */
    const char *layout; /* --layout */
    const char *fields; /* names, separated by commas; NULL: all that depend on time */
    const char *time;   /* all, FIRST..LAST, N or nearest:T */
} series_request;

typedef struct series_choice {
    mw_series *series;
    const mw_series_info *info;
    series_paths files;
    const char *path; /* of the first */
    size_t *field;    /* numbers of the fields */
    size_t field_count;
    size_t first, last; /* steps, both included */
} series_choice;

/* Refuse a --time that cannot be one, before anything is read. Returns 0, or END_USAGE after a
 * complaint. */
int series_check_time(const char *time);

/* Open the values and find what is asked for. `faces` is the number of faces of the mesh. Returns
 * 0, or an exit code after a complaint; close it in both cases. */
int series_choose(series_choice *c, const series_request *request, size_t vertices, size_t faces);
void series_close(series_choice *c);

static inline const mw_series_field *series_field(const series_choice *c, size_t k)
{
    return &c->info->fields[c->field[k]];
}

#endif
