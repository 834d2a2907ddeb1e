/* constraint_file.h - files of constraints: how commands read them, and complaints about them. */
#ifndef MW_CLI_CONSTRAINTS_CONSTRAINT_FILE_H
#define MW_CLI_CONSTRAINTS_CONSTRAINT_FILE_H

#include "cli/constraints/gdal_constraints.h"

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

typedef struct constraint_file_options {
    bool quiet;  /* no warnings */
    bool strict; /* rings that are skipped are an error */
    /* a file whose layer or attributes are asked for is read with GDAL */
    gdal_constraints_options gdal;
} constraint_file_options;

/* Read constraints, with GDAL if the library does not know the format. Rings that are skipped are
 * named in warnings. Returns 0, or an exit code after a complaint. */
int constraint_file_read(const char *path, constraint_file_options options,
                         mw_constraint_file *file);

/* Do they come from a .poly file? Its segments bound a domain, without polygons. */
bool constraint_file_is_poly(const mw_constraint_file *file);

/* Refuse an output that would overwrite the .node file beside a .poly, where its points may be.
 * Returns 0, or END_USAGE after a complaint. */
int constraint_file_check_output(const char *path, const char *output);

/* Complain of two constraints that cross. `cross` are their segments; `points` are the vertices,
 * three doubles each; `split` tells that they cross although --split was given. Returns the exit
 * code. */
int constraint_file_fail_crossing(const char *path, const mw_constraint_file *file,
                                  const double *points, const uint32_t cross[2], bool split);

/* --boundary: append the constraints of a boundary to others. Afterwards only the boundary has
 * polygons; the sides of the other polygons are plain edges. Attributes of the boundary's points
 * are dropped. `boundary` stays the caller's. Returns 0, or an exit code after a complaint. */
int constraint_file_join(mw_constraint_file *constraints, const mw_constraint_file *boundary);

#endif
