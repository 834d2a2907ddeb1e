/* raster - a raster of a mesh, by GDAL. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/monotonic_clock.h"
#include "cli/frame/progress.h"
#include "cli/frame/report.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/raster/raster_bands.h"
#include "cli/raster/raster_like.h"
#include "cli/raster/raster_mean.h"
#include "cli/raster/raster_series.h"

#include <math.h>
#include <stdlib.h>

enum { OUTSIDE_EMPTY = 0, OUTSIDE_NEAREST };
enum { TYPE_AUTO = 0, TYPE_FLOAT32, TYPE_FLOAT64 };

typedef struct raster_settings {
    common_settings common;
    raster_grid_wish grid;
    const char *time, *values;
    const char *like, *field, *derive, *nodata, *vertex_nodata, *driver, *creation, *crs;
    double max_edge;
    int outside, type;
    bool json, mean;
} raster_settings;

static const char *empty_or_nearest_name(int i)
{
    return (const char *[]){"empty", "nearest", NULL}[i];
}
static const char *empty_or_nearest_help(int i)
{
    return (const char *[]){"no value", "the value at the nearest point of the border"}[i];
}
static const choices raster_outside_choices = {"way of --outside", empty_or_nearest_name,
                                               empty_or_nearest_help};

static const char *pixel_type_name(int i)
{
    return (const char *[]){"auto", "float32", "float64", NULL}[i];
}
static const char *pixel_type_help(int i)
{
    return (const char *[]){"float32; of hillshade alone bytes, of triangle alone int32, of "
                            "triangle and others float64",
                            "4 bytes", "8 bytes: the values of 'sample', to the last bit"}[i];
}
static const choices pixel_type_choices = {"type of pixels", pixel_type_name, pixel_type_help};

static const option raster_options[] = {
    {"resolution", 0, OPTION_LENGTH, offsetof(raster_settings, grid.resolution), "R",
     "size of a pixel, in units of MESH (default: about the distance of neighbours in MESH; it is "
     "printed)",
     NULL},
    {"like", 0, OPTION_TEXT, offsetof(raster_settings, like), "RASTER",
     "take the pixels of RASTER: their number, position and size, and its nodata value", NULL},
    {"extent", 0, OPTION_TEXT, offsetof(raster_settings, grid.extent), "BOX",
     "XMIN,YMIN,XMAX,YMAX of the raster (default: that of MESH, grown to multiples of R)", NULL},
    {"field", 0, OPTION_TEXT, offsetof(raster_settings, field), "NAME",
     "the value of the pixels: z or a field of MESH (default: z)", NULL},
    {"time", 0, OPTION_TEXT, offsetof(raster_settings, time), "STEPS",
     "values over time: all, FIRST..LAST or N (steps, from 0), or nearest:T. A band for each step "
     "and field; --field is a list then (default: all fields over time)",
     NULL},
    {"values", 0, OPTION_TEXT, offsetof(raster_settings, values), "FILE",
     "the file with the values over time, or several with commas between them, each with later "
     "times than the one before (default: MESH)",
     NULL},
    {"mean", 0, OPTION_FLAG, offsetof(raster_settings, mean), NULL,
     "the mean over the part of each pixel that MESH covers, by area, instead of the value at its "
     "centre",
     NULL},
    {"derive", 0, OPTION_TEXT, offsetof(raster_settings, derive), "LIST",
     "instead, a band for each of slope, aspect (degrees), hillshade, triangle (its number)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(raster_settings, nodata), "V",
     "what pixels without a value get (default: that of --like; else nan, of hillshade alone 0, of "
     "triangle alone -1)",
     NULL},
    {"outside", 0, OPTION_CHOICE, offsetof(raster_settings, outside), "NAME",
     "what a pixel outside the mesh gets (default: empty):", &raster_outside_choices},
    {"max-edge", 0, OPTION_LENGTH, offsetof(raster_settings, max_edge), "L",
     "first peel triangles off the border while they have a border edge longer than L", NULL},
    {"vertex-nodata", 0, OPTION_TEXT, offsetof(raster_settings, vertex_nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"type", 0, OPTION_CHOICE, offsetof(raster_settings, type), "NAME",
     "type of the pixels (default: auto):", &pixel_type_choices},
    {"driver", 0, OPTION_TEXT, offsetof(raster_settings, driver), "NAME",
     "what GDAL writes: GTiff, COG, ... (default: by the ending of the output)", NULL},
    {"creation", 0, OPTION_TEXT, offsetof(raster_settings, creation), "LIST",
     "options of the driver, as COMPRESS=DEFLATE,TILED=YES", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(raster_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what it tells)", NULL},
    {"json", 0, OPTION_FLAG, offsetof(raster_settings, json), NULL, "print the report as JSON",
     NULL},
    {0},
};

/* What the command reads and makes. */
typedef struct raster_work {
    raster_mesh_settings wish;
    raster_mesh mesh;
    raster_grid grid;
    raster_like like;
    raster_scan *scan;
    raster_bands bands;
    raster_series series;
    raster_mean mean;
    gdal_raster *raster;
    double begin;
} raster_work;

