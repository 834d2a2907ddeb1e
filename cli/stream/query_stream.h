/* query_stream.h - reads a file of queries, has them answered, and writes each row again with its
 * answer behind it, in order. It works in blocks of a fixed size, so its memory does not depend on
 * the number of queries. */
#ifndef MW_CLI_STREAM_QUERY_STREAM_H
#define MW_CLI_STREAM_QUERY_STREAM_H

#include "cli/frame/options.h"
#include "cli/frame/report.h"
#include "cli/frame/text.h"
#include "cli/input/query_source.h"
#include "cli/stream/query_crs.h"

#define QUERY_BLOCK_SIZE ((size_t)1 << 18) /* queries in memory at a time */

/* The settings of the commands that answer queries, and the options that all of them have. */
typedef struct query_stream_settings {
    common_settings common;
    query_source_settings source;
    bool strict, stats, json, only_answers;
} query_stream_settings;

extern const option query_stream_options[];

/* A block of queries. Query i begins at values[i * stride]. */
typedef struct query_block {
    const double *values;
    size_t stride, count;
    uint64_t block; /* the number of this block, from 0 */
} query_block;

/* What a command does for its stream. `self` is the command's own data.
 *   _answer  answers a block; returns 0, or an exit code after a complaint
 *   _row     writes the cells of one answer, each behind a comma; returns false if there is none.
 *            The query is in the coordinate system of the mesh, as for _answer. Several threads
 *            call it at the same time
 *   _report  adds to the report of --stats, which has the number of points and the times already */
typedef int query_stream_answer(void *self, const query_block *block, void *answers);
typedef bool query_stream_row(const void *self, const double *query, const void *answer, text *out);
typedef void query_stream_report(const void *self, report *r);
/* Of answers with several rows: what row i is written from, or NULL behind the last one. There is
 * at least one. */
typedef const void *query_stream_part(const void *self, const void *answer, size_t i);

typedef struct query_stream {
    const query_stream_settings *settings;
    double begin;      /* monotonic_seconds when the command began */
    const char *doing; /* for the progress: "locating" */
    query_columns columns;
    query_domain domain;
    /* on QUERIES_IN_PLANE: its path, and its coordinate system or NULL */
    const char *mesh, *mesh_crs;
    bool heights;               /* do the answers hold values of the mesh? */
    size_t shown;               /* columns of the query that --only-answers writes */
    const char *const *answers; /* names of the answers' columns; NULL ends them */
    const char *kinds;          /* what these hold: 't' text, 'i' integer, 'r' real */
    size_t answer_size;         /* bytes of the answer to one query */
    query_stream_answer *answer;
    query_stream_row *row;
    query_stream_part *part; /* NULL: a row for each query, from its answer */
    size_t block_size;       /* queries in memory at a time; 0: QUERY_BLOCK_SIZE, the most */
    query_stream_report *report;
    void *self;
} query_stream;

/* Refuse an output that rows cannot be written to, before anything is read. Returns 0, or an exit
 * code after a complaint. */
int query_stream_check_output(const query_stream_settings *settings);

/* Write the header, then every row of the file with its answer. Returns the exit code. */
int query_stream_run(const query_stream *s, const char *path);

#endif
