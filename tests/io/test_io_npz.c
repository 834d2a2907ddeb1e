/* test_io_npz.c - arrays of NumPy in zip files: every type and shape that is read, and what is
 * refused, by files written here byte by byte. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/text/byte_order.h"
#include "support/files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* --- files ------------------------------------------------------------------------------------ */

typedef struct zip {
    unsigned char bytes[1 << 16], directory[4096];
    size_t size, listed;
    unsigned entries;
} zip;

static void put(unsigned char *to, size_t *at, uint64_t value, int size)
{
    for (int i = 0; i < size; i++) to[(*at)++] = (unsigned char)(i < 8 ? value >> 8 * i : 0);
}

static void zip_add(zip *z, const char *name, const void *data, size_t size)
{
    const size_t length = strlen(name), local = z->size;
    const uint32_t sum = (uint32_t)crc32(0, data, (unsigned)size);
    assert_true(z->size + size + 200 < sizeof z->bytes && z->listed + 200 < sizeof z->directory);
    put(z->bytes, &z->size, 0x04034b50, 4);
    put(z->bytes, &z->size, 0, 10);
    put(z->bytes, &z->size, sum, 4);
    put(z->bytes, &z->size, size, 4);
    put(z->bytes, &z->size, size, 4);
    put(z->bytes, &z->size, length, 2);
    put(z->bytes, &z->size, 3, 2); /* further bytes, which nothing reads */
    memcpy(z->bytes + z->size, name, length);
    z->size += length + 3;
    memcpy(z->bytes + z->size, data, size);
    z->size += size;
    put(z->directory, &z->listed, 0x02014b50, 4);
    put(z->directory, &z->listed, 0, 12);
    put(z->directory, &z->listed, sum, 4);
    put(z->directory, &z->listed, size, 4);
    put(z->directory, &z->listed, size, 4);
    put(z->directory, &z->listed, length, 2);
    put(z->directory, &z->listed, 5, 2);
    put(z->directory, &z->listed, 2, 2);
    put(z->directory, &z->listed, 0, 8);
    put(z->directory, &z->listed, local, 4);
    memcpy(z->directory + z->listed, name, length);
    z->listed += length + 7;
    z->entries++;
}

static void zip_write(zip *z, const char *name, size_t comment)
{
    const size_t directory = z->size;
    assert_true(z->size + z->listed + 22 + comment <= sizeof z->bytes);
    memcpy(z->bytes + z->size, z->directory, z->listed);
    z->size += z->listed;
    put(z->bytes, &z->size, 0x06054b50, 4);
    put(z->bytes, &z->size, 0, 4);
    put(z->bytes, &z->size, z->entries, 2);
    put(z->bytes, &z->size, z->entries, 2);
    put(z->bytes, &z->size, z->listed, 4);
    put(z->bytes, &z->size, directory, 4);
    put(z->bytes, &z->size, comment, 2);
    z->size += comment;
    files_write(name, (bytes){(const char *)z->bytes, z->size});
}

/* An array: what its header says, and its numbers as doubles, written as the header says. */
typedef struct npy {
    const char *name, *descr, *shape;
    bool by_columns;
    double values[16];
    int count;
} npy;

static void npy_put_number(unsigned char *to, size_t *at, const char *descr, double value)
{
    const int size = descr[2] == '8' ? 8 : descr[2] == '4' ? 4 : descr[2] == '2' ? 2 : 1;
    unsigned char little[8];
    size_t none = 0;
    uint64_t bits = (uint64_t)(int64_t)value;
    float narrow = (float)value;
    uint32_t narrow_bits;
    memcpy(&narrow_bits, &narrow, sizeof narrow);
    if (descr[1] == 'f') memcpy(&bits, &value, sizeof bits);
    if (descr[1] == 'f' && size == 4) bits = narrow_bits;
    put(little, &none, bits, size);
    for (int i = 0; i < size; i++) to[(*at)++] = little[descr[0] == '>' ? size - 1 - i : i];
}

static void zip_add_array(zip *z, const npy *a, int version)
{
    unsigned char data[1024];
    char header[200];
    size_t at = 0;
    const int length =
        snprintf(header, sizeof header, "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }\n",
                 a->descr, a->by_columns ? "True" : "False", a->shape);
    memcpy(data, "\x93NUMPY", 6);
    at = 6;
    put(data, &at, (uint64_t)version, 2);
    put(data, &at, (uint64_t)length, version == 1 ? 2 : 4);
    memcpy(data + at, header, (size_t)length);
    at += (size_t)length;
    for (int i = 0; i < a->count; i++) npy_put_number(data, &at, a->descr, a->values[i]);
    char name[300];
    snprintf(name, sizeof name, "%s.npy", a->name);
    zip_add(z, name, data, at);
}

/* A square of two triangles. */
static const npy points = {"points", "<f8", "(4, 2)", false, {0, 0, 1, 0, 1, 1, 0, 1}, 8},
                 faces = {"triangles", "<i4", "(2, 3)", false, {0, 1, 2, 0, 2, 3}, 6};

