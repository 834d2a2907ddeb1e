/* Triangle's .poly: the vertices as in .node, or "0" and the vertices in the .node file of the same name; then "count
 * markers" and "number a b marker" a line for the segments; then "count" and "number x y" a line for the holes. What
 * follows, the attributes of regions, is passed over, and so are markers and the numbers of segments and holes. */
#include "io/poly.h"

#include "io/mesh_readers.h"
#include "io/row.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The name without ".gz" and ".poly", in new memory. */
static char *stem_of(const char *path)
{
    char *stem = strdup(path);
    if (!stem || !mw__path_ends(path, ".poly")) return stem;
    char *end = stem + strlen(stem) - strlen(".poly");
    if (strchr("zZ", end[strlen(".poly") - 1])) end -= strlen(".gz");
    *end = 0;
    return stem;
}

/* The vertices stand in the .node file; what this one said of them does not count. */
static mw_status read_other_file(mw_source *source, mw_builder *builder, mw_error *error)
{
    mw_mesh_file *mesh = builder->file;
    if (strcmp(source->path, "-") == 0)
        return mw__source_fail(source, error, "the vertices stand in a .node file, which standard input cannot name");
    mw_mesh_file_release(mesh);
    mw__build_start(builder, mesh, source);
    char *stem = stem_of(source->path);
    if (!stem) return mw__fail_memory(error);
    mw_status status = mw__read_node_file(stem, builder, error);
    free(stem);
    builder->source = source;
    return status;
}

static mw_status read_vertices(mw_source *source, mw_builder *builder, mw_error *error)
{
    int64_t dimension = 2;
    mw_status status = mw__read_node_rows(source, builder, &dimension, error);
    if (status) return status;
    if (dimension != 2)
        return mw__source_fail(source, error, "vertices of 3 coordinates: this is a .poly of TetGen, not of Triangle");
    return builder->file->point_count > 0 ? MW_OK : read_other_file(source, builder, error);
}

/* The vertices and their fields become those of the constraints. */
static void hand_over(mw_mesh_file *mesh, mw_constraint_file *file)
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

static mw_status read_segment(mw_constraint_builder *builder, mw_builder *vertices, mw_row *row, mw_error *error)
{
    int64_t number;
    uint32_t end[2] = {0};
    mw_status status = mw__row_integer(row, "number of the segment", &number, error);
    for (int k = 0; !status && k < 2; k++) {
        status = mw__row_integer(row, "end of the segment", &number, error);
        if (!status) status = mw__build_vertex(vertices, number, &end[k], error);
    }
    if (status) return status;
    return mw__constraint_segment(builder, end[0], end[1], MW_NONE, mw__source_place(row->source), error);
}

static mw_status read_hole(mw_constraint_builder *builder, mw_row *row, mw_error *error)
{
    int64_t number;
    double xy[2] = {0};
    mw_status status = mw__row_integer(row, "number of the hole", &number, error);
    for (int k = 0; !status && k < 2; k++) status = mw__row_double(row, "place of the hole", &xy[k], error);
    if (!status && (!isfinite(xy[0]) || !isfinite(xy[1])))
        status = mw__source_fail(row->source, error, "the place of the hole is not finite");
    return status ? status : mw__constraint_hole(builder, xy[0], xy[1], error);
}

/* A header and its rows: segments where `vertices` are given, else holes, which a file may leave out. */
static mw_status read_rows(mw_source *source, mw_constraint_builder *builder, mw_builder *vertices, mw_error *error)
{
    const char *what = vertices ? "segments" : "holes";
    char *line;
    int64_t values[2] = {0};
    mw_status status = mw__source_content(source, &line, error);
    if (!status && !line && !vertices) return MW_OK;
    if (!status && !line) status = mw__source_fail(source, error, "the file ends before the segments");
    if (!status) status = mw__row_header(source, line, values, 2, error);
    for (int64_t i = 0; !status && i < values[0]; i++) {
        status = mw__source_content(source, &line, error);
        if (!status && !line) status = mw__rows_ended(source, what, i, values[0], error);
        if (status) break;
        mw_row row = {source, line};
        status = vertices ? read_segment(builder, vertices, &row, error) : read_hole(builder, &row, error);
    }
    return status;
}

static mw_status skip_rest(mw_source *source, mw_error *error)
{
    char *line;
    mw_status status;
    do status = mw__source_content(source, &line, error);
    while (!status && line);
    return status;
}

mw_status mw__read_poly(mw_source *source, mw_constraint_builder *builder, mw_error *error)
{
    mw_mesh_file mesh;
    mw_builder vertices;
    mw__build_start(&vertices, &mesh, source);
    builder->file->record_name = "line";
    mw_status status = read_vertices(source, &vertices, error);
    if (!status) status = read_rows(source, builder, &vertices, error);
    if (!status) status = read_rows(source, builder, NULL, error);
    if (!status) status = skip_rest(source, error);
    if (!status) status = mw__build_finish(&vertices, error);
    if (!status) hand_over(&mesh, builder->file);
    mw_mesh_file_release(&mesh);
    return status;
}
