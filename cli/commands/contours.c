/* contours - the lines of equal height of a mesh. */
#include "cli/commands/commands.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/mesh_crs.h"
#include "cli/input/mesh_field.h"
#include "cli/lines/contour_lines.h"
#include "cli/lines/contour_mesh.h"
#include "cli/lines/contour_polygons.h"
#include "cli/lines/row_output.h"
#include "cli/output/csv_row.h"
#include "cli/output/mended_mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CONTOURS_MOST_LEVELS 1000000
#define CONTOURS_FARTHEST 0x1p53 /* intervals from the base: doubles count them all up to there */

typedef struct contours_settings {
    common_settings common;
    const char *interval, *levels, *base, *field, *nodata, *crs;
    bool polygons;
} contours_settings;

static const option contours_options[] = {
    {"interval", 0, OPTION_TEXT, offsetof(contours_settings, interval), "D",
     "a level at every multiple of D", NULL},
    {"levels", 0, OPTION_TEXT, offsetof(contours_settings, levels), "LIST",
     "these levels, separated by commas: 0,2.5,10", NULL},
    {"base", 0, OPTION_TEXT, offsetof(contours_settings, base), "B",
     "with --interval: count the multiples from B (default: 0)", NULL},
    {"polygons", 0, OPTION_FLAG, offsetof(contours_settings, polygons), NULL,
     "instead of lines, the polygons between them: the parts of MESH in each band of values", NULL},
    {"field", 0, OPTION_TEXT, offsetof(contours_settings, field), "NAME",
     "the value: z or a field of MESH (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(contours_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"crs", 0, OPTION_TEXT, offsetof(contours_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {0},
};

/* --- levels --- */

typedef struct contour_levels {
    double *values;
    size_t count;
} contour_levels;

static int levels_fail(const char *name, const char *given)
{
    complain("option '--%s' must be %s, not '%.60s'", name,
             strcmp(name, "levels") == 0     ? "numbers separated by commas"
             : strcmp(name, "interval") == 0 ? "a positive number"
                                             : "a number",
             given);
    return END_USAGE;
}

static int levels_compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Parse the list of --levels, sort it and drop duplicates. */
static int levels_parse(contour_levels *l, const char *list)
{
    size_t room = 1;
    for (const char *c = list; *c; c++) room += *c == ',';
    l->values = malloc(room * sizeof *l->values);
    if (!l->values) return fail_memory();
    for (const char *p = list;; p++) {
        char *end;
        double value = strtod(p, &end);
        if (end == p || !isfinite(value) || (*end && *end != ','))
            return levels_fail("levels", list);
        l->values[l->count++] = value + 0.0;
        p = end;
        if (!*p) break;
    }
    qsort(l->values, l->count, sizeof *l->values, levels_compare);
    size_t kept = 1;
    for (size_t i = 1; i < l->count; i++)
        if (l->values[i] != l->values[kept - 1]) l->values[kept++] = l->values[i];
    l->count = kept;
    return 0;
}

/* Parse the number of an option; *decimals: the decimals that it is written with, or -1 with an
 * exponent. */
static int levels_number(const char *name, const char *given, double *value, int *decimals)
{
    char *end;
    const char *point = strchr(given, '.');
    *value = strtod(given, &end);
    if (end == given || *end || !isfinite(*value)) return levels_fail(name, given);
    *decimals = strpbrk(given, "eExX") ? -1 : point ? (int)strlen(point + 1) : 0;
    return 0;
}

/* A level with as many decimals as its interval: 3 * 0.1 is 0.3. */
static double levels_round(double value, int decimals)
{
    char digits[400];
    if (decimals < 0 || decimals > 15 || fabs(value) > 1e15) return value + 0.0;
    snprintf(digits, sizeof digits, "%.*f", decimals, value);
    return strtod(digits, NULL) + 0.0;
}

/* Are the multiples from the first up to the last few enough, and can doubles tell them apart? */
static int levels_check(const contours_settings *s, double first, double last, double low,
                        double high)
{
    if (!(last - first <= CONTOURS_MOST_LEVELS)) {
        complain("--interval %s makes more than %d levels between %g and %g", s->interval,
                 CONTOURS_MOST_LEVELS, low, high);
        return END_RESOURCE;
    }
    if (fabs(first) <= CONTOURS_FARTHEST && fabs(last) <= CONTOURS_FARTHEST) return 0;
    complain("--interval %s is too small for values between %g and %g, counted from %s",
             s->interval, low, high, s->base ? s->base : "0");
    return END_RESOURCE;
}

/* All multiples of the interval between the least and the largest value. */
static int levels_make(contour_levels *l, const contours_settings *s, const double *values,
                       size_t count)
{
    double interval, base = 0, low = INFINITY, high = -INFINITY;
    int decimals, of_base = 0;
    int end = levels_number("interval", s->interval, &interval, &decimals);
    if (end == 0 && s->base) end = levels_number("base", s->base, &base, &of_base);
    if (end) return end;
    if (of_base > decimals || of_base < 0) decimals = decimals < 0 ? -1 : of_base;
    for (size_t i = 0; i < count; i++) {
        low = values[i] < low ? values[i] : low;
        high = values[i] > high ? values[i] : high;
    }
    if (low > high) return 0; /* no vertex has a value */
    double first = floor((low - base) / interval), last = ceil((high - base) / interval);
    end = levels_check(s, first, last, low, high);
    if (end) return end;
    size_t room = (size_t)(last - first) + 1;
    l->values = malloc(room * sizeof *l->values);
    if (!l->values) return fail_memory();
    for (double k = first; k <= last && l->count < room; k++) {
        double level = levels_round(base + k * interval, decimals);
        if (l->count == 0 || level > l->values[l->count - 1]) l->values[l->count++] = level;
    }
    return 0;
}

/* --- lines --- */

typedef struct contours_writer {
    row_output out;
    bool table;
    uint64_t lines;
} contours_writer;

static int contours_write_line(void *self, const contour_line *line)
{
    contours_writer *w = self;
    text *out = &w->out.text;
    uint64_t number = w->lines++;
    int end = 0;
    for (size_t i = 0; end == 0 && i < (w->table ? line->count : 1); i++) {
        text_printf(out, "%llu", (unsigned long long)number);
        csv_row_double(out, true, line->level);
        csv_row_word(out, line->closed ? "1" : "0");
        if (w->table) csv_row_double(out, true, line->points[2 * i]);
        if (w->table) csv_row_double(out, true, line->points[2 * i + 1]);
        csv_row_end(out);
        end = w->table ? row_output_row(&w->out, line->points + 2 * i)
                       : row_output_line(&w->out, line->points, line->count);
    }
    return end;
}

static int contours_write_polygon(void *self, const contour_polygon *polygon)
{
    contours_writer *w = self;
    text *out = &w->out.text;
    uint64_t number = w->lines++;
    int end = 0;
    size_t rows = w->table ? polygon->first[polygon->ring_count] : 1;
    for (size_t i = 0, ring = 0; end == 0 && i < rows; i++) {
        const double *p = polygon->points + 2 * i;
        ring += i == polygon->first[ring + 1];
        text_printf(out, "%llu", (unsigned long long)number);
        csv_row_double(out, true, polygon->low);
        csv_row_double(out, true, polygon->high);
        if (w->table) csv_row_count(out, true, (uint32_t)ring);
        if (w->table) csv_row_double(out, true, p[0]);
        if (w->table) csv_row_double(out, true, p[1]);
        csv_row_end(out);
        end = w->table ? row_output_row(&w->out, p)
                       : row_output_polygon(&w->out, polygon->points, polygon->first,
                                            polygon->ring_count);
    }
    return end;
}

static int contours_open(const contours_settings *s, contours_writer *w, const char *crs)
{
    text header = {0};
    int end;
    const char *path = s->common.output;
    bool quiet = s->common.quiet;
    text_string(&header, s->polygons ? "polygon,min,max" : "line,elevation,closed");
    if (w->table) text_string(&header, s->polygons ? ",ring,x,y" : ",x,y");
    text_string(&header, "\n");
    if (w->table)
        end = row_output_open(&w->out, path, &header, s->polygons ? "irrirr" : "irirr", crs, quiet);
    else if (s->polygons)
        end = row_output_open_polygons(&w->out, path, &header, "irr", crs, quiet);
    else
        end = row_output_open_lines(&w->out, path, &header, "iri", crs, quiet);
    text_release(&header);
    return end;
}

static int contours_write(const contours_settings *s, const mw_mesh *mesh, const double *values,
                          const contour_levels *levels, const char *path, const char *crs)
{
    contours_writer w = {.table = !gdal_rows_known(s->common.output)};
    int end = contours_open(s, &w, crs);
    progress_phase("tracing", path);
    if (end == 0)
        end = s->polygons ? contour_polygons_make(mesh, values, levels->values, levels->count,
                                                  contours_write_polygon, &w)
                          : contour_lines_trace(mesh, values, levels->values, levels->count,
                                                contours_write_line, &w);
    int closed = row_output_close(&w.out, end == 0);
    if (end == 0) end = closed;
    if (end == 0 && w.lines == 0 && !s->common.quiet)
        complain(s->polygons ? "%s: remark: no triangle has a value at each vertex"
                             : "%s: remark: no line of these levels crosses the mesh",
                 path);
    return end;
}

/* Polygons of triangles that overlap would overlap. */
static int contours_check_mesh(const contours_settings *s, const mw_mesh *mesh, const char *path)
{
    mw_locator *locator;
    mw_error error;
    const mw_locator_options options = {
        .fill = MW_FILL_NO, .threads = s->common.threads, .progress = progress_of_call()};
    mw_status status = mw_locator_create(mesh, &options, &locator, &error);
    mw_locator_destroy(locator);
    if (status == MW_OK) return 0;
    int end = fail_mesh(path, &error);
    if (end == END_INPUT)
        complain("'meshwalk check %s' lists every defect, 'meshwalk view' shows it", path);
    return end;
}

static int contours_check(const contours_settings *s, const char *const *operands)
{
    double value;
    int decimals, end = 0;
    if (!s->interval == !s->levels) {
        complain(s->interval ? "give --interval or --levels, not both"
                             : "which levels? Give --interval D or --levels LIST");
        return END_USAGE;
    }
    if (s->base && !s->interval) {
        complain("option '--base' needs --interval");
        return END_USAGE;
    }
    if (s->interval) end = levels_number("interval", s->interval, &value, &decimals);
    if (end == 0 && s->interval && !(value > 0)) end = levels_fail("interval", s->interval);
    if (end == 0) end = files_check_output(s->common.output, operands, 1);
    if (end == 0) end = row_output_check(s->common.output);
    return end ? end : crs_check_option("crs", s->crs);
}

static int contours_create_mesh(const contours_settings *s, const char *path,
                                const mw_mesh_file *file, mw_mesh **mesh)
{
    mw_error error;
    mw_arrays arrays = mw_mesh_file_arrays(file);
    mw_mesh_options options = {.threads = s->common.threads, .progress = progress_of_call()};
    progress_phase("preparing", path);
    return mw_mesh_create(&arrays, &options, mesh, &error) == MW_OK ? 0 : fail_mesh(path, &error);
}

static bool contours_mesh_has_flat(const mw_mesh *mesh)
{
    uint32_t v[3];
    double p[3][2];
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
        if (mw_orient2d(p[0], p[1], p[2]) == 0) return true;
    }
    return false;
}

