#include "io/mesh/mesh_builder.h"
#include "io/mesh/face_cut.h"
#include "io/mesh/lonlat_cut.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void mw__build_start(mw_mesh_builder *builder, mw_mesh_file *file, mw_source *source)
{
    *file = (mw_mesh_file){0};
    *builder = (mw_mesh_builder){.file = file, .source = source, .highest = -1};
}

/* One more name with room for values. */
static mw_status names_add(char ***all, double ***values, size_t *count, const char *name,
                           mw_error *error)
{
    char **names = mw__realloc(*all, *count + 1, sizeof *names);
    if (!names) return mw__fail_memory(error);
    *all = names;
    if (values) {
        double **fields = mw__realloc(*values, *count + 1, sizeof *fields);
        if (!fields) return mw__fail_memory(error);
        *values = fields;
        fields[*count] = NULL;
    }
    names[*count] = strdup(name);
    if (!names[*count]) return mw__fail_memory(error);
    ++*count;
    return MW_OK;
}

mw_status mw__build_field(mw_mesh_builder *builder, const char *name, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (file->field_count == MW_COLUMN_LIMIT)
        return mw__source_fail(builder->source, error, "more than %d values per vertex",
                               MW_COLUMN_LIMIT);
    return names_add(&file->field_names, &file->fields, &file->field_count, name, error);
}

/* Arrays of so many elements are made at once, for large pages; they grow like others. */
mw_status mw__build_expect_points(mw_mesh_builder *builder, size_t n, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (builder->point_room > 0 || n == 0 || n > MW_MAX_VERTICES) return MW_OK;
    file->points = mw__alloc_lines(n, 3 * sizeof *file->points);
    bool made = file->points;
    for (size_t f = 0; made && f < file->field_count; f++) {
        file->fields[f] = mw__alloc_lines(n, sizeof *file->fields[f]);
        made = file->fields[f];
    }
    if (!made) return mw__fail_memory(error);
    builder->point_room = n;
    return MW_OK;
}

mw_status mw__build_expect_triangles(mw_mesh_builder *builder, size_t n, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (builder->triangle_room > 0 || n == 0 || n > MW_MAX_TRIANGLES) return MW_OK;
    file->triangles = mw__alloc_lines(n, 3 * sizeof *file->triangles);
    if (!file->triangles) return mw__fail_memory(error);
    builder->triangle_room = n;
    return MW_OK;
}

/* Half as much again, at least 16. */
static size_t room_after(size_t room)
{
    return room < 16 ? 16 : room + room / 2;
}

static bool points_resize(mw_mesh_builder *builder, size_t room)
{
    mw_mesh_file *file = builder->file;
    double *points = mw__realloc(file->points, room, 3 * sizeof *points);
    if (!points) return false;
    file->points = points;
    for (size_t f = 0; f < file->field_count; f++) {
        double *field = mw__realloc(file->fields[f], room, sizeof *field);
        if (!field) return false;
        file->fields[f] = field;
    }
    builder->point_room = room;
    return true;
}

/* Room for n more points. */
static mw_status points_grow(mw_mesh_builder *builder, size_t n, mw_error *error)
{
    const size_t count = builder->file->point_count;
    if (MW_LIKELY(n <= builder->point_room - count)) return MW_OK;
    if (n > MW_MAX_VERTICES - count)
        return mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " vertices",
                        mw__source_name(builder->source), MW_MAX_VERTICES);
    size_t room = room_after(count) < count + n ? count + n : room_after(count);
    return points_resize(builder, room < MW_MAX_VERTICES ? room : MW_MAX_VERTICES)
               ? MW_OK
               : mw__fail_memory(error);
}

mw_status mw__build_point(mw_mesh_builder *builder, double x, double y, double z, mw_error *error)
{
    mw_status status = points_grow(builder, 1, error);
    if (status) return status;
    double *point = builder->file->points + 3 * builder->file->point_count++;
    point[0] = x;
    point[1] = y;
    point[2] = z;
    return MW_OK;
}

mw_status mw__build_points(mw_mesh_builder *builder, size_t n, double **points, mw_error *error)
{
    mw_status status = points_grow(builder, n, error);
    if (status) return status;
    *points = builder->file->points + 3 * builder->file->point_count;
    builder->file->point_count += n;
    return MW_OK;
}

mw_status mw__read_xyz(const mw_source *source, const char *text, double xyz[3], mw_error *error)
{
    for (int k = 0; k < 3; k++) {
        text = mw__skip_blanks(text);
        const char *end = mw__read_double(text, &xyz[k]);
        if (!*text)
            return mw__source_fail(source, error, "a vertex has %d coordinates; 3 are needed", k);
        if (!end || !mw__at_gap(end))
            return mw__source_fail(source, error, "'%s' is not a number", mw__excerpt(text).text);
        text = end;
    }
    return MW_OK;
}

