/* NPZ, arrays of NumPy in a zip file, stored or deflated. "points" (or "vertices") has two or three
 * columns, "triangles" (or "faces") three or four columns of vertices from 0. Other arrays of
 * numbers are values of the vertices or of the faces: their length decides. */
#include "io/grid/byte_array.h"
#include "io/grid/grid_readers.h"
#include "io/grid/value_source.h"
#include "io/text/byte_order.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* An array as its header tells. */
typedef struct npz_array {
    char name[128];
    const unsigned char *data;
    size_t size;       /* of the data */
    mw_byte_array own; /* the unpacked entry; empty if it is stored */
    mw_number_type type;
    bool big, by_columns;
    uint64_t rows, columns; /* one column: a vector */
    int dimensions;         /* -1: no array of numbers in rows and columns */
} npz_array;

typedef struct npz_file {
    mw_source *source;
    mw_mesh_builder *builder;
    mw_byte_array file;
    size_t entry; /* where the next entry of the directory stands */
    uint64_t entries;
} npz_file;

static mw_status npz_fail(const npz_file *z, uint64_t position, mw_error *error, const char *text,
                          const char *detail)
{
    return mw__source_fail_at(z->source, position, error, text, detail);
}

/* --- the zip file --- */

enum { ZIP_END = 22, ZIP_ENTRY = 46, ZIP_LOCAL = 30, ZIP_COMMENT = 65535 };

static bool zip_is(const npz_file *z, size_t at, uint32_t mark)
{
    return mw__get_u32(z->file.bytes + at) == mark;
}

/* The record at the end of the file, which a comment may follow, tells of the directory. */
static mw_status zip_find_directory(npz_file *z, mw_error *error)
{
    size_t size = z->file.size;
    size_t least = size > ZIP_END + ZIP_COMMENT ? size - ZIP_END - ZIP_COMMENT : 0;
    for (size_t at = size < ZIP_END ? 0 : size - ZIP_END + 1; at-- > least;) {
        if (!zip_is(z, at, 0x06054b50)) continue;
        const unsigned char *end = z->file.bytes + at;
        z->entries = mw__get_u16(end + 10);
        z->entry = mw__get_u32(end + 16);
        if (z->entries == 0xffff || z->entry == 0xffffffff)
            return npz_fail(z, at, error, "%s", "zip files of more than 4 GB are not read");
        return MW_OK;
    }
    return npz_fail(z, size, error, "%s", "this is not a zip file, or its end is missing");
}

/* Where the data of an entry stand, packed. */
static mw_status zip_find_data(const npz_file *z, const unsigned char *entry, size_t *begin,
                               size_t *size, mw_error *error)
{
    size_t local = mw__get_u32(entry + 42);
    *size = mw__get_u32(entry + 20);
    if (local > z->file.size || z->file.size - local < ZIP_LOCAL || !zip_is(z, local, 0x04034b50))
        return npz_fail(z, local, error, "%s",
                        "an entry of the zip file is not where it should be");
    const unsigned char *head = z->file.bytes + local;
    *begin = local + ZIP_LOCAL + mw__get_u16(head + 26) + mw__get_u16(head + 28);
    if (*begin > z->file.size || *size > z->file.size - *begin)
        return npz_fail(z, local, error, "%s", "the data of an entry end early");
    return MW_OK;
}

/* Unpack the next entry; its name loses ".npy". */
static mw_status zip_read_entry(npz_file *z, npz_array *a, mw_error *error)
{
    size_t at = z->entry, begin = 0, size = 0;
    if (at > z->file.size || z->file.size - at < ZIP_ENTRY || !zip_is(z, at, 0x02014b50))
        return npz_fail(z, at, error, "%s", "an entry of the zip directory is damaged");
    const unsigned char *entry = z->file.bytes + at;
    size_t name = mw__get_u16(entry + 28);
    size_t whole = ZIP_ENTRY + name + mw__get_u16(entry + 30) + mw__get_u16(entry + 32);
    if (whole > z->file.size - at)
        return npz_fail(z, at, error, "%s", "an entry of the zip directory is damaged");
    z->entry = at + whole;
    snprintf(a->name, sizeof a->name, "%.*s", (int)name, (const char *)entry + ZIP_ENTRY);
    size_t length = strlen(a->name);
    if (length > 4 && strcmp(a->name + length - 4, ".npy") == 0) a->name[length - 4] = 0;
    mw_status status = zip_find_data(z, entry, &begin, &size, error);
    if (status) return status;
    a->data = z->file.bytes + begin;
    a->size = size;
    unsigned method = mw__get_u16(entry + 10);
    if (method == 8) {
        bool sound;
        status =
            mw__bytes_unpack(&a->own, a->data, size, true, mw__get_u32(entry + 24), &sound, error);
        if (!status && !sound)
            status = npz_fail(z, begin, error, "%s: the packed data are damaged", a->name);
        a->data = a->own.bytes;
        a->size = a->own.size;
    } else if (method != 0) {
        status = npz_fail(z, at, error, "%s: it is packed by another method than deflate", a->name);
    }
    if (status) return status;
    uLong sum = crc32(0, NULL, 0);
    for (size_t done = 0; done < a->size;) {
        size_t piece = a->size - done < (1u << 30) ? a->size - done : 1u << 30;
        sum = crc32(sum, a->data + done, (unsigned)piece);
        done += piece;
    }
    if (sum != mw__get_u32(entry + 16))
        status = npz_fail(z, begin, error, "%s: the check sum is wrong", a->name);
    return status;
}

