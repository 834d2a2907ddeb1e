#include "cli/vertices/vertex_table.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/text.h"
#include "src/base/posix.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    free(v->height_name);
    free(file->crs);
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

static int point_rows_read(point_rows *r, vertex_source *source)
{
    size_t count = 1;
    while (count > 0) {
        if (r->count == r->capacity && !point_rows_grow(r)) return fail_memory();
        double *next = r->values + r->count * r->width;
        int end = vertex_source_read(source, next, r->capacity - r->count, &count);
        if (end) return end;
        r->count += count;
        progress_points(r->count, vertex_source_fraction(source));
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

/* --- columns ---------------------------------------------------------------------------------- */

/* How the columns of POINTS are used. */
typedef struct point_columns {
    const char *path;
    vertex_source *source;
    size_t height; /* the value that is the height; SIZE_MAX: none */
    bool quiet;
} point_columns;

/* Report which columns do not become fields because they contain text, and where the first text is.
 */
static void columns_tell_texts(const point_columns *c)
{
    enum { MOST = 6 };
    text names = {0};
    size_t count = 0;
    int64_t first = INT64_MAX, place;
    for (size_t k = 2; k < vertex_source_width(c->source); k++) {
        if (!vertex_source_has_texts(c->source, k, &place)) continue;
        if (place < first) first = place;
        if (count++ < MOST)
            text_printf(&names, "%s'%s'", count > 1 ? ", " : "",
                        vertex_source_column(c->source, k));
        else if (count == MOST + 1)
            text_string(&names, ", ...");
    }
    if (count > 0 && !names.failed)
        complain("%s: column%s %.*s become%s no field%s: texts stand there, the first in %s "
                 "%" PRId64,
                 c->path, count > 1 ? "s" : "", (int)names.size, names.bytes, count > 1 ? "" : "s",
                 count > 1 ? "s" : "", vertex_source_has_features(c->source) ? "feature" : "line",
                 first);
    text_release(&names);
}

static int columns_fail_height(const point_columns *c)
{
    int64_t place = 0;
    vertex_source_has_texts(c->source, c->height, &place);
    complain("%s:%s%" PRId64
             ": column '%s', the height, has no number there; --columns chooses another",
             c->path, vertex_source_has_features(c->source) ? " feature " : "", place,
             vertex_source_column(c->source, c->height));
    return END_INPUT;
}

/* Are the heights of all features zero, as some programs write them by default? Then suggest
 * another column for the height. */
static void columns_tell_zero_heights(const point_columns *c, const point_rows *r)
{
    size_t other = vertex_source_named_height(c->source);
    if (other == SIZE_MAX || other == c->height) return;
    for (size_t i = 0; i < r->count; i++)
        if (r->values[i * r->width + c->height] != 0) return;
    complain("%s: warning: the heights of its points are all 0; --columns %s,%s,%s takes those of "
             "'%s'",
             c->path, vertex_source_column(c->source, 0), vertex_source_column(c->source, 1),
             vertex_source_column(c->source, other), vertex_source_column(c->source, other));
}

/* Make points x, y, z and fields of the columns. */
static int point_rows_split(vertex_table *v, point_rows *r, const point_columns *c)
{
    mw_mesh_file *file = &v->file;
    size_t n = r->count, width = r->width;
    file->point_count = n;
    file->has_z = c->height != SIZE_MAX;
    if (file->has_z && vertex_source_has_texts(c->source, c->height, NULL))
        return columns_fail_height(c);
    if (!c->quiet) columns_tell_texts(c);
    if (!c->quiet && file->has_z) columns_tell_zero_heights(c, r);
    for (size_t k = 2; k < width; k++) {
        if (k == c->height || vertex_source_has_texts(c->source, k, NULL) ||
            !vertex_source_has_numbers(c->source, k))
            continue;
        double *field = mesh_file_add_field(file, vertex_source_column(c->source, k));
        if (!field) return fail_memory();
        for (size_t i = 0; i < n; i++) field[i] = r->values[i * width + k];
    }
    if (width == 3 && c->height == 2) {
        file->points = r->values;
        r->values = NULL;
        return 0;
    }
    if (n > SIZE_MAX / (3 * sizeof(double)) - 1) return fail_memory();
    file->points = malloc((n + 1) * 3 * sizeof(double));
    if (!file->points) return fail_memory();
    for (size_t i = 0; i < n; i++) {
        const double *row = r->values + i * width;
        const double xyz[3] = {row[0], row[1], file->has_z ? row[c->height] : 0};
        memcpy(file->points + 3 * i, xyz, sizeof xyz);
    }
    return 0;
}

static int point_rows_take(vertex_table *v, point_columns *c)
{
    point_rows r = {.width = vertex_source_width(c->source)};
    int end = point_rows_read(&r, c->source);
    c->height = vertex_source_height(c->source);
    if (end == 0) end = point_rows_split(v, &r, c);
    if (end == 0 && c->height != SIZE_MAX &&
        !(v->height_name = strdup(vertex_source_column(c->source, c->height))))
        end = fail_memory();
    free(r.values);
    return end;
}

int vertex_table_read(vertex_table *v, const char *path, const vertex_table_options *how)
{
    point_columns c = {.path = files_is_standard(path) ? "standard input" : path,
                       .quiet = how->quiet};
    progress_phase("reading", path);
    int end = vertex_source_open(&c.source, path, &how->source);
    if (end == 0) end = point_rows_take(v, &c);
    if (end == 0) v->lonlat = vertex_source_is_lonlat(c.source);
    const char *crs = end == 0 ? vertex_source_crs(c.source) : NULL;
    if (crs && !(v->file.crs = strdup(crs))) end = fail_memory();
    vertex_source_close(c.source);
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
    if (count > 0)
        memcpy(file->points + 3 * first, constraints->points, count * 3 * sizeof(double));
    for (size_t f = 0; f < constraints->field_count; f++) {
        double *field = mesh_file_field_named(file, constraints->field_names[f]);
        if (!field) return fail_memory();
        memcpy(field + first, constraints->fields[f], count * sizeof(double));
    }
    for (size_t i = 0; constraints->has_z && !v->point_heights && i < first; i++)
        file->points[3 * i + 2] = NAN;
    file->has_z = file->has_z || constraints->has_z;
    for (size_t i = 0; i < 2 * constraints->segment_count; i++)
        constraints->segments[i] += (uint32_t)first;
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

bool vertex_table_find_column(const vertex_table *v, const char *column, vertex_field *field)
{
    *field = vertex_table_field(v, 0);
    if (v->height_name && strcasecmp(column, v->height_name) == 0) return true;
    for (size_t i = 0; i < v->point_fields; i++) {
        *field = vertex_table_field(v, i + 1);
        if (strcasecmp(column, v->file.field_names[i]) == 0) return true;
    }
    return false;
}
