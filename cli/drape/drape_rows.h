/* drape_rows.h - lines and polygons laid on a mesh, as rows: those of a table, or features. */
#ifndef MW_CLI_DRAPE_DRAPE_ROWS_H
#define MW_CLI_DRAPE_DRAPE_ROWS_H

#include "cli/lines/line_file.h"
#include "cli/lines/row_output.h"

#include <meshwalk/meshwalk.h>

typedef struct drape {
    const mw_mesh *mesh;
    const mw_locator *locator;
    const double *values; /* of each vertex, NaN where it is missing */
    const line_file *lines;
    const char *path; /* of the lines */
    double nodata;    /* height of points of outlines that have none */
    uint32_t threads;
    bool polygons, table, quiet;
    row_output *out;
    uint64_t rows;       /* written */
    uint64_t lost, part; /* lines or polygons without any height, and those with some */
    uint64_t dots;       /* those whose points are all equal */
    uint64_t unmeasured; /* polygons whose area is not known */
} drape;

/* Are the lines rings of polygons? All are, or none is; -1: some are. */
int drape_has_polygons(const line_file *lines);

/* The header of the rows and the kinds of its cells. False without memory. */
bool drape_write_header(const drape *d, text *header, text *kinds);

/* Returns 0, or an exit code after a complaint. */
int drape_write_rows(drape *d);

#endif
