/* sample_pieces.c - the value that the mesh has at each point, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/output/csv_row.h"
#include "mpi/program/pieces_query.h"

#include <math.h>
#include <stdlib.h>

typedef struct sample_settings {
    pieces_settings query;
    const char *field, *nodata;
    bool status, recover;
} sample_settings;

/* What the rows are made from. */
typedef struct sampled_pieces {
    double *triangles; /* rank 0 has a field of triangles: its values; or NULL */
    bool status;
} sampled_pieces;

static const option sample_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(sample_settings, field), "NAME",
     "the value to sample: z or a field of MESH, also one of triangles (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(sample_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"status", 0, OPTION_FLAG, offsetof(sample_settings, status), NULL,
     "add the column status: inside, edge, vertex, outside, hole, near or bad; or missing, where a "
     "corner has no value",
     NULL},
    {"recover", 0, OPTION_FLAG, offsetof(sample_settings, recover), NULL,
     "make values at triangles or faces continuous; at a vertex the mean of those around it, by "
     "area",
     NULL},
    {0},
};

static bool sample_row(const pieces_query *q, const void *self, const double point[2],
                       const service_answer *answer, text *out)
{
    const sampled_pieces *s = self;
    const int64_t triangle = answer->at.triangle;
    const double value = !s->triangles  ? answer->value
                         : triangle < 0 ? NAN
                                        : s->triangles[triangle];
    (void)q;
    (void)point;
    csv_row_double(out, !isnan(value), value);
    if (s->status)
        csv_row_word(out, isnan(value) && triangle >= 0
                              ? "missing"
                              : mw_where_name((mw_where)answer->at.where));
    return !isnan(value);
}

static int sample_run(const void *settings, const char *const *operands)
{
    const sample_settings *s = settings;
    pieces_query q = {0};
    const char *field = s->field ? s->field : "z";
    const char *const answers[] = {field, s->status ? "status" : NULL, NULL};
    sampled_pieces rows = {.status = s->status};
    mesh_field_choice choice = {.field = field,
                                .quiet = s->query.stream.common.quiet,
                                .recover = s->recover,
                                .triangles = &rows.triangles};
    int end = nodata_parse("nodata", s->nodata, &choice.nodata);
    if (end) return end;
    end = pieces_query_open(&q, program_service(), &s->query, operands, &choice);
    if (end == 0)
        end = pieces_query_run(&q, operands[1], answers, s->status ? "rt" : "r", sample_row, &rows);
    pieces_query_release(&q);
    free(rows.triangles);
    return end;
}

static const option *const tables[] = {sample_options, point_query_options, query_stream_options,
                                       common_options, NULL};

const command sample_pieces_command = {
    .name = "sample",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "interpolate heights or other values at points",
    .description = "Writes what 'meshwalk sample' writes, with all ranks.",
    .options = tables,
    .essential = "columns field only-answers output",
    .settings_size = sizeof(sample_settings),
    .run = sample_run,
};
