/* ADCIRC's fort.14 and SCHISM's hgrid.gr3: a title; the numbers of elements and vertices; lines
 * "number x y depth" and "number corners a b c (d)", all numbered from 1; then, perhaps, the open
 * boundaries and the land boundaries, as counted lists of vertices. The depth, positive
 * downwards, becomes the field "depth". Inside barriers (types 4, 5, 24, 25) name a vertex of their
 * second side behind each vertex: the edges of both sides are marked. Other numbers behind a vertex
 * (heights, coefficients) are passed over. Numbers may be separated by commas, as Fortran reads
 * them. */
#include "io/grid/grid_readers.h"
#include "io/text/counted_rows.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* The next line that is not blank, with blanks in place of commas. */
static mw_status fort14_line(mw_source *source, char **line, mw_error *error)
{
    do {
        mw_status status = mw__source_line(source, line, error);
        if (status || !*line) return status;
        *line = mw__skip_blanks(*line);
    } while (!**line);
    for (char *comma = strchr(*line, ','); comma; comma = strchr(comma, ',')) *comma = ' ';
    return MW_OK;
}

/* The number that begins a row: they go up from 1. */
static mw_status fort14_number(mw_number_row *row, const char *what, int64_t wanted,
                               mw_error *error)
{
    int64_t number;
    mw_status status = mw__row_integer(row, what, &number, error);
    if (!status && number != wanted)
        status = mw__source_fail(row->source, error, "the %s is %" PRId64 ", not %" PRId64, what,
                                 number, wanted);
    return status;
}

static mw_status fort14_read_vertices(mw_source *source, mw_mesh_builder *builder, int64_t count,
                                      mw_error *error)
{
    mw_status status = mw__build_field(builder, "depth", error);
    for (int64_t v = 0; !status && v < count; v++) {
        char *line;
        double x, y, depth;
        status = fort14_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, "vertices", v, count, error);
        if (status) return status;
        mw_number_row row = {source, line};
        status = fort14_number(&row, "number of the vertex", v + 1, error);
        if (!status) status = mw__row_double(&row, "x", &x, error);
        if (!status) status = mw__row_double(&row, "y", &y, error);
        if (!status) status = mw__row_double(&row, "depth", &depth, error);
        if (!status) status = mw__build_point(builder, x, y, 0, error);
        if (!status) mw__build_value(builder, 0, depth);
    }
    builder->points_complete = true;
    return status;
}

static mw_status fort14_read_element(mw_number_row *row, mw_mesh_builder *builder, mw_error *error)
{
    int64_t corners, vertex;
    mw_status status = mw__row_integer(row, "number of corners", &corners, error);
    if (!status && corners != 3 && corners != 4)
        status = mw__source_fail(row->source, error,
                                 "an element has %" PRId64 " corners; only 3 and 4 are possible",
                                 corners);
    mw__build_face(builder);
    for (int64_t k = 0; !status && k < corners; k++) {
        status = mw__row_integer(row, "corner", &vertex, error);
        if (!status) status = mw__build_corner(builder, vertex, error);
    }
    return status ? status : mw__build_face_end(builder, error);
}

static mw_status fort14_read_elements(mw_source *source, mw_mesh_builder *builder, int64_t count,
                                      mw_error *error)
{
    mw_status status = MW_OK;
    for (int64_t e = 0; !status && e < count; e++) {
        char *line;
        status = fort14_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, "elements", e, count, error);
        if (status) break;
        mw_number_row row = {source, line};
        status = fort14_number(&row, "number of the element", e + 1, error);
        if (!status) status = fort14_read_element(&row, builder, error);
    }
    return status;
}

/* A count at the beginning of a line; what follows is a comment, or a second number. */
static mw_status fort14_count(mw_source *source, const char *what, mw_number_row *row,
                              int64_t *count, bool *ended, mw_error *error)
{
    char *line;
    mw_status status = fort14_line(source, &line, error);
    *ended = !line;
    if (status || !line) return status;
    *row = (mw_number_row){source, line};
    status = mw__row_integer(row, what, count, error);
    if (!status && *count < 0)
        status = mw__source_fail(source, error, "the %s is %" PRId64, what, *count);
    return status;
}

