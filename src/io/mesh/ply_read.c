/* PLY, the Stanford polygon format: text, and binary in both byte orders. Read are the element
 * "vertex", with its properties x, y, (z) and its other numbers as fields, the element "face",
 * and the element "tristrips" (strips of triangles parted by -1); other elements and lists are
 * passed over. */
#include "io/mesh/mesh_readers.h"
#include "io/mesh/ply_header.h"
#include "io/text/byte_order.h"
#include "io/text/number_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct ply_reader {
    mw_source *source;
    mw_mesh_builder *builder;
    mw_ply_kind kind;
    const char *p; /* text: what is left of the line */
} ply_reader;

/* What to do with the values of one property. */
typedef enum ply_use { SKIP, COORDINATE, FIELD, CORNERS, STRIP } ply_use;
typedef struct ply_plan {
    ply_use use;
    size_t index; /* of the coordinate or the field */
} ply_plan;

/* The numbers of a strip: the two corners before, and how many since the last -1. */
typedef struct ply_strip {
    uint32_t before[2];
    uint64_t count;
} ply_strip;

static int64_t sign_extend(uint64_t bits, size_t size)
{
    unsigned shift = (unsigned)(64 - 8 * size);
    return (int64_t)(bits << shift) >> shift;
}

/* mw__get_bytes with a size that the compiler knows. */
static MW_INLINE uint64_t ply_bits_at(const unsigned char *bytes, size_t size, bool big)
{
    switch (size) {
    case 8: return mw__get_bytes(bytes, 8, big);
    case 4: return mw__get_bytes(bytes, 4, big);
    case 2: return mw__get_bytes(bytes, 2, big);
    default: return bytes[0];
    }
}

static MW_INLINE double ply_number_at(const unsigned char *bytes, mw_ply_number number, bool big)
{
    uint64_t bits = ply_bits_at(bytes, number.size, big);
    if (number.type == MW_PLY_SIGNED) return (double)sign_extend(bits, number.size);
    if (number.type == MW_PLY_UNSIGNED) return (double)bits;
    return number.size == 4 ? (double)mw__float_of_bits((uint32_t)bits) : mw__double_of_bits(bits);
}

/* An integer; a number of the type float is none. */
static mw_status ply_read_integer(ply_reader *r, mw_ply_number number, int64_t *value,
                                  mw_error *error)
{
    if (r->kind == MW_PLY_ASCII) {
        r->p = mw__skip_blanks(r->p);
        const char *end = mw__read_integer(r->p, value);
        if (!*r->p) return mw__source_fail(r->source, error, "the line ends before its last value");
        if (!end || !mw__at_gap(end))
            return mw__source_fail(r->source, error, "'%s' is not an integer",
                                   mw__excerpt(r->p).text);
        if (!mw__integer_fits(*value)) return mw__source_fail_large(r->source, r->p, end, error);
        r->p = end;
        return MW_OK;
    }
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(r->source, number.size, &bytes, error);
    if (status) return status;
    uint64_t bits = mw__get_bytes(bytes, number.size, r->kind == MW_PLY_BIG);
    bool is_signed = number.type == MW_PLY_SIGNED;
    if (!is_signed && bits > INT64_MAX)
        return mw__source_fail(r->source, error, "the number %" PRIu64 " is too large", bits);
    *value = is_signed ? sign_extend(bits, number.size) : (int64_t)bits;
    return MW_OK;
}

static mw_status ply_read_number(ply_reader *r, mw_ply_number number, double *value,
                                 mw_error *error)
{
    if (r->kind == MW_PLY_ASCII) {
        r->p = mw__skip_blanks(r->p);
        const char *end = mw__read_double(r->p, value);
        if (!*r->p) return mw__source_fail(r->source, error, "the line ends before its last value");
        if (!end || !mw__at_gap(end))
            return mw__source_fail(r->source, error, "'%s' is not a number",
                                   mw__excerpt(r->p).text);
        r->p = end;
        return MW_OK;
    }
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(r->source, number.size, &bytes, error);
    if (!status) *value = ply_number_at(bytes, number, r->kind == MW_PLY_BIG);
    return status;
}

static mw_status ply_read_strip_item(ply_reader *r, ply_strip *s, int64_t number, mw_error *error)
{
    if (number == -1) {
        s->count = 0;
        return MW_OK;
    }
    uint32_t c = 0;
    mw_status status = mw__build_vertex(r->builder, number, &c, error);
    if (status) return status;
    uint32_t a = s->before[0], b = s->before[1];
    /* every second triangle is turned; those with a repeated corner only join strips */
    if (s->count >= 2 && a != b && b != c && a != c)
        status = s->count % 2 == 0 ? mw__build_triangle(r->builder, a, b, c, error)
                                   : mw__build_triangle(r->builder, b, a, c, error);
    s->before[0] = b;
    s->before[1] = c;
    s->count++;
    return status;
}

