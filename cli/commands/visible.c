/* visible - what is seen from a point, over the terrain of a mesh. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/mesh_field.h"
#include "cli/output/csv_row.h"
#include "cli/raster/raster_like.h"
#include "cli/raster/raster_mesh.h"
#include "cli/raster/sight_raster.h"
#include "cli/stream/point_query.h"

#include <math.h>
#include <string.h>

typedef struct visible_settings {
    point_query_settings query;
    coordinates from;
    double height, target_height;
    const char *to, *field, *nodata, *like, *driver, *creation;
    raster_grid_wish grid;
    bool raster;
} visible_settings;

static const option visible_options[] = {
    {"from", 0, OPTION_XY_OR_XYZ, offsetof(visible_settings, from), "X,Y[,Z]",
     "the viewpoint, in the coordinates and heights of MESH; without Z it is above the ground",
     NULL},
    {"height", 0, OPTION_LENGTH, offsetof(visible_settings, height), "H",
     "height of a viewpoint without Z above the ground (default: 0)", NULL},
    {"target-height", 0, OPTION_LENGTH, offsetof(visible_settings, target_height), "H",
     "height of what is looked at above the ground (default: 0)", NULL},
    {"to", 0, OPTION_TEXT, offsetof(visible_settings, to), "POINTS",
     "look at the points of this file, as 'sample' takes them: a row for each", NULL},
    {"raster", 0, OPTION_FLAG, offsetof(visible_settings, raster), NULL,
     "look at the centres of pixels: write a raster, 1 visible, 0 hidden, 255 outside of MESH",
     NULL},
    {"resolution", 0, OPTION_LENGTH, offsetof(visible_settings, grid.resolution), "R",
     "with --raster: size of a pixel (default: about the distance of neighbours in MESH)", NULL},
    {"like", 0, OPTION_TEXT, offsetof(visible_settings, like), "RASTER",
     "with --raster: take the pixels of RASTER", NULL},
    {"extent", 0, OPTION_TEXT, offsetof(visible_settings, grid.extent), "BOX",
     "with --raster: XMIN,YMIN,XMAX,YMAX (default: that of MESH)", NULL},
    {"driver", 0, OPTION_TEXT, offsetof(visible_settings, driver), "NAME",
     "with --raster: what GDAL writes: GTiff, COG, ... (default: by the ending of the output)",
     NULL},
    {"creation", 0, OPTION_TEXT, offsetof(visible_settings, creation), "LIST",
     "with --raster: options of the driver, as COMPRESS=DEFLATE", NULL},
    {"field", 0, OPTION_TEXT, offsetof(visible_settings, field), "NAME",
     "the heights: z or a field of MESH (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(visible_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"columns", 0, OPTION_TEXT, offsetof(visible_settings, query.stream.source.columns), "LIST",
     "with --to: the columns of POINTS that hold x and y, as names or numbers from 1", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(visible_settings, query.crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {"points-crs", 0, OPTION_TEXT, offsetof(visible_settings, query.stream.source.crs), "CRS",
     "that of POINTS, or 'same' as MESH (default: what POINTS tells). Points in another system "
     "than "
     "MESH are transformed",
     NULL},
    {0},
};

static mw_sight_end visible_from(const visible_settings *s)
{
    bool absolute = s->from.count == 3;
    return (mw_sight_end){.x = s->from.at[0],
                          .y = s->from.at[1],
                          .height = absolute ? s->from.at[2] : s->height,
                          .absolute = absolute};
}

static int visible_view(const visible_settings *s, const mw_locator *locator, const double *heights,
                        const char *path, const char *crs, mw_viewpoint *view)
{
    mw_error error;
    mw_sight_end from = visible_from(s);
    if (crs && crs_is_lonlat(crs) && !s->query.stream.common.quiet)
        complain("%s: warning: it is in longitudes and latitudes, and lines of sight are straight "
                 "in them: bring it to a plane first",
                 path);
    if (mw_viewpoint_init(locator, heights, &from, view, &error) == MW_OK) return 0;
    complain("%s: %s", path, error.message);
    return END_INPUT;
}

/* --- points ----------------------------------------------------------------------------------- */

typedef struct visible_rows {
    const mw_viewpoint *view;
    double height;
} visible_rows;

static bool visible_row(const point_query *q, const void *self, const double point[2],
                        const mw_location *where, text *out)
{
    const visible_rows *rows = self;
    mw_viewpoint view = *rows->view; /* several threads write rows */
    mw_sight_end to = {.x = point[0], .y = point[1], .height = rows->height};
    mw_sight sight = mw_sight_to(&view, &to);
    bool known = sight.state != MW_SIGHT_UNKNOWN, hidden = sight.state == MW_SIGHT_HIDDEN;
    (void)q;
    (void)where;
    csv_row_word(out, !known ? "" : hidden ? "0" : "1");
    for (int k = 0; k < 2; k++)
        csv_row_double(out, hidden, view.at[k] + sight.at * (point[k] - view.at[k]));
    return known;
}

static int visible_points(const visible_settings *s, const char *path)
{
    static const char *const answers[] = {"visible", "obstacle_x", "obstacle_y", NULL};
    const char *field = s->field ? s->field : "z", *operands[] = {path, s->to};
    mesh_field_choice choice = {.field = field, .quiet = s->query.stream.common.quiet};
    point_query_settings query = s->query;
    point_query q = {0};
    mw_viewpoint view;
    query.lines = true;
    int end = nodata_parse("nodata", s->nodata, &choice.nodata);
    if (end) return end;
    end = point_query_open(&q, &query, operands, false, mesh_field_load, &choice);
    if (end == 0)
        end = visible_view(s, q.locator, mw_mesh_field(q.mesh, field), path, q.crs, &view);
    if (end == 0)
        end = point_query_run(&q, s->to, answers, "irr", visible_row,
                              &(visible_rows){&view, s->target_height});
    point_query_release(&q);
    return end;
}