mw_status mw__build_point_text(mw_mesh_builder *builder, const char *text, mw_error *error)
{
    double xyz[3];
    mw_status status = mw__read_xyz(builder->source, text, xyz, error);
    return status ? status : mw__build_point(builder, xyz[0], xyz[1], xyz[2], error);
}

void mw__build_value(mw_mesh_builder *builder, size_t field, double value)
{
    builder->file->fields[field][builder->file->point_count - 1] = value;
}

/* Room for n more triangles, and for their faces where faces are noted. */
static mw_status triangles_grow(mw_mesh_builder *builder, size_t n, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    const size_t count = file->triangle_count;
    if (MW_LIKELY(n <= builder->triangle_room - count)) return MW_OK;
    if (n > MW_MAX_TRIANGLES - count)
        return mw__fail(error, MW_ERROR_LIMIT, "%.240s: more than %" PRIu32 " triangles",
                        mw__source_name(builder->source), MW_MAX_TRIANGLES);
    size_t room = room_after(count) < count + n ? count + n : room_after(count);
    uint32_t *triangles = mw__realloc(file->triangles, room, 3 * sizeof *triangles);
    if (!triangles) return mw__fail_memory(error);
    file->triangles = triangles;
    if (file->faces) {
        uint32_t *faces = mw__realloc(file->faces, room, sizeof *faces);
        if (!faces) return mw__fail_memory(error);
        file->faces = faces;
    }
    builder->triangle_room = room;
    return MW_OK;
}

/* A triangle of the face that is counted next. */
static mw_status triangles_add(mw_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c,
                               mw_error *error)
{
    mw_mesh_file *file = builder->file;
    mw_status status = triangles_grow(builder, 1, error);
    if (status) return status;
    if (file->faces) file->faces[file->triangle_count] = (uint32_t)file->face_count;
    uint32_t *triangle = file->triangles + 3 * file->triangle_count++;
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
    return MW_OK;
}

/* An error about the face that is counted next, or about another one at an earlier position. */
static mw_status face_fail(const mw_mesh_builder *builder, uint64_t position, mw_error *error,
                           const char *format, ...) __attribute__((format(printf, 4, 5)));
static mw_status face_fail(const mw_mesh_builder *builder, uint64_t position, mw_error *error,
                           const char *format, ...)
{
    const char *variable = builder->corner_variable;
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!variable) return mw__source_fail_at(builder->source, position, error, "%s", text);
    return mw__source_fail_at(builder->source, position, error, "variable %.100s: %s", variable,
                              text);
}

/* Note where the first face with a vertex twice stands: later its place is not known. */
static mw_status repeat_note(mw_mesh_builder *builder, uint32_t vertex, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    mw_error place;
    face_fail(builder, mw__source_position(builder->source), &place,
              "face %" PRId64 " has vertex %" PRId64 " twice",
              (int64_t)file->face_count + builder->first_number, vertex + builder->first_number);
    file->repeat_triangle = file->triangle_count;
    file->repeat = strdup(place.message);
    return file->repeat ? MW_OK : mw__fail_memory(error);
}

mw_status mw__build_triangle(mw_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c,
                             mw_error *error)
{
    mw_status status = MW_OK;
    if (MW_UNLIKELY(a == b || b == c || c == a) && !builder->file->repeat)
        status = repeat_note(builder, a == b ? a : c, error);
    if (!status) status = triangles_add(builder, a, b, c, error);
    builder->file->face_count += !status;
    return status;
}

mw_status mw__build_triangle_room(mw_mesh_builder *builder, uint32_t **triangles, size_t *room,
                                  mw_error *error)
{
    mw_status status = triangles_grow(builder, 1, error);
    if (status) return status;
    *triangles = builder->file->triangles + 3 * builder->file->triangle_count;
    *room = builder->triangle_room - builder->file->triangle_count;
    return MW_OK;
}

void mw__build_triangles(mw_mesh_builder *builder, size_t n)
{
    mw_mesh_file *file = builder->file;
    for (size_t i = 0; file->faces && i < n; i++)
        file->faces[file->triangle_count + i] = (uint32_t)(file->face_count + i);
    file->triangle_count += n;
    file->face_count += n;
}

/* From the first face of more than one triangle on, the face of each triangle is noted. */
static mw_status faces_begin(mw_mesh_builder *builder, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (file->faces) return MW_OK;
    file->faces = mw__alloc(builder->triangle_room, sizeof *file->faces);
    if (!file->faces) return mw__fail_memory(error);
    for (size_t t = 0; t < file->triangle_count; t++) file->faces[t] = (uint32_t)t;
    return MW_OK;
}

