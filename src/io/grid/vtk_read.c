/* Legacy VTK, versions 1 to 5, as text and as bytes: unstructured grids and polydata. Read are
 * triangles, quadrilaterals, pixels, polygons and strips; vertices, lines and volumes are passed
 * over. Values of points become fields, those of cells triangle fields; a vector becomes NAME_0,
 * NAME_1, ... Texts are passed over. In names a blank is %20. */
#include "base/posix.h"
#include "io/grid/cell_builder.h"
#include "io/grid/grid_readers.h"
#include "io/grid/value_source.h"
#include "io/text/byte_order.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct vtk_mesh {
    mw_value_source values;
    mw_mesh_builder *builder;
    mw_cell_builder cells;
    bool old;       /* before version 5: each cell begins with its count of corners */
    int64_t tuples; /* of the data section: points or cells */
    bool cell_data; /* that section is of cells */
} vtk_mesh;

static mw_source *vtk_source(const vtk_mesh *m)
{
    return m->values.source;
}

/* Types of values that are no numbers of bytes: bits, eight to a byte, and texts. */
static const mw_number_type vtk_bits = {MW_NUMBER_UNSIGNED, 0}, vtk_texts = {MW_NUMBER_SIGNED, 0};

static mw_status vtk_type(vtk_mesh *m, const char *word, mw_number_type *type, mw_error *error)
{
    static const struct {
        const char *name;
        mw_number_type type;
    } types[] = {
        {"double", {MW_NUMBER_FLOAT, 8}},        {"float", {MW_NUMBER_FLOAT, 4}},
        {"int", {MW_NUMBER_SIGNED, 4}},          {"unsigned_int", {MW_NUMBER_UNSIGNED, 4}},
        {"long", {MW_NUMBER_SIGNED, 8}},         {"unsigned_long", {MW_NUMBER_UNSIGNED, 8}},
        {"short", {MW_NUMBER_SIGNED, 2}},        {"unsigned_short", {MW_NUMBER_UNSIGNED, 2}},
        {"char", {MW_NUMBER_SIGNED, 1}},         {"unsigned_char", {MW_NUMBER_UNSIGNED, 1}},
        {"vtktypeint64", {MW_NUMBER_SIGNED, 8}}, {"vtktypeuint64", {MW_NUMBER_UNSIGNED, 8}},
        {"vtktypeint32", {MW_NUMBER_SIGNED, 4}}, {"vtktypeuint32", {MW_NUMBER_UNSIGNED, 4}},
        {"vtkidtype", {MW_NUMBER_SIGNED, 4}},
    };
    for (size_t i = 0; word && i < sizeof types / sizeof *types; i++)
        if (strcasecmp(word, types[i].name) == 0) {
            *type = types[i].type;
            return MW_OK;
        }
    return mw__source_fail(vtk_source(m), error, "values of type '%s' are not read",
                           word ? mw__excerpt(word).text : "");
}

static mw_status vtk_word_type(vtk_mesh *m, mw_number_type *type, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&m->values, &word, error);
    return status ? status : vtk_type(m, word, type, error);
}

/* The type of values of points or cells. */
static mw_status vtk_values_type(vtk_mesh *m, mw_number_type *type, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&m->values, &word, error);
    bool text = word && (strcasecmp(word, "string") == 0 || strcasecmp(word, "utf8_string") == 0);
    bool bit = word && strcasecmp(word, "bit") == 0;
    if (text || bit) *type = text ? vtk_texts : vtk_bits;
    return status || text || bit ? status : vtk_type(m, word, type, error);
}

static mw_status vtk_read_points(vtk_mesh *m, mw_error *error)
{
    int64_t count;
    mw_number_type type;
    mw_status status = mw__value_word_count(&m->values, "number of points", &count, error);
    if (!status) status = vtk_word_type(m, &type, error);
    if (!status && m->builder->points_complete)
        status = mw__source_fail(vtk_source(m), error, "the points come a second time");
    for (int64_t i = 0; !status && i < count; i++) {
        double xyz[3];
        for (int k = 0; !status && k < 3; k++)
            status = mw__value_double(&m->values, type, "coordinate", &xyz[k], error);
        if (!status) status = mw__build_point(m->builder, xyz[0], xyz[1], xyz[2], error);
        if (!status) m->builder->file->has_z |= xyz[2] != 0;
    }
    m->builder->points_complete = true;
    return status;
}

