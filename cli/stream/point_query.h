/* point_query.h - what `locate` and `sample` share: a mesh in the plane, prepared for queries, and
 * a stream of points that are located in it. */
#ifndef MW_CLI_STREAM_POINT_QUERY_H
#define MW_CLI_STREAM_POINT_QUERY_H

#include "cli/stream/extent_remark.h"
#include "cli/stream/point_query_options.h"

/* Add to a report how many points got which status. `self` is the command's own data. */
typedef void point_query_count_rows(const void *self, report *r);

/* Values at the points of a block. They are interpolated together, since each look-up waits for
 * memory. */
typedef struct point_query_values {
    const double *field;      /* one for each vertex */
    double *at_points;        /* QUERY_BLOCK_SIZE of them, for the block that is being written */
    const mw_location *first; /* the answer to which the first value belongs */
} point_query_values;

static inline double point_query_value(const point_query_values *v, const mw_location *where)
{
    return v->at_points[where - v->first];
}

/* Locate a block of points elsewhere. `self` is the caller's. Returns 0, or an exit code after a
 * complaint. */
typedef int point_query_elsewhere(void *self, const query_block *block, mw_location *answers);

/* A mesh that is ready for queries. */
typedef struct point_query {
    const point_query_settings *settings;
    mw_prepared *map;        /* of a prepared file, which has mesh, locator and faces; or NULL */
    mw_mesh *own_mesh;       /* made from a file of another kind, or NULL */
    mw_locator *own_locator; /* NULL if it is that of `map` */
    const mw_mesh *mesh;
    const mw_locator *locator; /* NULL if points are located on the globe */
    mw_index *index;           /* NULL if the start has none */
    const char *path;          /* of the mesh */
    char *crs;                 /* its coordinate system; NULL: not known */
    uint32_t *own_faces;       /* of a file that is not mapped */
    const uint32_t *faces;     /* of its file, per triangle; NULL: they are the triangles */
    int first_number;          /* what its file counts from: 0 or 1 */
    extent_box extent;         /* of its vertices */
    double begin;              /* monotonic_seconds when the command began */
    point_query_count_rows *count_rows; /* NULL: tell how many points got which mw_where */
    point_query_values *values;         /* NULL: no values are asked for */
    point_query_elsewhere *elsewhere;   /* NULL: points are located here, in the locator */
    void *elsewhere_self;
} point_query;

/* Write the answer for one point, each cell behind a comma. Returns false if there is none. `self`
 * is the command's own data. Several threads call this at the same time. */
typedef bool point_query_row(const point_query *q, const void *self, const double point[2],
                             const mw_location *where, text *out);

/* Copy from the mesh's file what the rows need: the file is released before the queries begin.
 * Returns 0, or an exit code after a complaint. */
typedef int point_query_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file,
                             const void *self);

/* Read the mesh operands[0] and prepare it for queries; or map it, if it is prepared and the
 * options leave it as it was prepared. `border` tells that rows use
 * mw_nearest_border; `load` may be NULL. Returns 0, or an exit code after a complaint. Release it
 * in both cases. */
int point_query_open(point_query *q, const point_query_settings *settings,
                     const char *const *operands, bool border, point_query_load *load,
                     const void *self);
void point_query_release(point_query *q);

/* Refuse --trust for a file that is not prepared, or with options that need more than it has.
 * Returns 0, or an exit code after a complaint. */
int point_query_check_trust(const point_query_settings *settings, const char *path);

/* The same in two steps, for a mesh that comes from elsewhere. First what is asked for is checked,
 * before long work: `inputs` are the files that are read. Then the mesh is prepared, which has to
 * outlive the query; `path` is the file that it comes from, and `crs` the coordinate system that
 * this tells, or NULL. */
int point_query_begin(point_query *q, const point_query_settings *settings,
                      const char *const *inputs, int count);
int point_query_prepare(point_query *q, const mw_mesh *mesh, const char *path, const char *crs);

/* Locate a block of points. `counters` may be NULL. Returns 0, or an exit code after a
 * complaint. */
int point_query_locate(const point_query *q, const query_block *block, mw_location *answers,
                       mw_counters *counters);

/* Write the header, then the row of every point with its answer, in order. `answers` are the names
 * of the answer's cells; NULL ends them; `kinds` tell what they hold, as in query_stream.h.
 * Returns the exit code. */
int point_query_run(const point_query *q, const char *points, const char *const *answers,
                    const char *kinds, point_query_row *row, const void *self);

#endif
