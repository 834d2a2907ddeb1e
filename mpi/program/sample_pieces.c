/* sample_pieces.c - the value that the mesh has at each point, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/commands/commands.h"
#include "cli/commands/sample.h"
#include "mpi/program/pieces_query.h"

#include <math.h>
#include <stdlib.h>

/* What the rows are made from. */
typedef struct sampled_pieces {
    double *triangles; /* rank 0 has a field of triangles: its values; or NULL */
    bool status;
} sampled_pieces;

static bool sample_row(const pieces_query *q, const void *self, const double point[2],
                       const service_answer *answer, text *out)
{
    const sampled_pieces *s = self;
    const double value = !s->triangles      ? answer->value
                         : answer->from < 0 ? NAN
                                            : s->triangles[answer->from];
    const bool missing = s->triangles ? answer->from >= 0 && isnan(value) : answer->missing;
    (void)q;
    (void)point;
    return sample_cells_write(out, value, s->status, missing, (mw_where)answer->at.where);
}

/* The option that only rank 0 can obey; NULL: none is given. */
static const char *sample_option_alone(const sample_settings *s)
{
    return s->space                                 ? "as"
           : s->lonlat                              ? "lonlat"
           : s->centre.count                        ? "centre"
           : s->open                                ? "open"
           : s->query.any                           ? "any"
           : s->series.wide && !sample_is_series(s) ? "wide"
                                                    : NULL;
}

static int sample_field(const sample_settings *s, const char *const *operands)
{
    pieces_query q = {0};
    const char *field = s->field ? s->field : "z";
    const char *const answers[] = {field, s->status ? "status" : NULL, NULL};
    sampled_pieces rows = {.status = s->status};
    mesh_field_choice choice = {.field = field,
                                .quiet = s->query.stream.common.quiet,
                                .recover = s->series.recover,
                                .triangles = &rows.triangles};
    int end = nodata_parse("nodata", s->nodata, &choice.nodata);
    if (end) return end;
    end = pieces_query_open(&q, program_service(), &s->query, operands, &choice);
    q.outside = s->outside;
    q.missing = s->missing;
    if (end == 0)
        end = pieces_query_run(&q, operands[1], answers, s->status ? "rt" : "r", sample_row, &rows);
    pieces_query_release(&q);
    free(rows.triangles);
    return end;
}

/* Values over time: all ranks locate the points, rank 0 reads the values and interpolates them. */
static int sample_over_time(const sample_settings *s, const char *const *operands)
{
    pieces_query q = {.settings = &s->query, .service = program_service(), .path = operands[0]};
    const series_locating ranks = {
        .load = pieces_query_load, .locate = pieces_query_locate, .self = &q};
    return sample_series(s, operands, &ranks);
}

static int sample_run(const void *settings, const char *const *operands)
{
    const sample_settings *s = settings;
    const char *alone = sample_option_alone(s);
    if (alone) return pieces_query_alone(&sample_command, alone, s, operands);
    return sample_is_series(s) ? sample_over_time(s, operands) : sample_field(s, operands);
}

const command sample_pieces_command = {
    .name = "sample",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "interpolate heights or other values at points",
    .description = "Writes what 'meshwalk sample' writes, with all ranks.",
    .options = sample_option_tables,
    .essential = "columns field outside as output",
    .settings_size = sizeof(sample_settings),
    .run = sample_run,
};
