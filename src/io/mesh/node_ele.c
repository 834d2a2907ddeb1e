/* Triangle's .node and .ele: "count 2 attributes markers", then "number x y attributes marker" a
 * line, and "count 3 attributes", then "number a b c ..." a line. Numbering starts with 0 or 1: the
 * number of the first vertex decides. Markers and attributes of triangles are skipped; of six
 * corners the first three are read.
 *
 * The format has no names for attributes and no heights. A comment "# attributes: z, depth" on
 * top, which other programs skip, names them here, and an attribute called z is taken as the
 * height. */
#include "io/mesh/node_ele.h"
#include "base/posix.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/text/counted_rows.h"
#include "io/text/number_text.h"
#include "io/text/output.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char names_mark[] = "# attributes:";

/* The line that announces the rows, comments before it passed over; *names is a copy of the list
 * of names, or NULL. */
static mw_status node_read_top(mw_source *source, char **line, char **names, mw_error *error)
{
    for (;;) {
        mw_status status = mw__source_line(source, line, error);
        if (status || !*line) return status;
        char *p = mw__skip_blanks(*line);
        if (!*names && strncmp(p, names_mark, sizeof names_mark - 1) == 0) {
            *names = strdup(p + sizeof names_mark - 1);
            if (!*names) return mw__fail_memory(error);
        }
        p[strcspn(p, "#")] = 0;
        *line = p;
        if (*p) return MW_OK;
    }
}

static size_t attribute_names_count(const char *names)
{
    size_t count = 1;
    for (; *names; names++) count += *names == ',';
    return count;
}

/* Cut the next name off a list. */
static char *attribute_names_next(char **rest)
{
    char *name = mw__skip_blanks(*rest), *end = name + strcspn(name, ",");
    *rest = *end ? end + 1 : end;
    while (end > name && mw__is_blank(end[-1])) end--;
    *end = 0;
    return name;
}

/* Add the fields. *z is the position of the attribute that is the height, `attributes` if there
 * is none. */
static mw_status node_add_fields(mw_mesh_builder *builder, size_t attributes, char *names,
                                 size_t *z, mw_error *error)
{
    *z = attributes;
    bool named = names && attribute_names_count(names) == attributes;
    for (size_t a = 0; a < attributes; a++) {
        char number[32];
        snprintf(number, sizeof number, "attribute%zu", a + 1);
        const char *name = named ? attribute_names_next(&names) : number;
        if (named && *z == attributes && strcmp(name, "z") == 0) {
            *z = a;
            builder->file->has_z = 1;
            continue;
        }
        mw_status status = mw__build_field(builder, *name ? name : number, error);
        if (status) return status;
    }
    return MW_OK;
}

typedef struct node_header {
    int64_t count, dimension, attributes;
    size_t z; /* attribute that is the height */
} node_header;

static mw_status node_read_vertex(mw_source *source, const char *line, int64_t v,
                                  const node_header *header, mw_mesh_builder *builder,
                                  mw_error *error)
{
    mw_number_row r = {source, line};
    int64_t number;
    double xyz[3] = {0};
    mw_status status = mw__row_integer(&r, "number of the vertex", &number, error);
    if (!status && v == 0) {
        if (number != 0 && number != 1)
            return mw__source_fail(source, error,
                                   "the first vertex has the number %" PRId64 " instead of 0 or 1",
                                   number);
        builder->first_number = number;
    }
    if (!status && number != v + builder->first_number)
        return mw__source_fail(source, error, "vertex %" PRId64 " where %" PRId64 " was expected",
                               number, v + builder->first_number);
    for (int64_t k = 0; !status && k < header->dimension; k++)
        status = mw__row_double(&r, "coordinate", &xyz[k], error);
    if (!status) status = mw__build_point(builder, xyz[0], xyz[1], xyz[2], error);
    for (size_t a = 0, field = 0; !status && a < (size_t)header->attributes; a++) {
        double value;
        status = mw__row_double(&r, "attribute", &value, error);
        if (status) break;
        if (a == header->z)
            builder->file->points[3 * (builder->file->point_count - 1) + 2] = value;
        else
            mw__build_value(builder, field++, value);
    }
    return status;
}

