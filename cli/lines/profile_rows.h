/* profile_rows.h - the profile of lines over a mesh: a row for each crossing. */
#ifndef MW_CLI_LINES_PROFILE_ROWS_H
#define MW_CLI_LINES_PROFILE_ROWS_H

#include "cli/lines/line_file.h"
#include "cli/lines/row_output.h"

#include <meshwalk/meshwalk.h>

/* What is done, and what came of it. */
typedef struct profile {
    const mw_mesh *mesh;
    const mw_locator *locator;
    const double *values; /* one for each vertex; NaN where it is missing */
    const char *name;     /* of the values */
    const line_file *lines;
    row_output *out;
    uint32_t threads;
    uint64_t rows, empty; /* written; of these, without a value */
} profile;

/* Write the header, and the kinds of its columns, which have room for all. False if memory runs
 * out. */
bool profile_write_header(const profile *p, text *header, text *kinds);

/* Write the rows of all lines, in order. Returns 0, or an exit code after a complaint. */
int profile_write_rows(profile *p);

#endif
