/* locate_pieces.c - which triangle contains each point, by all ranks. */
#include "mpi/program/commands.h"

#include "cli/commands/commands.h"
#include "cli/commands/locate.h"
#include "cli/output/location_row.h"
#include "mpi/program/pieces_query.h"

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

/* The option that only rank 0 can obey; NULL: none is given. */
static const char *locate_option_alone(const locate_settings *s)
{
    return s->polygons.path        ? "polygons"
           : s->polygons.attribute ? "attribute"
           : s->polygons.layer     ? "polygon-layer"
           : s->query.any          ? "any"
                                   : NULL;
}

static int locate_run(const void *settings, const char *const *operands)
{
    const locate_settings *s = settings;
    const char *alone = locate_option_alone(s);
    pieces_query q;
    if (alone) return pieces_query_alone(&locate_command, alone, s, operands);
    if (!operands[1]) return options_fail_operands(&locate_command, 1);
    int end = pieces_query_open(&q, program_service(), &s->query, operands, NULL);
    const location_answers *a = &location_row_answers[s->details][q.faces != NULL];
    if (end == 0) end = pieces_query_run(&q, operands[1], a->names, a->kinds, locate_row, s);
    pieces_query_release(&q);
    return end;
}

const command locate_pieces_command = {
    .name = "locate",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .optional_operands = 1, /* as in the other program */
    .summary = "find the triangle, or the polygons, that contain each point",
    .description = "Writes what 'meshwalk locate' writes, with all ranks.",
    .options = locate_option_tables,
    .essential = "columns details polygons only-answers output",
    .settings_size = sizeof(locate_settings),
    .run = locate_run,
};