void mw__build_face(mw_mesh_builder *builder)
{
    builder->corner_count = builder->named = 0;
}

static mw_status no_such_vertex(const mw_mesh_builder *builder, uint64_t position, int64_t number,
                                mw_error *error)
{
    return mw__source_fail_at(builder->source, position, error,
                              "vertex %" PRId64
                              " does not exist: there are %zu, numbered from %" PRId64,
                              number, builder->file->point_count, builder->first_number);
}

mw_status mw__build_vertex(mw_mesh_builder *builder, int64_t number, uint32_t *vertex,
                           mw_error *error)
{
    uint64_t position = mw__source_position(builder->source);
    int64_t limit =
        builder->points_complete ? (int64_t)builder->file->point_count : (int64_t)MW_MAX_VERTICES;
    if (number < builder->first_number || number - builder->first_number >= limit) {
        if (builder->points_complete) return no_such_vertex(builder, position, number, error);
        return mw__source_fail(builder->source, error, "%" PRId64 " is not a vertex number",
                               number);
    }
    *vertex = (uint32_t)(number - builder->first_number);
    if (*vertex > builder->highest) {
        builder->highest = *vertex;
        builder->highest_position = position;
    }
    return MW_OK;
}

mw_status mw__build_corner(mw_mesh_builder *builder, int64_t number, mw_error *error)
{
    uint32_t vertex = 0;
    mw_status status = mw__build_vertex(builder, number, &vertex, error);
    if (status) return status;
    size_t count = builder->corner_count;
    if (builder->named < 3) builder->start[builder->named] = vertex;
    builder->named += builder->named < SIZE_MAX;
    if (count > 0 && builder->corners[count - 1] == vertex) return MW_OK;
    if (count == builder->corner_room) {
        size_t room = room_after(count);
        uint32_t *corners = mw__realloc(builder->corners, room, sizeof *corners);
        if (!corners) return mw__fail_memory(error);
        builder->corners = corners;
        builder->corner_room = room;
    }
    builder->corners[builder->corner_count++] = vertex;
    return MW_OK;
}

/* A face that was put down as a fan from its first corner, until it can be cut. */
typedef struct build_polygon {
    size_t triangle; /* its first */
    uint64_t position;
} build_polygon;

static mw_status polygon_cut(mw_mesh_builder *builder, const build_polygon *polygon,
                             mw_error *error)
{
    mw_mesh_file *file = builder->file;
    uint32_t *triangles = file->triangles + 3 * polygon->triangle;
    if ((builder->lonlat ? mw__lonlat_cut : mw__face_cut)(file->points, builder->corners,
                                                          builder->corner_count, triangles))
        return MW_OK;
    return face_fail(builder, polygon->position, error,
                     "face %" PRIu64 " with %zu corners is not convex; cut it into convex faces",
                     (uint64_t)file->faces[polygon->triangle] + (uint64_t)builder->first_number,
                     builder->corner_count);
}

static mw_status polygon_postpone(mw_mesh_builder *builder, const build_polygon *polygon,
                                  mw_error *error)
{
    if (builder->polygon_count == builder->polygon_room) {
        size_t room = room_after(builder->polygon_count);
        build_polygon *polygons = mw__realloc(builder->polygons, room, sizeof *polygons);
        if (!polygons) return mw__fail_memory(error);
        builder->polygons = polygons;
        builder->polygon_room = room;
    }
    builder->polygons[builder->polygon_count++] = *polygon;
    return MW_OK;
}

/* A face with at least four different corners. */
static mw_status polygon_add(mw_mesh_builder *builder, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    const uint32_t *corners = builder->corners;
    build_polygon polygon = {.triangle = file->triangle_count,
                             .position = mw__source_position(builder->source)};
    uint32_t highest = 0;
    mw_status status = triangles_grow(builder, 1, error);
    if (!status) status = faces_begin(builder, error);
    for (size_t i = 1; !status && i + 1 < builder->corner_count; i++)
        status = triangles_add(builder, corners[0], corners[i], corners[i + 1], error);
    for (size_t i = 0; i < builder->corner_count; i++)
        highest = corners[i] > highest ? corners[i] : highest;
    if (!status)
        status = highest < file->point_count ? polygon_cut(builder, &polygon, error)
                                             : polygon_postpone(builder, &polygon, error);
    file->face_count += !status;
    return status;
}

mw_status mw__build_face_end(mw_mesh_builder *builder, mw_error *error)
{
    const uint32_t *corners = builder->corners, *start = builder->start;
    if (builder->named < 3)
        return mw__source_fail(builder->source, error,
                               "a face has %zu corners; at least 3 are needed", builder->named);
    while (builder->corner_count > 1 && corners[builder->corner_count - 1] == corners[0])
        builder->corner_count--;
    if (builder->named == 3 || builder->corner_count < 3)
        return mw__build_triangle(builder, start[0], start[1], start[2], error);
    if (builder->corner_count == 3)
        return mw__build_triangle(builder, corners[0], corners[1], corners[2], error);
    return polygon_add(builder, error);
}

