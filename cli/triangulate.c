/* triangulate - a mesh of points. */
#include "classes.h"
#include "commands.h"
#include "files.h"
#include "message.h"
#include "progress.h"
#include "report.h"
#include "signals.h"
#include "tally.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { FORMAT_BY_ENDING = 0 };
static const char *const kinds[] = {"delaunay", "greedy", "min-weight", "min-max-angle", NULL};

typedef struct triangulate_settings {
    common_settings common;
    const char *columns, *classes;
    int kind, format;
    bool json;
} triangulate_settings;

static const char *format_name(int i)
{
    return i == FORMAT_BY_ENDING ? "auto" : mw_format_name((size_t)i - 1);
}
static const char *kind_name(int i)
{
    return kinds[i];
}
static const char *kind_help(int i)
{
    return i == 0 ? "no point inside the circle of a triangle" : NULL;
}
static const choices format_choices = {"format", format_name, NULL};
static const choices kind_choices = {"kind of triangulation", kind_name, kind_help};

static const option triangulate_options[] = {
    {"kind", 0, OPTION_CHOICE, offsetof(triangulate_settings, kind), "NAME",
     "kind of triangulation (default: delaunay, the only one so far):", &kind_choices},
    {"format", 0, OPTION_CHOICE, offsetof(triangulate_settings, format), "NAME",
     "format of MESH; node is two files, .node and .ele (default: auto, by its ending):", &format_choices},
    {"columns", 0, OPTION_TEXT, offsetof(triangulate_settings, columns), "LIST",
     "columns of POINTS to take, as names or numbers from 1: lon,lat,height or 3,4,5; the first two are x and y, the "
     "third is z, further ones become fields (default: all, with x, y and z first where a header names them)",
     NULL},
    {"class", 0, OPTION_TEXT, offsetof(triangulate_settings, classes), "LIST",
     "LAS: take points of these classes only, as names or numbers: ground or 2,9 (default: all)", NULL},
    {"json", 0, OPTION_FLAG, offsetof(triangulate_settings, json), NULL, "print the report as JSON", NULL},
    {0},
};

/* The points, and then the mesh, as they are read and written. */
typedef struct work {
    double *values; /* width per point */
    size_t width;
    mw_mesh_file file; /* its arrays belong to the work */
    mw_triangulation_report report;
    double begin;
} work;

static void release(work *w)
{
    for (size_t i = 0; i < w->file.field_count; i++) {
        if (w->file.field_names) free(w->file.field_names[i]);
        if (w->file.fields) free(w->file.fields[i]);
    }
    free(w->file.field_names);
    free(w->file.fields);
    free(w->file.points);
    free(w->file.triangles);
    free(w->values);
}

static bool grow(work *w, size_t *capacity)
{
    size_t wanted = *capacity ? 2 * *capacity : 4096;
    if (wanted > SIZE_MAX / sizeof(double) / w->width) return false;
    double *values = realloc(w->values, wanted * w->width * sizeof(double));
    if (!values) return false;
    w->values = values;
    *capacity = wanted;
    return true;
}

static int read_all(work *w, mw_point_reader *reader)
{
    mw_error error;
    size_t capacity = 0, count = 1;
    while (count > 0) {
        size_t *n = &w->file.point_count;
        if (*n == capacity && !grow(w, &capacity)) return fail_memory();
        if (mw_points_read(reader, w->values + *n * w->width, capacity - *n, &count, &error) != MW_OK)
            return fail_reading(&error);
        *n += count;
        progress_points(*n);
    }
    return 0;
}

static char *copy_of(const char *name)
{
    size_t size = strlen(name) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, name, size) : NULL;
}

/* Turn the columns read into points x, y, z and fields. */
static int split_columns(work *w, const mw_point_reader *reader)
{
    mw_mesh_file *file = &w->file;
    size_t n = file->point_count, width = w->width;
    file->has_z = width >= 3;
    file->field_count = width > 3 ? width - 3 : 0;
    file->field_names = calloc(file->field_count + 1, sizeof *file->field_names);
    file->fields = calloc(file->field_count + 1, sizeof *file->fields);
    if (!file->field_names || !file->fields) return fail_memory();
    for (size_t k = 0; k < file->field_count; k++) {
        file->field_names[k] = copy_of(mw_points_column(reader, 3 + k));
        file->fields[k] = malloc((n + 1) * sizeof(double));
        if (!file->field_names[k] || !file->fields[k]) return fail_memory();
        for (size_t i = 0; i < n; i++) file->fields[k][i] = w->values[i * width + 3 + k];
    }
    if (width == 3) {
        file->points = w->values;
        w->values = NULL;
        return 0;
    }
    if (n > SIZE_MAX / (3 * sizeof(double)) - 1) return fail_memory();
    file->points = malloc((n + 1) * 3 * sizeof(double));
    if (!file->points) return fail_memory();
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 3; k++) file->points[3 * i + k] = k < width ? w->values[i * width + k] : 0;
    free(w->values);
    w->values = NULL;
    return 0;
}

