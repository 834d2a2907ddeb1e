#include "cli/stream/query_stream.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "cli/gdal/gdal_rows.h"
#include "cli/output/csv_row.h"
#include "cli/output/prj_output.h"
#include "cli/stream/query_header.h"
#include "cli/stream/statistics.h"
#include "src/base/threads.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK ((size_t)1 << 12) /* rows that one thread makes at a time */
#define CHUNKS (QUERY_BLOCK_SIZE / CHUNK)

const option query_stream_options[] = {
    {"strict", 0, OPTION_FLAG, offsetof(query_stream_settings, strict), NULL,
     "exit with 1 if a point has no answer", NULL},
    {"stats", 0, OPTION_FLAG, offsetof(query_stream_settings, stats), NULL,
     "print counts and times on standard error when done", NULL},
    {"json", 0, OPTION_FLAG, offsetof(query_stream_settings, json), NULL, "with --stats: as JSON",
     NULL},
    {"layer", 0, OPTION_TEXT, offsetof(query_stream_settings, source.layer), "NAME",
     "of a file that GDAL reads: the layer with the points (default: the only one that has any)",
     NULL},
    {"where", 0, OPTION_TEXT, offsetof(query_stream_settings, source.where), "CONDITION",
     "of a file that GDAL reads: which features are read, in SQL, as \"depth > 10\" (default: all)",
     NULL},
    {"only-answers", 0, OPTION_FLAG, offsetof(query_stream_settings, only_answers), NULL,
     "write the coordinates and the answers, not the other columns; as CSV with commas", NULL},
    {0},
};

/* A stream in progress: the block in memory, and its rows. */
typedef struct query_pipeline {
    const query_stream *stream;
    query_source *source;
    mw_output *out;  /* NULL if `rows` are written */
    gdal_rows *rows; /* NULL if text is written */
    const char *path;
    mw_point_table table;
    size_t width, index[MAX_QUERY_COLUMNS]; /* values of a query, and their columns in the table */
    bool rows_wanted;
    char decimal; /* how answers are written; 0: not decided yet */
    query_crs crs;
    double *values;
    double *moved; /* the same in the coordinate system of the mesh; may be `values` */
    char *answers;
    text chunk[CHUNKS];
    size_t *row_end; /* with parts: in the chunk, where the rows of each query end */
    uint64_t unanswered[CHUNKS];
    stream_statistics statistics;
} query_pipeline;

/* Write what stands before the answer: the row as it was read, or the query. */
static void pipeline_begin_row(const query_pipeline *p, size_t i, text *out)
{
    size_t length;
    if (p->stream->settings->only_answers) {
        csv_row_numbers(out, p->values + i * p->width, p->stream->shown);
        return;
    }
    const char *row = query_source_row(p->source, i, &length);
    text_bytes(out, row, length);
}

/* One row. Returns whether it is an answer. */
static bool pipeline_write_row(const query_pipeline *p, size_t i, const void *answer, text *out)
{
    const query_stream *s = p->stream;
    pipeline_begin_row(p, i, out);
    size_t begin = out->size;
    bool answered = s->row(s->self, p->moved + i * p->width, answer, out);
    if (!s->settings->only_answers) csv_row_adapt(out, begin, p->table.separator, p->decimal);
    csv_row_end(out);
    return answered;
}

/* The rows of query i. Returns whether all are answers. */
static bool pipeline_write_rows(const query_pipeline *p, size_t i, text *out)
{
    const query_stream *s = p->stream;
    const void *answer = p->answers + i * s->answer_size, *part;
    if (!s->part) return pipeline_write_row(p, i, answer, out);
    bool answered = true;
    for (size_t k = 0; (part = s->part(s->self, answer, k)); k++)
        answered = pipeline_write_row(p, i, part, out) && answered;
    p->row_end[i] = out->size;
    return answered;
}

static void pipeline_format_chunk(query_pipeline *p, size_t k, size_t count)
{
    size_t begin = k * CHUNK, end = begin + CHUNK < count ? begin + CHUNK : count;
    text_clear(&p->chunk[k]);
    p->unanswered[k] = 0;
    for (size_t i = begin; i < end; i++)
        p->unanswered[k] += !pipeline_write_rows(p, i, &p->chunk[k]);
}

/* The first block tells what the columns hold. */
static int pipeline_learn_chunks(query_pipeline *p, size_t chunks)
{
    int end = 0;
    if (!p->rows || p->statistics.blocks > 1) return 0;
    for (size_t k = 0; end == 0 && k < chunks; k++)
        if (!p->chunk[k].failed)
            end = gdal_rows_learn(p->rows, p->chunk[k].bytes, p->chunk[k].size);
    return end;
}

