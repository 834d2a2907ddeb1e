#define _POSIX_C_SOURCE 200809L /* clock_gettime, strcasecmp */
#include "terrain.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

const char *program_name;

void fail(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "%s: ", program_name);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
    exit(code);
}

void fail_with(const mw_error *error)
{
    fail(error->status == MW_ERROR_INPUT || error->status == MW_ERROR_SYSTEM ? END_INPUT
                                                                             : END_FAILED,
         "%s", error->message);
}

double option_number(const char *name, const char *text, double low, double high)
{
    char *rest;
    double value = strtod(text, &rest);
    if (rest == text || *rest || !(value >= low && value <= high))
        fail(END_USAGE, "option '--%s' must be a number from %g to %g, not '%s'", name, low, high,
             text);
    return value;
}

/* --- reading ---------------------------------------------------------------------------------- */

/* Vertices and their heights on the way to a mesh. */
typedef struct draft {
    double *points; /* x y z of each */
    size_t point_count;
    uint32_t *triangles; /* NULL: to be triangulated */
    size_t triangle_count;
} draft;

static void *grown(void *array, size_t count, size_t size)
{
    void *larger = count < SIZE_MAX / size ? realloc(array, (count + 1) * size) : NULL;
    if (!larger) fail(END_FAILED, "out of memory");
    return larger;
}

static draft read_points(const char *path)
{
    mw_error error;
    mw_point_reader *reader;
    draft d = {0};
    if (mw_point_reader_open(path, NULL, &reader, &error)) fail_with(&error);
    size_t width = mw_point_reader_width(reader), room = 0, block = 4096;
    if (width < 3) fail(END_INPUT, "%s: the points have no heights: x, y and z are wanted", path);
    double *values = grown(NULL, block, width * sizeof *values);
    for (size_t got = 1; got > 0;) {
        if (mw_point_reader_read(reader, values, block, &got, &error)) fail_with(&error);
        while (room < d.point_count + got)
            d.points = grown(d.points, room = 2 * room + block, 3 * sizeof *d.points);
        for (size_t i = 0; i < got; i++, d.point_count++)
            memcpy(d.points + 3 * d.point_count, values + i * width, 3 * sizeof *values);
    }
    free(values);
    mw_point_reader_close(reader);
    return d;
}

/* A file that no reader of meshes knows holds points; so does standard input. */
static draft read_draft(const char *path)
{
    mw_error error;
    mw_mesh_file file;
    if (strcmp(path, "-") == 0) return read_points(path);
    if (mw_read_mesh(path, NULL, &file, &error)) {
        if (error.status == MW_ERROR_INPUT && strstr(error.message, "not a mesh in a known format"))
            return read_points(path);
        fail_with(&error);
    }
    if (!file.has_z) fail(END_INPUT, "%s: the mesh has no heights", path);
    draft d = {file.points, file.point_count, file.triangles, file.triangle_count};
    file.points = NULL;
    file.triangles = NULL;
    mw_mesh_file_release(&file);
    return d;
}

/* Leave out the vertices that are not kept. */
static void keep_vertices(draft *d, const bool *keep)
{
    uint32_t *number = grown(NULL, d->point_count, sizeof *number), kept = 0;
    for (size_t i = 0; i < d->point_count; i++) {
        number[i] = keep[i] ? kept : MW_NONE;
        if (keep[i])
            memmove(d->points + 3 * (size_t)kept++, d->points + 3 * i, 3 * sizeof *d->points);
    }
    for (size_t k = 0; d->triangles && k < 3 * d->triangle_count; k++)
        d->triangles[k] = number[d->triangles[k]];
    d->point_count = kept;
    free(number);
}

static void keep_used(draft *d)
{
    bool *used = grown(NULL, d->point_count, sizeof *used);
    memset(used, 0, d->point_count);
    for (size_t k = 0; k < 3 * d->triangle_count; k++) used[d->triangles[k]] = true;
    keep_vertices(d, used);
    free(used);
}

static mw_mesh *triangulated(draft *d, const char *path)
{
    mw_error error;
    mw_mesh *mesh;
    mw_delaunay_report report;
    uint32_t *same = grown(NULL, d->point_count, sizeof *same);
    bool *first = grown(NULL, d->point_count, sizeof *first);
    if (mw_delaunay(d->points, d->point_count, 3, NULL, same, &report, &mesh, &error))
        fail(END_INPUT, "%s: %s", path, error.message);
    if (report.duplicates > 0) {
        for (size_t i = 0; i < d->point_count; i++) first[i] = same[i] == MW_NONE;
        keep_vertices(d, first);
        mw_mesh_destroy(mesh);
        if (mw_delaunay(d->points, d->point_count, 3, NULL, NULL, NULL, &mesh, &error))
            fail_with(&error);
    }
    free(same);
    free(first);
    return mesh;
}

static mw_mesh *connected(draft *d, const char *path)
{
    mw_error error;
    mw_mesh *mesh;
    keep_used(d);
    mw_arrays arrays = {.points = d->points,
                        .point_count = d->point_count,
                        .point_stride = 3,
                        .triangles = d->triangles,
                        .triangle_count = d->triangle_count};
    if (mw_mesh_create(&arrays, NULL, &mesh, &error))
        fail(END_INPUT, "%s: %s", path, error.message);
    return mesh;
}

mw_mesh *terrain_read(const char *path)
{
    mw_error error;
    draft d = read_draft(path);
    mw_mesh *mesh = d.triangles ? connected(&d, path) : triangulated(&d, path);
    for (size_t i = 0; i < d.point_count; i++)
        if (!isfinite(d.points[3 * i + 2]))
            fail(END_INPUT, "%s: the height of point %zu is no number", path, i);
    if (mw_mesh_set_field(mesh, "z", d.points + 2, 3, &error)) fail_with(&error);
    free(d.points);
    free(d.triangles);
    return mesh;
}

/* --- writing ---------------------------------------------------------------------------------- */

int terrain_can_write(const char *path)
{
    const char *dot = strrchr(path, '.');
    bool known = dot && strcasecmp(dot, ".ele") == 0;
    for (size_t i = 0; mw_mesh_format_name(i) && dot && !known; i++)
        known = strcasecmp(dot + 1, mw_mesh_format_name(i)) == 0;
    return known;
}

void terrain_write(const char *path, const mw_mesh *mesh)
{
    mw_error error;
    uint32_t vertices = mw_mesh_vertex_count(mesh), triangles = mw_mesh_triangle_count(mesh);
    const double *z = mw_mesh_field(mesh, "z");
    mw_mesh_file file = {.point_count = vertices, .triangle_count = triangles, .has_z = 1};
    file.points = grown(NULL, vertices, 3 * sizeof *file.points);
    file.triangles = grown(NULL, triangles, 3 * sizeof *file.triangles);
    for (uint32_t i = 0; i < vertices; i++) {
        mw_mesh_vertex(mesh, i, file.points + 3 * (size_t)i);
        file.points[3 * (size_t)i + 2] = z[i];
    }
    for (uint32_t t = 0; t < triangles; t++)
        mw_mesh_triangle(mesh, t, file.triangles + 3 * (size_t)t);
    if (mw_write_mesh(path, &file, NULL, NULL, &error)) fail(END_FAILED, "%s", error.message);
    free(file.points);
    free(file.triangles);
}

double terrain_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
