/* polygon_query.h - a stream of points, each with the features that contain it. */
#ifndef MW_CLI_STREAM_POLYGON_QUERY_H
#define MW_CLI_STREAM_POLYGON_QUERY_H

#include "cli/constraints/polygon_file.h"
#include "cli/stream/point_query.h"

/* Read the polygons and answer every point, with all statuses and numbers if `details`. Returns
 * the exit code. */
int polygon_query_run(const point_query_settings *settings, const polygon_file_settings *polygons,
                      const char *points, bool details);

#endif
