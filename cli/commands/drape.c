/* drape - lays lines and polygons on a mesh. */
#include "cli/commands/commands.h"
#include "cli/drape/drape_rows.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/mesh_field.h"
#include "cli/stream/point_query.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct drape_settings {
    common_settings common;
    line_file_settings lines;
    const char *field, *nodata, *outside, *crs;
    bool strict;
} drape_settings;

static const option drape_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(drape_settings, field), "NAME",
     "the height: z or a field of MESH (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(drape_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"outside-z", 0, OPTION_TEXT, offsetof(drape_settings, outside), "Z",
     "the height of points of outlines that lie outside MESH (default: -9999)", NULL},
    {"attribute", 0, OPTION_TEXT, offsetof(drape_settings, lines.attribute), "LIST",
     "which attributes are kept, by GDAL (default: all)", NULL},
    {"layer", 0, OPTION_TEXT, offsetof(drape_settings, lines.layer), "NAME",
     "of a vector file: the layer (default: the only one that has lines or polygons)", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(drape_settings, lines.columns), "LIST",
     "of a table of points: the columns that hold x and y, as names or numbers from 1", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(drape_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {"lines-crs", 0, OPTION_TEXT, offsetof(drape_settings, lines.crs), "CRS",
     "that of LINES, or 'same' as MESH (default: what LINES tell). Lines in another system than "
     "MESH are transformed",
     NULL},
    {"strict", 0, OPTION_FLAG, offsetof(drape_settings, strict), NULL,
     "exit with 1 if a part of the lines or outlines lies outside MESH", NULL},
    {0},
};

static int drape_check(const drape_settings *s, const line_file *lines, const char *path,
                       bool *polygons)
{
    int kind = drape_has_polygons(lines);
    *polygons = kind == 1;
    if (kind < 0) {
        complain("%s: has lines and polygons: drape takes one of them; --layer chooses, or ogr2ogr "
                 "parts them",
                 path);
        return END_INPUT;
    }
    if (kind == 0 || gdal_rows_known(s->common.output)) return 0;
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
    if (d->unmeasured > 0)
        complain("%s: warning: polygons without an area, or with rings that cross, whose areas are "
                 "not known: %llu",
                 path, (unsigned long long)d->unmeasured);
}

static int drape_write(const drape_settings *s, const point_query *q, const line_file *lines,
                       const char *path, double nodata)
{
    row_output out;
    drape d = {.mesh = q->mesh,
               .locator = q->locator,
               .values = mw_mesh_field(q->mesh, s->field ? s->field : "z"),
               .lines = lines,
               .path = path,
               .nodata = nodata,
               .threads = s->common.threads,
               .table = !gdal_rows_known(s->common.output),
               .quiet = s->common.quiet,
               .out = &out};
    text header = {0}, kinds = {0};
    int end = drape_check(s, lines, path, &d.polygons);
    if (end) return end;
    if (!drape_write_header(&d, &header, &kinds)) end = fail_memory();
    text_bytes(&kinds, "", 1);
    progress_phase("draping", path);
    if (end == 0) {
        end = d.table ? row_output_open(&out, s->common.output, &header, kinds.bytes, q->crs,
                                        s->common.quiet)
                      : row_output_open_draped(&out, s->common.output, &header, kinds.bytes, q->crs,
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

/* Degrees are no lengths. */
static void drape_warn_of_degrees(const point_query *q, bool quiet)
{
    if (quiet || !q->crs || !crs_is_lonlat(q->crs)) return;
    complain("%s: warning: it is in longitudes and latitudes, so lengths and areas mix degrees "
             "with heights",
             q->path);
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
    point_query_settings query = {.stream = {.common = s->common}, .crs = s->crs, .lines = true};
    mesh_field_choice field = {.field = s->field ? s->field : "z", .quiet = s->common.quiet};
    line_file lines = {0};
    point_query q = {0};
    double outside;
    int end = nodata_parse("nodata", s->nodata, &field.nodata);
    if (end == 0) end = drape_parse_outside(s->outside, &outside);
    if (end == 0 && s->lines.crs && strcmp(s->lines.crs, "same") != 0)
        end = crs_check_option("lines-crs", s->lines.crs);
    if (end) return end;
    end = point_query_open(&q, &query, operands, false, mesh_field_load, &field);
    if (end == 0)
        end = line_file_read(&lines, operands[1], &s->lines, &s->common, operands[0], q.crs);
    if (end == 0) {
        drape_warn_of_degrees(&q, s->common.quiet);
        end = drape_write(s, &q, &lines, operands[1], outside);
    }
    line_file_release(&lines);
    point_query_release(&q);
    return end;
}

static const option *const tables[] = {drape_options, common_options, NULL};

const command drape_command = {
    .name = "drape",
    .operands = "MESH LINES|POLYGONS",
    .operand_count = 2,
    .summary = "lay lines or polygons on a mesh",
    .description =
        "Writes the lines of a file with the heights of MESH, and with a point wherever they cross "
        "an edge or a vertex of it, so that they lie on the surface. Their attributes are kept, "
        "and "
        "length and surface_length added: lengths in the plane and on the surface. What lies "
        "outside MESH is left out, so a line may become several. Polygons keep their outline, and "
        "get area, surface_area and outside_area too: in the plane and on the surface where MESH "
        "is, and in the plane where it is not.",
    .options = tables,
    .essential = "field attribute layer strict output",
    .settings_size = sizeof(drape_settings),
    .run = drape_run,
};
