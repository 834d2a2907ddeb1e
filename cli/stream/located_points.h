/* located_points.h - all points of a file, located in a mesh and kept: for answers that need them
 * again and again. */
#ifndef MW_CLI_STREAM_LOCATED_POINTS_H
#define MW_CLI_STREAM_LOCATED_POINTS_H

#include "cli/stream/point_query.h"

typedef struct located_points {
    double *points;       /* as they were read: `width` numbers each, x and y first */
    double *moved;        /* in the coordinate system of the mesh; may be `points` */
    mw_location *located; /* of each point */
    size_t width, count, room;
    size_t where[MW_WHERE_COUNT]; /* how many points are inside, on an edge, ... */
    bool lonlat;                  /* x and y of `points` are called longitude and latitude */
    char *crs;                    /* the system of `points`; NULL: not known */
    /* If rows are to be written again: names of the answers behind them, set before reading; NULL:
     * rows are not kept. */
    const char *const *answers;
    text header, rows; /* the first row with the names, and all other rows as they were read */
    size_t *row_end;   /* where each of them ends */
    char separator, decimal;
    bool only_answers;
} located_points;

/* Read the points and locate them in the mesh of the query. `extra` is the name of one more column
 * that is read, or NULL. `p` is all zero, except for `answers`. Returns 0, or an exit code after a
 * complaint. Release them in both cases. */
int located_points_read(located_points *p, const point_query *q, const char *path,
                        const char *extra);
void located_points_release(located_points *p);

/* Begin the row of a point: what was read, or its coordinates with --only-answers. Returns where
 * the answers begin, for the end of the row. */
size_t located_points_begin_row(const located_points *p, size_t i, text *out);
void located_points_end_row(const located_points *p, size_t begin, text *out);

/* How many points are in no triangle. */
size_t located_points_lost(const located_points *p);

#endif