static mw_status ply_read_list(ply_reader *r, const mw_ply_property *property, ply_use what,
                               mw_error *error)
{
    int64_t count, number;
    double ignored;
    ply_strip s = {0};
    mw_status status = ply_read_integer(r, property->count, &count, error);
    if (!status && count < 0)
        status = mw__source_fail(r->source, error, "a list announces %" PRId64 " values", count);
    if (what == CORNERS) mw__build_face(r->builder);
    for (int64_t i = 0; !status && i < count; i++) {
        if (what == SKIP) {
            status = ply_read_number(r, property->number, &ignored, error);
            continue;
        }
        status = ply_read_integer(r, property->number, &number, error);
        if (status) break;
        status = what == STRIP ? ply_read_strip_item(r, &s, number, error)
                               : mw__build_corner(r->builder, number, error);
    }
    return !status && what == CORNERS ? mw__build_face_end(r->builder, error) : status;
}

static void ply_take_number(ply_reader *r, ply_plan plan, double value)
{
    mw_mesh_file *file = r->builder->file;
    if (plan.use == COORDINATE) file->points[3 * (file->point_count - 1) + plan.index] = value;
    if (plan.use == FIELD) mw__build_value(r->builder, plan.index, value);
}

static mw_status ply_read_instance(ply_reader *r, const mw_ply_element *element,
                                   const ply_plan *plans, mw_error *error)
{
    for (size_t i = 0; i < element->property_count; i++) {
        const mw_ply_property *property = &element->properties[i];
        mw_status status;
        double value = 0;
        if (property->list)
            status = ply_read_list(r, property, plans[i].use, error);
        else
            status = ply_read_number(r, property->number, &value, error);
        if (status) return status;
        if (!property->list) ply_take_number(r, plans[i], value);
    }
    return MW_OK;
}

/* Text: go to the next line that is not blank. */
static mw_status ply_next_line(ply_reader *r, const mw_ply_element *element, uint64_t have,
                               mw_error *error)
{
    char *line;
    do {
        mw_status status = mw__source_line(r->source, &line, error);
        if (status) return status;
        if (!line)
            return mw__source_fail(r->source, error,
                                   "the file ends after %" PRIu64 " of %" PRIu64 " elements '%s'",
                                   have, element->count, mw__excerpt(element->name).text);
        r->p = mw__skip_blanks(line);
    } while (!*r->p);
    return MW_OK;
}

/* --- many at a time: binary numbers ----------------------------------------------------------- */

/* The bytes of each instance of an element without lists, else 0. */
static size_t ply_instance_bytes(const mw_ply_element *element)
{
    size_t bytes = 0;
    for (size_t i = 0; i < element->property_count; i++) {
        if (element->properties[i].list) return 0;
        bytes += element->properties[i].number.size;
    }
    return bytes;
}

static mw_status ply_take_instance(ply_reader *r, const mw_ply_element *element,
                                   const ply_plan *plans, bool vertices, const unsigned char *bytes,
                                   mw_error *error)
{
    mw_status status = vertices ? mw__build_point(r->builder, 0, 0, 0, error) : MW_OK;
    for (size_t i = 0; i < element->property_count && !status; i++) {
        const mw_ply_number number = element->properties[i].number;
        ply_take_number(r, plans[i], ply_number_at(bytes, number, r->kind == MW_PLY_BIG));
        bytes += number.size;
    }
    return status;
}

/* Are instances the three coordinates, as doubles? */
static bool ply_has_plain_points(const ply_reader *r, const mw_ply_element *element,
                                 const ply_plan *plans)
{
    bool plain = element->property_count == 3 && r->builder->file->field_count == 0;
    for (size_t i = 0; plain && i < 3; i++)
        plain = plans[i].use == COORDINATE && plans[i].index == i &&
                element->properties[i].number.size == 8 &&
                element->properties[i].number.type == MW_PLY_FLOAT;
    return plain;
}

static mw_status ply_take_points(ply_reader *r, const unsigned char *bytes, size_t n,
                                 mw_error *error)
{
    double *to;
    mw_status status = mw__build_points(r->builder, n, &to, error);
    if (status) return status;
    const bool big = r->kind == MW_PLY_BIG;
    for (size_t i = 0; i < 3 * n && !big; i++) to[i] = mw__get_f64(bytes + 8 * i);
    for (size_t i = 0; i < 3 * n && big; i++)
        to[i] = mw__double_of_bits(mw__get_bytes(bytes + 8 * i, 8, true));
    return MW_OK;
}