static mw_status read_arrays(const npy *const *arrays, int version, size_t comment,
                             mw_mesh_file *file, mw_error *error)
{
    zip *z = calloc(1, sizeof *z);
    for (; *arrays; arrays++) zip_add_array(z, *arrays, version);
    zip_write(z, "a.npz", comment);
    free(z);
    return mw_read_mesh("a.npz", NULL, file, error);
}

static void expect_square(const mw_mesh_file *file, bool quads)
{
    static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const uint32_t v[6] = {0, 1, 2, 0, 2, 3};
    assert_int_equal(file->point_count, 4);
    assert_int_equal(file->triangle_count, 2);
    assert_int_equal(file->face_count, quads ? 1 : 2);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++) assert_true(file->points[3 * i + k] == corner[i][k]);
    assert_memory_equal(file->triangles, v, sizeof v);
}

static void expect_read(const npy *const *arrays, int version, size_t comment, mw_mesh_file *file)
{
    mw_error error;
    if (read_arrays(arrays, version, comment, file, &error)) fail_msg("%s", error.message);
}

/* --- what is read ----------------------------------------------------------------------------- */

static void test_forms(void **state)
{
    (void)state;
    static const char *const reals[] = {"<f8", ">f8", "<f4", ">f4", "<i2",
                                        ">i4", "<u8", "|u1", "|i1", "<i8"};
    static const char *const integers[] = {"<i8", ">i8", "<u4", ">i2", "|u1", "|i1", "<u2"};
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
        for (size_t k = 0; k < sizeof integers / sizeof *integers; k++) {
            npy p = points, f = faces;
            mw_mesh_file file;
            p.descr = reals[i];
            f.descr = integers[k];
            if (i % 2) p.name = "vertices";
            if (k % 2) f.name = "faces";
            const npy *const arrays[] = {&f, &p, NULL};
            expect_read(arrays, 1 + (int)(i % 3), 7 * k, &file);
            expect_square(&file, false);
            assert_int_equal(file.has_z, 0);
            mw_mesh_file_release(&file);
        }
}

static void test_columns_and_heights(void **state)
{
    (void)state;
    const npy p = {"points", "<f8", "(4, 3)", true, {0, 1, 1, 0, 0, 0, 1, 1, 5, 6, 7, 8}, 12},
              f = {"faces", "<u4", "(1,4)", false, {0, 1, 2, 3}, 4},
              g = {"faces", "<i4", "(2, 3)", true, {0, 0, 1, 2, 2, 3}, 6};
    for (int quads = 0; quads < 2; quads++) {
        const npy *const arrays[] = {&p, quads ? &f : &g, NULL};
        mw_mesh_file file;
        expect_read(arrays, 1, 0, &file);
        expect_square(&file, quads);
        assert_int_equal(file.has_z, 1);
        for (int i = 0; i < 4; i++) assert_true(file.points[3 * i + 2] == 5 + i);
        mw_mesh_file_release(&file);
    }
}

static double field_at(const mw_mesh_file *file, const char *name, size_t v)
{
    for (size_t f = 0; f < file->field_count; f++)
        if (strcmp(file->field_names[f], name) == 0) return file->fields[f][v];
    fail_msg("there is no field %s", name);
    return 0;
}

static double face_at(const mw_mesh_file *file, const char *name, size_t t)
{
    for (size_t f = 0; f < file->triangle_field_count; f++)
        if (strcmp(file->triangle_field_names[f], name) == 0) return file->triangle_fields[f][t];
    fail_msg("there is no triangle field %s", name);
    return 0;
}

/* Values by their length; arrays of other lengths, of texts and of three dimensions are passed
 * over. */
static void test_values(void **state)
{
    (void)state;
    const npy one = {"one", "<f4", "(4,)", false, {2, 3, 5, 7}, 4},
              two = {"two", ">i2", "(4, 2)", false, {1, -2, 3, -4, 5, -6, 7, -8}, 8},
              kind = {"kind", "|b1", "(2,)", false, {1, 0}, 2},
              wide = {"wide", "<f8", "(2, 2)", true, {10, 20, 30, 40}, 4},
              odd = {"odd", "<f8", "(3,)", false, {1, 2, 3}, 3},
              none = {"none", "<f8", "(0,)", false, {0}, 0},
              deep = {"deep", "<f8", "(4, 1, 1)", false, {1, 2, 3, 4}, 4},
              text = {"text", "<U1", "(4,)", false, {0}, 0},
              half = {"half", "<f1", "(4,)", false, {0}, 0};
    const npy *const arrays[] = {&one,  &two,  &kind, &odd,    &none,  &deep,
                                 &text, &half, &wide, &points, &faces, NULL};
    mw_mesh_file file;
    expect_read(arrays, 2, 65535 - 60000, &file);
    expect_square(&file, false);
    assert_int_equal(file.field_count, 3);
    assert_int_equal(file.triangle_field_count, 3);
    for (size_t v = 0; v < 4; v++) {
        assert_true(field_at(&file, "one", v) == one.values[v]);
        assert_true(field_at(&file, "two_0", v) == two.values[2 * v]);
        assert_true(field_at(&file, "two_1", v) == two.values[2 * v + 1]);
    }
    for (size_t t = 0; t < 2; t++) {
        assert_true(face_at(&file, "kind", t) == kind.values[t]);
        assert_true(face_at(&file, "wide_0", t) == wide.values[t]);
        assert_true(face_at(&file, "wide_1", t) == wide.values[2 + t]);
    }
    mw_mesh_file_release(&file);
}

