/* point_query_options.h - the options of commands that locate points in a mesh (point_query.h). */
#ifndef MW_CLI_STREAM_POINT_QUERY_OPTIONS_H
#define MW_CLI_STREAM_POINT_QUERY_OPTIONS_H

#include "cli/stream/query_stream.h"

#include <meshwalk/meshwalk.h>

typedef struct point_query_settings {
    query_stream_settings stream;
    const char *crs; /* of the mesh; NULL: not given */
    double tolerance;
    uint32_t sample, steps, cells, layers;
    int walk, start, arithmetic; /* mw_walk_kind, mw_start_kind, mw_arithmetic */
    int finish, fill;            /* numbers of the names of --finish and --fill */
    int descent;                 /* mw_descent */
    bool areas, any;
    bool trust;     /* a prepared mesh is not checked */
    bool lines;     /* of a command about lines, which has no --any */
    bool elsewhere; /* points are located elsewhere: no locator is made, no prepared mesh mapped */
    bool globe;     /* points are located on the globe (globe_points.h): the plane does not count */
} point_query_settings;

extern const option point_query_options[];

/* The names that --walk, --start and --descent accept. */
extern const choices point_query_walks, point_query_starts, point_query_descents;

/* The option that is given although points are located on a polyhedron, not in the plane; NULL:
 * none is. */
const char *point_query_option_of_plane(const point_query_settings *settings);

/* Refuse values of --cells and --layers above the limits of the library. Returns 0, or END_USAGE
 * after a complaint. */
int point_query_check_index(uint32_t cells, uint32_t layers);

/* The walk that --finish names, and the name of the arithmetic. */
mw_walk_kind point_query_finish(const point_query_settings *settings);
const char *point_query_arithmetic(const point_query_settings *settings);

#endif
