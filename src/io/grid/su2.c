/* SU2: "KEY= value" lines, % begins a comment. NDIME= 2; NELEM= and a line "type corners number"
 * each; NPOIN= and a line "x y number" each; NMARK=, and for each marker MARKER_TAG=, MARKER_ELEMS=
 * and a line "3 a b" for each edge. Counted from 0. The sections come in any order. Vertices that
 * parts of a mesh share (SEND_RECV=, and lines "1 a n") are passed over. */
#include "io/grid/grid_readers.h"
#include "io/text/counted_rows.h"

#include <inttypes.h>
#include <string.h>

/* The next line that is more than a comment; NULL at the end. */
static mw_status su2_line(mw_source *source, char **line, mw_error *error)
{
    do {
        mw_status status = mw__source_line(source, line, error);
        if (status || !*line) return status;
        (*line)[strcspn(*line, "%")] = 0;
        *line = mw__skip_blanks(*line);
    } while (!**line);
    return MW_OK;
}

/* What follows KEY=, or NULL for another key. */
static const char *su2_value(const char *line, const char *key)
{
    size_t length = strlen(key);
    if (strncmp(line, key, length) != 0) return NULL;
    line = mw__skip_blanks(line + length);
    return *line == '=' ? mw__skip_blanks(line + 1) : NULL;
}

static mw_status su2_count(mw_source *source, const char *value, const char *what, int64_t *count,
                           mw_error *error)
{
    mw_number_row row = {source, value};
    mw_status status = mw__row_integer(&row, what, count, error);
    if (!status && *count < 0)
        status = mw__source_fail(source, error, "the %s is %" PRId64, what, *count);
    return status;
}

static mw_status su2_read_element(mw_source *source, const char *line, mw_mesh_builder *builder,
                                  mw_error *error)
{
    int64_t type, vertex;
    mw_number_row row = {source, line};
    mw_status status = mw__row_integer(&row, "type of the element", &type, error);
    if (!status && type != 5 && type != 9)
        status = mw__source_fail(source, error,
                                 "an element has type %" PRId64
                                 "; only 5 (triangle) and 9 (quadrilateral) are read",
                                 type);
    mw__build_face(builder);
    for (int64_t k = 0; !status && k < (type == 5 ? 3 : 4); k++) {
        status = mw__row_integer(&row, "corner", &vertex, error);
        if (!status) status = mw__build_corner(builder, vertex, error);
    }
    return status ? status : mw__build_face_end(builder, error);
}

static mw_status su2_read_point(mw_source *source, const char *line, mw_mesh_builder *builder,
                                mw_error *error)
{
    double x, y;
    mw_number_row row = {source, line};
    mw_status status = mw__row_double(&row, "x", &x, error);
    if (!status) status = mw__row_double(&row, "y", &y, error);
    return status ? status : mw__build_point(builder, x, y, 0, error);
}

static mw_status su2_read_edge(mw_source *source, const char *line, mw_mesh_builder *builder,
                               mw_error *error)
{
    int64_t type, a, b;
    mw_number_row row = {source, line};
    mw_status status = mw__row_integer(&row, "type of the edge", &type, error);
    if (!status && type == 1) return MW_OK; /* a vertex */
    if (!status && type != 3)
        status = mw__source_fail(
            source, error, "a marker has an element of type %" PRId64 "; edges have type 3", type);
    if (!status) status = mw__row_integer(&row, "first vertex", &a, error);
    if (!status) status = mw__row_integer(&row, "second vertex", &b, error);
    return status ? status : mw__build_edge(builder, a, b, error);
}

typedef mw_status su2_row(mw_source *source, const char *line, mw_mesh_builder *builder,
                          mw_error *error);

static mw_status su2_read_rows(mw_source *source, mw_mesh_builder *builder, const char *value,
                               const char *what, su2_row *read, mw_error *error)
{
    int64_t count;
    mw_status status = su2_count(source, value, what, &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        char *line;
        status = su2_line(source, &line, error);
        if (!status && line && su2_value(line, "SEND_RECV"))
            status = su2_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, what, i, count, error);
        if (!status) status = read(source, line, builder, error);
    }
    return status;
}

static mw_status su2_read_tag(const char *tag, mw_mesh_builder *builder, mw_error *error)
{
    char name[256];
    size_t length = strcspn(tag, " \t");
    if (length > sizeof name - 1) length = sizeof name - 1;
    memcpy(name, tag, length);
    name[length] = 0;
    return mw__build_mark(builder, name, error);
}

static mw_status su2_read_key(mw_source *source, const char *line, mw_mesh_builder *builder,
                              mw_error *error)
{
    const char *value;
    int64_t number;
    mw_status status;
    if ((value = su2_value(line, "NELEM")))
        return su2_read_rows(source, builder, value, "elements", su2_read_element, error);
    if ((value = su2_value(line, "NPOIN"))) {
        if (builder->points_complete)
            return mw__source_fail(source, error, "the vertices come a second time");
        status = su2_read_rows(source, builder, value, "vertices", su2_read_point, error);
        builder->points_complete = true;
        return status;
    }
    if ((value = su2_value(line, "MARKER_TAG"))) return su2_read_tag(value, builder, error);
    if ((value = su2_value(line, "MARKER_ELEMS"))) {
        if (builder->file->mark_count == 0)
            return mw__source_fail(source, error, "there is no MARKER_TAG before MARKER_ELEMS");
        return su2_read_rows(source, builder, value, "edges", su2_read_edge, error);
    }
    bool zones = (value = su2_value(line, "NZONE"));
    if (!zones && !(value = su2_value(line, "NDIME"))) return MW_OK;
    status = su2_count(source, value, zones ? "number of zones" : "dimension", &number, error);
    if (!status && number != (zones ? 1 : 2))
        status = mw__source_fail(source, error,
                                 zones ? "a mesh of several zones is not read"
                                       : "the mesh is not in the plane");
    return status;
}

mw_status mw__read_su2(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    char *line;
    mw_status status;
    while (!(status = su2_line(source, &line, error)) && line) {
        status = su2_read_key(source, line, builder, error);
        if (status) return status;
    }
    if (!status && !builder->points_complete)
        status = mw__source_fail(source, error, "there are no vertices ('NPOIN=') in this file");
    return status;
}
