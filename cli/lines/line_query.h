/* line_query.h - what the commands that lay lines on a mesh share: options, the mesh with its
 * heights, and the lines. */
#ifndef MW_CLI_LINES_LINE_QUERY_H
#define MW_CLI_LINES_LINE_QUERY_H

#include "cli/lines/line_file.h"
#include "cli/stream/point_query.h"

typedef struct line_query_settings {
    common_settings common;
    line_file_settings lines;
    const char *field, *nodata, *crs;
    bool strict; /* each command says what it means */
} line_query_settings;

/* For settings that begin with line_query_settings. */
extern const option line_query_options[];

typedef struct line_query {
    point_query mesh;
    line_file lines;
    const char *field;    /* its name */
    const double *values; /* one for each vertex; NaN where it is missing */
} line_query;

/* Read the mesh operands[0] and the lines operands[1]. Of a mesh in degrees a warning tells what
 * the lengths of the command are then: `degrees`. Returns 0, or an exit code after a complaint;
 * release it in both cases. */
int line_query_open(line_query *q, const line_query_settings *settings, const char *const *operands,
                    const char *degrees);
void line_query_release(line_query *q);

#endif
