/* 2DM, the meshes of SMS: one card on each line. Read are ND (vertex: number x y z), E3T and E4Q
 * (triangle and quadrilateral: number, corners, material, which may be a real number). Cards of
 * lines (E2L, E3L), node strings and all other cards are skipped; elements with vertices on their
 * sides (E6T, E8Q, E9Q) are refused. Numbers may have gaps and come in any order: vertices and
 * faces are counted in the order of their numbers, as datasets list their values. */
#include "io/grid/grid_readers.h"
#include "io/grid/number_list.h"
#include "io/text/counted_rows.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct sms_mesh {
    mw_source *source;
    mw_rank_list vertices, faces;
    mw_number_list xyz;       /* three for each vertex */
    mw_integer_list lines;    /* of each vertex */
    mw_integer_list elements; /* five for each face: line, corners; corner 0: none */
    mw_number_list materials; /* of each face; 0: none */
    bool has_materials;       /* some face has one */
} sms_mesh;

enum { ELEMENT_SIZE = 5 };

static mw_status sms_read_vertex(sms_mesh *m, mw_number_row *row, mw_error *error)
{
    static const char *const names[] = {"x", "y", "z"};
    int64_t number;
    mw_status status = mw__row_integer(row, "number of the vertex", &number, error);
    if (!status) status = mw__integers_add(&m->vertices.numbers, number, error);
    if (!status) status = mw__integers_add(&m->lines, m->source->line, error);
    for (int k = 0; !status && k < 3; k++) {
        double value;
        status = mw__row_double(row, names[k], &value, error);
        if (!status) status = mw__numbers_add(&m->xyz, value, error);
    }
    return status;
}

static mw_status sms_read_element(sms_mesh *m, mw_number_row *row, int corners, mw_error *error)
{
    int64_t number, element[ELEMENT_SIZE] = {m->source->line};
    double material = 0;
    mw_status status = mw__row_integer(row, "number of the element", &number, error);
    for (int k = 0; !status && k < corners; k++) {
        status = mw__row_integer(row, "corner", &element[1 + k], error);
        if (!status && element[1 + k] <= 0)
            status = mw__source_fail(m->source, error, "%" PRId64 " is not a vertex number",
                                     element[1 + k]);
    }
    /* the material may be missing */
    if (!status && !mw__row_ends(row)) {
        status = mw__row_double(row, "material", &material, error);
        m->has_materials = true;
    }
    if (!status) status = mw__integers_add(&m->faces.numbers, number, error);
    for (int k = 0; !status && k < ELEMENT_SIZE; k++)
        status = mw__integers_add(&m->elements, element[k], error);
    return status ? status : mw__numbers_add(&m->materials, material, error);
}

static mw_status sms_read_card(sms_mesh *m, const char *line, mw_error *error)
{
    static const char *const refused[] = {"E6T", "E8Q", "E9Q"};
    size_t length = strcspn(line, " \t");
    mw_number_row row = {m->source, line + length};
    if (length == 2 && strncmp(line, "ND", 2) == 0) return sms_read_vertex(m, &row, error);
    if (length != 3) return MW_OK;
    if (strncmp(line, "E3T", 3) == 0) return sms_read_element(m, &row, 3, error);
    if (strncmp(line, "E4Q", 3) == 0) return sms_read_element(m, &row, 4, error);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (strncmp(line, refused[i], 3) == 0)
            return mw__source_fail(m->source, error,
                                   "%s: elements with vertices on their sides are not read",
                                   refused[i]);
    return MW_OK;
}

static mw_status sms_read_cards(sms_mesh *m, mw_error *error)
{
    char *line;
    mw_status status = mw__source_content_line(m->source, &line, error);
    if (status) return status;
    if (!line || strncmp(line, "MESH2D", 6) != 0)
        return mw__source_fail(m->source, error, "a 2DM file begins with MESH2D");
    while (!(status = mw__source_content_line(m->source, &line, error)) && line) {
        status = sms_read_card(m, line, error);
        if (status) return status;
    }
    return status;
}

/* Sort numbers; one that comes twice is an error, at the line that `lines` tells. */
static mw_status sms_sort(sms_mesh *m, mw_rank_list *ranks, const char *what, const int64_t *lines,
                          size_t stride, mw_error *error)
{
    size_t twice;
    mw_status status = mw__ranks_sort(ranks, &twice, error);
    if (!status && twice != SIZE_MAX)
        status = mw__source_fail_at(m->source, (uint64_t)lines[stride * twice], error,
                                    "this %s has the same number as another one", what);
    return status;
}

static mw_status sms_build_vertices(const sms_mesh *m, mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; !status && i < m->vertices.numbers.count; i++) {
        const double *p = m->xyz.values + 3 * mw__ranks_position(&m->vertices, i);
        status = mw__build_point(builder, p[0], p[1], p[2], error);
    }
    builder->points_complete = true;
    return status;
}

static mw_status sms_build_face(const sms_mesh *m, const int64_t *element, mw_mesh_builder *builder,
                                mw_error *error)
{
    mw_status status = MW_OK;
    m->source->line = element[0]; /* errors name it */
    mw__build_face(builder);
    for (int k = 1; !status && k <= 4 && element[k] > 0; k++) {
        size_t rank = mw__ranks_find(&m->vertices, element[k]);
        if (rank == SIZE_MAX)
            return mw__source_fail(m->source, error, "vertex %" PRId64 " does not exist",
                                   element[k]);
        status = mw__build_corner(builder, (int64_t)rank + 1, error);
    }
    return status ? status : mw__build_face_end(builder, error);
}

static mw_status sms_build_faces(const sms_mesh *m, mw_mesh_builder *builder, mw_error *error)
{
    mw_status status = MW_OK;
    size_t count = m->faces.numbers.count;
    for (size_t i = 0; !status && i < count; i++) {
        size_t position = mw__ranks_position(&m->faces, i);
        status = sms_build_face(m, m->elements.values + ELEMENT_SIZE * position, builder, error);
    }
    if (status || !m->has_materials) return status;
    double *materials = mw__alloc(count, sizeof *materials);
    if (!materials) return mw__fail_memory(error);
    for (size_t i = 0; i < count; i++)
        materials[i] = m->materials.values[mw__ranks_position(&m->faces, i)];
    status = mw__build_face_field(builder, "material", materials, error);
    free(materials);
    return status;
}

static mw_status sms_build(sms_mesh *m, mw_mesh_builder *builder, mw_error *error)
{
    builder->file->has_z = 1;
    builder->first_number = 1;
    mw_status status = sms_read_cards(m, error);
    int64_t end = m->source->line;
    if (!status) status = sms_sort(m, &m->vertices, "vertex", m->lines.values, 1, error);
    if (!status)
        status = sms_sort(m, &m->faces, "element", m->elements.values, ELEMENT_SIZE, error);
    if (!status) status = sms_build_vertices(m, builder, error);
    if (!status) status = sms_build_faces(m, builder, error);
    if (!status) m->source->line = end;
    if (!status && builder->file->point_count == 0)
        status = mw__source_fail(m->source, error, "there is no vertex ('ND') in this file");
    return status;
}

mw_status mw__read_2dm(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    sms_mesh m = {.source = source};
    mw_status status = sms_build(&m, builder, error);
    mw__ranks_release(&m.vertices);
    mw__ranks_release(&m.faces);
    free(m.xyz.values);
    free(m.lines.values);
    free(m.elements.values);
    free(m.materials.values);
    return status;
}