/* A triangle without area has no sides for polygons to lie on. Take it away, and split what lies at
 * its long edge at the vertex between. */
static int contours_drop_flat(const contours_settings *s, const char *path, mw_mesh_file *file,
                              mw_mesh **mesh)
{
    mended_mesh mended;
    size_t flat = 0;
    const mw_mend_options repairs = {.repairs = MW_REPAIR_DROP | MW_REPAIR_SPLIT,
                                     .progress = progress_of_call()};
    mw_mesh_destroy(*mesh);
    *mesh = NULL;
    int end = mended_mesh_create(&mended, path, file, &repairs);
    for (size_t i = 0; end == 0 && i < mended.mended.change_count; i++)
        flat += mended.mended.changes[i].kind == MW_MEND_DROPPED_FLAT;
    mended_mesh_release(&mended);
    if (end == 0 && !s->common.quiet)
        complain("%s: remark: %zu triangles without area are left out, and those at their long "
                 "edges split",
                 path, flat);
    return end ? end : contours_create_mesh(s, path, file, mesh);
}

/* What a run has. */
typedef struct contours_work {
    mw_mesh_file file;
    char *crs;
    double *values; /* of the vertices of the file */
    contour_levels levels;
    contour_mesh crossed; /* for lines */
    mw_mesh *mesh;        /* for polygons */
} contours_work;

