/* VTU, unstructured grids of VTK in XML: numbers as text, as base64 in place, or appended, raw or
 * as base64; packed by zlib or not. Cells and values as in vtk_read.c. */
#include "io/grid/byte_array.h"
#include "io/grid/cell_builder.h"
#include "io/grid/grid_readers.h"
#include "io/grid/value_source.h"
#include "io/text/byte_order.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A tag: where it stands, its name, and the text of its attributes. All point into the file. */
typedef struct vtu_tag {
    const char *begin, *name, *attributes, *end; /* end: behind '>' */
    size_t name_length;
    bool closing, empty; /* </name>, <name/> */
} vtu_tag;

typedef enum vtu_part { VTU_NONE, VTU_POINTS, VTU_CELLS, VTU_POINT_DATA, VTU_CELL_DATA } vtu_part;

typedef struct vtu_mesh {
    mw_source *source;
    mw_mesh_builder *builder;
    mw_byte_array file;
    mw_cell_builder cells;
    const char *appended; /* behind its '_'; NULL: none */
    bool appended_text;   /* base64 */
    bool big, packed;
    size_t header_size; /* 4 or 8 */
    int64_t points, cell_count;
    int pieces;
} vtu_mesh;

static mw_status vtu_fail(const vtu_mesh *m, const char *where, mw_error *error, const char *text,
                          const char *detail)
{
    return mw__source_fail_at(m->source, (uint64_t)(where - (const char *)m->file.bytes), error,
                              text, detail);
}

static const char *vtu_file_end(const vtu_mesh *m)
{
    return (const char *)m->file.bytes + m->file.size;
}

/* --- XML --- */

/* The next tag from p on; false at the end. Comments and declarations are passed over. */
static bool vtu_next_tag(const vtu_mesh *m, const char *p, vtu_tag *tag)
{
    const char *end = vtu_file_end(m);
    while ((p = memchr(p, '<', (size_t)(end - p)))) {
        if (end - p > 4 && strncmp(p, "<!--", 4) == 0) {
            const char *close = strstr(p, "-->"); /* NUL ends the file */
            if (!close) return false;
            p = close + 3;
            continue;
        }
        const char *close = memchr(p, '>', (size_t)(end - p));
        if (!close) return false;
        if (p[1] == '?' || p[1] == '!') {
            p = close + 1;
            continue;
        }
        *tag = (vtu_tag){.begin = p, .end = close + 1, .closing = p[1] == '/'};
        tag->name = p + 1 + tag->closing;
        tag->empty = close > tag->name && close[-1] == '/';
        tag->name_length = strcspn(tag->name, " \t\r\n/>");
        tag->attributes = tag->name + tag->name_length;
        return true;
    }
    return false;
}

static bool vtu_is(const vtu_tag *tag, const char *name)
{
    return tag->name_length == strlen(name) && strncmp(tag->name, name, tag->name_length) == 0;
}

