/* test_io_large.c - meshes that are longer than the blocks in which files are read and written
 * come back bit for bit, in every format. */
#define _GNU_SOURCE /* memmem */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/environment.h"
#include "support/write_mesh_file.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Vertices of a lattice, SIDE by SIDE. Each square is a quadrilateral or two triangles. More of
 * all than 2^16. */
enum { SIDE = 264, POINTS = SIDE * SIDE, SQUARES = (SIDE - 1) * (SIDE - 1) };

typedef struct large_mesh {
    mw_mesh_file file;
    double points[3 * POINTS], depth[POINTS], kind[2 * SQUARES], *fields[1], *triangle_fields[1];
    uint32_t triangles[6 * SQUARES], faces[2 * SQUARES];
    char *field_names[1], *triangle_field_names[1];
} large_mesh;

/* With heights all faces are triangles: a quadrilateral in space may be cut either way. */
static void add_square(large_mesh *m, uint32_t a, uint64_t *random, int has_z)
{
    mw_mesh_file *f = &m->file;
    const uint32_t corner[6] = {a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE};
    bool whole = !has_z && mw__random_below(random, 3) > 0;
    memcpy(m->triangles + 3 * f->triangle_count, corner, sizeof corner);
    for (int i = 0; i < 2; i++, f->triangle_count++) {
        m->faces[f->triangle_count] = (uint32_t)f->face_count;
        m->kind[f->triangle_count] = (double)(f->face_count * 7 % 1000);
        if (i == 1 || !whole) f->face_count++;
    }
}

static large_mesh *make_large_mesh(uint64_t seed, int has_z)
{
    static char depth[] = "depth", kind[] = "physical";
    large_mesh *m = calloc(1, sizeof *m);
    uint64_t random = seed;
    assert_non_null(m);
    m->fields[0] = m->depth;
    m->field_names[0] = depth;
    m->triangle_fields[0] = m->kind;
    m->triangle_field_names[0] = kind;
    m->file = (mw_mesh_file){.points = m->points,
                             .triangles = m->triangles,
                             .point_count = POINTS,
                             .has_z = has_z,
                             .faces = has_z ? NULL : m->faces,
                             .fields = m->fields,
                             .field_names = m->field_names,
                             .field_count = 1,
                             .triangle_fields = m->triangle_fields,
                             .triangle_field_names = m->triangle_field_names,
                             .triangle_field_count = 1};
    for (uint32_t v = 0; v < POINTS; v++) {
        m->points[3 * v] = v % SIDE + (double)(mw__random(&random) >> 11) * 0x1p-56;
        m->points[3 * v + 1] = (double)v / SIDE + (double)(mw__random(&random) >> 11) * 0x1p-56;
        if (has_z) m->points[3 * v + 2] = (double)(mw__random(&random) >> 11) * 0x1p-50 - 4;
        m->depth[v] = (double)(mw__random(&random) >> 11) * 0x1p-44 - 256;
    }
    for (uint32_t y = 0; y + 1 < SIDE; y++)
        for (uint32_t x = 0; x + 1 < SIDE; x++) add_square(m, y * SIDE + x, &random, has_z);
    return m;
}

static void expect_values(const char *path, const double *a, const double *b, size_t n,
                          const char *what)
{
    for (size_t i = 0; i < n; i++)
        if (a[i] != b[i]) fail_msg("%s: %s %zu: %a, not %a", path, what, i, b[i], a[i]);
}