/* Make room for all instances, if there are bytes for them: `size` each, or more. */
static mw_status ply_expect(ply_reader *r, const mw_ply_element *element, bool vertices,
                            size_t size, mw_error *error)
{
    if (element->count > mw__source_left(r->source) / size) return MW_OK;
    return vertices ? mw__build_expect_points(r->builder, (size_t)element->count, error)
                    : mw__build_expect_triangles(r->builder, (size_t)element->count, error);
}

/* All instances of an element without lists, `size` bytes each. */
static mw_status ply_read_blocks(ply_reader *r, const mw_ply_element *element,
                                 const ply_plan *plans, bool vertices, size_t size, mw_error *error)
{
    const uint64_t most = MW_BYTES_LIMIT / size;
    const bool points = vertices && ply_has_plain_points(r, element, plans);
    if (vertices) {
        mw_status status = ply_expect(r, element, true, size, error);
        if (status) return status;
    }
    for (uint64_t i = 0; i < element->count;) {
        const uint64_t left = element->count - i, n = left < most ? left : most;
        const unsigned char *bytes;
        mw_status status = mw__source_bytes(r->source, n * size, &bytes, error);
        if (!status && points) status = ply_take_points(r, bytes, n, error);
        for (uint64_t k = 0; k < n && !status && !points; k++)
            status = ply_take_instance(r, element, plans, vertices, bytes + k * size, error);
        if (status) return status;
        i += n;
    }
    return MW_OK;
}

/* Is an instance a list of vertices as most files have it, a byte that counts and numbers of four
 * bytes, and are the vertices known? */
static bool ply_has_plain_faces(const ply_reader *r, const mw_ply_element *element,
                                const ply_plan *plans)
{
    const mw_ply_property *property = element->properties;
    return element->property_count == 1 && plans[0].use == CORNERS && property->count.size == 1 &&
           property->number.size == 4 && r->builder->points_complete;
}

enum { PLAIN_FACE = 13 }; /* bytes */

/* Up to `most` triangles that follow each other, whose vertices exist and differ. *count: how many;
 * what follows them is left to ply_read_instance. */
static mw_status ply_read_triangles(ply_reader *r, uint64_t most, uint64_t *count, mw_error *error)
{
    const size_t points = r->builder->file->point_count,
                 limit = points < INT32_MAX ? points : INT32_MAX;
    const bool big = r->kind == MW_PLY_BIG;
    const char *peeked;
    const unsigned char *bytes;
    uint32_t *v;
    size_t have, n = 0, room;
    mw_status status = mw__source_peek(r->source, MW_BYTES_LIMIT, &peeked, &have, error);
    *count = 0;
    if (!status) status = mw__build_triangle_room(r->builder, &v, &room, error);
    if (status) return status;
    if (have / PLAIN_FACE < room) room = have / PLAIN_FACE;
    if (most < room) room = (size_t)most;
    for (bytes = (const unsigned char *)peeked; n < room && bytes[0] == 3;
         bytes += PLAIN_FACE, n++, v += 3) {
        for (int k = 0; k < 3; k++) v[k] = (uint32_t)mw__get_bytes(bytes + 1 + 4 * k, 4, big);
        if (v[0] >= limit || v[1] >= limit || v[2] >= limit) break;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) break;
    }
    mw__build_triangles(r->builder, n);
    *count = n;
    return mw__source_bytes(r->source, n * PLAIN_FACE, &bytes, error);
}

/* All instances of one element. One without properties has no data, whatever its count. */
static mw_status ply_read_element(ply_reader *r, const mw_ply_element *element,
                                  const ply_plan *plans, bool vertices, mw_error *error)
{
    if (element->property_count == 0) return MW_OK;
    const size_t size = r->kind == MW_PLY_ASCII ? 0 : ply_instance_bytes(element);
    if (size > 0) return ply_read_blocks(r, element, plans, vertices, size, error);
    const bool plain = r->kind != MW_PLY_ASCII && ply_has_plain_faces(r, element, plans);
    mw_status status = plain ? ply_expect(r, element, false, PLAIN_FACE, error) : MW_OK;
    if (status) return status;
    for (uint64_t i = 0; i < element->count; i++) {
        uint64_t count = 0;
        if (r->kind == MW_PLY_ASCII) status = ply_next_line(r, element, i, error);
        if (plain) status = ply_read_triangles(r, element->count - i, &count, error);
        i += count;
        if (!status && i == element->count) return MW_OK;
        if (!status && vertices) status = mw__build_point(r->builder, 0, 0, 0, error);
        if (!status) status = ply_read_instance(r, element, plans, error);
        if (!status && r->kind == MW_PLY_ASCII && *mw__skip_blanks(r->p))
            status = mw__source_fail(r->source, error, "'%s' follows the last value of the line",
                                     mw__excerpt(mw__skip_blanks(r->p)).text);
        if (status) return status;
    }
    return MW_OK;
}

