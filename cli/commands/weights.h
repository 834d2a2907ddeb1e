/* weights.h - what the commands `weights` of meshwalk and meshwalk-mpi share. */
#ifndef MW_CLI_COMMANDS_WEIGHTS_H
#define MW_CLI_COMMANDS_WEIGHTS_H

#include "cli/frame/options.h"
#include "cli/stream/located_points.h"

enum { METHOD_LINEAR = 0, METHOD_CONSERVATIVE };

typedef struct weights_settings {
    point_query_settings query;
    int method, values, norm;
    bool lonlat, open;
} weights_settings;

/* The options, for weights_settings. */
extern const option *const weights_option_tables[];

/* Weights of points, as they are written. */
typedef struct weights_result {
    const query_stream_settings *stream;
    const located_points *points;
    const double *vertices; /* x, y of each vertex */
    bool globe;             /* which are longitudes and latitudes on the globe */
    const mw_operator *weights;
} weights_result;

/* Refuse an output that is none, or an input. Returns 0, or an exit code after a complaint. */
int weights_check(const char *output, const char *const *operands);

/* Write the file, then the report if --stats asks for it. Returns the exit code. */
int weights_finish(const weights_result *result, const char *output);

#endif