static int read_points(const triangulate_settings *s, const char *path, work *w)
{
    mw_error error;
    mw_points_options options = {.columns = s->columns};
    mw_point_reader *reader;
    int end = s->classes ? classes_parse(s->classes, options.classes) : 0;
    if (end) return end;
    progress_phase("reading", path);
    if (mw_points_open(path, &options, &reader, &error) != MW_OK) return fail_reading(&error);
    w->width = mw_points_width(reader);
    end = read_all(w, reader);
    if (end == 0) end = split_columns(w, reader);
    mw_points_close(reader);
    return end;
}

static int triangulate(const char *path, work *w)
{
    mw_error error;
    mw_mesh *mesh;
    mw_mesh_file *file = &w->file;
    progress_phase("triangulating", path);
    if (mw_delaunay(file->points, file->point_count, 3, NULL, &w->report, &mesh, &error) != MW_OK)
        return fail_mesh(path, &error);
    uint32_t count = mw_mesh_triangle_count(mesh);
    file->triangle_count = count;
    file->triangles = malloc((size_t)count * 3 * sizeof(uint32_t));
    if (file->triangles)
        for (uint32_t t = 0; t < count; t++) mw_mesh_triangle(mesh, t, file->triangles + 3 * (size_t)t);
    mw_mesh_destroy(mesh);
    return file->triangles ? 0 : fail_memory();
}

/* The report goes to standard output, unless the mesh does. */
static int print_report(const triangulate_settings *s, const work *w)
{
    report r;
    if (s->common.quiet) return 0;
    report_begin(&r, s->json);
    report_count(&r, "points", w->report.points);
    report_count(&r, "duplicates", w->report.duplicates);
    report_count(&r, "triangles", w->file.triangle_count);
    double visited = w->report.points ? (double)w->report.triangles_visited / (double)w->report.points : 0;
    report_number(&r, "visited_per_point", (double)(int64_t)(visited * 1000 + 0.5) / 1000);
    report_number(&r, "seconds", (double)(int64_t)((tally_clock() - w->begin) * 1000 + 0.5) / 1000);
    report_end(&r);
    if (!files_is_stream(s->common.output)) return files_write_text(NULL, &r.text);
    progress_end();
    int end = r.text.failed ? fail_memory() : 0;
    if (end == 0) fwrite(r.text.bytes, 1, r.text.size, stderr);
    text_release(&r.text);
    return end;
}

static int write_mesh(const triangulate_settings *s, const work *w, bool named)
{
    mw_error error;
    const char *format = s->format == FORMAT_BY_ENDING ? NULL : format_name(s->format);
    progress_phase("writing", NULL);
    if (named) signals_hold(true);
    mw_status status = mw_write_mesh(s->common.output, format, &w->file, &error);
    if (named) signals_hold(false);
    return status == MW_OK ? 0 : fail_writing(&error);
}

/* Does the name end in the name of a format, or in .ele, the other half of node? */
static bool ending_is_known(const char *path)
{
    const char *ending = strrchr(path, '.');
    if (!ending) return false;
    const char *name;
    for (size_t i = 0; (name = mw_format_name(i)); i++)
        if (strcasecmp(ending + 1, name) == 0) return true;
    return strcasecmp(ending, ".ele") == 0;
}

/* What can be refused before the work begins. */
static int check_settings(const triangulate_settings *s, const char *points)
{
    const char *output = s->common.output;
    if (s->kind != 0) {
        complain("--kind %s is not available in this version; delaunay is", kinds[s->kind]);
        return END_USAGE;
    }
    if (!output) {
        complain("triangulate: -o MESH is missing: where should the mesh go?");
        return END_USAGE;
    }
    if (files_is_stream(output) && s->format == FORMAT_BY_ENDING) {
        complain("triangulate: a mesh on standard output wants --format");
        return END_USAGE;
    }
    if (s->format == FORMAT_BY_ENDING && !ending_is_known(output)) {
        complain("%s: the name tells no format for meshes; --format does (off, ply, ...)", output);
        return END_USAGE;
    }
    return files_check(output, &points, 1);
}

static int run(const void *settings, const char *const *operands)
{
    const triangulate_settings *s = settings;
    work w = {.begin = tally_clock()};
    bool named = false;
    int end = check_settings(s, operands[0]);
    if (end == 0) end = files_try_output(s->common.output, &named);
    if (end == 0) end = read_points(s, operands[0], &w);
    if (end == 0) end = triangulate(operands[0], &w);
    if (end == 0) end = write_mesh(s, &w, named);
    if (end == 0) end = print_report(s, &w);
    release(&w);
    return end;
}

static const option *const tables[] = {triangulate_options, common_options, NULL};

const command triangulate_command = {
    .name = "triangulate",
    .operands = "POINTS -o MESH",
    .operand_count = 1,
    .summary = "make a Delaunay triangulation of points",
    .description = "Writes the Delaunay triangulation of POINTS to MESH. Vertex i of the mesh is point i, from 0. A "
                   "point equal to an earlier one is counted in the report, and belongs to no triangle. A third "
                   "column is the height, further columns become fields. '-' is standard input.",
    .options = tables,
    .settings_size = sizeof(triangulate_settings),
    .run = run,
};