/* Numbers with a keyword and a type in front of them, as version 5 has them. */
static mw_status vtk_read_array(vtk_mesh *m, const char *keyword, int64_t count,
                                mw_integer_list *list, mw_error *error)
{
    char *word;
    mw_number_type type;
    mw_status status = mw__value_word(&m->values, &word, error);
    if (!status && (!word || strcasecmp(word, keyword) != 0))
        status = mw__source_fail(vtk_source(m), error, "expected %s", keyword);
    if (!status) status = vtk_word_type(m, &type, error);
    for (int64_t i = 0; !status && i < count; i++) {
        int64_t value;
        status = mw__value_integer(&m->values, type, "number of a vertex", &value, error);
        if (!status) status = mw__integers_add(list, value, error);
    }
    return status;
}

/* Cells with their counts in front: "n a b c ...". */
static mw_status vtk_read_old_cells(vtk_mesh *m, int64_t count, int64_t all, mw_error *error)
{
    static const mw_number_type integer = {MW_NUMBER_SIGNED, 4};
    mw_status status = MW_OK;
    for (int64_t i = 0; !status && i < count; i++) {
        int64_t corners, vertex;
        status = mw__value_integer(&m->values, integer, "number of corners", &corners, error);
        if (!status && (corners < 0 || corners > all))
            status = mw__source_fail(vtk_source(m), error,
                                     "a cell has %" PRId64 " corners, but only %" PRId64
                                     " numbers are left",
                                     corners, all);
        if (status) break;
        all -= corners + 1;
        for (int64_t k = 0; !status && k < corners; k++) {
            status = mw__value_integer(&m->values, integer, "number of a vertex", &vertex, error);
            if (!status) status = mw__integers_add(&m->cells.corners, vertex, error);
        }
        if (!status)
            status = mw__integers_add(&m->cells.ends, (int64_t)m->cells.corners.count, error);
    }
    return status;
}

/* Version 5: counts of offsets and of corners; offsets begin with 0. */
static mw_status vtk_read_new_cells(vtk_mesh *m, int64_t offsets, int64_t corners, mw_error *error)
{
    mw_integer_list ends = {0};
    int64_t before = (int64_t)m->cells.corners.count;
    mw_status status = vtk_read_array(m, "OFFSETS", offsets, &ends, error);
    if (!status) status = vtk_read_array(m, "CONNECTIVITY", corners, &m->cells.corners, error);
    for (size_t i = 1; !status && i < ends.count; i++)
        status = ends.values[i] < 0 || ends.values[i] > corners
                     ? mw__source_fail(vtk_source(m), error,
                                       "the offset %" PRId64 " is outside the list of corners",
                                       ends.values[i])
                     : mw__integers_add(&m->cells.ends, before + ends.values[i], error);
    free(ends.values);
    return status;
}

/* A group of cells; those of polydata have one type, which their keyword tells. */
static mw_status vtk_read_cells(vtk_mesh *m, int64_t type, mw_error *error)
{
    int64_t count, all;
    size_t before = m->cells.ends.count;
    mw_status status = mw__value_word_count(&m->values, "number of cells", &count, error);
    if (!status) status = mw__value_word_count(&m->values, "number of corners", &all, error);
    if (!status)
        status = m->old ? vtk_read_old_cells(m, count, all, error)
                        : vtk_read_new_cells(m, count, all, error);
    for (size_t i = before; !status && type && i < m->cells.ends.count; i++)
        status = mw__integers_add(&m->cells.types, type, error);
    return status;
}

static mw_status vtk_read_cell_types(vtk_mesh *m, mw_error *error)
{
    static const mw_number_type integer = {MW_NUMBER_SIGNED, 4};
    int64_t count, type;
    mw_status status = mw__value_word_count(&m->values, "number of types", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        status = mw__value_integer(&m->values, integer, "type of a cell", &type, error);
        if (!status) status = mw__integers_add(&m->cells.types, type, error);
    }
    return status;
}