static bool vtu_is_gap(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* A character as UTF-8; where it ends. */
static char *vtu_put_character(char *to, uint32_t code)
{
    if (code < 0x80) {
        *to++ = (char)code;
        return to;
    }
    int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    *to++ = (char)((more == 1 ? 0xc0 : more == 2 ? 0xe0 : 0xf0) | code >> 6 * more);
    while (more-- > 0) *to++ = (char)(0x80 | (code >> 6 * more & 0x3f));
    return to;
}

/* The character that "&lt;", "&#60;" or "&#x3c;" stands for; 0 if it is none. */
static uint32_t vtu_character(const char *text, size_t length)
{
    static const char *const names[] = {"lt", "gt", "amp", "quot", "apos"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (length == strlen(names[k]) && memcmp(text, names[k], length) == 0)
            return (uint32_t) "<>&\"'"[k];
    if (length < 2 || *text != '#') return 0;
    bool hexadecimal = text[1] == 'x';
    const char *digits = text + 1 + hexadecimal;
    size_t count = strspn(digits, hexadecimal ? "0123456789abcdefABCDEF" : "0123456789");
    if (count == 0 || count > 7 || digits + count != text + length) return 0;
    unsigned long code = strtoul(digits, NULL, hexadecimal ? 16 : 10);
    return code >= ' ' && code <= 0x10ffff ? (uint32_t)code : 0;
}

/* Characters that XML describes ("&lt;") become what they stand for, which is never longer. */
static void vtu_decode(char *text)
{
    char *to = text;
    for (const char *c = text; *c; c++) {
        const char *end = *c == '&' ? strchr(c, ';') : NULL;
        uint32_t code = end ? vtu_character(c + 1, (size_t)(end - c - 1)) : 0;
        if (code == 0) {
            *to++ = *c;
            continue;
        }
        to = vtu_put_character(to, code);
        c = end;
    }
    *to = 0;
}

/* The value of an attribute, cut to the room; false if there is none. */
static bool vtu_attribute(const vtu_tag *tag, const char *name, char *value, size_t room)
{
    size_t length = strlen(name);
    const char *p = tag->attributes;
    while (p < tag->end) {
        while (p < tag->end && vtu_is_gap(*p)) p++;
        const char *key = p;
        while (p < tag->end && *p != '=' && *p != '>') p++;
        size_t key_length = (size_t)(p - key);
        while (key_length > 0 && vtu_is_gap(key[key_length - 1])) key_length--;
        if (p >= tag->end || *p != '=') return false;
        for (p++; p < tag->end && vtu_is_gap(*p); p++) continue;
        char quote = *p;
        if (quote != '"' && quote != '\'') return false;
        const char *text = ++p;
        while (p < tag->end && *p != quote) p++;
        if (p >= tag->end) return false;
        if (key_length == length && strncmp(key, name, length) == 0) {
            size_t size = (size_t)(p - text);
            if (size >= room) size = room - 1;
            memcpy(value, text, size);
            value[size] = 0;
            vtu_decode(value);
            return true;
        }
        p++;
    }
    return false;
}

static mw_status vtu_count(const vtu_mesh *m, const vtu_tag *tag, const char *name, int64_t *count,
                           mw_error *error)
{
    char text[32];
    if (!vtu_attribute(tag, name, text, sizeof text))
        return vtu_fail(m, tag->begin, error, "the attribute %s is missing", name);
    const char *end = mw__read_integer(text, count);
    if (!end || *end || *count < 0 || !mw__integer_fits(*count))
        return vtu_fail(m, tag->begin, error, "%s is not a count", name);
    return MW_OK;
}

/* --- arrays --- */

static bool vtu_type(const char *name, mw_number_type *type)
{
    static const struct {
        const char *name;
        mw_number_type type;
    } types[] = {{"Float64", {MW_NUMBER_FLOAT, 8}}, {"Float32", {MW_NUMBER_FLOAT, 4}},
                 {"Int64", {MW_NUMBER_SIGNED, 8}},  {"UInt64", {MW_NUMBER_UNSIGNED, 8}},
                 {"Int32", {MW_NUMBER_SIGNED, 4}},  {"UInt32", {MW_NUMBER_UNSIGNED, 4}},
                 {"Int16", {MW_NUMBER_SIGNED, 2}},  {"UInt16", {MW_NUMBER_UNSIGNED, 2}},
                 {"Int8", {MW_NUMBER_SIGNED, 1}},   {"UInt8", {MW_NUMBER_UNSIGNED, 1}}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(name, types[i].name) == 0) {
            *type = types[i].type;
            return true;
        }
    return false;
}

static mw_status vtu_read_text(const vtu_mesh *m, const vtu_tag *tag, mw_number_list *list,
                               mw_error *error)
{
    const char *p = tag->end, *end = vtu_file_end(m);
    while (p < end) {
        double value;
        while (p < end && vtu_is_gap(*p)) p++;
        if (p == end || *p == '<') return MW_OK;
        const char *next = mw__read_double(p, &value);
        if (!next || !(vtu_is_gap(*next) || *next == '<'))
            return vtu_fail(m, p, error, "'%s' is not a number",
                            mw__excerpt_of(p, strcspn(p, " \t\r\n<")).text);
        mw_status status = mw__numbers_add(list, value, error);
        if (status) return status;
        p = next;
    }
    return MW_OK;
}

static uint64_t vtu_header(const vtu_mesh *m, const unsigned char *bytes, uint64_t i)
{
    return mw__get_bytes(bytes + i * m->header_size, m->header_size, m->big);
}

/* Blocks packed by zlib: how many, the size of each and of the last, their packed sizes. */
static mw_status vtu_unpack(const vtu_mesh *m, const vtu_tag *tag, const unsigned char *bytes,
                            size_t size, mw_byte_array *out, mw_error *error)
{
    uint64_t room = size / m->header_size;
    uint64_t blocks = room ? vtu_header(m, bytes, 0) : 0;
    if (room == 0 || (blocks > 0 && (room < 3 || blocks > room - 3)))
        return vtu_fail(m, tag->begin, error, "%s", "the data of the array end early");
    size_t begin = (size_t)(3 + blocks) * m->header_size;
    for (uint64_t b = 0; b < blocks; b++) {
        uint64_t packed = vtu_header(m, bytes, 3 + b), block = vtu_header(m, bytes, 1);
        bool sound;
        if (packed > size - begin)
            return vtu_fail(m, tag->begin, error, "%s", "the data of the array end early");
        mw_status status =
            mw__bytes_unpack(out, bytes + begin, (size_t)packed, false,
                             block < SIZE_MAX ? (size_t)block : SIZE_MAX, &sound, error);
        if (status) return status;
        if (!sound) return vtu_fail(m, tag->begin, error, "%s", "the packed data are damaged");
        begin += (size_t)packed;
    }
    return MW_OK;
}

/* Numbers as bytes, with their size in front, packed or not. */
static mw_status vtu_read_bytes(const vtu_mesh *m, const vtu_tag *tag, const unsigned char *bytes,
                                size_t size, mw_number_type type, mw_number_list *list,
                                mw_error *error)
{
    mw_byte_array unpacked = {0};
    mw_status status = MW_OK;
    if (m->packed) {
        status = vtu_unpack(m, tag, bytes, size, &unpacked, error);
        bytes = unpacked.bytes;
        size = unpacked.size;
    } else if (size < m->header_size || vtu_header(m, bytes, 0) > size - m->header_size) {
        status = vtu_fail(m, tag->begin, error, "%s", "the data of the array end early");
    } else {
        size = (size_t)vtu_header(m, bytes, 0);
        bytes += m->header_size;
    }
    for (size_t i = 0; !status && i < size / type.size; i++)
        status =
            mw__numbers_add(list, mw__value_of_bytes(bytes + i * type.size, type, m->big), error);
    free(unpacked.bytes);
    return status;
}

/* As base64 or raw: where it is, up to the end of the file. */
static mw_status vtu_read_data(const vtu_mesh *m, const vtu_tag *tag, const char *data, bool text,
                               mw_number_type type, mw_number_list *list, mw_error *error)
{
    size_t size = (size_t)(vtu_file_end(m) - data);
    if (!text) return vtu_read_bytes(m, tag, (const unsigned char *)data, size, type, list, error);
    mw_byte_array bytes = {0};
    const char *end = memchr(data, '<', size);
    if (end) size = (size_t)(end - data);
    mw_status status = mw__bytes_decode(&bytes, (const unsigned char *)data, size, error);
    if (!status) status = vtu_read_bytes(m, tag, bytes.bytes, bytes.size, type, list, error);
    free(bytes.bytes);
    return status;
}

/* The numbers of a <DataArray>. */
static mw_status vtu_read_array(const vtu_mesh *m, const vtu_tag *tag, mw_number_list *list,
                                mw_error *error)
{
    char type_name[16] = "", format[16] = "ascii";
    mw_number_type type;
    int64_t offset;
    vtu_attribute(tag, "type", type_name, sizeof type_name);
    vtu_attribute(tag, "format", format, sizeof format);
    if (!vtu_type(type_name, &type))
        return vtu_fail(m, tag->begin, error, "an array of type '%s' is not read", type_name);
    if (strcmp(format, "appended") == 0) {
        mw_status status = vtu_count(m, tag, "offset", &offset, error);
        if (status) return status;
        if (!m->appended || offset > vtu_file_end(m) - m->appended)
            return vtu_fail(m, tag->begin, error, "%s",
                            "the array is in <AppendedData>, which ends before it or is missing");
        return vtu_read_data(m, tag, m->appended + offset, m->appended_text, type, list, error);
    }
    if (tag->empty) return MW_OK;
    if (strcmp(format, "ascii") == 0) return vtu_read_text(m, tag, list, error);
    if (strcmp(format, "binary") == 0)
        return vtu_read_data(m, tag, tag->end, true, type, list, error);
    return vtu_fail(m, tag->begin, error, "an array of format '%s' is not read", format);
}

/* --- what arrays mean --- */

static mw_status vtu_expect(const vtu_mesh *m, const vtu_tag *tag, const mw_number_list *list,
                            uint64_t wanted, mw_error *error)
{
    if (list->count == wanted) return MW_OK;
    return mw__source_fail_at(m->source, (uint64_t)(tag->begin - (const char *)m->file.bytes),
                              error, "the array has %zu numbers, not %" PRIu64, list->count,
                              wanted);
}

static mw_status vtu_take_points(vtu_mesh *m, const vtu_tag *tag, const mw_number_list *list,
                                 mw_error *error)
{
    if (m->builder->points_complete)
        return vtu_fail(m, tag->begin, error, "%s", "the points come a second time");
    if (m->points > INT64_MAX / 3)
        return vtu_fail(m, tag->begin, error, "%s", "there are too many points");
    mw_status status = vtu_expect(m, tag, list, 3 * (uint64_t)m->points, error);
    for (size_t i = 0; !status && i < list->count; i += 3) {
        const double *p = list->values + i;
        m->builder->file->has_z |= p[2] != 0;
        status = mw__build_point(m->builder, p[0], p[1], p[2], error);
    }
    m->builder->points_complete = true;
    return status;
}

static mw_status vtu_take_cells(vtu_mesh *m, const vtu_tag *tag, const char *name,
                                const mw_number_list *list, mw_error *error)
{
    bool ends = strcmp(name, "offsets") == 0, types = strcmp(name, "types") == 0;
    mw_integer_list *to = ends ? &m->cells.ends : types ? &m->cells.types : &m->cells.corners;
    if (!ends && !types && strcmp(name, "connectivity") != 0) return MW_OK;
    if (to->count) return vtu_fail(m, tag->begin, error, "%s come a second time", name);
    mw_status status =
        ends || types ? vtu_expect(m, tag, list, (uint64_t)m->cell_count, error) : MW_OK;
    for (size_t i = 0; !status && i < list->count; i++) {
        double value = list->values[i];
        if (!(value >= 0 && value < 0x1p53 && value == (double)(int64_t)value))
            return vtu_fail(m, tag->begin, error, "%s: the numbers must be whole and at least 0",
                            name);
        status = mw__integers_add(to, (int64_t)value, error);
    }
    return status;
}

static mw_status vtu_take_values(vtu_mesh *m, const vtu_tag *tag, const char *name, bool of_cells,
                                 const mw_number_list *list, mw_error *error)
{
    char text[16] = "1";
    int64_t width, count = of_cells ? m->cell_count : m->points;
    vtu_attribute(tag, "NumberOfComponents", text, sizeof text);
    const char *end = mw__read_integer(text, &width);
    if (!end || width < 1 || width > MW_COLUMN_LIMIT) width = 1;
    if (list->count != (uint64_t)count * (uint64_t)width)
        return vtu_expect(m, tag, list, (uint64_t)count * (uint64_t)width, error);
    return mw__cells_add_values(&m->cells, m->builder, name, list->values, (size_t)count,
                                (size_t)width, of_cells, error);
}

static mw_status vtu_take_array(vtu_mesh *m, const vtu_tag *tag, vtu_part part, mw_error *error)
{
    char name[256] = "", type[16] = "";
    mw_number_list list = {0};
    vtu_attribute(tag, "Name", name, sizeof name);
    vtu_attribute(tag, "type", type, sizeof type);
    if (strcmp(type, "String") == 0) return MW_OK;
    mw_status status = vtu_read_array(m, tag, &list, error);
    if (status)
        ;
    else if (part == VTU_POINTS)
        status = vtu_take_points(m, tag, &list, error);
    else if (part == VTU_CELLS)
        status = vtu_take_cells(m, tag, name, &list, error);
    else
        status = vtu_take_values(m, tag, name, part == VTU_CELL_DATA, &list, error);
    free(list.values);
    return status;
}

/* --- the file --- */

static mw_status vtu_open_file(vtu_mesh *m, const vtu_tag *tag, mw_error *error)
{
    char text[64] = "";
    vtu_attribute(tag, "type", text, sizeof text);
    if (strcmp(text, "UnstructuredGrid") != 0)
        return vtu_fail(m, tag->begin, error,
                        "files of type '%s' are not read, only UnstructuredGrid", text);
    m->big = vtu_attribute(tag, "byte_order", text, sizeof text) && strcmp(text, "BigEndian") == 0;
    m->header_size =
        vtu_attribute(tag, "header_type", text, sizeof text) && strcmp(text, "UInt64") == 0 ? 8 : 4;
    m->packed = vtu_attribute(tag, "compressor", text, sizeof text) && *text;
    if (m->packed && strcmp(text, "vtkZLibDataCompressor") != 0)
        return vtu_fail(m, tag->begin, error, "data packed by %s are not read, only by zlib", text);
    return MW_OK;
}

static mw_status vtu_open_piece(vtu_mesh *m, const vtu_tag *tag, mw_error *error)
{
    if (++m->pieces > 1)
        return vtu_fail(m, tag->begin, error, "%s", "a file of several pieces is not read");
    mw_status status = vtu_count(m, tag, "NumberOfPoints", &m->points, error);
    return status ? status : vtu_count(m, tag, "NumberOfCells", &m->cell_count, error);
}

/* Where the appended data begin: behind the first '_'. */
static void vtu_open_appended(vtu_mesh *m, const vtu_tag *tag)
{
    char text[16] = "";
    vtu_attribute(tag, "encoding", text, sizeof text);
    m->appended_text = strcmp(text, "base64") == 0;
    const char *mark = memchr(tag->end, '_', (size_t)(vtu_file_end(m) - tag->end));
    if (mark) m->appended = mark + 1;
}

/* The part that a tag begins; it ends with its closing tag. */
static vtu_part vtu_part_of(const vtu_tag *tag)
{
    return vtu_is(tag, "Points")      ? VTU_POINTS
           : vtu_is(tag, "Cells")     ? VTU_CELLS
           : vtu_is(tag, "PointData") ? VTU_POINT_DATA
           : vtu_is(tag, "CellData")  ? VTU_CELL_DATA
                                      : VTU_NONE;
}

/* Look at all tags: first for what the file is and where it has appended data, then for points and
 * cells, then for values. */
static mw_status vtu_scan(vtu_mesh *m, int pass, mw_error *error)
{
    vtu_tag tag = {.end = (const char *)m->file.bytes};
    vtu_part part = VTU_NONE;
    mw_status status = MW_OK;
    while (!status && vtu_next_tag(m, tag.end, &tag)) {
        if (vtu_is(&tag, "AppendedData")) {
            if (pass == 0) vtu_open_appended(m, &tag);
            return MW_OK;
        }
        if (vtu_part_of(&tag) != VTU_NONE)
            part = tag.closing || tag.empty ? VTU_NONE : vtu_part_of(&tag);
        else if (tag.closing)
            continue;
        else if (pass == 0 && vtu_is(&tag, "VTKFile"))
            status = vtu_open_file(m, &tag, error);
        else if (pass == 0 && vtu_is(&tag, "Piece"))
            status = vtu_open_piece(m, &tag, error);
        else if (pass > 0 && vtu_is(&tag, "DataArray") && part != VTU_NONE &&
                 (pass == 1) == (part == VTU_POINTS || part == VTU_CELLS))
            status = vtu_take_array(m, &tag, part, error);
    }
    return status;
}

static mw_status vtu_read_file(vtu_mesh *m, mw_error *error)
{
    m->source->binary = true;
    mw_status status = mw__bytes_read(&m->file, m->source, error);
    if (!status && m->file.size == 0)
        status = mw__source_fail(m->source, error, "the file is empty");
    if (!status) status = vtu_scan(m, 0, error);
    if (!status && (m->pieces == 0 || m->header_size == 0))
        status = mw__source_fail_at(m->source, 0, error,
                                    "there is no <Piece> of a <VTKFile> in this file");
    if (!status) status = vtu_scan(m, 1, error);
    if (!status && (uint64_t)m->points != m->builder->file->point_count)
        status = mw__source_fail_at(m->source, 0, error, "there are no <Points> in this file");
    if (!status && (uint64_t)m->cell_count != m->cells.ends.count)
        status = mw__source_fail_at(m->source, 0, error, "there are no <Cells> in this file");
    for (size_t i = 0; !status && i < m->cells.ends.count; i++)
        if (m->cells.ends.values[i] > (int64_t)m->cells.corners.count)
            status = mw__source_fail_at(m->source, 0, error, "cell %zu has no corners", i);
    if (!status) status = vtu_scan(m, 2, error);
    return status ? status : mw__cells_finish(&m->cells, m->builder, error);
}

mw_status mw__read_vtu(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    vtu_mesh m = {.source = source, .builder = builder};
    mw_status status = vtu_read_file(&m, error);
    mw__cells_release(&m.cells);
    free(m.file.bytes);
    return status;
}
