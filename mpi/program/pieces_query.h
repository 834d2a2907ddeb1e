/* pieces_query.h - what the commands of meshwalk-mpi share: a mesh from a file that rank 0 reads
 * and distributes, and a stream of points that all ranks locate. As cli/stream/point_query.h. */
#ifndef MWP_PROGRAM_PIECES_QUERY_H
#define MWP_PROGRAM_PIECES_QUERY_H

#include "cli/frame/options.h"
#include "cli/input/mesh_field.h"
#include "cli/stream/extent_remark.h"
#include "cli/stream/point_query.h"
#include "mpi/program/service.h"

/* The settings are those of the other program (point_query_options). Ranks have a way of their own
 * to find triangles, so walks, starts and what belongs to them make no difference. */
typedef point_query_settings pieces_settings;

typedef struct pieces_query {
    const pieces_settings *settings;
    service *service;
    const char *path;
    char *crs;       /* NULL: not known */
    uint32_t *faces; /* NULL: faces are the triangles */
    int first_number;
    bool values;          /* each point gets a value of the field of vertices */
    int outside, missing; /* as `sample` has them */
    double *vertices;     /* x, y of all vertices of the file */
    size_t vertex_count;
    extent_box extent, points;
    uint64_t where[MW_WHERE_COUNT];
    double begin;
} pieces_query;

/* Write the cells of an answer; returns false if there is none. */
typedef bool pieces_row(const pieces_query *q, const void *self, const double point[2],
                        const service_answer *answer, text *out);

/* Read the mesh operands[0] and distribute it, with the field of `field` unless that is NULL.
 * Returns 0, or an exit code after a complaint. Release it in both cases. */
int pieces_query_open(pieces_query *q, service *s, const pieces_settings *settings,
                      const char *const *operands, const mesh_field_choice *field);
void pieces_query_release(pieces_query *q);

/* The same for commands that read the mesh as the other program does (point_query.h), and keep it
 * on rank 0; of a query with the first three members. pieces_query_load is a point_query_load that
 * distributes it without values, pieces_query_locate a point_query_elsewhere. */
point_query_load pieces_query_load;
point_query_elsewhere pieces_query_locate;

/* Locate all points, a block at a time. `take` gets the answers of each block, and the number of
 * its first point; it may be NULL. Returns 0, or an exit code after a complaint. */
typedef void pieces_take(void *self, size_t from, const service_answer *answers, size_t n);
int pieces_locate_all(const pieces_query *q, const query_block *all, uint32_t more,
                      pieces_take *take, void *self, mw_location *located);

/* Let rank 0 alone do what the ranks cannot do together: it runs the command of the other program,
 * which has the same settings. `because` names the option. Returns the exit code. */
int pieces_query_alone(const command *serial, const char *because, const void *settings,
                       const char *const *operands);

/* A location as the library has it for the whole mesh. */
mw_location pieces_location(const mwp_location *at);

/* The exit code for an error of the ranks, after a complaint. */
int pieces_query_fail(const pieces_query *q, const mwp_error *from);

/* Write the header and the rows of all points. Arguments as point_query_run. */
int pieces_query_run(pieces_query *q, const char *points, const char *const *answers,
                     const char *kinds, pieces_row *row, const void *self);

#endif