/* --- values --- */

/* The length of a text of bytes stands in front of it, in 1, 2, 4 or 8 bytes, as two bits tell. */
static mw_status vtk_skip_text(vtk_mesh *m, mw_error *error)
{
    static const size_t sizes[] = {8, 4, 2, 1};
    const char *next;
    const unsigned char *bytes;
    size_t there;
    mw_status status = mw__source_peek(vtk_source(m), 1, &next, &there, error);
    if (status) return status;
    size_t size = sizes[there ? (unsigned char)*next >> 6 : 3];
    status = mw__value_bytes(&m->values, size, &bytes, error);
    if (status) return status;
    uint64_t length = mw__get_bytes(bytes, size, true) & (UINT64_MAX >> (66 - 8 * size));
    return mw__source_skip(vtk_source(m), length, error);
}

/* As text, each stands in a line of its own. */
static mw_status vtk_skip_texts(vtk_mesh *m, int64_t count, mw_error *error)
{
    mw_status status = MW_OK;
    m->values.rest = NULL;
    for (int64_t i = 0; !status && i < count; i++) {
        char *line = NULL;
        status =
            m->values.binary ? vtk_skip_text(m, error) : mw__value_line(&m->values, &line, error);
        if (!status && !line && !m->values.binary)
            status = mw__source_fail(vtk_source(m), error, "the file ends before a text");
    }
    return status;
}

/* Read a value. Bits are taken from `byte`; a new byte is read after eight of them. */
static mw_status vtk_read_value(vtk_mesh *m, mw_number_type type, uint64_t i, double *value,
                                unsigned *byte, mw_error *error)
{
    if (type.size > 0 || !m->values.binary)
        return mw__value_double(&m->values, type, "value", value, error);
    if (i % 8 == 0) {
        const unsigned char *bytes;
        mw_status status = mw__value_bytes(&m->values, 1, &bytes, error);
        if (status) return status;
        *byte = *bytes;
    }
    *value = *byte >> (7 - i % 8) & 1;
    return MW_OK;
}

/* `count` values of the points or cells, `width` each, with a name. */
static mw_status vtk_read_values(vtk_mesh *m, const char *name, int64_t width, int64_t tuples,
                                 mw_number_type type, mw_error *error)
{
    mw_number_list list = {0};
    mw_status status = MW_OK;
    unsigned byte = 0;
    uint64_t at = 0;
    if (type.size == 0 && type.kind == vtk_texts.kind)
        return tuples == 0 || tuples <= INT64_MAX / width
                   ? vtk_skip_texts(m, tuples * width, error)
                   : mw__source_fail(vtk_source(m), error, "there are too many texts");
    for (int64_t i = 0; !status && i < tuples; i++)
        for (int64_t k = 0; !status && k < width; k++) {
            double value;
            status = vtk_read_value(m, type, at++, &value, &byte, error);
            if (!status) status = mw__numbers_add(&list, value, error);
        }
    if (!status && tuples == m->tuples)
        status = mw__cells_add_values(&m->cells, m->builder, name, list.values, (size_t)tuples,
                                      (size_t)width, m->cell_data, error);
    free(list.values);
    return status;
}

static int vtk_hex_digit(char c)
{
    return c >= '0' && c <= '9'                     ? c - '0'
           : (c | 0x20) >= 'a' && (c | 0x20) <= 'f' ? (c | 0x20) - 'a' + 10
                                                    : -1;
}

/* %20 and others become the characters that they stand for. */
static void vtk_decode_name(char *name)
{
    char *to = name;
    for (const char *c = name; *c; c++) {
        int high = *c == '%' ? vtk_hex_digit(c[1]) : -1;
        int low = high >= 0 ? vtk_hex_digit(c[2]) : -1;
        *to++ = low < 0 || 16 * high + low < ' ' ? *c : (char)(16 * high + low);
        if (low >= 0 && 16 * high + low >= ' ') c += 2;
    }
    *to = 0;
}

