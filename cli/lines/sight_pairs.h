/* sight_pairs.h - lines of sight between the ends of lines. */
#ifndef MW_CLI_LINES_SIGHT_PAIRS_H
#define MW_CLI_LINES_SIGHT_PAIRS_H

#include "cli/lines/line_file.h"
#include "cli/lines/row_output.h"

#include <meshwalk/meshwalk.h>

typedef struct sight_pairs {
    const mw_locator *locator;
    const double *heights; /* one for each vertex; NaN where it is missing */
    const line_file *lines;
    double height, target_height; /* of the first and of the last point of each, above the ground */
    uint64_t unknown;             /* lines with an end that has no ground: counted */
} sight_pairs;

/* Write a row for each line, with its attributes and what is known of the straight line between its
 * ends: a table, or the straight lines as features. Returns 0, or an exit code after a complaint.
 *   output  NULL: standard output
 *   crs     of the mesh; NULL: not known */
int sight_pairs_write(sight_pairs *p, const char *output, const char *crs, bool quiet);

#endif
