/* weights_pieces.c - the weights that interpolate values of a mesh at points, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/stream/located_points.h"
#include "mpi/program/pieces_query.h"

#include <stdlib.h>

/* The entries of all points, in their order. */
typedef struct weights_work {
    pieces_query *query;
    uint32_t *row, *column;
    double *weight;
    size_t count;
} weights_work;

static void weights_take(weights_work *w, size_t row, const service_answer *answer)
{
    for (int k = 0; k < 3 && answer->corner[k] >= 0; k++, w->count++) {
        w->row[w->count] = (uint32_t)row;
        w->column[w->count] = (uint32_t)answer->corner[k];
        w->weight[w->count] = answer->weight[k];
    }
}

/* Locate some of the points, from number `from`. */
static int weights_locate_part(weights_work *w, const query_block *all, size_t from, size_t n,
                               service_answer *answers, mw_location *located)
{
    mwp_error error;
    const pieces_settings *s = w->query->settings;
    const service_options options = {
        .tolerance = s->tolerance, .threads = s->stream.common.threads, .more = SERVICE_CORNERS};
    if (service_locate(w->query->service, all->values + from * all->stride, all->stride, n,
                       &options, answers, &error))
        return pieces_query_fail(w->query, &error);
    for (size_t i = 0; i < n; i++) {
        located[from + i] = pieces_location(&answers[i].at);
        weights_take(w, from + i, &answers[i]);
    }
    return 0;
}

static int weights_locate(void *self, const query_block *all, mw_location *located)
{
    weights_work *w = self;
    const size_t entries = 3 * all->count + 1;
    service_answer *answers = malloc(QUERY_BLOCK_SIZE * sizeof *answers);
    w->row = malloc(entries * sizeof *w->row);
    w->column = malloc(entries * sizeof *w->column);
    w->weight = malloc(entries * sizeof *w->weight);
    int end = answers && w->row && w->column && w->weight ? 0 : fail_memory();
    for (size_t from = 0; from < all->count && end == 0; from += QUERY_BLOCK_SIZE) {
        const size_t left = all->count - from;
        end = weights_locate_part(w, all, from, left < QUERY_BLOCK_SIZE ? left : QUERY_BLOCK_SIZE,
                                  answers, located);
    }
    free(answers);
    return end;
}

static int weights_write(const weights_work *w, const located_points *p, const char *output)
{
    mw_error error;
    mw_operator *made;
    const mw_operator_entries entries = {.row = w->row,
                                         .column = w->column,
                                         .weight = w->weight,
                                         .count = w->count,
                                         .rows = (uint32_t)p->count,
                                         .columns = (uint32_t)w->query->vertex_count};
    const mw_weight_positions positions = {.columns = w->query->vertices,
                                           .rows = p->moved,
                                           .row_stride = p->width,
                                           .located = p->located,
                                           .degrees = p->lonlat && p->moved == p->points};
    const mw_file_options options = {.progress = progress_of_call()};
    progress_phase("writing", output);
    if (mw_operator_create_from_entries(&entries, NULL, &made, &error) != MW_OK)
        return fail_query(&error);
    mw_status status = mw_write_weights(output, made, &positions, &options, &error);
    mw_operator_destroy(made);
    return status == MW_OK ? 0 : fail_writing(&error);
}

static int weights_run(const void *settings, const char *const *operands)
{
    pieces_settings s = *(const pieces_settings *)settings;
    const char *output = s.stream.common.output;
    pieces_query pieces = {0};
    weights_work work = {.query = &pieces};
    located_points p = {0};
    if (files_is_standard(output)) {
        complain("weights needs an output: -o FILE.nc, or FILE.npz");
        return END_USAGE;
    }
    int end = files_check_output(output, operands, 2);
    if (end) return end;
    s.stream.common.output = NULL; /* the query writes no rows */
    end = pieces_query_open(&pieces, program_service(), &s, operands, NULL);
    const point_query_settings points = {.stream = s.stream};
    const point_query q = {.settings = &points,
                           .path = pieces.path,
                           .crs = pieces.crs,
                           .extent = pieces.extent,
                           .elsewhere = weights_locate,
                           .elsewhere_self = &work};
    if (end == 0) end = located_points_read(&p, &q, operands[1], NULL);
    if (end == 0) end = weights_write(&work, &p, output);
    if (end == 0 && s.stream.strict && located_points_lost(&p)) end = END_UNANSWERED;
    located_points_release(&p);
    pieces_query_release(&pieces);
    free(work.row);
    free(work.column);
    free(work.weight);
    return end;
}

static const option weights_options[] = {
    {"strict", 0, OPTION_FLAG, offsetof(pieces_settings, stream.strict), NULL,
     "exit with 1 if a point is in no triangle", NULL},
    {"layer", 0, OPTION_TEXT, offsetof(pieces_settings, stream.source.layer), "NAME",
     "of a file that GDAL reads: the layer with the points (default: the only one that has any)",
     NULL},
    {"where", 0, OPTION_TEXT, offsetof(pieces_settings, stream.source.where), "CONDITION",
     "of a file that GDAL reads: which features are read, in SQL, as \"depth > 10\" (default: all)",
     NULL},
    {0},
};

static const option *const tables[] = {weights_options, point_query_options, common_options, NULL};

const command weights_pieces_command = {
    .name = "weights",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "write the weights that interpolate values at points",
    .description = "Writes what 'meshwalk weights' writes, with all ranks.",
    .options = tables,
    .essential = "columns points-crs output",
    .settings_size = sizeof(pieces_settings),
    .run = weights_run,
};
