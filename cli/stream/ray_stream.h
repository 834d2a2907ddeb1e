/* ray_stream.h - what `star` and `sample` on a star share: a star-shaped polyhedron, and a stream
 * of rays from its centre. */
#ifndef MW_CLI_STREAM_RAY_STREAM_H
#define MW_CLI_STREAM_RAY_STREAM_H

#include "cli/input/star_input.h"
#include "cli/stream/query_stream.h"
#include "cli/stream/statistics.h"

/* The first member of what a command hands to the stream as its own data. */
typedef struct ray_stream {
    const query_stream_settings *stream;
    const coordinates *centre;
    mw_star_query_options options; /* walk, start and index; the rest is set for each block */
    bool lonlat;                   /* rays are longitudes and latitudes */
    double begin;                  /* monotonic_seconds when the command began */
    star_input polyhedron;
    const double *field;      /* NULL, or a value for each vertex */
    double *at_rays;          /* with a field: its values for the block that is being written */
    const mw_location *first; /* the answer to which the first of these belongs */
    double *points;           /* of a block, if rays are longitudes and latitudes */
    location_statistics statistics;
} ray_stream;

/* The value of the field where a ray meets the polyhedron. */
static inline double ray_stream_value(const ray_stream *q, const mw_location *where)
{
    return q->at_rays[where - q->first];
}

/* Answer the rays of the file `path`. `answers` and `kinds` as of query_stream; `self` begins with
 * it. Returns the exit code. */
int ray_stream_run(ray_stream *q, const char *path, const char *const *answers, const char *kinds,
                   query_stream_row *row, query_stream_report *tell);

/* Add to the report of --stats how many rays got which status. */
void ray_stream_report_status(const ray_stream *q, report *out);

void ray_stream_release(ray_stream *q);

#endif
