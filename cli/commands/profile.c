/* profile - the heights of a mesh along lines, with every edge that they cross. */
#include "cli/commands/commands.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/lines/line_query.h"
#include "cli/lines/profile_rows.h"

static const option profile_options[] = {
    {"strict", 0, OPTION_FLAG, offsetof(line_query_settings, strict), NULL,
     "exit with 1 if a row has no value", NULL},
    {0},
};

static int profile_write(const line_query_settings *s, const line_query *q, const char *path)
{
    const point_query *mesh = &q->mesh;
    const line_file *lines = &q->lines;
    row_output out;
    profile p = {.mesh = mesh->mesh,
                 .locator = mesh->locator,
                 .values = q->values,
                 .name = q->field,
                 .lines = lines,
                 .out = &out,
                 .threads = s->common.threads};
    text header = {0}, kinds = {0};
    if (!profile_write_header(&p, &header, &kinds)) header.failed = true;
    progress_phase("following", path);
    int end = header.failed ? fail_memory()
                            : row_output_open(&out, s->common.output, &header, kinds.bytes,
                                              mesh->crs, s->common.quiet);
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
    if (!s->common.quiet) extent_remark(mesh->path, &mesh->extent, path, &extent, p.rows - p.empty);
    return s->strict && p.empty > 0 ? END_UNANSWERED : 0;
}

static int profile_run(const void *settings, const char *const *operands)
{
    line_query q;
    int end = line_query_open(&q, settings, operands, "chainages are in degrees");
    if (end == 0) end = profile_write(settings, &q, operands[1]);
    line_query_release(&q);
    return end;
}

static const option *const tables[] = {line_query_options, profile_options, common_options, NULL};

const command profile_command = {
    .name = "profile",
    .operands = "MESH LINES",
    .operand_count = 2,
    .summary = "the heights of the mesh along lines",
    .description =
        "Writes a row for every point where a line begins, bends, crosses an edge or a vertex of "
        "MESH, or ends: feature,part, the attributes of the line, chainage,x,y,z,triangle,at. The "
        "chainage is the length of the line up to there, in the units of MESH; z is interpolated "
        "linearly, and empty outside MESH; the triangle is the one that the line enters there, or "
        "-1; at is begin, corner (of the line), edge, vertex or end. LINES is a vector file with "
        "lines or polygons, or a table of points, which is one line.",
    .options = tables,
    .essential = "field attribute layer columns output",
    .settings_size = sizeof(line_query_settings),
    .run = profile_run,
};