static int raster_refuse(const char *why)
{
    complain("raster: %s", why);
    return END_USAGE;
}

/* --- settings --------------------------------------------------------------------------------- */

static raster_type raster_type_of(const raster_settings *s, const raster_bands *b)
{
    bool triangle = false;
    if (s->type != TYPE_AUTO) return s->type == TYPE_FLOAT64 ? RASTER_FLOAT64 : RASTER_FLOAT32;
    for (uint32_t k = 0; k < b->count; k++) triangle = triangle || b->bands[k] == BAND_TRIANGLE;
    if (triangle) return b->count == 1 ? RASTER_INT32 : RASTER_FLOAT64;
    return b->count == 1 && b->bands[0] == BAND_HILLSHADE ? RASTER_BYTE : RASTER_FLOAT32;
}

static double nodata_of_type(raster_type type)
{
    return type == RASTER_BYTE ? 0 : type == RASTER_INT32 ? -1 : (double)NAN;
}

/* Can a pixel of this type have the value? */
static bool type_holds(raster_type type, double value)
{
    switch (type) {
    case RASTER_BYTE: return value >= 0 && value <= 255 && value == floor(value);
    case RASTER_INT32: return value >= INT32_MIN && value < 0 && value == floor(value);
    case RASTER_FLOAT32: return isnan(value) || (double)(float)value == value;
    case RASTER_FLOAT64: break;
    }
    return true;
}

static int raster_choose_nodata(const raster_settings *s, raster_bands *b)
{
    char *end;
    b->nodata = nodata_of_type(b->type);
    if (!s->nodata) return 0;
    b->nodata = strtod(s->nodata, &end);
    if (*s->nodata && !*end && type_holds(b->type, b->nodata)) return 0;
    complain("option '--nodata' must be a number that a pixel can have, not '%.60s'", s->nodata);
    return END_USAGE;
}

static int raster_choose_bands(const raster_settings *s, raster_bands *b)
{
    b->bands[0] = BAND_VALUE;
    b->count = s->derive ? raster_bands_parse(s->derive, b->bands) : 1;
    if (b->count == 0) return END_USAGE;
    for (uint32_t k = 0; s->mean && k < b->count; k++)
        if (b->bands[k] == BAND_TRIANGLE)
            return raster_refuse("--derive triangle cannot be used with --mean: a mean of triangle "
                                 "numbers has no meaning");
    b->type = raster_type_of(s, b);
    return raster_choose_nodata(s, b);
}

/* Refuse wrong settings before the work begins. */
static int raster_check_settings(const raster_settings *s, const char *mesh, raster_work *w)
{
    const char *inputs[] = {mesh, s->values ? s->values : mesh, s->like};
    if (s->like && (s->grid.extent || s->grid.resolution > 0))
        return raster_refuse(
            "--resolution and --extent cannot be used with --like, which sets the pixels");
    if (s->values && !s->time)
        return raster_refuse("--values needs --time: it is for values over time");
    if (s->time && (s->derive || s->outside != OUTSIDE_EMPTY || s->vertex_nodata))
        return raster_refuse("--derive, --outside and --vertex-nodata cannot be used with --time");
    if (s->mean && s->outside != OUTSIDE_EMPTY)
        return raster_refuse("--outside cannot be used with --mean");
    int end = s->time ? series_check_time(s->time) : 0;
    if (end == 0) end = raster_grid_check(&s->grid);
    if (end == 0) end = raster_choose_bands(s, &w->bands);
    if (end == 0) end = crs_check_option("crs", s->crs);
    if (end == 0) end = nodata_parse("vertex-nodata", s->vertex_nodata, &w->wish.field.nodata);
    if (end == 0) end = gdal_raster_check(s->common.output, s->driver);
    return end ? end : files_check_output(s->common.output, inputs, s->like ? 3 : 2);
}