static mw_status ply_plan_vertex(ply_reader *r, const mw_ply_element *element, ply_plan *plans,
                                 mw_error *error)
{
    static const char *const names[] = {"x", "y", "z"};
    for (size_t i = 0; i < element->property_count; i++) {
        const mw_ply_property *property = &element->properties[i];
        if (property->list) continue;
        plans[i] = (ply_plan){FIELD, r->builder->file->field_count};
        for (size_t k = 0; k < 3; k++)
            if (strcmp(property->name, names[k]) == 0) plans[i] = (ply_plan){COORDINATE, k};
        mw_status status =
            plans[i].use == FIELD ? mw__build_field(r->builder, property->name, error) : MW_OK;
        if (status) return status;
    }
    for (size_t k = 0; k < 3; k++) {
        size_t i = mw__ply_property(element, names[k]);
        bool found = i < element->property_count && plans[i].use == COORDINATE;
        if (k == 2)
            r->builder->file->has_z = found;
        else if (!found)
            return mw__source_fail(r->source, error, "the vertices have no property '%s'",
                                   names[k]);
    }
    return MW_OK;
}

static mw_status ply_plan_faces(ply_reader *r, const mw_ply_element *element, ply_use what,
                                ply_plan *plans, mw_error *error)
{
    size_t i = mw__ply_property(element, "vertex_indices");
    if (i == element->property_count) i = mw__ply_property(element, "vertex_index");
    if (i < element->property_count && element->properties[i].list &&
        element->properties[i].number.type != MW_PLY_FLOAT)
        plans[i].use = what;
    else if (element->count > 0)
        return mw__source_fail(r->source, error,
                               "element '%s' has no list of integers 'vertex_indices'",
                               mw__excerpt(element->name).text);
    return MW_OK;
}

static mw_status ply_read_elements(ply_reader *r, const mw_ply_header *header, mw_error *error)
{
    bool vertices = false;
    for (size_t e = 0; e < header->element_count; e++) {
        const mw_ply_element *element = &header->elements[e];
        ply_plan *plans = mw__calloc(element->property_count, sizeof *plans);
        if (!plans) return mw__fail_memory(error);
        bool is_vertex = strcmp(element->name, "vertex") == 0;
        mw_status status = MW_OK;
        if (is_vertex)
            status = ply_plan_vertex(r, element, plans, error);
        else if (strcmp(element->name, "face") == 0)
            status = ply_plan_faces(r, element, CORNERS, plans, error);
        else if (strcmp(element->name, "tristrips") == 0)
            status = ply_plan_faces(r, element, STRIP, plans, error);
        if (!status) status = ply_read_element(r, element, plans, is_vertex, error);
        free(plans);
        if (status) return status;
        vertices |= is_vertex;
        r->builder->points_complete = vertices;
    }
    return vertices
               ? MW_OK
               : mw__source_fail(r->source, error, "there is no element 'vertex' in this file");
}

static mw_status ply_check_end(ply_reader *r, const mw_ply_header *header, mw_error *error)
{
    if (r->kind != MW_PLY_ASCII)
        return mw__source_check_end(r->source, header->element_count, "elements", error);
    char *line;
    do {
        mw_status status = mw__source_line(r->source, &line, error);
        if (status) return status;
    } while (line && !*mw__skip_blanks(line));
    return line ? mw__source_fail(r->source, error,
                                  "the file has more data than the header announces")
                : MW_OK;
}

mw_status mw__read_ply(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    mw_ply_header header;
    mw_status status = mw__ply_read_header(source, &header, error);
    ply_reader r = {.source = source, .builder = builder, .kind = header.kind};
    source->binary = !status && header.kind != MW_PLY_ASCII;
    if (!status) status = ply_read_elements(&r, &header, error);
    if (!status) status = ply_check_end(&r, &header, error);
    if (!status) {
        builder->file->crs = header.crs;
        header.crs = NULL;
    }
    mw__ply_release_header(&header);
    return status;
}
