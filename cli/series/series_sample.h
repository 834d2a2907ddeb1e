/* series_sample.h - values over time at the points of a file, as a table. */
#ifndef MW_CLI_SERIES_SERIES_SAMPLE_H
#define MW_CLI_SERIES_SERIES_SAMPLE_H

#include "cli/stream/point_query.h"

/* How points are located elsewhere. `load` gets the mesh and its file first; `self` is the
 * caller's, for both. */
typedef struct series_locating {
    point_query_load *load;
    point_query_elsewhere *locate;
    void *self;
} series_locating;

typedef struct series_settings {
    const char *time;        /* --time; NULL: all */
    const char *values;      /* --values: the file; NULL: the mesh */
    const char *time_column; /* --time-column; NULL: none */
    const char *fields;      /* --field */
    bool recover, wide, status;
    bool globe; /* points and mesh are longitudes and latitudes on the globe, */
    bool open;  /* which may be open */
    const series_locating *elsewhere; /* NULL: points are located here */
} series_settings;

/* Returns the exit code. */
int series_sample(const point_query_settings *query, const series_settings *settings,
                  const char *const *operands);

#endif
