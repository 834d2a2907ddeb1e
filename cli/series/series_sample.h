/* series_sample.h - values over time at the points of a file, as a table. */
#ifndef MW_CLI_SERIES_SERIES_SAMPLE_H
#define MW_CLI_SERIES_SERIES_SAMPLE_H

#include "cli/stream/point_query.h"

typedef struct series_settings {
    const char *time;        /* --time; NULL: all */
    const char *values;      /* --values: the file; NULL: the mesh */
    const char *time_column; /* --time-column; NULL: none */
    const char *fields;      /* --field */
    bool recover, wide, status;
    bool globe; /* points and mesh are longitudes and latitudes on the globe, */
    bool open;  /* which may be open */
} series_settings;

/* Returns the exit code. */
int series_sample(const point_query_settings *query, const series_settings *settings,
                  const char *const *operands);

#endif