/* Features have the point of their query, however many it has. */
static int pipeline_write_features(query_pipeline *p, size_t k, size_t count)
{
    const text *chunk = &p->chunk[k];
    size_t first = k * CHUNK, last = first + CHUNK < count ? first + CHUNK : count, begin = 0;
    int end = 0;
    if (!p->row_end)
        return gdal_rows_write(p->rows, chunk->bytes, chunk->size, p->values + first * p->width,
                               p->width);
    for (size_t i = first; end == 0 && i < last; begin = p->row_end[i++])
        end = gdal_rows_write(p->rows, chunk->bytes + begin, p->row_end[i] - begin,
                              p->values + i * p->width, 0);
    return end;
}

static int pipeline_write_chunks(query_pipeline *p, size_t chunks, size_t count)
{
    int end = pipeline_learn_chunks(p, chunks);
    for (size_t k = 0; end == 0 && k < chunks; k++) {
        const text *chunk = &p->chunk[k];
        if (chunk->failed) return fail_memory();
        if (p->rows)
            end = pipeline_write_features(p, k, count);
        else
            mw_output_write(p->out, chunk->bytes, chunk->size);
        p->statistics.unanswered += p->unanswered[k];
    }
    return end;
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
    for (size_t k; (k = atomic_fetch_add(&f->next, 1)) < f->chunks;)
        pipeline_format_chunk(f->pipeline, k, f->count);
}

/* Several threads make the rows, at most one for each chunk. One thread then writes them in
 * order. */
static int pipeline_write_block(query_pipeline *p, size_t count)
{
    pipeline_formatting formatting = {p, count, (count + CHUNK - 1) / CHUNK, 0};
    size_t chunks = formatting.chunks;
    mw__team_run(mw__team(p->stream->settings->common.threads, chunks), pipeline_format_chunks,
                 &formatting);
    return pipeline_write_chunks(p, chunks, count);
}

/* Bring the queries into the coordinate system of the mesh. */
static void pipeline_move_block(query_pipeline *p, size_t count)
{
    if (p->moved == p->values) return;
    memcpy(p->moved, p->values, count * p->width * sizeof *p->values);
    p->crs.lost += gdal_transform_points(p->crs.transform, p->moved, count, p->width,
                                         p->stream->settings->common.threads);
}

static int pipeline_answer_block(query_pipeline *p, size_t count)
{
    query_block block = {
        .values = p->moved, .stride = p->width, .count = count, .block = p->statistics.blocks};
    double begin = monotonic_seconds();
    pipeline_move_block(p, count);
    int end = p->stream->answer(p->stream->self, &block, p->answers);
    p->statistics.answering += monotonic_seconds() - begin;
    p->statistics.queries += count;
    p->statistics.blocks++;
    return end;
}

/* Answers have decimal commas where the table has them. Its first block decides. */
static int pipeline_choose_decimal(query_pipeline *p)
{
    query_source_table(p->source, &p->table);
    if (!p->decimal) p->decimal = p->table.decimal;
    if (p->decimal == p->table.decimal || p->stream->settings->only_answers) return 0;
    complain("%s: has its first decimal comma after %" PRIu64
             " rows, whose answers are already written with decimal points; --only-answers writes "
             "no table",
             p->path, p->statistics.queries);
    return END_INPUT;
}

static size_t pipeline_block_size(const query_pipeline *p)
{
    size_t size = p->stream->block_size;
    return size ? size : QUERY_BLOCK_SIZE;
}

static int pipeline_read_block(query_pipeline *p, size_t *count)
{
    double before = query_source_fraction(p->source);
    int end = query_source_read(p->source, p->values, pipeline_block_size(p), count);
    progress_part(before, query_source_fraction(p->source));
    return end == 0 && *count > 0 ? pipeline_choose_decimal(p) : end;
}

static int pipeline_open_rows(query_pipeline *p, const text *header)
{
    const query_stream *s = p->stream;
    bool only = s->settings->only_answers;
    gdal_rows_form form = {
        .header = header->bytes,
        .header_size = header->size,
        .separator = only ? ',' : p->table.separator,
        .decimal = only || !p->decimal ? '.' : p->decimal,
        .dimensions = s->shown,
        .dropped = only ? s->shown : query_source_coordinates(p->source),
        .answers = s->kinds,
        .crs = p->crs.of_rows,
        .quiet = s->settings->common.quiet,
    };
    return gdal_rows_open(&p->rows, s->settings->common.output, &form);
}

/* The coordinate system of the rows, if it is more than a guess. */
static const char *pipeline_told_crs(const query_pipeline *p)
{
    return p->crs.told ? p->crs.of_rows : NULL;
}

