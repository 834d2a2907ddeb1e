#include "cli/stream/query_stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/stream/statistics.h"
#include "src/base/threads.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK ((size_t)1 << 12) /* rows that one thread makes at a time */
#define CHUNKS (QUERY_BLOCK_SIZE / CHUNK)

const option query_stream_options[] = {
    {"strict", 0, OPTION_FLAG, offsetof(query_stream_settings, strict), NULL, "exit with 1 if a point has no answer",
     NULL},
    {"stats", 0, OPTION_FLAG, offsetof(query_stream_settings, stats), NULL,
     "print counts and times on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(query_stream_settings, json), NULL, "with --stats: as JSON", NULL},
    {0},
};

/* A stream in progress: the block in memory, and its rows. */
typedef struct query_pipeline {
    const query_stream *stream;
    mw_point_reader *reader;
    mw_output *out;
    const char *path;
    size_t width, index[MAX_QUERY_COLUMNS];
    bool in_order; /* are the wanted columns the first ones, in their order? */
    double *values;
    char *answers;
    text chunk[CHUNKS];
    uint64_t unanswered[CHUNKS];
    stream_statistics statistics;
} query_pipeline;

static void pipeline_format_chunk(query_pipeline *p, size_t k, size_t count)
{
    const query_stream *s = p->stream;
    size_t begin = k * CHUNK, end = begin + CHUNK < count ? begin + CHUNK : count;
    text_clear(&p->chunk[k]);
    p->unanswered[k] = 0;
    for (size_t i = begin; i < end; i++) {
        const void *answer = p->answers + i * s->answer_size;
        p->unanswered[k] += !s->row(s->self, p->values + i * p->width, answer, &p->chunk[k]);
    }
}

typedef struct pipeline_formatting {
    query_pipeline *pipeline;
    size_t count, chunks;
    atomic_size_t next; /* the chunk to make next */
} pipeline_formatting;

static void pipeline_format_chunks(void *work, uint32_t member)
{
    pipeline_formatting *f = work;
    (void)member;
    for (size_t k; (k = atomic_fetch_add(&f->next, 1)) < f->chunks;) pipeline_format_chunk(f->pipeline, k, f->count);
}

/* Several threads make the rows, at most one for each chunk. One thread then writes them in
 * order. */
static int pipeline_write_block(query_pipeline *p, size_t count)
{
    pipeline_formatting formatting = {p, count, (count + CHUNK - 1) / CHUNK, 0};
    size_t chunks = formatting.chunks;
    mw__team_run(mw__team(p->stream->settings->common.threads, chunks), pipeline_format_chunks, &formatting);
    for (size_t k = 0; k < chunks; k++) {
        if (p->chunk[k].failed) return fail_memory();
        mw_output_write(p->out, p->chunk[k].bytes, p->chunk[k].size);
        p->statistics.unanswered += p->unanswered[k];
    }
    return 0;
}

/* Move the wanted columns to the front of each row. */
static void pipeline_arrange_columns(query_pipeline *p, size_t count)
{
    size_t wanted = p->stream->columns.count;
    double row[MAX_QUERY_COLUMNS];
    for (size_t i = 0; i < count; i++) {
        double *values = p->values + i * p->width;
        for (size_t k = 0; k < wanted; k++) row[k] = values[p->index[k]];
        memcpy(values, row, wanted * sizeof *row);
    }
}

static int pipeline_answer_block(query_pipeline *p, size_t count)
{
    if (!p->in_order) pipeline_arrange_columns(p, count);
    query_block block = {.values = p->values, .stride = p->width, .count = count, .block = p->statistics.blocks};
    double begin = monotonic_seconds();
    int end = p->stream->answer(p->stream->self, &block, p->answers);
    p->statistics.answering += monotonic_seconds() - begin;
    p->statistics.queries += count;
    p->statistics.blocks++;
    return end;
}

static int pipeline_read_block(query_pipeline *p, size_t *count)
{
    mw_error error;
    return mw_point_reader_read(p->reader, p->values, QUERY_BLOCK_SIZE, count, &error) == MW_OK ? 0
                                                                                                : fail_reading(&error);
}

static int pipeline_find_columns(query_pipeline *p)
{
    const query_stream *s = p->stream;
    int end = query_columns_find(&s->columns, p->path, p->reader, s->settings->columns, p->index);
    p->in_order = true;
    for (size_t k = 0; k < s->columns.count; k++) p->in_order = p->in_order && p->index[k] == k;
    return end;
}

/* A file without rows needs no columns, so they are looked for after the first block is read. */
static int pipeline_run_blocks(query_pipeline *p)
{
    size_t count;
    int end = pipeline_read_block(p, &count);
    if (end == 0 && count > 0) end = pipeline_find_columns(p);
    if (end == 0) mw_output_write(p->out, p->stream->header, strlen(p->stream->header));
    /* If the output fails, closing it reports the error. */
    while (end == 0 && count > 0 && !mw_output_failed(p->out)) {
        end = pipeline_answer_block(p, count);
        if (end == 0) end = pipeline_write_block(p, count);
        progress_points(p->statistics.queries, mw_point_reader_fraction(p->reader));
        if (end == 0) end = pipeline_read_block(p, &count);
    }
    return end;
}

/* The queries and the output are open. */
static int pipeline_run(query_pipeline *p)
{
    mw_error error;
    const query_stream *s = p->stream;
    p->width = mw_point_reader_width(p->reader);
    signals_set_temporary(mw_output_temporary(p->out));
    p->values = malloc(QUERY_BLOCK_SIZE * p->width * sizeof *p->values);
    p->answers = malloc(QUERY_BLOCK_SIZE * s->answer_size);
    int end = p->values && p->answers ? pipeline_run_blocks(p) : fail_memory();
    progress_phase("writing", NULL);
    if (mw_output_close(p->out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_set_temporary(NULL);
    for (size_t k = 0; k < CHUNKS; k++) text_release(&p->chunk[k]);
    free(p->answers);
    free(p->values);
    return end;
}

static int pipeline_print_statistics(const query_pipeline *p)
{
    report r;
    report_begin(&r, p->stream->settings->json);
    report_count(&r, "points", p->statistics.queries);
    p->stream->report(p->stream->self, &r);
    statistics_report_times(&r, &p->statistics);
    report_end(&r);
    return files_write_error_text(&r.text);
}

int query_stream_run(const query_stream *s, const char *path)
{
    const query_stream_settings *settings = s->settings;
    const char *output = settings->common.output ? settings->common.output : "-";
    mw_error error;
    mw_point_reader_options options = {.columns = settings->columns};
    int end = 0;
    query_pipeline *p = calloc(1, sizeof *p);
    if (!p) return fail_memory();
    *p = (query_pipeline){.stream = s, .path = path, .statistics = {.begin = s->begin, .ready = monotonic_seconds()}};
    progress_phase(s->doing, path);
    if (mw_point_reader_open(path, &options, &p->reader, &error) != MW_OK)
        end = fail_reading(&error);
    else if (mw_output_open(output, &p->out, &error) != MW_OK)
        end = fail_writing(&error);
    if (end == 0) end = pipeline_run(p);
    mw_point_reader_close(p->reader);
    if (end == 0 && settings->stats) end = pipeline_print_statistics(p);
    if (end == 0 && settings->strict && p->statistics.unanswered) end = END_UNANSWERED;
    free(p);
    return end;
}
