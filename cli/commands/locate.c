/* locate - which triangle, or which polygons, contain each point. */
#include "cli/commands/commands.h"
#include "cli/output/csv_row.h"
#include "cli/frame/message.h"
#include "cli/stream/polygon_query.h"

typedef struct locate_settings {
    point_query_settings query;
    polygon_file_settings polygons;
    int base; /* number of the name of --base */
    bool details;
} locate_settings;

enum { BASE_0 = 0, BASE_1, BASE_FILE };
static const char *locate_base_name(int i)
{
    return (const char *[]){"0", "1", "file", NULL}[i];
}
static const choices locate_bases = {"base", locate_base_name, NULL};

static const option locate_options[] = {
    {"details", 0, OPTION_FLAG, offsetof(locate_settings, details), NULL,
     "add the columns local (edge or vertex of the triangle), border_triangle, border_edge, "
     "distance (of points "
     "outside) and hole; with --polygons: the column border_of",
     NULL},
    {"base", 0, OPTION_CHOICE, offsetof(locate_settings, base), "B",
     "what triangles and faces are counted from; file: as the file of MESH counts (default: 0):",
     &locate_bases},
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

static uint32_t locate_base(const point_query *q, const locate_settings *s)
{
    return s->base == BASE_FILE ? (uint32_t)q->first_number : (uint32_t)s->base;
}

/* Write the cells of --details. Points that lie in no triangle have a nearest border edge. */
static void locate_write_details(const point_query *q, uint32_t base, const double point[2],
                                 const mw_location *where, text *out)
{
    mw_nearest_border_point hit = {0};
    bool away = where->where == MW_OUTSIDE || where->where == MW_IN_HOLE || where->where == MW_NEAR;
    if (away) away = mw_nearest_border(q->locator, point[0], point[1], &hit, NULL) == MW_OK;
    csv_row_count(out, where->local != 255, where->local);
    csv_row_count(out, away, hit.triangle + base);
    csv_row_count(out, away, hit.edge);
    csv_row_double(out, away, hit.distance);
    csv_row_count(out, where->hole != MW_NONE, where->hole);
}

static bool locate_row(const point_query *q, const void *self, const double point[2],
                       const mw_location *where, text *out)
{
    const locate_settings *s = self;
    bool found = where->triangle != MW_NONE;
    uint32_t base = locate_base(q, s);
    csv_row_status(out, mw_where_name((mw_where)where->where),
                   found ? where->triangle + base : MW_NONE);
    if (q->faces) csv_row_count(out, found, found ? q->faces[where->triangle] + base : 0);
    csv_row_weights(out, where->triangle, where->weight);
    if (s->details) locate_write_details(q, base, point, where, out);
    return found;
}

/* Names of the answers, and what they hold; of a mesh whose file has other faces than triangles
 * also the face, behind the triangle. */
#define WEIGHTS "w0", "w1", "w2"
#define DETAILS "local", "border_triangle", "border_edge", "distance", "hole"
typedef struct locate_answers {
    const char *names[12];
    const char *kinds;
} locate_answers;

static const locate_answers answers[2][2] = {
    {{{"status", "triangle", WEIGHTS}, "tirrr"},
     {{"status", "triangle", "face", WEIGHTS}, "tiirrr"}},
    {{{"status", "triangle", WEIGHTS, DETAILS}, "tirrriiiri"},
     {{"status", "triangle", "face", WEIGHTS, DETAILS}, "tiirrriiiri"}}};

static int locate_in_polygons(const locate_settings *s, const char *const *operands)
{
    if (s->base != BASE_0) {
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
        complain("option '--%s' is for --polygons",
                 s->polygons.attribute ? "attribute" : "polygon-layer");
        return END_USAGE;
    }
    int end = point_query_open(&q, &s->query, operands, s->details, NULL, NULL);
    const locate_answers *a = &answers[s->details][q.faces != NULL];
    if (end == 0) end = point_query_run(&q, operands[1], a->names, a->kinds, locate_row, s);
    point_query_release(&q);
    return end;
}

static const option *const tables[] = {locate_options, point_query_options, query_stream_options,
                                       common_options, NULL};

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
    .options = tables,
    .essential = "columns details polygons only-answers output",
    .settings_size = sizeof(locate_settings),
    .run = locate_run,
};