static int pipeline_write_header(query_pipeline *p)
{
    const query_stream *s = p->stream;
    text header = {0};
    if (s->settings->only_answers)
        query_header_write_answers(&header, &s->columns, s->shown, s->answers);
    else
        query_header_write(&header, &p->table, &s->columns, p->index, s->answers);
    int end = header.failed ? fail_memory() : 0;
    if (end == 0 && !p->rows_wanted)
        end = prj_output_check(s->settings->common.output, pipeline_told_crs(p),
                               s->settings->common.quiet);
    if (end == 0 && p->rows_wanted)
        end = pipeline_open_rows(p, &header);
    else if (end == 0)
        mw_output_write(p->out, header.bytes, header.size);
    text_release(&header);
    return end;
}

static int pipeline_run_blocks(query_pipeline *p)
{
    size_t count;
    int end = pipeline_read_block(p, &count);
    if (end == 0) end = pipeline_write_header(p);
    /* If the output fails, closing it reports the error. */
    while (end == 0 && count > 0 && !(p->out && mw_output_failed(p->out))) {
        end = pipeline_answer_block(p, count);
        if (end == 0) end = pipeline_write_block(p, count);
        progress_points(p->statistics.queries, query_source_fraction(p->source));
        if (end == 0) end = pipeline_read_block(p, &count);
    }
    return end;
}

static int pipeline_open_source(query_pipeline *p)
{
    const query_stream *s = p->stream;
    query_crs_settings crs = {.domain = s->domain,
                              .mesh = files_is_standard(s->mesh) ? "standard input" : s->mesh,
                              .mesh_crs = s->mesh_crs,
                              .option = s->settings->source.crs,
                              .heights = s->heights,
                              .quiet = s->settings->common.quiet};
    query_columns columns = s->columns;
    columns.prefer = query_crs_prefers(&crs);
    int end = query_source_open(&p->source, p->path, &s->settings->source, &columns, p->index);
    if (end) return end;
    p->width = s->columns.count;
    query_source_table(p->source, &p->table);
    return query_crs_open(&p->crs, &crs, p->path, p->source);
}

/* The queries and the output are open. */
static int pipeline_run(query_pipeline *p)
{
    mw_error error;
    const query_stream *s = p->stream;
    if (p->out) signals_set_temporary(mw_output_temporary(p->out));
    size_t most = pipeline_block_size(p), bytes = most * p->width * sizeof *p->values;
    p->values = malloc(bytes);
    p->moved = p->crs.transform ? malloc(bytes) : p->values;
    p->answers = malloc(most * s->answer_size);
    p->row_end = s->part ? malloc(most * sizeof *p->row_end) : NULL;
    bool room = p->values && p->moved && p->answers && (p->row_end || !s->part);
    int end = room ? pipeline_run_blocks(p) : fail_memory();
    progress_phase("writing", NULL);
    if (p->out && mw_output_close(p->out, end == 0, &error) != MW_OK && end == 0)
        end = fail_writing(&error);
    int closed = gdal_rows_close(p->rows, end == 0);
    if (end == 0) end = closed;
    signals_set_temporary(NULL);
    for (size_t k = 0; k < CHUNKS; k++) text_release(&p->chunk[k]);
    free(p->row_end);
    free(p->answers);
    if (p->moved != p->values) free(p->moved);
    free(p->values);
    return end;
}

static void pipeline_remark_lost(const query_pipeline *p)
{
    if (p->crs.lost == 0 || p->stream->settings->common.quiet) return;
    complain("%s: remark: %" PRIu64
             " points have no position in the coordinate system of the mesh; their status is bad",
             files_is_standard(p->path) ? "standard input" : p->path, p->crs.lost);
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

int query_stream_check_output(const query_stream_settings *settings)
{
    const char *output = settings->common.output;
    return gdal_rows_known(output) ? gdal_rows_check(output) : files_check_text_output(output);
}

int query_stream_run(const query_stream *s, const char *path)
{
    const query_stream_settings *settings = s->settings;
    const char *output = settings->common.output ? settings->common.output : "-";
    mw_error error;
    query_pipeline *p = calloc(1, sizeof *p);
    if (!p) return fail_memory();
    *p = (query_pipeline){
        .stream = s, .path = path, .statistics = {.begin = s->begin, .ready = monotonic_seconds()}};
    progress_phase(s->doing, path);
    int end = pipeline_open_source(p);
    p->rows_wanted = gdal_rows_known(output);
    if (end == 0 && !p->rows_wanted && mw_output_open(output, &p->out, &error) != MW_OK)
        end = fail_writing(&error);
    if (end == 0) end = pipeline_run(p);
    if (end == 0) pipeline_remark_lost(p);
    if (end == 0 && !p->rows_wanted)
        end = prj_output_write(output, pipeline_told_crs(p), settings->common.quiet);
    query_crs_close(&p->crs);
    query_source_close(p->source);
    if (end == 0 && settings->stats) end = pipeline_print_statistics(p);
    if (end == 0 && settings->strict && p->statistics.unanswered) end = END_UNANSWERED;
    free(p);
    return end;
}
