/* profile - the heights of a mesh along lines, with every edge that they cross. */
#include "cli/commands/commands.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/mesh_field.h"
#include "cli/lines/profile_rows.h"
#include "cli/stream/point_query.h"

#include <stdlib.h>
#include <string.h>

typedef struct profile_settings {
    common_settings common;
    line_file_settings lines;
    const char *field, *nodata, *crs;
    bool strict;
} profile_settings;

static const option profile_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(profile_settings, field), "NAME",
     "the value along the lines: z or a field of MESH (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(profile_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"attribute", 0, OPTION_TEXT, offsetof(profile_settings, lines.attribute), "LIST",
     "which attributes of the lines are kept, by GDAL (default: all)", NULL},
    {"layer", 0, OPTION_TEXT, offsetof(profile_settings, lines.layer), "NAME",
     "of a vector file: the layer with the lines (default: the only one that may have any)", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(profile_settings, lines.columns), "LIST",
     "of a table of points: the columns that hold x and y, as names or numbers from 1", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(profile_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {"lines-crs", 0, OPTION_TEXT, offsetof(profile_settings, lines.crs), "CRS",
     "that of LINES, or 'same' as MESH (default: what LINES tell). Lines in another system than "
     "MESH are transformed",
     NULL},
    {"strict", 0, OPTION_FLAG, offsetof(profile_settings, strict), NULL,
     "exit with 1 if a row has no value", NULL},
    {0},
};

/* Degrees are no lengths. */
static void profile_warn_of_degrees(const point_query *q, bool quiet)
{
    if (quiet || !q->crs || !crs_is_lonlat(q->crs)) return;
    complain("%s: warning: it is in longitudes and latitudes, so chainages are in degrees",
             q->path);
}

static int profile_write(const profile_settings *s, const point_query *q, const line_file *lines,
                         const char *path)
{
    const char *name = s->field ? s->field : "z";
    row_output out;
    profile p = {.mesh = q->mesh,
                 .locator = q->locator,
                 .values = mw_mesh_field(q->mesh, name),
                 .name = name,
                 .lines = lines,
                 .out = &out,
                 .threads = s->common.threads};
    text header = {0}, kinds = {0};
    if (!profile_write_header(&p, &header, &kinds)) header.failed = true;
    progress_phase("following", path);
    int end = header.failed ? fail_memory()
                            : row_output_open(&out, s->common.output, &header, kinds.bytes, q->crs,
                                              s->common.quiet);
    if (!header.failed) {
        if (end == 0) end = profile_write_rows(&p);
        int closed = row_output_close(&out, end == 0);
        if (end == 0) end = closed;
    }
    text_release(&header);
    text_release(&kinds);
    if (end) return end;
    extent_box extent = {0};
    extent_add(&extent, lines->points, lines->first[lines->count], 2);
    if (!s->common.quiet) extent_remark(q->path, &q->extent, path, &extent, p.rows - p.empty);
    return s->strict && p.empty > 0 ? END_UNANSWERED : 0;
}

static int profile_run(const void *settings, const char *const *operands)
{
    const profile_settings *s = settings;
    point_query_settings query = {.stream = {.common = s->common}, .crs = s->crs, .lines = true};
    mesh_field_choice field = {.field = s->field ? s->field : "z", .quiet = s->common.quiet};
    line_file lines = {0};
    point_query q = {0};
    int end = nodata_parse("nodata", s->nodata, &field.nodata);
    if (end == 0 && s->lines.crs && strcmp(s->lines.crs, "same") != 0)
        end = crs_check_option("lines-crs", s->lines.crs);
    if (end) return end;
    end = point_query_open(&q, &query, operands, false, mesh_field_load, &field);
    if (end == 0)
        end = line_file_read(&lines, operands[1], &s->lines, &s->common, operands[0], q.crs);
    if (end == 0) {
        profile_warn_of_degrees(&q, s->common.quiet);
        end = profile_write(s, &q, &lines, operands[1]);
    }
    line_file_release(&lines);
    point_query_release(&q);
    return end;
}

static const option *const tables[] = {profile_options, common_options, NULL};

const command profile_command = {
    .name = "profile",
    .operands = "MESH LINES",
    .operand_count = 2,
    .summary = "the heights of the mesh along lines",
    .description =
        "Writes a row for every point where a line begins, bends, crosses an edge or a vertex of "
        "MESH, or ends: feature,part, the attributes of the line, chainage,x,y,z,triangle,at. The "
        "chainage is the length of the line up to there, in the units of MESH; z is interpolated "
        "linearly, and empty outside MESH; the triangle is that in which the line goes on, or -1; "
        "at is begin, corner (of the line), edge, vertex or end. LINES is a vector file with lines "
        "or polygons, or a table of points, which is one line.",
    .options = tables,
    .essential = "field attribute layer columns output",
    .settings_size = sizeof(profile_settings),
    .run = profile_run,
};