/* --- what is refused -------------------------------------------------------------------------- */

static void refuse_arrays(const npy *a, const npy *b, const char *says)
{
    const npy *const arrays[] = {a, b, NULL};
    mw_mesh_file file;
    mw_error error;
    assert_int_equal(read_arrays(arrays, 1, 0, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, error.line, says);
    assert_null(file.points);
}

static void test_refused_arrays(void **state)
{
    (void)state;
    npy p = points, f = faces;
    p.shape = "(8,)";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    p.shape = "(2, 4)";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    p.shape = "(8, 1)";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    p.shape = "(5, 2)";
    refuse_arrays(&p, &faces, "points: the array ends early");
    p.shape = "(4294967296000, 2)";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    p.shape = "[4, 2]";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    p.shape = "(4, -2)";
    refuse_arrays(&p, &faces, "points: the array needs two or three columns");
    refuse_arrays(&points, &points, "points: points come a second time");
    refuse_arrays(&faces, NULL, "no array 'points' in this file");
    f.shape = "(3, 2)";
    refuse_arrays(&points, &f, "triangles: the array needs three or four columns of integers");
    f.shape = "(6,)";
    refuse_arrays(&points, &f, "triangles: the array needs three or four columns of integers");
    f = faces;
    f.descr = "<f8";
    refuse_arrays(&points, &f, "triangles: the array needs three or four columns of integers");
    f = faces;
    f.values[4] = -1;
    refuse_arrays(&points, &f, "triangles: row 1 names vertex -1");
    f.descr = "<i8";
    f.values[4] = 4294967295.0;
    refuse_arrays(&points, &f, "triangles: row 1 names vertex 4294967295");
    f = faces;
    f.values[4] = 4;
    refuse_arrays(&points, &f, "4");
    const npy *const arrays[] = {&points, &faces, &faces, NULL};
    mw_mesh_file file;
    mw_error error;
    assert_int_equal(read_arrays(arrays, 1, 0, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, error.line, "triangles: faces come a second time");
}

static void refuse_bytes(const unsigned char *all, size_t size, const char *says)
{
    mw_mesh_file file;
    mw_error error;
    files_write("b.npz", (bytes){(const char *)all, size});
    assert_int_equal(mw_read_mesh("b.npz", NULL, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, error.line, says);
}

/* A sound file of two arrays, with one place changed. */
static void test_damaged(void **state)
{
    (void)state;
    zip *z = calloc(1, sizeof *z);
    zip_add_array(z, &points, 1);
    const size_t second = z->size;
    zip_add_array(z, &faces, 1);
    const size_t directory = z->size;
    zip_write(z, "b.npz", 0);
    const size_t end = z->size - 22;
    const struct {
        size_t at;
        unsigned char add;
        const char *says;
    } changes[] = {
        {0, 1, "an entry of the zip file is not where it should be"},
        {second + 3, 1, "an entry of the zip file is not where it should be"},
        {second + 27, 200, "the data of an entry end early"},
        {directory, 1, "an entry of the zip directory is damaged"},
        {directory + 10, 1, "packed by another method than deflate"},
        {directory + 10, 8, "points: the check sum is wrong"},
        {directory + 16, 1, "points: the check sum is wrong"},
        {directory + 22, 200, "the data of an entry end early"},
        {directory + 29, 200, "an entry of the zip directory is damaged"},
        {end, 1, "this is not a zip file, or its end is missing"},
        {end + 19, 1, "an entry of the zip directory is damaged"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        z->bytes[changes[i].at] = (unsigned char)(z->bytes[changes[i].at] + changes[i].add);
        refuse_bytes(z->bytes, z->size, changes[i].says);
        z->bytes[changes[i].at] = (unsigned char)(z->bytes[changes[i].at] - changes[i].add);
    }
    memset(z->bytes + end + 10, 0xff, 2);
    refuse_bytes(z->bytes, z->size, "zip files of more than 4 GB are not read");
    free(z);
    z = calloc(1, sizeof *z);
    zip_add(z, "points.npy", "no array of NumPy", 17);
    zip_write(z, "c.npz", 0);
    refuse_bytes(z->bytes, z->size, "points: this is not a NumPy array");
    free(z);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),   cmocka_unit_test(test_columns_and_heights),
        cmocka_unit_test(test_values),  cmocka_unit_test(test_refused_arrays),
        cmocka_unit_test(test_damaged),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
