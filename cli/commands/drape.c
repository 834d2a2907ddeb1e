/* drape - lays lines and polygons on a mesh. */
#include "cli/commands/commands.h"
#include "cli/drape/drape_rows.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/lines/line_query.h"

#include <math.h>
#include <stdlib.h>

typedef struct drape_settings {
    line_query_settings query;
    const char *outside;
} drape_settings;

static const option drape_options[] = {
    {"outside-z", 0, OPTION_TEXT, offsetof(drape_settings, outside), "Z",
     "the height of points of outlines that lie outside MESH (default: -9999)", NULL},
    {"strict", 0, OPTION_FLAG, offsetof(drape_settings, query.strict), NULL,
     "exit with 1 if a part of the lines or outlines lies outside MESH", NULL},
    {0},
};

static int drape_check(const common_settings *common, const line_file *lines, const char *path,
                       bool *polygons)
{
    int kind = drape_has_polygons(lines);
    *polygons = kind == 1;
    if (kind < 0) {
        complain("%s: has both lines and polygons, but drape takes one kind; choose a layer with "
                 "--layer, or separate them with ogr2ogr",
                 path);
        return END_INPUT;
    }
    if (kind == 0 || gdal_rows_known(common->output)) return 0;
    complain("%s: polygons need a vector file as output: -o FILE.gpkg", path);
    return END_USAGE;
}

static void drape_tell(const drape *d)
{
    const char *noun = d->polygons ? "polygons" : "lines",
               *path = files_is_standard(d->path) ? "standard input" : d->path;
    if (d->quiet) return;
    if (d->lost > 0)
        complain("%s: warning: %s outside the mesh%s: %llu", path, noun,
                 d->polygons ? "" : ", which are left out", (unsigned long long)d->lost);
    if (d->part > 0)
        complain("%s: remark: %s outside the mesh in part%s: %llu", path, noun,
                 d->polygons ? "" : ", which is left out", (unsigned long long)d->part);
    if (d->dots > 0)
        complain("%s: remark: %s whose points are all equal%s: %llu", path, noun,
                 d->polygons ? "" : ", which are left out", (unsigned long long)d->dots);
    if (d->unmeasured > 0)
        complain("%s: warning: polygons without an area, or with rings that cross, whose areas are "
                 "not known: %llu",
                 path, (unsigned long long)d->unmeasured);
}

static int drape_write(const line_query_settings *s, const line_query *q, const char *path,
                       double nodata)
{
    const char *crs = q->mesh.crs;
    row_output out;
    drape d = {.mesh = q->mesh.mesh,
               .locator = q->mesh.locator,
               .values = q->values,
               .lines = &q->lines,
               .path = path,
               .nodata = nodata,
               .threads = s->common.threads,
               .table = !gdal_rows_known(s->common.output),
               .quiet = s->common.quiet,
               .out = &out};
    text header = {0}, kinds = {0};
    int end = drape_check(&s->common, &q->lines, path, &d.polygons);
    if (end) return end;
    if (!drape_write_header(&d, &header, &kinds)) end = fail_memory();
    text_bytes(&kinds, "", 1);
    progress_phase("draping", path);
    if (end == 0) {
        end = d.table ? row_output_open(&out, s->common.output, &header, kinds.bytes, crs,
                                        s->common.quiet)
                      : row_output_open_draped(&out, s->common.output, &header, kinds.bytes, crs,
                                               s->common.quiet, d.polygons);
        if (end == 0) end = drape_write_rows(&d);
        int closed = row_output_close(&out, end == 0);
        if (end == 0) end = closed;
    }
    text_release(&header);
    text_release(&kinds);
    if (end) return end;
    drape_tell(&d);
    return s->strict && d.lost + d.part > 0 ? END_UNANSWERED : 0;
}

static int drape_parse_outside(const char *given, double *z)
{
    char *stop;
    *z = -9999;
    if (!given) return 0;
    *z = strtod(given, &stop);
    if (*given && !*stop && isfinite(*z)) return 0;
    complain("option '--outside-z' must be a number, not '%.60s'", given);
    return END_USAGE;
}

static int drape_run(const void *settings, const char *const *operands)
{
    const drape_settings *s = settings;
    line_query q = {0};
    double outside;
    int end = drape_parse_outside(s->outside, &outside);
    if (end == 0)
        end =
            line_query_open(&q, &s->query, operands, "lengths and areas mix degrees with heights");
    if (end == 0) end = drape_write(&s->query, &q, operands[1], outside);
    line_query_release(&q);
    return end;
}

static const option *const tables[] = {line_query_options, drape_options, common_options, NULL};

const command drape_command = {
    .name = "drape",
    .operands = "MESH LINES|POLYGONS",
    .operand_count = 2,
    .summary = "lay lines or polygons on a mesh",
    .description =
        "Writes the lines of a file with the heights of MESH, and with a point wherever they cross "
        "an edge or a vertex of it, so that they lie on the surface. Their attributes are kept, "
        "and length and surface_length added: lengths in the plane and on the surface. Parts "
        "outside MESH are left out, so a line may become several. Polygons keep their outline and "
        "get three more attributes: area, in the plane, and surface_area, on the surface, of the "
        "part over MESH; and outside_area, in the plane, of the rest.",
    .options = tables,
    .essential = "field attribute layer strict output",
    .settings_size = sizeof(drape_settings),
    .run = drape_run,
};