/* --- the grid --------------------------------------------------------------------------------- */

static int raster_make_grid(const raster_settings *s, const char *path, raster_work *w)
{
    raster_grid_wish wish = s->grid;
    double nodata = w->like.form.nodata;
    if (s->like && !s->nodata && !isnan(nodata) && type_holds(w->bands.type, nodata))
        w->bands.nodata = nodata;
    if (s->like) return raster_like_grid(&w->like, &w->grid, path, w->mesh.crs, s->common.quiet);
    if (wish.resolution == 0)
        wish.resolution = raster_grid_resolution(raster_mesh_area(&w->mesh), w->mesh.vertices);
    return raster_grid_make(&w->grid, &wish, w->mesh.extent);
}

/* --- the raster ------------------------------------------------------------------------------- */

/* Centres of pixels are taken as they are, as the points of all commands. Say so if longitudes that
 * are counted from another meridian leave out a column of them. */
static void raster_warn_of_seam(const char *path, const raster_work *w)
{
    const raster_grid *g = &w->grid;
    const double *mesh = w->mesh.extent, east = g->west + g->columns * g->width;
    for (int turn = -360; turn <= 360; turn += 720) {
        if (fmin(mesh[2] + turn, east) - fmax(mesh[0] + turn, g->west) <= g->width / 2) continue;
        complain("%s: warning: its longitudes are from %g to %g, but those of the raster from %g "
                 "to %g: pixels that lie in the mesh only with 360 degrees %s have no value; set "
                 "--extent to the extent of the mesh, or use --mean, which finds them",
                 path, mesh[0], mesh[2], g->west, east, turn < 0 ? "more" : "less");
        return;
    }
}

static void raster_warn(const raster_settings *s, const char *path, const raster_work *w)
{
    const raster_bands *b = &w->bands;
    bool angles = s->derive && (b->count > 1 || b->bands[0] != BAND_TRIANGLE);
    if (s->common.quiet) return;
    if (angles && w->mesh.crs && crs_is_lonlat(w->mesh.crs))
        complain("%s: warning: it is in longitudes and latitudes, so its slopes are heights over "
                 "degrees: transform it to a projected coordinate system first",
                 path);
    if (!s->mean && w->mesh.crs && crs_is_lonlat(w->mesh.crs)) raster_warn_of_seam(path, w);
    if (b->filled == 0)
        complain(
            "%s: warning: no pixel has a value: none of their centres lies in a triangle whose "
            "vertices have values",
            s->common.output);
    if (b->mistakable > 0)
        complain("%s: warning: %llu of its pixels have the value of --nodata", s->common.output,
                 (unsigned long long)b->mistakable);
}

static int raster_write(const raster_settings *s, const char *path, raster_work *w)
{
    const char *names[BAND_COUNT];
    const raster_grid *g = &w->grid;
    raster_bands *b = &w->bands;
    for (uint32_t k = 0; k < b->count; k++)
        names[k] = b->bands[k] == BAND_VALUE ? w->wish.field.field : raster_band_name(b->bands[k]);
    gdal_raster_form form = {.columns = g->columns,
                             .rows = g->rows,
                             .bands = s->time ? w->series.bands : b->count,
                             .by_band = s->time != NULL,
                             .corner = {g->west, g->north},
                             .size = {g->width, g->height},
                             .type = b->type,
                             .nodata = b->nodata,
                             .names = s->time ? (const char *const *)w->series.names : names,
                             .crs = w->mesh.crs ? w->mesh.crs : w->like.crs,
                             .driver = s->driver,
                             .creation = s->creation};
    int end = raster_scan_create(&w->scan, w->mesh.locator, w->mesh.mesh, g, s->common.threads);
    if (end == 0) end = gdal_raster_create(&w->raster, s->common.output, &form);
    b->mesh = &w->mesh;
    b->grid = g;
    b->scan = w->scan;
    b->nearest = s->outside == OUTSIDE_NEAREST;
    b->threads = s->common.threads;
    w->mean = (raster_mean){.bands = b,
                            .series = s->time ? &w->series : NULL,
                            .mesh = &w->mesh,
                            .degrees = w->mesh.crs && crs_is_lonlat(w->mesh.crs)};
    progress_phase("writing", s->common.output);
    if (end == 0)
        end = s->mean   ? raster_mean_write(&w->mean, w->raster)
              : s->time ? raster_series_write(&w->series, b, &w->mesh, w->raster)
                        : raster_bands_write(b, w->raster);
    int closed = gdal_raster_close(w->raster, end == 0);
    if (end == 0) end = closed;
    if (end == 0) raster_warn(s, path, w);
    return end;
}

