#include "cli/input/vertex_table.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/input/las_classes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void vertex_table_release(vertex_table *v)
{
    mw_mesh_file *file = &v->file;
    for (size_t i = 0; i < file->field_count; i++) {
        if (file->field_names) free(file->field_names[i]);
        if (file->fields) free(file->fields[i]);
    }
    free(file->field_names);
    free(file->fields);
    free(file->points);
    free(file->triangles);
    free(file->crs);
    free(v->height_name);
    *v = (vertex_table){0};
}

/* The rows read from a file of points. */
typedef struct point_rows {
    double *values; /* `width` for each row */
    size_t width, count, capacity;
} point_rows;

static bool point_rows_grow(point_rows *r)
{
    size_t wanted = r->capacity ? 2 * r->capacity : 4096;
    if (wanted > SIZE_MAX / sizeof(double) / r->width) return false;
    double *values = realloc(r->values, wanted * r->width * sizeof(double));
    if (!values) return false;
    r->values = values;
    r->capacity = wanted;
    return true;
}

static int point_rows_read(point_rows *r, mw_point_reader *reader)
{
    mw_error error;
    size_t count = 1;
    while (count > 0) {
        if (r->count == r->capacity && !point_rows_grow(r)) return fail_memory();
        double *next = r->values + r->count * r->width;
        if (mw_point_reader_read(reader, next, r->capacity - r->count, &count, &error) != MW_OK)
            return fail_reading(&error);
        r->count += count;
        progress_points(r->count, mw_point_reader_fraction(reader));
    }
    return 0;
}

/* Add a field for all vertices. Its values are not set. */
static double *mesh_file_add_field(mw_mesh_file *file, const char *name)
{
    size_t count = file->field_count + 1;
    char **names = realloc(file->field_names, count * sizeof *names);
    if (names) file->field_names = names;
    double **fields = realloc(file->fields, count * sizeof *fields);
    if (fields) file->fields = fields;
    if (!names || !fields) return NULL;
    names[count - 1] = strdup(name);
    fields[count - 1] = malloc((file->point_count + 1) * sizeof(double));
    file->field_count = count;
    return names[count - 1] ? fields[count - 1] : NULL;
}

/* Make points x, y, z and fields of the columns. */
static int point_rows_split(vertex_table *v, point_rows *r, const mw_point_reader *reader)
{
    mw_mesh_file *file = &v->file;
    size_t n = r->count, width = r->width;
    file->point_count = n;
    file->has_z = width >= 3;
    if (file->has_z && !(v->height_name = strdup(mw_point_reader_column(reader, 2)))) return fail_memory();
    for (size_t k = 3; k < width; k++) {
        double *field = mesh_file_add_field(file, mw_point_reader_column(reader, k));
        if (!field) return fail_memory();
        for (size_t i = 0; i < n; i++) field[i] = r->values[i * width + k];
    }
    if (width == 3) {
        file->points = r->values;
        r->values = NULL;
        return 0;
    }
    if (n > SIZE_MAX / (3 * sizeof(double)) - 1) return fail_memory();
    file->points = malloc((n + 1) * 3 * sizeof(double));
    if (!file->points) return fail_memory();
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 3; k++) file->points[3 * i + k] = k < width ? r->values[i * width + k] : 0;
    return 0;
}

int vertex_table_read(vertex_table *v, const char *path, const char *columns, const char *classes)
{
    mw_error error;
    mw_point_reader_options options = {.columns = columns};
    mw_point_reader *reader;
    int end = classes ? las_classes_parse(classes, options.classes) : 0;
    if (end) return end;
    progress_phase("reading", path);
    if (mw_point_reader_open(path, &options, &reader, &error) != MW_OK) return fail_reading(&error);
    point_rows r = {.width = mw_point_reader_width(reader)};
    end = point_rows_read(&r, reader);
    if (end == 0) end = point_rows_split(v, &r, reader);
    const char *crs = mw_point_reader_crs(reader);
    if (end == 0 && crs && !(v->file.crs = strdup(crs))) end = fail_memory();
    free(r.values);
    mw_point_reader_close(reader);
    v->points = v->file.point_count;
    v->point_fields = v->file.field_count;
    v->point_heights = v->file.has_z;
    return end;
}

/* Append `count` vertices whose coordinates and values are missing. */
static bool vertex_table_extend(mw_mesh_file *file, size_t count)
{
    size_t first = file->point_count, all = first + count;
    if (all > SIZE_MAX / (3 * sizeof(double)) - 1) return false;
    double *points = realloc(file->points, (all + 1) * 3 * sizeof(double));
    if (!points) return false;
    file->points = points;
    for (size_t i = 3 * first; i < 3 * all; i++) points[i] = NAN;
    for (size_t f = 0; f < file->field_count; f++) {
        double *field = realloc(file->fields[f], (all + 1) * sizeof(double));
        if (!field) return false;
        file->fields[f] = field;
        for (size_t i = first; i < all; i++) field[i] = NAN;
    }
    file->point_count = all;
    return true;
}