mw_status mw__read_node_rows(mw_source *node, mw_mesh_builder *builder, int64_t *dimension,
                             mw_error *error)
{
    char *line, *names = NULL;
    int64_t values[4] = {0, 2, 0, 0};
    node_header header = {0};
    builder->source = node;
    mw_status status = node_read_top(node, &line, &names, error);
    if (!status) status = mw__rows_header(node, line, values, 4, error);
    if (!status && values[1] != 2 && values[1] != 3)
        status = mw__source_fail(node, error,
                                 "the vertices have %" PRId64 " coordinates; 2 or 3 are possible",
                                 values[1]);
    if (!status && values[2] > MW_COLUMN_LIMIT)
        status = mw__source_fail(node, error, "more than %d attributes", MW_COLUMN_LIMIT);
    if (!status) {
        header = (node_header){values[0], values[1], values[2], 0};
        builder->file->has_z = header.dimension == 3;
        status = node_add_fields(builder, (size_t)header.attributes, names, &header.z, error);
    }
    free(names);
    for (int64_t v = 0; !status && v < header.count; v++) {
        status = mw__source_content_line(node, &line, error);
        if (!status && !line) status = mw__rows_end_early(node, "vertices", v, header.count, error);
        if (!status) status = node_read_vertex(node, line, v, &header, builder, error);
    }
    builder->points_complete = true;
    *dimension = header.dimension;
    return status;
}

mw_status mw__read_node(mw_source *node, mw_mesh_builder *builder, mw_error *error)
{
    int64_t dimension;
    mw_status status = mw__read_node_rows(node, builder, &dimension, error);
    return status
               ? status
               : mw__rows_check_end(node, "vertices", (int64_t)builder->file->point_count, error);
}

mw_status mw__read_ele(mw_source *ele, mw_mesh_builder *builder, mw_error *error)
{
    char *line;
    int64_t values[3] = {0, 3, 0}, first = 0;
    builder->source = ele;
    mw_status status = mw__source_content_line(ele, &line, error);
    if (!status) status = mw__rows_header(ele, line, values, 3, error);
    if (!status && values[1] != 3 && values[1] != 6)
        status = mw__source_fail(ele, error,
                                 "the elements have %" PRId64 " corners; triangles have 3 (or 6)",
                                 values[1]);
    for (int64_t t = 0; !status && t < values[0]; t++) {
        int64_t number = 0;
        status = mw__source_content_line(ele, &line, error);
        if (!status && !line) status = mw__rows_end_early(ele, "triangles", t, values[0], error);
        if (status) break;
        mw_number_row r = {ele, line};
        status = mw__row_integer(&r, "number of the triangle", &number, error);
        if (t == 0) first = number == 1;
        if (!status && number != t + first)
            status =
                mw__source_fail(ele, error, "triangle %" PRId64 " where %" PRId64 " was expected",
                                number, t + first);
        mw__build_face(builder);
        for (int64_t k = 0; !status && k < values[1]; k++) {
            status = mw__row_integer(&r, "corner", &number, error);
            if (!status && k < 3) status = mw__build_corner(builder, number, error);
        }
        if (!status) status = mw__build_face_end(builder, error);
    }
    return status ? status : mw__rows_check_end(ele, "triangles", values[0], error);
}

/* The path without ".gz" and without ".node" or ".ele". */
static size_t node_ele_stem_length(const char *path)
{
    size_t length = strlen(path);
    if (length > 3 && strcmp(path + length - 3, ".gz") == 0) length -= 3;
    if (mw__path_ends(path, ".node")) return length - 5;
    if (mw__path_ends(path, ".ele")) return length - 4;
    return strlen(path);
}

/* The file of a kind (".node" or ".ele") that belongs to `path`, in new memory; NULL without
 * memory. */
static char *node_ele_find_file(const char *path, const char *ending)
{
    if (mw__path_ends(path, ending)) return strdup(path);
    int stem = (int)node_ele_stem_length(path);
    size_t size = strlen(path) + 16;
    char *found = mw__alloc(size, 1);
    if (!found) return NULL;
    snprintf(found, size, "%.*s%s.gz", stem, path, ending);
    bool packed = access(found, F_OK) == 0;
    snprintf(found, size, "%.*s%s", stem, path, ending);
    if (packed && access(found, F_OK) != 0) strcat(found, ".gz");
    return found;
}

mw_status mw__node_ele_exists(const char *path, bool *exists, mw_error *error)
{
    char *found = node_ele_find_file(path, ".node");
    if (!found) return mw__fail_memory(error);
    *exists = access(found, F_OK) == 0;
    free(found);
    return MW_OK;
}