static void contours_work_release(contours_work *w)
{
    mw_mesh_file_release(&w->file);
    free(w->crs);
    free(w->values);
    free(w->levels.values);
    contour_mesh_release(&w->crossed);
    mw_mesh_destroy(w->mesh);
}

static int contours_make_polygons(const contours_settings *s, const char *path, contours_work *w)
{
    int end = contours_create_mesh(s, path, &w->file, &w->mesh);
    if (end == 0 && contours_mesh_has_flat(w->mesh))
        end = contours_drop_flat(s, path, &w->file, &w->mesh);
    return end ? end : contours_check_mesh(s, w->mesh, path);
}

static int contours_make_lines(const contours_settings *s, const char *path, contours_work *w)
{
    const mw_mesh_options options = {.threads = s->common.threads, .progress = progress_of_call()};
    progress_phase("preparing", path);
    return contour_mesh_create(&w->crossed, path, &w->file, w->values, w->levels.values,
                               w->levels.count, &options);
}

static int contours_make(const contours_settings *s, const char *path, contours_work *w)
{
    mesh_field_choice field = {.field = s->field ? s->field : "z", .quiet = s->common.quiet};
    int end = nodata_parse("nodata", s->nodata, &field.nodata);
    if (end == 0 && s->levels) end = levels_parse(&w->levels, s->levels);
    if (end == 0) end = files_read_mesh(path, &w->file);
    if (end == 0) end = mesh_crs_settle(path, s->crs, w->file.crs, s->common.quiet, &w->crs);
    if (end == 0 && s->polygons) end = contours_make_polygons(s, path, w);
    if (end == 0) end = mesh_field_copy(path, &w->file, &field, &w->values);
    if (end == 0 && s->interval) end = levels_make(&w->levels, s, w->values, w->file.point_count);
    return end || s->polygons ? end : contours_make_lines(s, path, w);
}

