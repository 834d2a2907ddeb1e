#include "cli/input/stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"

#include <stdlib.h>
#include <string.h>

#define CHUNK ((size_t)1 << 12) /* of a block: rows that one thread formats in one go */
#define CHUNKS (STREAM_BLOCK / CHUNK)

const option stream_options[] = {
    {"strict", 0, OPTION_FLAG, offsetof(stream_settings, strict), NULL, "exit with 1 if a point has no answer", NULL},
    {"stats", 0, OPTION_FLAG, offsetof(stream_settings, stats), NULL,
     "print counts and times on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(stream_settings, json), NULL, "with --stats: as JSON", NULL},
    {0},
};

/* A stream under way: a block of it, and its rows. */
typedef struct flow {
    const stream *stream;
    mw_point_reader *reader;
    mw_output *out;
    const char *path;
    size_t width, pick[MOST_COLUMNS];
    bool in_order; /* the columns wanted come first, as they are wanted */
    double *values;
    char *answers;
    text chunk[CHUNKS];
    uint64_t unanswered[CHUNKS];
    tally tally;
} flow;

static void format_chunk(flow *f, size_t k, size_t count)
{
    const stream *s = f->stream;
    size_t begin = k * CHUNK, end = begin + CHUNK < count ? begin + CHUNK : count;
    text_clear(&f->chunk[k]);
    f->unanswered[k] = 0;
    for (size_t i = begin; i < end; i++) {
        const void *answer = f->answers + i * s->answer_size;
        f->unanswered[k] += !s->row(s->self, f->values + i * f->width, answer, &f->chunk[k]);
    }
}

/* Rows are made by several threads, none of them without work, and written in order. */
static int write_block(flow *f, size_t count)
{
    long chunks = (long)((count + CHUNK - 1) / CHUNK);
    long threads = tally_threads(f->stream->settings->common.threads);
    if (threads > chunks) threads = chunks;
#ifdef _OPENMP
#pragma omp parallel for num_threads((int)threads) if (threads > 1) schedule(dynamic)
#endif
    for (long k = 0; k < chunks; k++) format_chunk(f, (size_t)k, count);
    for (long k = 0; k < chunks; k++) {
        if (f->chunk[k].failed) return fail_memory();
        mw_output_write(f->out, f->chunk[k].bytes, f->chunk[k].size);
        f->tally.unanswered += f->unanswered[k];
    }
    return 0;
}

/* Bring the columns wanted to the front of each row. */
static void arrange(flow *f, size_t count)
{
    size_t wanted = f->stream->columns.count;
    double row[MOST_COLUMNS];
    for (size_t i = 0; i < count; i++) {
        double *values = f->values + i * f->width;
        for (size_t k = 0; k < wanted; k++) row[k] = values[f->pick[k]];
        memcpy(values, row, wanted * sizeof *row);
    }
}

static int answer_block(flow *f, size_t count)
{
    if (!f->in_order) arrange(f, count);
    queries block = {.values = f->values, .stride = f->width, .count = count, .block = f->tally.blocks};
    double begin = tally_clock();
    int end = f->stream->answer(f->stream->self, &block, f->answers);
    f->tally.answering += tally_clock() - begin;
    f->tally.queries += count;
    f->tally.blocks++;
    return end;
}

static int read_block(flow *f, size_t *count)
{
    mw_error error;
    return mw_point_reader_read(f->reader, f->values, STREAM_BLOCK, count, &error) == MW_OK ? 0 : fail_reading(&error);
}

static int pick(flow *f)
{
    const stream *s = f->stream;
    int end = columns_pick(&s->columns, f->path, f->reader, s->settings->columns, f->pick);
    f->in_order = true;
    for (size_t k = 0; k < s->columns.count; k++) f->in_order = f->in_order && f->pick[k] == k;
    return end;
}

/* A file without rows has no columns that could be wrong. */
static int run_blocks(flow *f)
{
    size_t count;
    int end = read_block(f, &count);
    if (end == 0 && count > 0) end = pick(f);
    if (end == 0) mw_output_write(f->out, f->stream->header, strlen(f->stream->header));
    while (end == 0 && count > 0 && !mw_output_failed(f->out)) { /* closing the output reports what failed */
        end = answer_block(f, count);
        if (end == 0) end = write_block(f, count);
        progress_points(f->tally.queries);
        if (end == 0) end = read_block(f, &count);
    }
    return end;
}

/* Queries and output are open. */
static int run_flow(flow *f)
{
    mw_error error;
    const stream *s = f->stream;
    f->width = mw_point_reader_width(f->reader);
    signals_remove(mw_output_temporary(f->out));
    f->values = malloc(STREAM_BLOCK * f->width * sizeof *f->values);
    f->answers = malloc(STREAM_BLOCK * s->answer_size);
    int end = f->values && f->answers ? run_blocks(f) : fail_memory();
    progress_phase("writing", NULL);
    if (mw_output_close(f->out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_remove(NULL);
    for (size_t k = 0; k < CHUNKS; k++) text_release(&f->chunk[k]);
    free(f->answers);
    free(f->values);
    return end;
}

static int print_stats(const flow *f)
{
    report r;
    report_begin(&r, f->stream->settings->json);
    report_count(&r, "points", f->tally.queries);
    f->stream->report(f->stream->self, &r);
    tally_report_times(&r, &f->tally);
    report_end(&r);
    return tally_print(&r);
}

int stream_run(const stream *s, const char *path)
{
    const stream_settings *settings = s->settings;
    const char *output = settings->common.output ? settings->common.output : "-";
    mw_error error;
    mw_point_reader_options options = {.columns = settings->columns};
    int end = 0;
    flow *f = calloc(1, sizeof *f);
    if (!f) return fail_memory();
    *f = (flow){.stream = s, .path = path, .tally = {.begin = s->begin, .ready = tally_clock()}};
    progress_phase(s->doing, path);
    if (mw_point_reader_open(path, &options, &f->reader, &error) != MW_OK)
        end = fail_reading(&error);
    else if (mw_output_open(output, &f->out, &error) != MW_OK)
        end = fail_writing(&error);
    if (end == 0) end = run_flow(f);
    mw_point_reader_close(f->reader);
    if (end == 0 && settings->stats) end = print_stats(f);
    if (end == 0 && settings->strict && f->tally.unanswered) end = END_UNLOCATED;
    free(f);
    return end;
}
