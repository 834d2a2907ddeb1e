/* locate_pieces.c - which triangle contains each point, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/output/location_row.h"
#include "mpi/program/pieces_query.h"

typedef struct locate_settings {
    pieces_settings query;
    int base;
    bool details;
} locate_settings;

static const option locate_options[] = {
    {"details", 0, OPTION_FLAG, offsetof(locate_settings, details), NULL,
     "add the columns local, border_triangle, border_edge, distance (of points outside) and hole",
     NULL},
    {"base", 0, OPTION_CHOICE, offsetof(locate_settings, base), "B",
     "what triangles and faces are counted from; file: as the file of MESH counts (default: 0):",
     &location_bases},
    {0},
};

/* The border edge nearest to a point in no triangle. */
static bool locate_nearest(const pieces_query *q, const double point[2],
                           mw_nearest_border_point *hit)
{
    mwp_nearest_border_point at;
    if (mwp_nearest_border(q->service->mesh, point[0], point[1], &at, NULL) != MW_OK) return false;
    *hit = (mw_nearest_border_point){
        .triangle = (uint32_t)at.triangle, .edge = at.edge, .distance = at.distance};
    return true;
}

static bool locate_row(const pieces_query *q, const void *self, const double point[2],
                       const service_answer *answer, text *out)
{
    const locate_settings *s = self;
    const mw_location where = pieces_location(&answer->at);
    const uint32_t base = location_row_base(s->base, q->first_number);
    mw_nearest_border_point hit;
    location_row_write(out, &where, base, q->faces);
    if (s->details) {
        const bool away = location_row_is_away(&where) && locate_nearest(q, point, &hit);
        location_row_details(out, &where, away ? &hit : NULL, base);
    }
    return where.triangle != MW_NONE;
}

static int locate_run(const void *settings, const char *const *operands)
{
    const locate_settings *s = settings;
    pieces_query q;
    int end = pieces_query_open(&q, program_service(), &s->query, operands, NULL);
    const location_answers *a = &location_row_answers[s->details][q.faces != NULL];
    if (end == 0) end = pieces_query_run(&q, operands[1], a->names, a->kinds, locate_row, s);
    pieces_query_release(&q);
    return end;
}

static const option *const tables[] = {locate_options, point_query_options, query_stream_options,
                                       common_options, NULL};

const command locate_pieces_command = {
    .name = "locate",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "find the triangle that contains each point",
    .description = "Writes what 'meshwalk locate' writes, with all ranks.",
    .options = tables,
    .essential = "columns details only-answers output",
    .settings_size = sizeof(locate_settings),
    .run = locate_run,
};