/* `faces`: the format has faces of four corners. */
static void expect_mesh(const char *path, const mw_mesh_file *a, const mw_mesh_file *b, bool faces,
                        bool z)
{
    assert_int_equal(a->point_count, b->point_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (size_t i = 0; i < 3 * a->point_count; i++)
        if (a->points[i] != b->points[i] && (z || i % 3 < 2))
            fail_msg("%s: coordinate %zu: %a, not %a", path, i, b->points[i], a->points[i]);
    for (size_t i = 0; i < 3 * a->triangle_count; i++)
        if (a->triangles[i] != b->triangles[i]) fail_msg("%s: corner %zu", path, i);
    if (!faces || !a->faces) {
        for (size_t t = 0; b->faces && t < a->triangle_count; t++) assert_int_equal(b->faces[t], t);
        return;
    }
    assert_int_equal(b->face_count, a->face_count);
    assert_non_null(b->faces);
    assert_memory_equal(b->faces, a->faces, a->triangle_count * sizeof *a->faces);
}

/* A reader cuts quadrilaterals where they fold least. Take its triangles, once they are known to
 * have the same corners. */
static void take_cuts(large_mesh *m)
{
    assert_int_equal(mw_write_mesh("a.vtu", &m->file, NULL, NULL, NULL), MW_OK);
    mw_mesh_file back = mesh_file_read("a.vtu");
    assert_int_equal(back.triangle_count, m->file.triangle_count);
    for (size_t t = 0; t + 1 < back.triangle_count; t++) {
        const uint32_t *a = m->triangles + 3 * t, *b = back.triangles + 3 * t;
        bool whole = m->faces[t] == m->faces[t + 1];
        uint64_t was = 0, is = 0;
        for (int i = 0; i < (whole ? 6 : 3); i++) {
            was |= UINT64_C(1) << (a[i] - a[0]) % 61;
            is |= UINT64_C(1) << (b[i] - a[0]) % 61;
        }
        assert_true(was == is);
        t += whole;
    }
    memcpy(m->triangles, back.triangles, 3 * back.triangle_count * sizeof *back.triangles);
    mw_mesh_file_release(&back);
    files_clear();
}

static void test_every_format(void **state)
{
    (void)state;
    static const struct {
        const char *path, *format;
        bool faces, z, fields, triangle_fields;
    } cases[] = {{"a.off", NULL, false, true, false, false},
                 {"a.obj", NULL, false, true, false, false},
                 {"a.ply", NULL, false, true, true, false},
                 {"a.ply", "ply-ascii", false, true, true, false},
                 {"a.node", NULL, false, true, true, false},
                 {"a.vtk", NULL, false, true, true, false},
                 {"a.vtu", NULL, true, true, true, true},
                 {"a.msh", NULL, true, true, false, true},
                 {"a.gr3", NULL, true, false, true, false},
                 {"a.14", NULL, false, false, true, false},
                 {"a.2dm", NULL, true, false, false, true},
                 {"a.nc", NULL, true, true, true, true}};
    size_t count = sizeof cases / sizeof *cases - (mw_netcdf_version(NULL, 0) == 0);
    uint64_t seed = environment_print_seed("test_every_format", 77);
    for (int has_z = 0; has_z < 2; has_z++) {
        large_mesh *m = make_large_mesh(seed, has_z);
        if (!has_z) take_cuts(m);
        for (size_t i = 0; i < count; i++) {
            mw_error error;
            if (mw_write_mesh(cases[i].path, &m->file, cases[i].format, NULL, &error) != MW_OK)
                fail_msg("%s", error.message);
            mw_mesh_file back = mesh_file_read(cases[i].path);
            expect_mesh(cases[i].path, &m->file, &back, cases[i].faces, cases[i].z);
            if (cases[i].fields) {
                assert_int_equal(back.field_count, 1);
                expect_values(cases[i].path, m->depth, back.fields[0], POINTS, "value");
            }
            if (cases[i].triangle_fields) {
                assert_int_equal(back.triangle_field_count, 1);
                expect_values(cases[i].path, m->kind, back.triangle_fields[0],
                              m->file.triangle_count, "value of triangle");
            }
            mw_mesh_file_release(&back);
            files_clear();
        }
        free(m);
    }
}

/* The coordinate system decides what netCDF calls the coordinates. */
static void test_coordinate_systems(void **state)
{
    (void)state;
    static const struct {
        const char *crs;
        bool lonlat;
    } cases[] = {
        {"EPSG:4326", true},
        {"GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.25]]]", true},
        {"GEOGCRS[\"WGS 84\"]", true},
        {"GEODCRS[\"WGS 84\"]", true},
        {"EPSG:2056", false},
        {"PROJCS[\"a plane\"]", false}};
    double points[] = {1, 2, 0, 3, 2, 0, 1, 4, 0};
    uint32_t triangles[] = {0, 1, 2};
    if (mw_netcdf_version(NULL, 0) == 0) {
        print_message("left out: no libnetcdf\n");
        skip();
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char crs[200];
        snprintf(crs, sizeof crs, "%s", cases[i].crs);
        mw_mesh_file file = {.points = points,
                             .triangles = triangles,
                             .point_count = 3,
                             .triangle_count = 1,
                             .crs = crs};
        assert_int_equal(mw_write_mesh("a.nc", &file, NULL, NULL, NULL), MW_OK);
        size_t size;
        char *text = files_read("a.nc", &size);
        assert_non_null(text);
        assert_int_equal(memmem(text, size, "degrees_east", 12) != NULL, cases[i].lonlat);
        assert_int_equal(memmem(text, size, "degrees_north", 13) != NULL, cases[i].lonlat);
        assert_int_equal(memmem(text, size, "projection_x_coordinate", 23) != NULL,
                         !cases[i].lonlat);
        free(text);
        mw_mesh_file back = mesh_file_read("a.nc");
        assert_non_null(back.crs);
        assert_string_equal(back.crs, cases[i].crs);
        mw_mesh_file_release(&back);
        files_clear();
    }
}

/* A buffer that grows. */
typedef struct growing {
    char *bytes;
    size_t size, room;
} growing;

static void grow(growing *g, uint64_t bits, int size, bool big)
{
    if (g->size + 8 > g->room) {
        g->room = 2 * g->room + 4096;
        g->bytes = realloc(g->bytes, g->room);
        assert_non_null(g->bytes);
    }
    for (int i = 0; i < size; i++)
        g->bytes[g->size++] = (char)(bits >> 8 * (big ? size - 1 - i : i));
}

static uint64_t bits_of_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* PLY with numbers of several types, or with three doubles, in which every `part`-th square is a
 * quadrilateral and the others are two triangles: those are read in runs. */
static growing make_ply(const large_mesh *m, uint32_t part, bool big, bool plain)
{
    char header[500];
    growing g = {0};
    uint32_t faces = 2 * SQUARES - (SQUARES + part - 1) / part;
    int length =
        snprintf(header, sizeof header,
                 "ply\nformat binary_%s_endian 1.0\nelement vertex %d\n%sproperty double x\n"
                 "property double y\n%selement other 3\nproperty int i\nelement face %u\n"
                 "property list uchar %s vertex_indices\nend_header\n",
                 big ? "big" : "little", POINTS, plain ? "" : "property short s\n",
                 plain ? "property double z\n" : "property uint64 u\nproperty char c\n", faces,
                 big ? "int" : "uint");
    for (int i = 0; i < length; i++) grow(&g, (uint8_t)header[i], 1, big);
    for (uint32_t v = 0; v < POINTS; v++) {
        const double *p = m->points + (size_t)3 * v;
        if (!plain) grow(&g, (uint16_t)(v % 7 - 3), 2, big);
        for (int k = 0; k < (plain ? 3 : 2); k++) grow(&g, bits_of_double(p[k]), 8, big);
        if (plain) continue;
        grow(&g, (uint64_t)v << 20, 8, big);
        grow(&g, (uint8_t)(v % 100 - 50), 1, big);
    }
    for (int i = 0; i < 3; i++) grow(&g, 7, 4, big);
    for (uint32_t i = 0; i < SQUARES; i++) {
        const uint32_t a = i / (SIDE - 1) * SIDE + i % (SIDE - 1),
                       corner[] = {a, a + 1, a + SIDE + 1, a + SIDE, a, a + SIDE + 1, a + SIDE};
        const bool whole = i % part == 0;
        grow(&g, whole ? 4 : 3, 1, big);
        for (int k = 0; k < (whole ? 4 : 3); k++) grow(&g, corner[k], 4, big);
        if (!whole) grow(&g, 3, 1, big);
        for (int k = 4; !whole && k < 7; k++) grow(&g, corner[k], 4, big);
    }
    return g;
}

static void expect_ply(const large_mesh *m, uint32_t part, bool plain, const mw_mesh_file *file)
{
    assert_int_equal(file->point_count, POINTS);
    assert_int_equal(file->triangle_count, 2 * SQUARES);
    assert_int_equal(file->field_count, plain ? 0 : 3);
    assert_int_equal(file->has_z, plain);
    if (plain) assert_memory_equal(file->points, m->points, sizeof m->points);
    for (uint32_t v = 0; v < POINTS && !plain; v++) {
        const double is[] = {file->points[3 * v], file->points[3 * v + 1], file->fields[0][v],
                             file->fields[1][v], file->fields[2][v]},
                     was[] = {m->points[3 * v], m->points[3 * v + 1], (double)(v % 7) - 3,
                              v * 0x1p20, (double)(v % 100) - 50};
        assert_memory_equal(is, was, sizeof is);
    }
    for (uint32_t i = 0, face = 0; i < SQUARES; i++) {
        const uint32_t a = i / (SIDE - 1) * SIDE + i % (SIDE - 1), *v = file->triangles + 6 * i;
        const uint32_t two[] = {a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE};
        if (i % part) assert_memory_equal(v, two, sizeof two);
        assert_int_equal(file->faces[2 * i], face);
        if (i % part) face++;
        assert_int_equal(file->faces[2 * i + 1], face++);
    }
}

static void test_ply_in_either_order(void **state)
{
    (void)state;
    large_mesh *m = make_large_mesh(environment_print_seed("test_ply_in_either_order", 78), 1);
    for (int i = 0; i < 8; i++) {
        const uint32_t part = i % 4 < 2 ? 3 : 7001;
        const bool plain = i >= 4;
        growing g = make_ply(m, part, i % 2, plain);
        mw_mesh_file file = mesh_file_read_bytes("a.ply", (bytes){g.bytes, g.size});
        mw_error error;
        expect_ply(m, part, plain, &file);
        mw_mesh_file_release(&file);
        files_write_gzip("a.ply.gz", (bytes){g.bytes, g.size}); /* its size tells nothing */
        file = mesh_file_read("a.ply.gz");
        expect_ply(m, part, plain, &file);
        mw_mesh_file_release(&file);
        /* A vertex that is not there, in the middle of a run; and an end there. */
        const size_t at = g.size - 13 * 500 + 1;
        memset(g.bytes + at, 0x7f, 16);
        files_write("a.ply", (bytes){g.bytes, g.size});
        assert_int_equal(mw_read_mesh("a.ply", NULL, &file, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, -1, "does not exist");
        files_write("a.ply", (bytes){g.bytes, at - 20});
        assert_int_equal(mw_read_mesh("a.ply", NULL, &file, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, -1, "the data end early");
        free(g.bytes);
        files_clear();
    }
    free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_format),
        cmocka_unit_test(test_ply_in_either_order),
        cmocka_unit_test(test_coordinate_systems),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