static mw_status vtk_copy_name(vtk_mesh *m, char *name, size_t size, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&m->values, &word, error);
    if (status) return status;
    if (!word || strlen(word) >= size)
        return mw__source_fail(vtk_source(m), error, "a name is missing or too long");
    strcpy(name, word);
    vtk_decode_name(name);
    return MW_OK;
}

enum { VTK_NAME_SIZE = 256, VTK_WIDTH_LIMIT = 1000 };

static mw_status vtk_check_width(vtk_mesh *m, int64_t width, mw_error *error)
{
    if (width >= 1 && width <= VTK_WIDTH_LIMIT) return MW_OK;
    return mw__source_fail(vtk_source(m), error,
                           "the values have %" PRId64 " numbers each; 1 to 1000 are read", width);
}

/* SCALARS name type (width), and then perhaps LOOKUP_TABLE name. */
static mw_status vtk_read_scalars(vtk_mesh *m, mw_error *error)
{
    char name[VTK_NAME_SIZE];
    mw_number_type type;
    int64_t width = 1;
    mw_status status = vtk_copy_name(m, name, sizeof name, error);
    if (!status) status = vtk_values_type(m, &type, error);
    if (!status && *mw__skip_blanks(m->values.rest))
        status = mw__value_word_integer(&m->values, "count of components", &width, error);
    if (!status) status = vtk_check_width(m, width, error);
    if (!status && m->values.binary) { /* the line is there, or else these are values */
        const char *next;
        size_t size;
        status = mw__source_peek(vtk_source(m), 12, &next, &size, error);
        if (status) return status;
        if (size == 12 && memcmp(next, "LOOKUP_TABLE", 12) == 0) {
            char *line;
            status = mw__value_line(&m->values, &line, error);
        }
    } else if (!status) {
        char *line;
        do status = mw__value_line(&m->values, &line, error);
        while (!status && line && !*mw__skip_blanks(line));
        if (!status && line && strncmp(mw__skip_blanks(line), "LOOKUP_TABLE", 12) != 0)
            mw__source_unread_line(vtk_source(m));
    }
    m->values.rest = NULL;
    return status ? status : vtk_read_values(m, name, width, m->tuples, type, error);
}

/* VECTORS, NORMALS, TENSORS, TENSORS6, GLOBAL_IDS, PEDIGREE_IDS, EDGE_FLAGS name type;
 * TEXTURE_COORDINATES name width type. */
static mw_status vtk_read_vectors(vtk_mesh *m, int64_t width, mw_error *error)
{
    char name[VTK_NAME_SIZE];
    mw_number_type type;
    mw_status status = vtk_copy_name(m, name, sizeof name, error);
    if (!status && !width)
        status = mw__value_word_integer(&m->values, "count of components", &width, error);
    if (!status) status = vtk_check_width(m, width, error);
    if (!status) status = vtk_values_type(m, &type, error);
    return status ? status : vtk_read_values(m, name, width, m->tuples, type, error);
}

/* COLOR_SCALARS name width: numbers from 0 to 1, or bytes. */
static mw_status vtk_read_colours(vtk_mesh *m, mw_error *error)
{
    char name[VTK_NAME_SIZE];
    int64_t width;
    mw_status status = vtk_copy_name(m, name, sizeof name, error);
    if (!status) status = mw__value_word_integer(&m->values, "count of colours", &width, error);
    if (!status) status = vtk_check_width(m, width, error);
    return status ? status
                  : vtk_read_values(m, name, width, m->tuples,
                                    (mw_number_type){MW_NUMBER_UNSIGNED, 1}, error);
}

/* A table of colours is passed over. */
static mw_status vtk_skip_table(vtk_mesh *m, mw_error *error)
{
    char name[VTK_NAME_SIZE];
    int64_t count;
    mw_status status = vtk_copy_name(m, name, sizeof name, error);
    if (!status) status = mw__value_word_count(&m->values, "size of the table", &count, error);
    for (int64_t i = 0; !status && i / 4 < count; i++) {
        double ignored;
        status = mw__value_double(&m->values, (mw_number_type){MW_NUMBER_UNSIGNED, 1}, "colour",
                                  &ignored, error);
    }
    return status;
}