static mw_status node_ele_read_file(const char *path, const char *ending, mw_mesh_builder *builder,
                                    mw_status (*read)(mw_source *, mw_mesh_builder *, mw_error *),
                                    mw_error *error)
{
    mw_source source;
    char *found = node_ele_find_file(path, ending);
    if (!found) return mw__fail_memory(error);
    mw_status status = mw__source_open(&source, found, error);
    free(found);
    if (status) return status;
    if (builder->job) mw__source_watch(&source, builder->job);
    status = read(&source, builder, error);
    if (!status) status = mw__build_finish(builder, error);
    mw__source_close(&source);
    return status;
}

mw_status mw__read_node_file(const char *path, mw_mesh_builder *builder, mw_error *error)
{
    return node_ele_read_file(path, ".node", builder, mw__read_node, error);
}

mw_status mw__read_node_ele(const char *path, mw_mesh_builder *builder, mw_error *error)
{
    mw_job *job = builder->job;
    mw_job_span outer = job ? mw__job_steps_of(job, 0, 1, 2) : (mw_job_span){0};
    mw_status status = mw__read_node_file(path, builder, error);
    if (job) mw__job_steps_end(job, outer);
    if (job) outer = mw__job_steps_of(job, 1, 1, 2);
    if (!status) status = node_ele_read_file(path, ".ele", builder, mw__read_ele, error);
    if (job) mw__job_steps_end(job, outer);
    return status;
}

static void node_write(mw_output *output, const mw_mesh_file *file)
{
    size_t attributes = file->field_count + (file->has_z ? 1 : 0);
    if (attributes > 0) mw__output_text(output, names_mark);
    if (file->has_z) mw__output_text(output, file->field_count > 0 ? " z," : " z");
    for (size_t f = 0; f < file->field_count; f++) {
        mw__output_char(output, ' ');
        mw__output_field_name(output, file->field_names, f);
        if (f + 1 < file->field_count) mw__output_char(output, ',');
    }
    mw_output_printf(output, "%s%zu 2 %zu 0\n", attributes > 0 ? "\n" : "", file->point_count,
                     attributes);
    for (size_t v = 0; v < file->point_count && !mw_output_failed(output); v++) {
        mw__output_integer(output, v);
        for (size_t k = 0; k < (file->has_z ? 3 : 2); k++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->points[3 * v + k]);
        }
        for (size_t f = 0; f < file->field_count; f++) {
            mw__output_char(output, ' ');
            mw_output_double(output, file->fields[f][v]);
        }
        mw__output_char(output, '\n');
    }
}

static void ele_write(mw_output *output, const mw_mesh_file *file)
{
    mw_output_printf(output, "%zu 3 0\n", file->triangle_count);
    for (size_t t = 0; t < file->triangle_count && !mw_output_failed(output); t++) {
        mw__output_integer(output, t);
        for (size_t k = 0; k < 3; k++) {
            mw__output_char(output, ' ');
            mw__output_integer(output, file->triangles[3 * t + k]);
        }
        mw__output_char(output, '\n');
    }
}

/* Both files are complete before the first of them gets its name. */
mw_status mw__write_node_ele(const char *path, const mw_mesh_file *file, mw_job *job,
                             mw_error *error)
{
    if (strcmp(path, "-") == 0)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the format 'node' writes two files: it needs a name for them");
    int stem = (int)node_ele_stem_length(path);
    size_t size = strlen(path) + 16;
    char *node_path = mw__alloc(2, size);
    if (!node_path) return mw__fail_memory(error);
    char *ele_path = node_path + size;
    snprintf(node_path, size, "%.*s.node", stem, path);
    snprintf(ele_path, size, "%.*s.ele", stem, path);
    mw_output *node = NULL, *ele = NULL;
    mw_status status = mw_output_open(node_path, &node, error);
    if (!status) status = mw_output_open(ele_path, &ele, error);
    free(node_path);
    if (status) {
        mw_output_close(node, 0, NULL);
        return status;
    }
    mw__output_watch(node, job, mw__expected_bytes(file));
    mw__output_watch(ele, job, mw__expected_bytes(file));
    node_write(node, file);
    ele_write(ele, file);
    mw__output_flush(node);
    mw__output_flush(ele);
    bool complete = !mw_output_failed(node) && !mw_output_failed(ele);
    bool node_failed = mw_output_failed(node);
    if (!complete) { /* report the one that failed, drop the other */
        status = mw_output_close(node_failed ? node : ele, 1, error);
        mw_output_close(node_failed ? ele : node, 0, NULL);
        return status;
    }
    status = mw_output_close(ele, 1, error);
    mw_status second = mw_output_close(node, !status, status ? NULL : error);
    return status ? status : second;
}
