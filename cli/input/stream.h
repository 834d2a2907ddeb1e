/* stream.h - a file of queries and a row of CSV for each: read, answered and written in order, in blocks of a fixed size,
 * so that any number of them can be asked in bounded memory. */
#ifndef CLI_STREAM_H
#define CLI_STREAM_H

#include "cli/input/columns.h"
#include "cli/frame/options.h"
#include "cli/frame/report.h"
#include "cli/frame/tally.h"

#define STREAM_BLOCK ((size_t)1 << 18) /* queries in memory at a time */

/* The settings of the commands that answer queries, and the options that are the same for all of them. */
typedef struct stream_settings {
    common_settings common;
    const char *columns;
    bool strict, stats, json;
} stream_settings;

extern const option stream_options[];

/* A block of queries as read: that of query i begins at values[i * stride], with the columns in the order wanted. */
typedef struct queries {
    const double *values;
    size_t stride, count;
    uint64_t block; /* blocks before this one */
} queries;

/* Answer a block. Returns 0 or an exit code after a complaint. `self` is the command's own. */
typedef int stream_answer(void *self, const queries *block, void *answers);
/* Write the row of one query, with its newline; false: it has no answer. Called by several threads at a time. */
typedef bool stream_row(const void *self, const double *query, const void *answer, text *out);
/* Add to a report what --stats tells beside the number of points and the times. */
typedef void stream_report(const void *self, report *r);

/* What a command is asked, and what it does with it. */
typedef struct stream {
    const stream_settings *settings;
    double begin;      /* tally_clock when the command began */
    const char *doing; /* as the progress says it: "locating" */
    const char *header;
    columns columns;
    size_t answer_size;
    stream_answer *answer;
    stream_row *row;
    stream_report *report;
    void *self;
} stream;

/* Write the header, then the row of every query in the file. Returns the exit code. */
int stream_run(const stream *s, const char *path);

#endif
