#include "cli/stream/located_points.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/output/csv_row.h"
#include "cli/stream/query_crs.h"
#include "cli/stream/query_header.h"

#include <stdlib.h>
#include <string.h>

void located_points_release(located_points *p)
{
    if (p->moved != p->points) free(p->moved);
    free(p->points);
    free(p->located);
    free(p->row_end);
    free(p->crs);
    text_release(&p->header);
    text_release(&p->rows);
}

size_t located_points_begin_row(const located_points *p, size_t i, text *out)
{
    const size_t from = i ? p->row_end[i - 1] : 0;
    if (p->only_answers)
        csv_row_numbers(out, p->points + i * p->width, 2);
    else
        text_bytes(out, p->rows.bytes + from, p->row_end[i] - from);
    return out->size;
}

void located_points_end_row(const located_points *p, size_t begin, text *out)
{
    if (!p->only_answers) csv_row_adapt(out, begin, p->separator, p->decimal);
    csv_row_end(out);
}

size_t located_points_lost(const located_points *p)
{
    return p->where[MW_OUTSIDE] + p->where[MW_IN_HOLE] + p->where[MW_BAD];
}

/* Have room for one more block. */
static bool located_points_grow(located_points *p)
{
    if (p->room - p->count >= QUERY_BLOCK_SIZE) return true;
    const size_t room = p->count + p->count / 2 + QUERY_BLOCK_SIZE;
    double *points = realloc(p->points, room * p->width * sizeof *points);
    if (points) p->points = points;
    size_t *ends = points && p->answers ? realloc(p->row_end, room * sizeof *ends) : NULL;
    if (ends) p->row_end = ends;
    const bool grown = points && (ends || !p->answers);
    if (grown) p->room = room;
    return grown;
}

/* Keep the rows of a block. */
static int located_points_keep(located_points *p, const query_source *source, size_t count)
{
    for (size_t i = 0; i < count && p->answers; i++) {
        size_t length = 0;
        const char *row = p->only_answers ? "" : query_source_row(source, i, &length);
        text_bytes(&p->rows, row, length);
        p->row_end[p->count + i] = p->rows.size;
    }
    return p->rows.failed ? fail_memory() : 0;
}

/* The first row that is written, once the first block has told what the table is. */
static int located_points_head(located_points *p, const query_source *source,
                               const query_columns *columns, const size_t *index)
{
    mw_point_table table;
    if (!p->answers) return 0;
    query_source_table(source, &table);
    p->separator = table.separator;
    p->decimal = table.decimal;
    if (p->only_answers)
        query_header_write_answers(&p->header, columns, 2, p->answers);
    else
        query_header_write(&p->header, &table, columns, index, p->answers);
    return p->header.failed ? fail_memory() : 0;
}

static int located_points_load(located_points *p, query_source *source)
{
    for (size_t count = 1; count > 0; p->count += count) {
        if (!located_points_grow(p)) return fail_memory();
        int end =
            query_source_read(source, p->points + p->count * p->width, QUERY_BLOCK_SIZE, &count);
        if (end == 0) end = located_points_keep(p, source, count);
        if (end) return end;
        progress_points(p->count, query_source_fraction(source));
    }
    return 0;
}

static int located_points_move(located_points *p, query_crs *crs, const point_query *q)
{
    p->moved = p->points;
    if (!crs->transform) return 0;
    const size_t bytes = p->count * p->width * sizeof *p->moved;
    p->moved = malloc(bytes + 1);
    if (!p->moved) return fail_memory();
    memcpy(p->moved, p->points, bytes);
    crs->lost += gdal_transform_points(crs->transform, p->moved, p->count, p->width,
                                       q->settings->stream.common.threads);
    return 0;
}

static int located_points_locate(located_points *p, const point_query *q)
{
    p->located = malloc(p->count * sizeof *p->located + 1);
    if (!p->located) return fail_memory();
    progress_phase("locating", NULL);
    const query_block all = {.values = p->moved, .stride = p->width, .count = p->count};
    int end = point_query_locate(q, &all, p->located, NULL);
    for (size_t i = 0; i < p->count && end == 0; i++) p->where[p->located[i].where]++;
    return end;
}

static int located_points_remark(const located_points *p, const point_query *q, const char *path,
                                 const query_crs *crs)
{
    extent_box extent = {0};
    const char *shown = files_is_standard(path) ? "standard input" : path;
    if (q->settings->stream.common.quiet) return 0;
    if (crs->lost)
        complain("%s: remark: %zu points have no position in the coordinate system of the mesh; "
                 "their status is bad",
                 shown, (size_t)crs->lost);
    if (q->settings->globe) return 0;
    extent_add(&extent, p->moved, p->count, p->width);
    extent_remark(q->path, &q->extent, path, &extent, p->count - located_points_lost(p));
    return 0;
}

int located_points_read(located_points *p, const point_query *q, const char *path,
                        const char *extra)
{
    const query_stream_settings *settings = &q->settings->stream;
    const query_crs_settings crs_settings = {.domain = QUERIES_IN_PLANE,
                                             .mesh = files_is_standard(q->path) ? "standard input"
                                                                                : q->path,
                                             .mesh_crs = q->crs,
                                             .option = settings->source.crs,
                                             .quiet = settings->common.quiet};
    query_columns columns = {
        .axes = QUERY_PLANE, .names = {"x", "y", extra}, .count = extra ? 3 : 2};
    size_t index[MAX_QUERY_COLUMNS];
    query_source *source = NULL;
    query_crs crs = {0};
    p->width = columns.count;
    p->only_answers = settings->only_answers;
    columns.prefer = query_crs_prefers(&crs_settings);
    progress_phase("reading", path);
    int end = query_source_open(&source, path, &settings->source, &columns, index);
    if (end == 0) p->lonlat = query_source_is_lonlat(source);
    if (end == 0) end = query_crs_open(&crs, &crs_settings, path, source);
    if (end == 0 && crs.of_rows && !(p->crs = strdup(crs.of_rows))) end = fail_memory();
    if (end == 0) end = located_points_load(p, source);
    if (end == 0) end = located_points_head(p, source, &columns, index);
    if (end == 0) end = located_points_move(p, &crs, q);
    if (end == 0) end = located_points_locate(p, q);
    if (end == 0) end = located_points_remark(p, q, path, &crs);
    query_crs_close(&crs);
    query_source_close(source);
    return end;
}
