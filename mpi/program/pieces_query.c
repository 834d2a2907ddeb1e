/* pieces_query.c - a mesh in pieces for a command, and the stream of its points. */
#include "mpi/program/pieces_query.h"

#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/gdal/mesh_crs.h"

#include <stdlib.h>
#include <string.h>

int pieces_query_fail(const pieces_query *q, const mwp_error *from)
{
    const char *path = q->path;
    mw_error error = {
        .status = from->status, .triangle = from->triangle, .vertex = from->vertex, .line = -1};
    memcpy(error.message, from->message, sizeof error.message);
    return from->status == MW_ERROR_INPUT ? fail_mesh(path, &error) : fail_query(&error);
}

/* --- the mesh --------------------------------------------------------------------------------- */

/* The file as it is distributed: without heights and fields but the one that is asked for, if it is
 * one of vertices. */
static int file_distribute(pieces_query *q, const mw_mesh_file *file, const mw_mesh *mesh,
                           const mesh_field_choice *field)
{
    mwp_error error;
    mw_mesh_file bare = {.points = file->points,
                         .point_count = file->point_count,
                         .triangles = file->triangles,
                         .triangle_count = file->triangle_count};
    q->values = field && !(field->triangles && *field->triangles);
    char *name = q->values ? (char *)(uintptr_t)field->field : NULL;
    double *values = q->values ? (double *)(uintptr_t)mw_mesh_field(mesh, name) : NULL;
    if (q->values) {
        bare.field_names = &name; /* only read */
        bare.fields = &values;
        bare.field_count = 1;
    }
    progress_phase("distributing", q->path);
    mw_status status =
        service_scatter(q->service, &bare, q->settings->stream.common.threads, &error);
    return status ? pieces_query_fail(q, &error) : 0;
}

static int file_take(pieces_query *q, mw_mesh_file *file, const mesh_field_choice *field)
{
    mw_error error;
    mw_mesh *mesh;
    const bool quiet = q->settings->stream.common.quiet;
    const mw_arrays arrays = mw_mesh_file_arrays(file);
    extent_add(&q->extent, file->points, file->point_count, 3);
    q->vertex_count = file->point_count;
    q->vertices = malloc(2 * file->point_count * sizeof *q->vertices + 1);
    if (!q->vertices) return fail_memory();
    for (size_t v = 0; v < file->point_count; v++)
        memcpy(q->vertices + 2 * v, file->points + 3 * v, 2 * sizeof *q->vertices);
    if (mw_mesh_create(&arrays, NULL, &mesh, &error) != MW_OK) return fail_mesh(q->path, &error);
    if (!quiet) extent_warn_of_seam(q->path, &q->extent, mesh);
    q->first_number = file->first_number;
    int end = mesh_crs_settle(q->path, q->settings->crs, file->crs, quiet, &q->crs);
    if (end == 0 && field) end = mesh_field_load(mesh, q->path, file, field);
    if (end == 0) end = file_distribute(q, file, mesh, field);
    mw_mesh_destroy(mesh);
    q->faces = file->faces;
    file->faces = NULL;
    return end;
}

int pieces_query_open(pieces_query *q, service *s, const pieces_settings *settings,
                      const char *const *operands, const mesh_field_choice *field)
{
    mw_mesh_file file;
    point_query checked;
    *q = (pieces_query){
        .settings = settings, .service = s, .path = operands[0], .begin = monotonic_seconds()};
    int end = point_query_begin(&checked, settings, operands, 2);
    if (end == 0) end = point_query_check_trust(settings, q->path);
    if (end == 0) end = files_read_mesh(q->path, &file);
    if (end) return end;
    end = file_take(q, &file, field);
    mw_mesh_file_release(&file);
    return end;
}

void pieces_query_release(pieces_query *q)
{
    free(q->crs);
    free(q->faces);
    free(q->vertices);
}

mw_location pieces_location(const mwp_location *at)
{
    mw_location where = {.triangle = at->triangle < 0 ? MW_NONE : (uint32_t)at->triangle,
                         .hole = at->hole,
                         .where = at->where,
                         .local = at->local};
    memcpy(where.weight, at->weight, sizeof where.weight);
    return where;
}

int pieces_query_alone(const command *serial, const char *because, const void *settings,
                       const char *const *operands)
{
    common_settings *common = malloc(serial->settings_size); /* their first member */
    if (!common) return fail_memory();
    memcpy(common, settings, serial->settings_size);
    if (common->threads == 0) common->threads = 1;
    const int end = serial->run(common, operands);
    if (!common->quiet && (end == 0 || end == END_UNANSWERED))
        complain("remark: because of '--%s' rank 0 did all the work", because);
    free(common);
    return end;
}

