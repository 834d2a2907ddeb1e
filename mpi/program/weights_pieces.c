/* weights_pieces.c - the weights that interpolate values of a mesh at points, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/commands/commands.h"
#include "cli/commands/weights.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "mpi/program/pieces_query.h"

#include <stdlib.h>

/* The entries of all points, in their order. */
typedef struct weights_work {
    pieces_query *query;
    uint32_t *row, *column;
    double *weight;
    size_t count;
} weights_work;

static void weights_take(void *self, size_t from, const service_answer *answers, size_t n)
{
    weights_work *w = self;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3 && answers[i].corner[k] >= 0; k++, w->count++) {
            w->row[w->count] = (uint32_t)(from + i);
            w->column[w->count] = (uint32_t)answers[i].corner[k];
            w->weight[w->count] = answers[i].weight[k];
        }
}

static int weights_locate(void *self, const query_block *all, mw_location *located)
{
    weights_work *w = self;
    const size_t entries = 3 * all->count + 1;
    w->row = malloc(entries * sizeof *w->row);
    w->column = malloc(entries * sizeof *w->column);
    w->weight = malloc(entries * sizeof *w->weight);
    if (!w->row || !w->column || !w->weight) return fail_memory();
    return pieces_locate_all(w->query, all, SERVICE_CORNERS, weights_take, w, located);
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
    progress_phase("weighing", NULL);
    if (mw_operator_create_from_entries(&entries, NULL, &made, &error) != MW_OK)
        return fail_query(&error);
    const weights_result result = {.stream = &w->query->settings->stream,
                                   .points = p,
                                   .vertices = w->query->vertices,
                                   .weights = made};
    const int end = weights_finish(&result, output);
    mw_operator_destroy(made);
    return end;
}

static int weights_at_points(const weights_settings *all, const char *const *operands)
{
    pieces_settings s = all->query;
    const char *output = s.stream.common.output;
    pieces_query pieces = {0};
    weights_work work = {.query = &pieces};
    located_points p = {0};
    int end = weights_check(output, operands);
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
    located_points_release(&p);
    pieces_query_release(&pieces);
    free(work.row);
    free(work.column);
    free(work.weight);
    return end;
}

/* The option that only rank 0 can obey; NULL: none is given. */
static const char *weights_option_alone(const weights_settings *s)
{
    return s->method      ? "method"
           : s->values    ? "values"
           : s->norm      ? "norm"
           : s->lonlat    ? "lonlat"
           : s->open      ? "open"
           : s->query.any ? "any"
                          : NULL;
}

static int weights_run(const void *settings, const char *const *operands)
{
    const weights_settings *s = settings;
    const char *alone = weights_option_alone(s);
    return alone ? pieces_query_alone(&weights_command, alone, s, operands)
                 : weights_at_points(s, operands);
}

const command weights_pieces_command = {
    .name = "weights",
    .operands = "MESH POINTS|GRID",
    .operand_count = 2,
    .summary = "write the weights that interpolate values at points",
    .description = "Writes what 'meshwalk weights' writes, with all ranks.",
    .options = weights_option_tables,
    .essential = "method columns points-crs stats output",
    .settings_size = sizeof(weights_settings),
    .run = weights_run,
};
