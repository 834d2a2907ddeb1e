/* query.h - what `locate` and `sample` have in common: a mesh, a stream of points, a row of output for each. */
#ifndef CLI_QUERY_H
#define CLI_QUERY_H

#include "cli/input/stream.h"

#include <meshwalk/meshwalk.h>

typedef struct query_settings {
    stream_settings stream;
    double tolerance;
    uint32_t sample, steps, cells, layers;
    int walk, start, arithmetic; /* mw_walk_kind, mw_start_kind, mw_arithmetic */
    int finish, fill;            /* numbers of names of --finish and --fill */
    bool areas, any;
} query_settings;

extern const option query_options[];

/* The names that --walk and --start take. */
extern const choices query_walks, query_starts;

/* Refuse what the library does not take of --cells and --layers. Returns 0 or an exit code after a complaint. */
int query_check_index(uint32_t cells, uint32_t layers);

/* A mesh ready to be asked. */
typedef struct query {
    const query_settings *settings;
    mw_mesh *mesh;
    mw_locator *locator;
    mw_index *index; /* NULL for starts that have none */
    double begin;    /* seconds, tally_clock */
} query;

/* Write the row of one point, with its newline; false: the point has no answer. `self` is the command's own. Called by
 * several threads at a time. */
typedef bool query_row(const query *q, const void *self, const double point[2], const mw_location *where, text *out);

/* Take from the file of the mesh what the rows will need: the file is released before the queries begin. Returns 0 or an
 * exit code after a complaint. */
typedef int query_keep(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self);

/* Read the mesh and prepare it; `border`: rows will ask for the nearest border; `keep` may be NULL. Returns 0 or an exit
 * code after a complaint. Release it in either case. */
int query_open(query *q, const query_settings *settings, const char *const *operands, bool border, query_keep *keep,
               const void *self);
void query_release(query *q);

/* Write `header`, then the row of every point, in order. Returns the exit code. */
int query_run(const query *q, const char *points, const char *header, query_row *row, const void *self);

#endif