/* The field of this name. It is added if there is none, without values. */
static double *mesh_file_field_named(mw_mesh_file *file, const char *name)
{
    for (size_t f = 0; f < file->field_count; f++)
        if (strcmp(file->field_names[f], name) == 0) return file->fields[f];
    double *field = mesh_file_add_field(file, name);
    for (size_t i = 0; field && i < file->point_count; i++) field[i] = NAN;
    return field;
}

int vertex_table_append(vertex_table *v, mw_constraint_file *constraints)
{
    mw_mesh_file *file = &v->file;
    size_t first = v->points, count = constraints->point_count;
    if (first + count > MW_MAX_VERTICES) {
        complain("more than %u vertices", (unsigned)MW_MAX_VERTICES);
        return END_RESOURCE;
    }
    if (!vertex_table_extend(file, count)) return fail_memory();
    if (count > 0) memcpy(file->points + 3 * first, constraints->points, count * 3 * sizeof(double));
    for (size_t f = 0; f < constraints->field_count; f++) {
        double *field = mesh_file_field_named(file, constraints->field_names[f]);
        if (!field) return fail_memory();
        memcpy(field + first, constraints->fields[f], count * sizeof(double));
    }
    for (size_t i = 0; constraints->has_z && !v->point_heights && i < first; i++) file->points[3 * i + 2] = NAN;
    file->has_z = file->has_z || constraints->has_z;
    for (size_t i = 0; i < 2 * constraints->segment_count; i++) constraints->segments[i] += (uint32_t)first;
    return 0;
}

int vertex_table_complete(vertex_table *v, const mw_mesh *mesh)
{
    mw_mesh_file *file = &v->file;
    size_t known = file->point_count;
    uint32_t all = mw_mesh_vertex_count(mesh), count = mw_mesh_triangle_count(mesh);
    if (all > known && !vertex_table_extend(file, all - known)) return fail_memory();
    for (size_t i = known; i < all; i++) mw_mesh_vertex(mesh, (uint32_t)i, file->points + 3 * i);
    file->triangle_count = count;
    file->triangles = malloc(((size_t)count + 1) * 3 * sizeof(uint32_t));
    if (!file->triangles) return fail_memory();
    for (uint32_t t = 0; t < count; t++) mw_mesh_triangle(mesh, t, file->triangles + 3 * (size_t)t);
    return 0;
}

/* Copy a field of a mesh that has as many vertices. */
static bool mesh_file_take_field(mw_mesh_file *file, const char *name, const double *values)
{
    if (strcmp(name, "z") == 0) {
        file->has_z = true;
        for (size_t i = 0; i < file->point_count; i++) file->points[3 * i + 2] = values[i];
        return true;
    }
    double *field = mesh_file_add_field(file, name);
    if (field && file->point_count > 0) memcpy(field, values, file->point_count * sizeof *field);
    return field != NULL;
}

int vertex_table_of_mesh(vertex_table *v, const mw_mesh *mesh)
{
    mw_mesh_file *file = &v->file;
    *v = (vertex_table){0};
    int end = vertex_table_complete(v, mesh);
    for (size_t i = 0; end == 0 && i < file->point_count; i++) file->points[3 * i + 2] = 0;
    for (size_t f = 0; end == 0 && f < mw_mesh_field_count(mesh); f++) {
        const char *name = mw_mesh_field_name(mesh, f);
        if (!mesh_file_take_field(file, name, mw_mesh_field(mesh, name))) end = fail_memory();
    }
    v->points = file->point_count;
    v->point_fields = file->field_count;
    v->point_heights = file->has_z;
    return end;
}

size_t vertex_table_field_count(const vertex_table *v)
{
    return 1 + v->file.field_count;
}

vertex_field vertex_table_field(const vertex_table *v, size_t number)
{
    if (number == 0) return (vertex_field){v->file.points + 2, 3, v->point_heights};
    return (vertex_field){v->file.fields[number - 1], 1, number - 1 < v->point_fields};
}

/* Is this the column of a name, or of a number from 1? */
static bool column_is(const char *column, const char *name, size_t number)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%zu", number);
    return strcasecmp(column, name) == 0 || strcmp(column, digits) == 0;
}

bool vertex_table_find_column(const vertex_table *v, const char *column, vertex_field *field)
{
    *field = vertex_table_field(v, 0);
    if (v->height_name && column_is(column, v->height_name, 3)) return true;
    for (size_t i = 0; i < v->point_fields; i++) {
        *field = vertex_table_field(v, i + 1);
        if (column_is(column, v->file.field_names[i], i + 4)) return true;
    }
    return false;
}
