/* sample.h - what the commands `sample` of meshwalk and meshwalk-mpi share: their options, and what
 * a point outside, or one beside a vertex without a value, gets. */
#ifndef MW_CLI_COMMANDS_SAMPLE_H
#define MW_CLI_COMMANDS_SAMPLE_H

#include "cli/frame/options.h"
#include "cli/series/series_sample.h"

enum { OUTSIDE_EMPTY = 0, OUTSIDE_NEAREST, OUTSIDE_LINEAR };
enum { MISSING_EMPTY = 0, MISSING_NEAREST };
enum { SAMPLE_PLANE = 0, SAMPLE_STAR };

typedef struct sample_settings {
    point_query_settings query;
    const char *field, *nodata;
    int outside, missing;
    bool status, lonlat, open;
    int space;          /* SAMPLE_PLANE, SAMPLE_STAR */
    coordinates centre; /* not given: the origin */
    series_settings series;
} sample_settings;

/* The options, for sample_settings. */
extern const option *const sample_option_tables[];

/* Are values over time asked for? */
bool sample_is_series(const sample_settings *s);

/* Write them. `elsewhere` is NULL if the points are located here. Returns the exit code. */
int sample_series(const sample_settings *s, const char *const *operands,
                  const series_locating *elsewhere);

/* The corners of a triangle, with their values. */
typedef struct sample_corners {
    double at[3][2];
    double value[3]; /* NaN: missing */
} sample_corners;

/* `values` has one value for each vertex. */
void sample_corners_read(const mw_mesh *mesh, const double *values, uint32_t triangle,
                         sample_corners *c);
/* The value of the corner nearest to p that has one; NaN if none has. */
double sample_nearest_value(const sample_corners *c, const double p[2]);
/* The value at p of the plane through the three corners. Not finite if they span no plane. */
double sample_plane_value(const sample_corners *c, const double p[2]);

/* Write the value, and the status if that is wanted. `missing`: there is a triangle, but a corner
 * has no value. Returns false if there is no value. */
bool sample_cells_write(text *out, double value, bool status, bool missing, mw_where where);

#endif