static int raster_print_report(const raster_settings *s, const raster_work *w)
{
    report r;
    const raster_grid *g = &w->grid;
    const double box[4] = {g->west, g->north - g->rows * g->height, g->west + g->columns * g->width,
                           g->north},
                 size[2] = {g->width, g->height};
    uint64_t pixels = (uint64_t)g->columns * g->rows;
    if (s->common.quiet) return 0;
    report_begin(&r, s->json);
    report_count(&r, "columns", g->columns);
    report_count(&r, "rows", g->rows);
    if (s->time) report_count(&r, "bands", w->series.bands);
    report_numbers(&r, "resolution", size, g->width == g->height ? 1 : 2);
    report_numbers(&r, "extent", box, 4);
    if (s->max_edge > 0) report_count(&r, "peeled", w->mesh.peeled);
    report_count(&r, "with_value", w->bands.filled);
    report_count(&r, "empty", pixels - w->bands.filled);
    if (s->mean) report_number(&r, "area", w->mean.area);
    if (s->mean && w->bands.bands[0] != BAND_ASPECT)
        report_number(&r, "integral", w->mean.integral);
    report_number(&r, "nodata", w->bands.nodata);
    report_rounded(&r, "seconds", monotonic_seconds() - w->begin);
    report_end(&r);
    return files_write_text(NULL, &r.text);
}

static int raster_run(const void *settings, const char *const *operands)
{
    const raster_settings *s = settings;
    raster_work w = {.begin = monotonic_seconds()};
    w.wish = (raster_mesh_settings){
        .common = &s->common,
        .field = {.field = s->field ? s->field : "z", .quiet = s->common.quiet},
        .crs = s->crs,
        .max_edge = s->max_edge,
        .over_time = s->time != NULL,
        .border = s->outside == OUTSIDE_NEAREST,
        .cut = s->mean};
    int end = raster_check_settings(s, operands[0], &w);
    if (end == 0) end = raster_like_read(&w.like, s->like);
    if (end == 0) end = raster_mesh_read(&w.mesh, operands[0], &w.wish);
    const series_request request = {.path = s->values,
                                    .mesh = operands[0],
                                    .layout = s->common.layout,
                                    .fields = s->field,
                                    .time = s->time};
    if (end == 0 && s->time)
        end = raster_series_open(&w.series, &request, &w.mesh, s->common.quiet);
    if (end == 0) end = raster_make_grid(s, operands[0], &w);
    if (end == 0) end = raster_write(s, operands[0], &w);
    if (end == 0) end = raster_print_report(s, &w);
    if (s->time) raster_series_close(&w.series);
    raster_scan_release(w.scan);
    raster_grid_release(&w.grid);
    raster_mesh_release(&w.mesh);
    raster_like_release(&w.like);
    return end;
}

static const option *const tables[] = {raster_options, common_options, NULL};

const command raster_command = {
    .name = "raster",
    .operands = "MESH -o RASTER",
    .operand_count = 1,
    .summary = "make a raster of a mesh: heights, slopes, a hillshade",
    .description =
        "Writes the value that MESH has at the centre of each pixel, as 'sample' interpolates it, "
        "to RASTER: a GeoTIFF, or another format that GDAL writes. '-' is standard input.",
    .options = tables,
    .essential = "resolution like field derive output",
    .settings_size = sizeof(raster_settings),
    .run = raster_run,
};