static int contours_run(const void *settings, const char *const *operands)
{
    const contours_settings *s = settings;
    contours_work w = {0};
    int end = contours_check(s, operands);
    if (end == 0) end = contours_make(s, operands[0], &w);
    if (end == 0 && s->polygons)
        end = contours_write(s, w.mesh, w.values, &w.levels, operands[0], w.crs);
    else if (end == 0)
        end = contours_write(s, w.crossed.mesh, w.crossed.values, &w.levels, operands[0], w.crs);
    contours_work_release(&w);
    return end;
}

static const option *const tables[] = {contours_options, common_options, NULL};

const command contours_command = {
    .name = "contours",
    .operands = "MESH",
    .operand_count = 1,
    .summary = "the lines of equal height of a mesh, or bands between them",
    .description =
        "Writes lines of a vector file, by the ending of the output, with the attributes line, "
        "elevation and closed; or a row for each point of each line: line,elevation,closed,x,y. "
        "Every line is closed or goes from border to border. A vertex at the level counts as above "
        "it, so flat triangles at the level lie above it, and the line runs along them. Higher "
        "ground lies to the left of a line. With --polygons, it writes the parts of MESH from one "
        "level up to the next, with the attributes polygon, min and max, or the rows "
        "polygon,min,max,ring,x,y.",
    .options = tables,
    .essential = "interval levels polygons field output",
    .settings_size = sizeof(contours_settings),
    .run = contours_run,
};