/* What begins with METADATA ends with an empty line. */
static mw_status vtk_skip_metadata(vtk_mesh *m, mw_error *error)
{
    char *line;
    mw_status status;
    do status = mw__value_line(&m->values, &line, error);
    while (!status && line && *mw__skip_blanks(line));
    m->values.rest = NULL;
    return status;
}

/* FIELD name count, and for each: name width tuples type. */
static mw_status vtk_read_field(vtk_mesh *m, mw_error *error)
{
    char name[VTK_NAME_SIZE];
    int64_t count, width, tuples;
    mw_number_type type;
    mw_status status = vtk_copy_name(m, name, sizeof name, error);
    if (!status) status = mw__value_word_count(&m->values, "count of arrays", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        status = vtk_copy_name(m, name, sizeof name, error);
        if (!status && strcmp(name, "METADATA") == 0) {
            status = vtk_skip_metadata(m, error);
            i--;
            continue;
        }
        if (!status)
            status = mw__value_word_count(&m->values, "count of components", &width, error);
        if (!status) status = mw__value_word_count(&m->values, "count of values", &tuples, error);
        if (!status && tuples > 0) status = vtk_check_width(m, width, error);
        if (!status) status = vtk_values_type(m, &type, error);
        if (!status) status = vtk_read_values(m, name, width, tuples, type, error);
    }
    return status;
}

static mw_status vtk_begin_data(vtk_mesh *m, bool cell_data, mw_error *error)
{
    size_t there = cell_data ? m->cells.ends.count : m->builder->file->point_count;
    mw_status status = mw__value_word_count(&m->values, "count of values", &m->tuples, error);
    m->cell_data = cell_data;
    if (!status && (uint64_t)m->tuples != there)
        status = mw__source_fail(vtk_source(m), error, "the file has %" PRId64 " values for %zu %s",
                                 m->tuples, there, cell_data ? "cells" : "points");
    return status;
}

/* --- all of it --- */

typedef enum vtk_keyword {
    VTK_POINTS,
    VTK_CELLS,
    VTK_CELL_TYPES,
    VTK_POLYGONS,
    VTK_STRIPS,
    VTK_LINES,
    VTK_VERTICES,
    VTK_POINT_DATA,
    VTK_CELL_DATA,
    VTK_SCALARS,
    VTK_VECTORS,
    VTK_NORMALS,
    VTK_TENSORS,
    VTK_TENSORS_6,
    VTK_GLOBAL_IDS,
    VTK_PEDIGREE_IDS,
    VTK_EDGE_FLAGS,
    VTK_TEXTURE,
    VTK_COLOURS,
    VTK_FIELD,
    VTK_TABLE,
    VTK_METADATA,
    VTK_KEYWORD_COUNT
} vtk_keyword;

static const char *const vtk_keywords[VTK_KEYWORD_COUNT] = {
    "POINTS",        "CELLS",           "CELL_TYPES",
    "POLYGONS",      "TRIANGLE_STRIPS", "LINES",
    "VERTICES",      "POINT_DATA",      "CELL_DATA",
    "SCALARS",       "VECTORS",         "NORMALS",
    "TENSORS",       "TENSORS6",        "GLOBAL_IDS",
    "PEDIGREE_IDS",  "EDGE_FLAGS",      "TEXTURE_COORDINATES",
    "COLOR_SCALARS", "FIELD",           "LOOKUP_TABLE",
    "METADATA"};