/* --- a raster --------------------------------------------------------------------------------- */

static int visible_print_report(const visible_settings *s, const sight_raster *r, double begin)
{
    report out;
    const raster_grid *g = r->grid;
    const double size[2] = {g->width, g->height};
    if (s->query.stream.common.quiet) return 0;
    report_begin(&out, s->query.stream.json);
    report_count(&out, "columns", g->columns);
    report_count(&out, "rows", g->rows);
    report_numbers(&out, "resolution", size, g->width == g->height ? 1 : 2);
    report_count(&out, "visible", r->visible);
    report_count(&out, "hidden", r->hidden);
    report_count(&out, "empty", (uint64_t)g->columns * g->rows - r->visible - r->hidden);
    report_rounded(&out, "seconds", monotonic_seconds() - begin);
    report_end(&out);
    return files_write_text(NULL, &out.text);
}

static int visible_write(const visible_settings *s, const raster_mesh *mesh, const raster_grid *g,
                         const char *like_crs, const mw_viewpoint *view, double begin)
{
    static const char *const names[] = {"visible"};
    const common_settings *common = &s->query.stream.common;
    gdal_raster *raster;
    gdal_raster_form form = {.columns = g->columns,
                             .rows = g->rows,
                             .bands = 1,
                             .corner = {g->west, g->north},
                             .size = {g->width, g->height},
                             .type = RASTER_BYTE,
                             .nodata = SIGHT_PIXEL_NONE,
                             .names = names,
                             .crs = mesh->crs ? mesh->crs : like_crs,
                             .driver = s->driver,
                             .creation = s->creation};
    sight_raster work = {
        .view = view, .grid = g, .height = s->target_height, .threads = common->threads};
    int end = gdal_raster_create(&raster, common->output, &form);
    progress_phase("looking", common->output);
    if (end == 0) end = sight_raster_write(&work, raster);
    int closed = gdal_raster_close(raster, end == 0);
    if (end == 0) end = closed;
    return end ? end : visible_print_report(s, &work, begin);
}

static int visible_raster(const visible_settings *s, const char *path)
{
    double begin = monotonic_seconds();
    const common_settings *common = &s->query.stream.common;
    const char *inputs[] = {path, s->like};
    raster_mesh_settings wish = {
        .common = common,
        .field = {.field = s->field ? s->field : "z", .quiet = common->quiet},
        .crs = s->query.crs};
    raster_mesh mesh = {0};
    raster_like like = {0};
    raster_grid_wish size = s->grid;
    raster_grid grid = {0};
    mw_viewpoint view;
    int end = raster_grid_check(&s->grid);
    if (end == 0) end = crs_check_option("crs", s->query.crs);
    if (end == 0) end = nodata_parse("nodata", s->nodata, &wish.field.nodata);
    if (end == 0) end = gdal_raster_check(common->output, s->driver);
    if (end == 0) end = files_check_output(common->output, inputs, s->like ? 2 : 1);
    if (end == 0) end = raster_like_read(&like, s->like);
    if (end == 0) end = raster_mesh_read(&mesh, path, &wish);
    if (end == 0) end = visible_view(s, mesh.locator, mesh.values, path, mesh.crs, &view);
    if (end == 0 && size.resolution == 0)
        size.resolution = raster_grid_resolution(mesh.area, mesh.vertices);
    if (end == 0)
        end = s->like ? raster_like_grid(&like, &grid, path, mesh.crs, common->quiet)
                      : raster_grid_make(&grid, &size, mesh.extent);
    if (end == 0) end = visible_write(s, &mesh, &grid, like.crs, &view, begin);
    raster_grid_release(&grid);
    raster_like_release(&like);
    raster_mesh_release(&mesh);
    return end;
}

/* --- the command ------------------------------------------------------------------------------ */

static int visible_refuse(const char *why)
{
    complain("visible: %s", why);
    return END_USAGE;
}

static int visible_run(const void *settings, const char *const *operands)
{
    const visible_settings *s = settings;
    const raster_grid_wish *grid = &s->grid;
    bool of_raster = s->like || s->driver || s->creation || grid->extent || grid->resolution > 0;
    if (s->from.count == 0) return visible_refuse("where is the viewpoint? --from X,Y,Z tells");
    if (s->from.count == 3 && s->height > 0)
        return visible_refuse("--height is for a viewpoint without Z");
    if (!s->to == !s->raster)
        return visible_refuse("look at what? either --to POINTS or --raster tells");
    if (of_raster && !s->raster)
        return visible_refuse("--resolution, --like, --extent, --driver and --creation are for "
                              "--raster");
    if (s->like && (grid->extent || grid->resolution > 0))
        return visible_refuse(
            "--resolution and --extent cannot be used with --like, which sets the pixels");
    return s->raster ? visible_raster(s, operands[0]) : visible_points(s, operands[0]);
}

static const option *const tables[] = {visible_options, query_stream_options, common_options, NULL};

const command visible_command = {
    .name = "visible",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "what is seen from a point, over the terrain",
    .description =
        "Tells for each point of --to, or for each pixel of a raster, whether the straight line to "
        "it from the viewpoint is nowhere below the terrain. Lines that touch the terrain count as "
        "free. Writes every row of POINTS unchanged, followed by visible (1, 0, or empty outside "
        "of MESH) and obstacle_x,obstacle_y, where the terrain is first in the way.",
    .options = tables,
    .essential = "from height target-height to output",
    .settings_size = sizeof(visible_settings),
    .run = visible_run,
};