int pieces_query_load(mw_mesh *mesh, const char *path, const mw_mesh_file *file, const void *self)
{
    pieces_query *q = (pieces_query *)(uintptr_t)self; /* as it was handed out */
    (void)path;
    return file_distribute(q, file, mesh, NULL);
}

static int pieces_locate_block(const pieces_query *q, const query_block *all, size_t from, size_t n,
                               uint32_t more, service_answer *answers)
{
    mwp_error error;
    const service_options options = {.tolerance = q->settings->tolerance,
                                     .threads = q->settings->stream.common.threads,
                                     .more = more};
    return service_locate(q->service, all->values + from * all->stride, all->stride, n, &options,
                          answers, &error)
               ? pieces_query_fail(q, &error)
               : 0;
}

int pieces_locate_all(const pieces_query *q, const query_block *all, uint32_t more,
                      pieces_take *take, void *self, mw_location *located)
{
    service_answer *answers = malloc(QUERY_BLOCK_SIZE * sizeof *answers);
    int end = answers ? 0 : fail_memory();
    for (size_t from = 0; from < all->count && end == 0; from += QUERY_BLOCK_SIZE) {
        const size_t left = all->count - from,
                     n = left < QUERY_BLOCK_SIZE ? left : QUERY_BLOCK_SIZE;
        end = pieces_locate_block(q, all, from, n, more, answers);
        for (size_t i = 0; i < n && end == 0; i++)
            located[from + i] = pieces_location(&answers[i].at);
        if (end == 0 && take) take(self, from, answers, n);
    }
    free(answers);
    return end;
}

int pieces_query_locate(void *self, const query_block *block, mw_location *answers)
{
    return pieces_locate_all(self, block, SERVICE_NOTHING, NULL, NULL, answers);
}

/* --- the points ------------------------------------------------------------------------------- */

typedef struct pieces_context {
    pieces_query *query;
    pieces_row *row;
    const void *self;
} pieces_context;

static int pieces_answer(void *self, const query_block *block, void *answers)
{
    const pieces_context *context = self;
    pieces_query *q = context->query;
    mwp_error error;
    const service_answer *answer = answers;
    const service_options options = {.tolerance = q->settings->tolerance,
                                     .threads = q->settings->stream.common.threads,
                                     .more = q->values ? SERVICE_VALUES : SERVICE_NOTHING,
                                     .outside = q->outside,
                                     .missing = q->missing};
    if (service_locate(q->service, block->values, block->stride, block->count, &options, answers,
                       &error))
        return pieces_query_fail(q, &error);
    for (size_t i = 0; i < block->count; i++) q->where[answer[i].at.where]++;
    extent_add(&q->points, block->values, block->count, block->stride);
    return 0;
}

static bool pieces_write_row(const void *self, const double *point, const void *answer, text *out)
{
    const pieces_context *context = self;
    return context->row(context->query, context->self, point, answer, out);
}

static void pieces_report(const void *self, report *r)
{
    const pieces_context *context = self;
    const pieces_query *q = context->query;
    mwp_mesh_info info;
    mwp_mesh_describe(q->service->mesh, &info);
    for (int i = 0; i < MW_WHERE_COUNT; i++)
        report_count(r, mw_where_name((mw_where)i), q->where[i]);
    report_count(r, "ranks", (uint64_t)q->service->wire.size);
    report_count(r, "rim_triangles", info.rim_triangles);
    report_count(r, "bytes_of_rank_0", info.bytes);
}

int pieces_query_run(pieces_query *q, const char *points, const char *const *answers,
                     const char *kinds, pieces_row *row, const void *self)
{
    pieces_context context = {q, row, self};
    const query_stream s = {
        .settings = &q->settings->stream,
        .begin = q->begin,
        .doing = "locating",
        .columns = {.axes = QUERY_PLANE, .names = {"x", "y"}, .count = 2},
        .domain = QUERIES_IN_PLANE,
        .mesh = q->path,
        .mesh_crs = q->crs,
        .heights = q->values,
        .shown = 2,
        .answers = answers,
        .kinds = kinds,
        .answer_size = sizeof(service_answer),
        .answer = pieces_answer,
        .row = pieces_write_row,
        .report = pieces_report,
        .self = &context,
    };
    const int end = query_stream_run(&s, points);
    if ((end == 0 || end == END_UNANSWERED) && !q->settings->stream.common.quiet)
        extent_remark(q->path, &q->extent, points, &q->points,
                      q->where[MW_INSIDE] + q->where[MW_ON_EDGE] + q->where[MW_ON_VERTEX] +
                          q->where[MW_NEAR]);
    return end;
}