/* --- the arrays --- */

/* What follows 'key': in the header, or NULL. */
static const char *npy_value(const char *header, const char *key)
{
    char quoted[32];
    snprintf(quoted, sizeof quoted, "'%s'", key);
    const char *p = strstr(header, quoted);
    if (!p) return NULL;
    p += strlen(quoted);
    while (*p == ' ' || *p == ':') p++;
    return p;
}

static bool npy_read_type(npz_array *a, const char *descr)
{
    if (*descr++ != '\'') return false;
    a->big = *descr == '>';
    descr++;
    a->type.kind = *descr == 'f'   ? MW_NUMBER_FLOAT
                   : *descr == 'i' ? MW_NUMBER_SIGNED
                                   : MW_NUMBER_UNSIGNED;
    bool known = strchr("fiub", *descr) && *descr;
    char size = known ? descr[1] : 0;
    a->type.size = (size_t)(size - '0');
    return known && descr[2] == '\'' &&
           (size == '8' || size == '4' || size == '2' || (*descr != 'f' && size == '1'));
}

/* (rows,) or (rows, columns) */
static bool npy_read_shape(npz_array *a, const char *shape)
{
    uint64_t lengths[2] = {1, 1};
    if (*shape++ != '(') return false;
    for (a->dimensions = 0; *shape && *shape != ')';) {
        if (a->dimensions == 2) return false;
        uint64_t length = 0;
        if (*shape < '0' || *shape > '9') return false;
        for (; *shape >= '0' && *shape <= '9'; shape++) {
            if (length > UINT32_MAX) return false;
            length = 10 * length + (uint64_t)(*shape - '0');
        }
        lengths[a->dimensions++] = length;
        while (*shape == ',' || *shape == ' ') shape++;
    }
    a->rows = lengths[0];
    a->columns = lengths[1];
    return a->dimensions > 0;
}

/* The header of an array: \x93NUMPY, version, length, a dictionary of Python. An array of texts or
 * objects is left with dimensions -1. */
static mw_status npy_read_header(const npz_file *z, npz_array *a, mw_error *error)
{
    size_t at = 0, length = 0;
    a->dimensions = -1;
    if (a->size >= 12 && memcmp(a->data, "\x93NUMPY", 6) == 0) {
        at = a->data[6] == 1 ? 10 : 12;
        length = at == 10 ? mw__get_u16(a->data + 8) : mw__get_u32(a->data + 8);
    }
    if (at == 0 || length > a->size - at || length > MW_BYTES_LIMIT)
        return npz_fail(z, 0, error, "%s: this is not a NumPy array", a->name);
    char *header = strndup((const char *)a->data + at, length);
    if (!header) return mw__fail_memory(error);
    a->data += at + length;
    a->size -= at + length;
    const char *descr = npy_value(header, "descr"), *shape = npy_value(header, "shape");
    const char *order = npy_value(header, "fortran_order");
    a->by_columns = order && strncmp(order, "True", 4) == 0;
    bool numbers = descr && shape && npy_read_type(a, descr) && npy_read_shape(a, shape);
    free(header);
    if (!numbers) a->dimensions = -1;
    if (!numbers) return MW_OK;
    if (a->columns && a->rows > a->size / a->type.size / a->columns)
        return npz_fail(z, 0, error, "%s: the array ends early", a->name);
    return MW_OK;
}

static double npy_at(const npz_array *a, size_t row, size_t column)
{
    size_t i = a->by_columns ? column * (size_t)a->rows + row : row * (size_t)a->columns + column;
    return mw__value_of_bytes(a->data + i * a->type.size, a->type, a->big);
}

