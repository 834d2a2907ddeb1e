/* Triangle's .poly: the vertices as in .node, or "0" and the vertices in the .node file of the same
 * name; then "count markers" and "number a b marker" a line for the segments; then "count" and
 * "number x y" a line for the holes. Markers, the numbers of segments and holes, and the attributes
 * of regions at the end are skipped. */
#include "io/constraints/poly.h"

#include "io/mesh/node_ele.h"
#include "io/text/counted_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The name without ".gz" and ".poly", in new memory. */
static char *poly_stem(const char *path)
{
    char *stem = strdup(path);
    if (!stem || !mw__path_ends(path, ".poly")) return stem;
    char *end = stem + strlen(stem) - strlen(".poly");
    if (strchr("zZ", end[strlen(".poly") - 1])) end -= strlen(".gz");
    *end = 0;
    return stem;
}

/* The vertices are in the .node file; what the .poly said about them is ignored. */
static mw_status poly_read_node_file(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    mw_mesh_file *mesh = builder->file;
    if (strcmp(source->path, "-") == 0)
        return mw__source_fail(source, error,
                               "the vertices are in a .node file beside this one; name the .poly "
                               "file instead of standard input");
    mw_mesh_file_release(mesh);
    mw__build_start(builder, mesh, source);
    char *stem = poly_stem(source->path);
    if (!stem) return mw__fail_memory(error);
    mw_status status = mw__read_node_file(stem, builder, error);
    free(stem);
    builder->source = source;
    return status;
}

static mw_status poly_read_vertices(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    int64_t dimension = 2;
    mw_status status = mw__read_node_rows(source, builder, &dimension, error);
    if (status) return status;
    if (dimension != 2)
        return mw__source_fail(
            source, error,
            "the vertices have 3 coordinates: this .poly file is of TetGen, not of Triangle");
    return builder->file->point_count > 0 ? MW_OK : poly_read_node_file(source, builder, error);
}

/* The vertices and their fields become those of the constraints. */
static void poly_take_vertices(mw_mesh_file *mesh, mw_constraint_file *file)
{
    for (size_t i = 0; !mesh->has_z && i < mesh->point_count; i++) mesh->points[3 * i + 2] = NAN;
    file->points = mesh->points;
    file->point_count = mesh->point_count;
    file->has_z = mesh->has_z;
    file->field_names = mesh->field_names;
    file->fields = mesh->fields;
    file->field_count = mesh->field_count;
    *mesh = (mw_mesh_file){.triangles = mesh->triangles};
}

static mw_status poly_read_segment(mw_constraint_builder *builder, mw_mesh_builder *vertices,
                                   mw_number_row *row, mw_error *error)
{
    int64_t number;
    uint32_t end[2] = {0};
    mw_status status = mw__row_integer(row, "number of the segment", &number, error);
    for (int k = 0; !status && k < 2; k++) {
        status = mw__row_integer(row, "end of the segment", &number, error);
        if (!status) status = mw__build_vertex(vertices, number, &end[k], error);
    }
    if (status) return status;
    return mw__constraint_segment(builder, end[0], end[1], MW_NONE,
                                  mw__source_position(row->source), error);
}

static mw_status poly_read_hole(mw_constraint_builder *builder, mw_number_row *row, mw_error *error)
{
    int64_t number;
    double xy[2] = {0};
    mw_status status = mw__row_integer(row, "number of the hole", &number, error);
    for (int k = 0; !status && k < 2; k++)
        status = mw__row_double(row, "point of the hole", &xy[k], error);
    if (!status && (!isfinite(xy[0]) || !isfinite(xy[1])))
        status = mw__source_fail(row->source, error, "the point of the hole is not finite");
    return status ? status : mw__constraint_hole(builder, xy[0], xy[1], error);
}

/* A header and its rows: segments where `vertices` are given, else holes, which a file may leave
 * out. */
static mw_status poly_read_rows(mw_source *source, mw_constraint_builder *builder,
                                mw_mesh_builder *vertices, mw_error *error)
{
    const char *what = vertices ? "segments" : "holes";
    char *line;
    int64_t values[2] = {0};
    mw_status status = mw__source_content_line(source, &line, error);
    if (!status && !line && !vertices) return MW_OK;
    if (!status && !line)
        status = mw__source_fail(source, error, "the file ends before the segments");
    if (!status) status = mw__rows_header(source, line, values, 2, error);
    for (int64_t i = 0; !status && i < values[0]; i++) {
        status = mw__source_content_line(source, &line, error);
        if (!status && !line) status = mw__rows_end_early(source, what, i, values[0], error);
        if (status) break;
        mw_number_row row = {source, line};
        status = vertices ? poly_read_segment(builder, vertices, &row, error)
                          : poly_read_hole(builder, &row, error);
    }
    return status;
}

static mw_status poly_skip_rest(mw_source *source, mw_error *error)
{
    char *line;
    mw_status status;
    do status = mw__source_content_line(source, &line, error);
    while (!status && line);
    return status;
}

mw_status mw__read_poly(mw_source *source, mw_constraint_builder *builder, mw_error *error)
{
    mw_mesh_file mesh;
    mw_mesh_builder vertices;
    mw__build_start(&vertices, &mesh, source);
    builder->file->record_name = "line";
    mw_status status = poly_read_vertices(source, &vertices, error);
    if (!status) status = poly_read_rows(source, builder, &vertices, error);
    if (!status) status = poly_read_rows(source, builder, NULL, error);
    if (!status) status = poly_skip_rest(source, error);
    if (!status) status = mw__build_finish(&vertices, error);
    if (!status) poly_take_vertices(&mesh, builder->file);
    mw_mesh_file_release(&mesh);
    return status;
}