/* Find the corners of a postponed face again, and cut it. */
static mw_status polygon_finish(mw_mesh_builder *builder, const build_polygon *polygon,
                                mw_error *error)
{
    const mw_mesh_file *file = builder->file;
    size_t t = polygon->triangle;
    builder->corners[0] = file->triangles[3 * t];
    builder->corners[1] = file->triangles[3 * t + 1];
    for (builder->corner_count = 2;
         t < file->triangle_count && file->faces[t] == file->faces[polygon->triangle]; t++)
        builder->corners[builder->corner_count++] = file->triangles[3 * t + 2];
    return polygon_cut(builder, polygon, error);
}

mw_status mw__build_late_field(mw_mesh_builder *builder, const char *name, double **values,
                               mw_error *error)
{
    mw_mesh_file *file = builder->file;
    size_t room = builder->point_room;
    mw_status status = mw__build_field(builder, name, error);
    if (status) return status;
    *values = file->fields[file->field_count - 1] = mw__alloc(room, sizeof **values);
    if (!*values) return mw__fail_memory(error);
    for (size_t v = 0; v < file->point_count; v++) (*values)[v] = NAN;
    return MW_OK;
}

mw_status mw__build_face_field(mw_mesh_builder *builder, const char *name, const double *values,
                               mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (file->triangle_field_count == MW_COLUMN_LIMIT)
        return mw__source_fail(builder->source, error, "more than %d values per face",
                               MW_COLUMN_LIMIT);
    mw_status status = names_add(&file->triangle_field_names, &file->triangle_fields,
                                 &file->triangle_field_count, name, error);
    if (status) return status;
    double *field = mw__alloc(file->triangle_count, sizeof *field);
    if (!field) return mw__fail_memory(error);
    file->triangle_fields[file->triangle_field_count - 1] = field;
    for (size_t t = 0; t < file->triangle_count; t++)
        field[t] = values[file->faces ? file->faces[t] : t];
    return MW_OK;
}

mw_status mw__build_mark(mw_mesh_builder *builder, const char *name, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    return names_add(&file->mark_names, NULL, &file->mark_count, name, error);
}

mw_status mw__build_edge(mw_mesh_builder *builder, int64_t a, int64_t b, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    mw_marked_edge edge = {.mark = (uint32_t)file->mark_count - 1};
    mw_status status = mw__build_vertex(builder, a, &edge.vertex[0], error);
    if (!status) status = mw__build_vertex(builder, b, &edge.vertex[1], error);
    if (status) return status;
    if (file->edge_count == builder->edge_room) {
        size_t room = room_after(file->edge_count);
        mw_marked_edge *edges = mw__realloc(file->edges, room, sizeof *edges);
        if (!edges) return mw__fail_memory(error);
        file->edges = edges;
        builder->edge_room = room;
    }
    file->edges[file->edge_count++] = edge;
    return MW_OK;
}

mw_status mw__build_finish(mw_mesh_builder *builder, mw_error *error)
{
    mw_mesh_file *file = builder->file;
    if (builder->highest >= (int64_t)file->point_count)
        return no_such_vertex(builder, builder->highest_position,
                              builder->highest + builder->first_number, error);
    for (size_t i = 0; i < builder->polygon_count; i++) {
        mw_status status = polygon_finish(builder, &builder->polygons[i], error);
        if (status) return status;
    }
    builder->polygon_count = 0;
    file->first_number = (int)builder->first_number;
    if (file->point_count < builder->point_room && !points_resize(builder, file->point_count))
        return mw__fail_memory(error);
    const bool exact = file->triangles && file->triangle_count == builder->triangle_room;
    if (!exact) {
        const size_t size = 3 * sizeof *file->triangles;
        uint32_t *triangles = mw__realloc(file->triangles, file->triangle_count, size);
        if (!triangles) return mw__fail_memory(error);
        file->triangles = triangles;
    }
    if (file->faces && !exact) {
        uint32_t *faces = mw__realloc(file->faces, file->triangle_count, sizeof *faces);
        if (!faces) return mw__fail_memory(error);
        file->faces = faces;
    }
    return MW_OK;
}

void mw__build_release(mw_mesh_builder *builder)
{
    free(builder->corners);
    free(builder->polygons);
    *builder = (mw_mesh_builder){0};
}

void mw__fields_release(char **names, double **fields, size_t count)
{
    for (size_t f = 0; f < count; f++) {
        free(names[f]);
        free(fields[f]);
    }
    free(names);
    free(fields);
}