static mw_status npz_take_points(const npz_file *z, const npz_array *a, mw_error *error)
{
    mw_mesh_builder *builder = z->builder;
    if (a->dimensions != 2 || (a->columns != 2 && a->columns != 3))
        return npz_fail(z, 0, error, "%s: the array needs two or three columns", a->name);
    if (builder->points_complete)
        return npz_fail(z, 0, error, "%s: points come a second time", a->name);
    builder->file->has_z = a->columns == 3;
    builder->points_complete = true;
    mw_status status = MW_OK;
    for (size_t v = 0; !status && v < a->rows; v++)
        status = mw__build_point(builder, npy_at(a, v, 0), npy_at(a, v, 1),
                                 a->columns == 3 ? npy_at(a, v, 2) : 0, error);
    return status;
}

static mw_status npz_take_faces(const npz_file *z, const npz_array *a, mw_error *error)
{
    mw_mesh_builder *builder = z->builder;
    if (a->dimensions != 2 || (a->columns != 3 && a->columns != 4) ||
        a->type.kind == MW_NUMBER_FLOAT)
        return npz_fail(z, 0, error, "%s: the array needs three or four columns of integers",
                        a->name);
    if (builder->file->face_count)
        return npz_fail(z, 0, error, "%s: faces come a second time", a->name);
    mw_status status = MW_OK;
    for (size_t f = 0; !status && f < a->rows; f++) {
        mw__build_face(builder);
        for (size_t k = 0; !status && k < a->columns; k++) {
            double vertex = npy_at(a, f, k);
            if (!(vertex >= 0 && vertex < MW_MAX_VERTICES))
                return mw__source_fail_at(z->source, 0, error,
                                          "%s: row %zu names vertex %.0f, which cannot exist",
                                          a->name, f, vertex);
            status = mw__build_corner(builder, (int64_t)vertex, error);
        }
        if (!status) status = mw__build_face_end(builder, error);
    }
    return status;
}

static mw_status npz_take_column(const npz_file *z, const npz_array *a, size_t column,
                                 mw_error *error)
{
    char name[160];
    mw_mesh_file *file = z->builder->file;
    double *values;
    snprintf(name, sizeof name, a->columns > 1 ? "%s_%zu" : "%s", a->name, column);
    if (a->rows == file->point_count) {
        mw_status status = mw__build_late_field(z->builder, name, &values, error);
        for (size_t v = 0; !status && v < a->rows; v++) values[v] = npy_at(a, v, column);
        return status;
    }
    values = mw__alloc((uint64_t)a->rows, sizeof *values);
    if (!values) return mw__fail_memory(error);
    for (size_t f = 0; f < a->rows; f++) values[f] = npy_at(a, f, column);
    mw_status status = mw__build_face_field(z->builder, name, values, error);
    free(values);
    return status;
}

/* Arrays of other lengths are passed over. */
static mw_status npz_take_values(const npz_file *z, const npz_array *a, mw_error *error)
{
    const mw_mesh_file *file = z->builder->file;
    mw_status status = MW_OK;
    if (a->dimensions < 1 || a->columns > 16 || a->rows == 0) return MW_OK;
    if (a->rows != file->point_count && a->rows != file->face_count) return MW_OK;
    for (size_t k = 0; !status && k < a->columns; k++) status = npz_take_column(z, a, k, error);
    return status;
}

static mw_status npz_take(const npz_file *z, const npz_array *a, int pass, mw_error *error)
{
    bool points = strcmp(a->name, "points") == 0 || strcmp(a->name, "vertices") == 0;
    bool faces = strcmp(a->name, "triangles") == 0 || strcmp(a->name, "faces") == 0;
    if (pass == 0 && points) return npz_take_points(z, a, error);
    if (pass == 1 && faces) return npz_take_faces(z, a, error);
    return pass == 2 && !points && !faces ? npz_take_values(z, a, error) : MW_OK;
}

/* The points first, then the faces, then values. */
static mw_status npz_scan(npz_file *z, int pass, mw_error *error)
{
    mw_status status = zip_find_directory(z, error);
    for (uint64_t i = 0; !status && i < z->entries; i++) {
        npz_array a = {0};
        status = zip_read_entry(z, &a, error);
        if (!status) status = npy_read_header(z, &a, error);
        if (!status) status = npz_take(z, &a, pass, error);
        free(a.own.bytes);
    }
    return status;
}

mw_status mw__read_npz(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    npz_file z = {.source = source, .builder = builder};
    source->binary = true;
    mw_status status = mw__bytes_read(&z.file, source, error);
    for (int pass = 0; !status && pass < 3; pass++) {
        status = npz_scan(&z, pass, error);
        if (!status && pass == 0 && !builder->points_complete)
            status = npz_fail(&z, 0, error, "%s", "there is no array 'points' in this file");
    }
    free(z.file.bytes);
    return status;
}
