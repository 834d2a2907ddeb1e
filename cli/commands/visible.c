/* visible - what is seen from points, over the terrain of a mesh. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/mesh_field.h"
#include "cli/lines/line_query.h"
#include "cli/lines/sight_pairs.h"
#include "cli/output/csv_row.h"
#include "cli/raster/raster_like.h"
#include "cli/raster/raster_mesh.h"
#include "cli/raster/sight_raster.h"
#include "cli/stream/point_query.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct visible_settings {
    point_query_settings query;
    double height, target_height;
    const char *from, *to, *between, *field, *nodata, *like, *driver, *creation;
    raster_grid_wish grid;
    bool raster;
} visible_settings;

static const option visible_options[] = {
    {"from", 0, OPTION_TEXT, offsetof(visible_settings, from), "X,Y[,Z]",
     "the viewpoint, in the coordinates and heights of MESH; without Z it is above the ground. "
     "Several, separated by semicolons: how many of them see each point",
     NULL},
    {"height", 0, OPTION_LENGTH, offsetof(visible_settings, height), "H",
     "height above the ground of viewpoints without Z, and of the first points of LINES (default: "
     "0)",
     NULL},
    {"target-height", 0, OPTION_LENGTH, offsetof(visible_settings, target_height), "H",
     "height above the ground of what is looked at (default: 0)", NULL},
    {"to", 0, OPTION_TEXT, offsetof(visible_settings, to), "POINTS",
     "look at the points of this file, as 'sample' takes them: a row for each", NULL},
    {"between", 0, OPTION_TEXT, offsetof(visible_settings, between), "LINES",
     "instead, look from the first to the last point of each line of this vector file", NULL},
    {"raster", 0, OPTION_FLAG, offsetof(visible_settings, raster), NULL,
     "look at the centres of pixels: write a raster, 1 visible, 0 hidden, 255 outside of MESH; of "
     "several viewpoints the number that see it",
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

/* --- viewpoints ------------------------------------------------------------------------------- */

typedef struct visible_views {
    mw_sight_end *ends;
    mw_viewpoint *views;
    size_t count;
} visible_views;

static void views_release(visible_views *v)
{
    free(v->ends);
    free(v->views);
}

static int views_fail(const char *given)
{
    complain("option '--from' must be coordinates X,Y or X,Y,Z, or several separated by "
             "semicolons, not '%.60s'",
             given);
    return END_USAGE;
}

/* Take one viewpoint. Returns what follows, or NULL. */
static const char *views_take(mw_sight_end *end, const char *p, double height)
{
    double at[3];
    int count = 0;
    do {
        char *stop;
        at[count] = strtod(p, &stop);
        if (stop == p || !isfinite(at[count++])) return NULL;
        p = stop;
    } while (count < 3 && *p == ',' && p++);
    if (count < 2 || (*p && *p != ';')) return NULL;
    *end = (mw_sight_end){
        .x = at[0], .y = at[1], .height = count == 3 ? at[2] : height, .absolute = count == 3};
    return p;
}

/* Take the list of --from. */
static int views_parse(visible_views *v, const visible_settings *s)
{
    size_t room = 1;
    bool above = false; /* the ground is one */
    for (const char *c = s->from; *c; c++) room += *c == ';';
    v->ends = malloc(room * sizeof *v->ends);
    v->views = malloc(room * sizeof *v->views);
    if (!v->ends || !v->views) return fail_memory();
    for (const char *p = s->from;; p++) {
        mw_sight_end *end = &v->ends[v->count++];
        p = views_take(end, p, s->height);
        if (!p) return views_fail(s->from);
        above = above || !end->absolute;
        if (!*p) break;
    }
    if (above || !(s->height > 0)) return 0;
    complain("visible: --height is for a viewpoint without Z");
    return END_USAGE;
}

static void visible_warn_of_degrees(const visible_settings *s, const char *path, const char *crs)
{
    if (crs && crs_is_lonlat(crs) && !s->query.stream.common.quiet)
        complain("%s: warning: it is in longitudes and latitudes, and lines of sight are straight "
                 "in them: transform it to a projected coordinate system first",
                 path);
}