/* A vertex of a boundary; it makes an edge with the one before, if that is not 0. */
static mw_status fort14_boundary_vertex(mw_number_row *row, mw_mesh_builder *builder,
                                        int64_t *before, mw_error *error)
{
    int64_t vertex;
    uint32_t known;
    mw_status status = mw__row_integer(row, "vertex of the boundary", &vertex, error);
    if (!status) status = mw__build_vertex(builder, vertex, &known, error);
    if (!status && *before) status = mw__build_edge(builder, *before, vertex, error);
    *before = vertex;
    return status;
}

/* The vertices of one boundary, and those of its second side if it is an inside barrier. */
static mw_status fort14_read_boundary(mw_source *source, mw_mesh_builder *builder, int64_t count,
                                      bool two_sides, mw_error *error)
{
    mw_status status = MW_OK;
    int64_t before[2] = {0};
    for (int64_t i = 0; !status && i < count; i++) {
        char *line;
        status = fort14_line(source, &line, error);
        if (!status && !line)
            status = mw__rows_end_early(source, "vertices of a boundary", i, count, error);
        if (status) break;
        mw_number_row row = {source, line};
        status = fort14_boundary_vertex(&row, builder, &before[0], error);
        if (!status && two_sides && !mw__row_ends(&row))
            status = fort14_boundary_vertex(&row, builder, &before[1], error);
    }
    return status;
}

/* The type of a land boundary, which SCHISM can do without: a comment takes its place. */
static void fort14_take_type(const char *text, int64_t *type)
{
    int64_t number;
    const char *end = mw__read_integer(mw__skip_blanks(text), &number);
    if (end && mw__at_gap(end) && mw__integer_fits(number)) *type = number;
}

/* Weirs inside of the mesh, with pipes or without. */
static bool fort14_has_two_sides(int64_t type)
{
    return type == 4 || type == 5 || type == 24 || type == 25;
}

/* All open, or all land boundaries; neither need be there. */
static mw_status fort14_read_boundaries(mw_source *source, mw_mesh_builder *builder, bool land,
                                        mw_error *error)
{
    mw_number_row row;
    int64_t boundaries = 0, all, count = 0;
    bool ended;
    mw_status status =
        fort14_count(source, "number of boundaries", &row, &boundaries, &ended, error);
    if (status || ended) return status;
    status = fort14_count(source, "number of vertices of boundaries", &row, &all, &ended, error);
    if (status || ended) return status;
    for (int64_t b = 0; !status && b < boundaries; b++) {
        int64_t type = 0;
        char name[64];
        status =
            fort14_count(source, "number of vertices of a boundary", &row, &count, &ended, error);
        if (!status && ended)
            status = mw__rows_end_early(source, "boundaries", b, boundaries, error);
        if (!status && land) fort14_take_type(row.p, &type);
        if (land)
            snprintf(name, sizeof name, "land %" PRId64 " type %" PRId64, b + 1, type);
        else
            snprintf(name, sizeof name, "open %" PRId64, b + 1);
        if (!status) status = mw__build_mark(builder, name, error);
        if (!status)
            status =
                fort14_read_boundary(source, builder, count, fort14_has_two_sides(type), error);
    }
    return status;
}

mw_status mw__read_fort14(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    char *line;
    int64_t elements = 0, vertices = 0;
    builder->first_number = 1;
    mw_status status = mw__source_line(source, &line, error); /* the title */
    if (!status) status = fort14_line(source, &line, error);
    if (!status && !line)
        status = mw__source_fail(source, error,
                                 "the line with the numbers of elements and vertices is missing");
    if (status) return status;
    mw_number_row row = {source, line};
    status = mw__row_integer(&row, "number of elements", &elements, error);
    if (!status) status = mw__row_integer(&row, "number of vertices", &vertices, error);
    if (!status && (elements < 0 || vertices < 0))
        status = mw__source_fail(source, error, "a count is negative");
    if (!status) status = fort14_read_vertices(source, builder, vertices, error);
    if (!status) status = fort14_read_elements(source, builder, elements, error);
    if (!status) status = fort14_read_boundaries(source, builder, false, error);
    return status ? status : fort14_read_boundaries(source, builder, true, error);
}

/* The same with longitudes and latitudes, as the name says. */
mw_status mw__read_hgrid_ll(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    builder->file->crs = strdup("EPSG:4326");
    return builder->file->crs ? mw__read_fort14(source, builder, error) : mw__fail_memory(error);
}
