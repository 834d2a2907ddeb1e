/* series_values.h - values over time at points: a step is read, and interpolated. */
#ifndef MW_CLI_SERIES_SERIES_VALUES_H
#define MW_CLI_SERIES_SERIES_VALUES_H

#include "cli/series/series_choice.h"

/* The points at which values are asked for, in their mesh. */
typedef struct series_points {
    const mw_mesh *mesh;
    const uint32_t *face; /* of each triangle; NULL: triangle i is face i */
    size_t face_count;
    const mw_location *located;
    size_t count;
    bool recover; /* values at faces are made continuous first */
    uint32_t threads;
} series_points;

typedef struct series_values {
    const series_choice *choice;
    const series_points *at;
    mw_operator *weights;
    double *values;   /* of a field at a step, as the file has them */
    double *vertices; /* recovered */
} series_values;

/* Returns 0, or an exit code after a complaint; release in both cases. */
int series_values_open(series_values *v, const series_choice *choice, const series_points *at);
void series_values_release(series_values *v);

/* The values of field k (of the choice) at a step: one for each point, NaN where there is none.
 * Returns 0, or an exit code after a complaint. */
int series_values_read(series_values *v, size_t k, size_t step, double *result);

/* The values of field k, each at a time of its own between steps: interpolated linearly in time,
 * NaN before the first and after the last step of the choice. */
int series_values_follow(series_values *v, size_t k, const double *times, size_t stride,
                         double *result);

#endif