static int views_prepare(visible_views *v, const visible_settings *s, const mw_locator *locator,
                         const double *heights, const char *path, const char *crs)
{
    mw_error error;
    visible_warn_of_degrees(s, path, crs);
    for (size_t i = 0; i < v->count; i++) {
        if (mw_viewpoint_init(locator, heights, &v->ends[i], &v->views[i], &error) == MW_OK)
            continue;
        complain("%s: at %.10g,%.10g: %s", path, v->ends[i].x, v->ends[i].y, error.message);
        return END_INPUT;
    }
    return 0;
}

/* --- points ----------------------------------------------------------------------------------- */

typedef struct visible_rows {
    const visible_views *views;
    double height;
} visible_rows;

static bool visible_row(const point_query *q, const void *self, const double point[2],
                        const mw_location *where, text *out)
{
    const visible_rows *rows = self;
    mw_viewpoint view = rows->views->views[0]; /* several threads write rows */
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

/* How many of several viewpoints see the point. */
static bool visible_count_row(const point_query *q, const void *self, const double point[2],
                              const mw_location *where, text *out)
{
    const visible_rows *rows = self;
    const mw_sight_end to = {.x = point[0], .y = point[1], .height = rows->height};
    uint32_t seen = 0;
    bool known = true;
    (void)q;
    (void)where;
    for (size_t i = 0; i < rows->views->count && known; i++) {
        mw_viewpoint view = rows->views->views[i];
        mw_sight sight = mw_sight_to(&view, &to);
        known = sight.state != MW_SIGHT_UNKNOWN;
        seen += sight.state == MW_SIGHT_VISIBLE;
    }
    csv_row_count(out, known, seen);
    return known;
}

static int visible_points(const visible_settings *s, const char *path)
{
    static const char *const answers[] = {"visible", "obstacle_x", "obstacle_y", NULL},
                             *const counts[] = {"visible", NULL};
    const char *field = s->field ? s->field : "z", *operands[] = {path, s->to};
    mesh_field_choice choice = {.field = field, .quiet = s->query.stream.common.quiet};
    point_query_settings query = s->query;
    point_query q = {0};
    visible_views views = {0};
    const visible_rows rows = {&views, s->target_height};
    query.lines = true;
    int end = nodata_parse("nodata", s->nodata, &choice.nodata);
    if (end == 0) end = views_parse(&views, s);
    if (end == 0) end = point_query_open(&q, &query, operands, false, mesh_field_load, &choice);
    if (end == 0)
        end = views_prepare(&views, s, q.locator, mw_mesh_field(q.mesh, field), path, q.crs);
    if (end == 0)
        end = views.count == 1 ? point_query_run(&q, s->to, answers, "irr", visible_row, &rows)
                               : point_query_run(&q, s->to, counts, "i", visible_count_row, &rows);
    point_query_release(&q);
    views_release(&views);
    return end;
}

/* --- pairs ------------------------------------------------------------------------------------ */

static int visible_between(const visible_settings *s, const char *path)
{
    const common_settings *common = &s->query.stream.common;
    const line_query_settings query = {
        .common = *common,
        .lines = {.layer = s->query.stream.source.layer, .crs = s->query.stream.source.crs},
        .field = s->field,
        .nodata = s->nodata,
        .crs = s->query.crs};
    const char *operands[] = {path, s->between};
    line_query q = {0};
    int end = line_query_open(&q, &query, operands, "lines of sight are straight in them");
    sight_pairs pairs = {.locator = q.mesh.locator,
                         .heights = q.values,
                         .lines = &q.lines,
                         .height = s->height,
                         .target_height = s->target_height};
    progress_phase("looking", s->between);
    if (end == 0) end = sight_pairs_write(&pairs, common->output, q.mesh.crs, common->quiet);
    line_query_release(&q);
    if (end == 0 && pairs.unknown > 0 && !common->quiet)
        complain("%s: remark: %llu of its lines have an end outside of %s, or where it has no "
                 "height",
                 s->between, (unsigned long long)pairs.unknown, path);
    return end ? end : s->query.stream.strict && pairs.unknown > 0 ? END_UNANSWERED : 0;
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
    if (r->count > 1) report_count(&out, "viewpoints", r->count);
    report_count(&out, "visible", r->visible);
    report_count(&out, "hidden", r->hidden);
    report_count(&out, "empty", (uint64_t)g->columns * g->rows - r->visible - r->hidden);
    report_rounded(&out, "seconds", monotonic_seconds() - begin);
    report_end(&out);
    return files_write_text(NULL, &out.text);
}

static int visible_write(const visible_settings *s, const raster_mesh *mesh, const raster_grid *g,
                         const char *like_crs, const visible_views *views, double begin)
{
    static const char *const names[] = {"visible"};
    const common_settings *common = &s->query.stream.common;
    gdal_raster *raster;
    sight_raster work = {.views = views->views,
                         .count = views->count,
                         .grid = g,
                         .height = s->target_height,
                         .threads = common->threads};
    gdal_raster_form form = {.columns = g->columns,
                             .rows = g->rows,
                             .bands = 1,
                             .corner = {g->west, g->north},
                             .size = {g->width, g->height},
                             .type = sight_raster_type(&work),
                             .nodata = sight_raster_none(&work),
                             .names = names,
                             .crs = mesh->crs ? mesh->crs : like_crs,
                             .driver = s->driver,
                             .creation = s->creation};
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
    visible_views views = {0};
    int end = raster_grid_check(&s->grid);
    if (end == 0) end = views_parse(&views, s);
    if (end == 0) end = crs_check_option("crs", s->query.crs);
    if (end == 0) end = nodata_parse("nodata", s->nodata, &wish.field.nodata);
    if (end == 0) end = gdal_raster_check(common->output, s->driver);
    if (end == 0) end = files_check_output(common->output, inputs, s->like ? 2 : 1);
    if (end == 0) end = raster_like_read(&like, s->like);
    if (end == 0) end = raster_mesh_read(&mesh, path, &wish);
    if (end == 0) end = views_prepare(&views, s, mesh.locator, mesh.values, path, mesh.crs);
    if (end == 0 && size.resolution == 0)
        size.resolution = raster_grid_resolution(raster_mesh_area(&mesh), mesh.vertices);
    if (end == 0)
        end = s->like ? raster_like_grid(&like, &grid, path, mesh.crs, common->quiet)
                      : raster_grid_make(&grid, &size, mesh.extent);
    if (end == 0) end = visible_write(s, &mesh, &grid, like.crs, &views, begin);
    views_release(&views);
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
    if (!s->from == !s->between)
        return visible_refuse(s->from ? "--from cannot be used with --between, whose lines have "
                                        "the viewpoints"
                                      : "where is the viewpoint? Give --from X,Y,Z");
    if (s->between ? s->to || s->raster : !s->to == !s->raster)
        return visible_refuse("what is looked at? Give --to POINTS, --between LINES or --raster");
    if (s->between && s->query.stream.source.columns) return visible_refuse("--columns needs --to");
    if (of_raster && !s->raster)
        return visible_refuse(
            "--resolution, --like, --extent, --driver and --creation need --raster");
    if (s->like && (grid->extent || grid->resolution > 0))
        return visible_refuse(
            "--resolution and --extent cannot be used with --like, which sets the pixels");
    return s->raster    ? visible_raster(s, operands[0])
           : s->between ? visible_between(s, operands[0])
                        : visible_points(s, operands[0]);
}

static const option *const tables[] = {visible_options, query_stream_options, common_options, NULL};

const command visible_command = {
    .name = "visible",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "what is seen from points, over the terrain",
    .description =
        "Tells for each point of --to, or for each pixel of a raster, whether the straight line to "
        "it from the viewpoint is nowhere below the terrain. Lines that touch the terrain count as "
        "free. Writes every row of POINTS unchanged, followed by visible (1, 0, or empty outside "
        "of MESH) and obstacle_x,obstacle_y, where the terrain is first in the way. Of several "
        "viewpoints, visible is how many of them see the point. With --between, it writes a row or "
        "a feature for each line.",
    .options = tables,
    .essential = "from height to between output",
    .settings_size = sizeof(visible_settings),
    .run = visible_run,
};
