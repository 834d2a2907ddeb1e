/* locate - which triangle, or which polygons, contain each point. */
#include "cli/commands/locate.h"
#include "cli/commands/commands.h"
#include "cli/frame/message.h"
#include "cli/output/location_row.h"

static const option locate_options[] = {
    {"details", 0, OPTION_FLAG, offsetof(locate_settings, details), NULL,
     "add the columns local (edge or vertex of the triangle), border_triangle, border_edge, "
     "distance (of points "
     "outside) and hole; with --polygons: the column border_of",
     NULL},
    {"base", 0, OPTION_CHOICE, offsetof(locate_settings, base), "B",
     "what triangles and faces are counted from; file: as the file of MESH counts (default: 0):",
     &location_bases},
    {"polygons", 0, OPTION_TEXT, offsetof(locate_settings, polygons.path), "FILE",
     "locate the points in the polygons of FILE (GeoJSON, .poly, what GDAL reads), without a MESH: "
     "the columns are "
     "status, feature and others",
     NULL},
    {"attribute", 0, OPTION_TEXT, offsetof(locate_settings, polygons.attribute), "LIST",
     "with --polygons: also columns with these attributes of the feature, by GDAL", NULL},
    {"polygon-layer", 0, OPTION_TEXT, offsetof(locate_settings, polygons.layer), "NAME",
     "with --polygons: the layer with the polygons (default: the only one that may have any)",
     NULL},
    {0},
};

static bool locate_row(const point_query *q, const void *self, const double point[2],
                       const mw_location *where, text *out)
{
    const locate_settings *s = self;
    const uint32_t base = location_row_base(s->base, q->first_number);
    mw_nearest_border_point hit;
    location_row_write(out, where, base, q->faces);
    if (s->details) {
        const bool away = location_row_is_away(where) &&
                          mw_nearest_border(q->locator, point[0], point[1], &hit, NULL) == MW_OK;
        location_row_details(out, where, away ? &hit : NULL, base);
    }
    return where->triangle != MW_NONE;
}

static int locate_in_polygons(const locate_settings *s, const char *const *operands)
{
    if (s->base != LOCATION_BASE_0) {
        complain("--base is for MESH, not for --polygons");
        return END_USAGE;
    }
    if (!operands[1]) return polygon_query_run(&s->query, &s->polygons, operands[0], s->details);
    complain("--polygons takes the place of MESH: only POINTS may follow, not also '%s'",
             operands[1]);
    return END_USAGE;
}

static int locate_run(const void *settings, const char *const *operands)
{
    const locate_settings *s = settings;
    point_query q;
    if (s->polygons.path) return locate_in_polygons(s, operands);
    if (!operands[1]) return options_fail_operands(&locate_command, 1);
    if (s->polygons.attribute || s->polygons.layer) {
        complain("option '--%s' needs --polygons",
                 s->polygons.attribute ? "attribute" : "polygon-layer");
        return END_USAGE;
    }
    int end = point_query_open(&q, &s->query, operands, s->details, NULL, NULL);
    const location_answers *a = &location_row_answers[s->details][q.faces != NULL];
    if (end == 0) end = point_query_run(&q, operands[1], a->names, a->kinds, locate_row, s);
    point_query_release(&q);
    return end;
}

const option *const locate_option_tables[] = {locate_options, point_query_options,
                                              query_stream_options, common_options, NULL};

const command locate_command = {
    .name = "locate",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .optional_operands = 1, /* without MESH, but with --polygons */
    .summary = "find the triangle, or the polygons, that contain each point",
    .description =
        "Writes every row of POINTS unchanged, followed by status,triangle,w0,w1,w2. The "
        "status is inside, edge, vertex, outside, hole, near or bad; the triangle is its "
        "number in MESH, from 0, or -1; w0, w1, w2 are the weights of its corners, empty if "
        "there is no triangle. If MESH has other faces than triangles, the column face is the "
        "number of the face that the triangle is cut from. A point on an edge or a corner "
        "belongs to the lowest-numbered triangle that contains it. '-' is standard input. "
        "With --polygons FILE instead of MESH the status is inside, border, outside or bad; "
        "feature is the lowest number of a feature of FILE, from 0, that contains the point "
        "or has it on its border, or -1; others are the numbers of the other features, "
        "separated by blanks.",
    .options = locate_option_tables,
    .essential = "columns details polygons only-answers output",
    .settings_size = sizeof(locate_settings),
    .run = locate_run,
};