static mw_status vtk_read_keyword(vtk_mesh *m, vtk_keyword keyword, mw_error *error)
{
    switch (keyword) {
    case VTK_POINTS: return vtk_read_points(m, error);
    case VTK_CELLS: return vtk_read_cells(m, 0, error);
    case VTK_CELL_TYPES: return vtk_read_cell_types(m, error);
    case VTK_POLYGONS: return vtk_read_cells(m, MW_CELL_POLYGON, error);
    case VTK_STRIPS: return vtk_read_cells(m, MW_CELL_STRIP, error);
    case VTK_LINES: return vtk_read_cells(m, MW_CELL_LINE, error);
    case VTK_VERTICES: return vtk_read_cells(m, MW_CELL_VERTEX, error);
    case VTK_POINT_DATA: return vtk_begin_data(m, false, error);
    case VTK_CELL_DATA: return vtk_begin_data(m, true, error);
    case VTK_SCALARS: return vtk_read_scalars(m, error);
    case VTK_VECTORS:
    case VTK_NORMALS: return vtk_read_vectors(m, 3, error);
    case VTK_TENSORS: return vtk_read_vectors(m, 9, error);
    case VTK_TENSORS_6: return vtk_read_vectors(m, 6, error);
    case VTK_GLOBAL_IDS:
    case VTK_PEDIGREE_IDS:
    case VTK_EDGE_FLAGS: return vtk_read_vectors(m, 1, error);
    case VTK_TEXTURE: return vtk_read_vectors(m, 0, error);
    case VTK_COLOURS: return vtk_read_colours(m, error);
    case VTK_FIELD: return vtk_read_field(m, error);
    case VTK_TABLE: return vtk_skip_table(m, error);
    case VTK_METADATA: return vtk_skip_metadata(m, error);
    case VTK_KEYWORD_COUNT: break;
    }
    return MW_OK;
}

static mw_status vtk_read_sections(vtk_mesh *m, mw_error *error)
{
    for (;;) {
        char *word;
        mw_status status = mw__value_word(&m->values, &word, error);
        if (status || !word) return status;
        int keyword = 0;
        while (keyword < VTK_KEYWORD_COUNT && strcasecmp(word, vtk_keywords[keyword]) != 0)
            keyword++;
        if (keyword == VTK_KEYWORD_COUNT)
            return mw__source_fail(vtk_source(m), error, "'%s' was not expected here",
                                   mw__excerpt(word).text);
        status = vtk_read_keyword(m, (vtk_keyword)keyword, error);
        if (status) return status;
    }
}

/* # vtk DataFile Version x.y, a title, ASCII or BINARY, DATASET and its kind. */
static mw_status vtk_read_header(vtk_mesh *m, mw_error *error)
{
    char *line, *word;
    static const char mark[] = "# vtk DataFile Version ";
    mw_status status = mw__value_line(&m->values, &line, error);
    if (status) return status;
    if (!line || strncasecmp(line, mark, sizeof mark - 1) != 0)
        return mw__source_fail(vtk_source(m), error, "expected '%s'", mark);
    m->old = line[sizeof mark - 1] < '5';
    status = mw__value_line(&m->values, &line, error);
    if (!status) status = mw__value_word(&m->values, &word, error);
    if (status) return status;
    if (!word || (strcasecmp(word, "ASCII") != 0 && strcasecmp(word, "BINARY") != 0))
        return mw__source_fail(vtk_source(m), error, "expected ASCII or BINARY");
    m->values.binary = m->values.big = strcasecmp(word, "BINARY") == 0;
    status = mw__value_word(&m->values, &word, error);
    if (!status && (!word || strcasecmp(word, "DATASET") != 0))
        status = mw__source_fail(vtk_source(m), error, "expected DATASET");
    if (!status) status = mw__value_word(&m->values, &word, error);
    if (status) return status;
    if (!word || (strcasecmp(word, "UNSTRUCTURED_GRID") != 0 && strcasecmp(word, "POLYDATA") != 0))
        return mw__source_fail(vtk_source(m), error,
                               "dataset '%s' is not read, only UNSTRUCTURED_GRID and POLYDATA",
                               word ? mw__excerpt(word).text : "");
    vtk_source(m)->binary = m->values.binary;
    return MW_OK;
}

mw_status mw__read_vtk(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    vtk_mesh m = {.values = {.source = source}, .builder = builder};
    mw_status status = vtk_read_header(&m, error);
    if (!status) status = vtk_read_sections(&m, error);
    if (!status) status = mw__cells_finish(&m.cells, builder, error);
    mw__cells_release(&m.cells);
    return status;
}
