/* test_io_roundtrip.c - what the writers write comes back, bit for bit. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/write_mesh_file.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { POINTS = 500, TRIANGLES = 900, FIELDS = 3 };

/* A mesh with doubles of every kind; not a mesh that makes sense. The points differ, as STL needs
 * it. */
typedef struct sample {
    double points[3 * POINTS], fields[FIELDS][POINTS], *field_list[FIELDS];
    uint32_t triangles[3 * TRIANGLES];
    char *names[FIELDS];
    mw_mesh_file file;
} sample;

static double any_double(uint64_t *random, int kind)
{
    uint64_t b = mw__random(random);
    double v;
    switch (kind % 4) {
    case 0: memcpy(&v, &b, sizeof v); break;
    case 1: v = (double)(b >> 11) * 0x1p-53; break;
    case 2: v = (double)(int64_t)(b % 100000000) / 1000; break;
    default: v = (double)(int64_t)(b % 2001) - 1000; break;
    }
    return isfinite(v) ? v : 1e300;
}

static void fill(sample *s, uint64_t seed, int has_z)
{
    static char names[FIELDS][32] = {"depth", "velocity u", "x"};
    uint64_t random = seed;
    for (size_t i = 0; i < 3 * POINTS; i++) s->points[i] = any_double(&random, (int)(i / 3));
    for (size_t v = 0; v < POINTS; v++)
        s->points[3 * v] = (double)v + (double)(mw__random(&random) >> 12) * 0x1p-52;
    for (size_t v = 0; v < POINTS; v += 7) s->points[3 * v + 1] = -0.0;
    for (size_t v = 0; v < POINTS && !has_z; v++) s->points[3 * v + 2] = 0;
    for (size_t f = 0; f < FIELDS; f++) {
        for (size_t v = 0; v < POINTS; v++) s->fields[f][v] = any_double(&random, (int)v);
        s->fields[f][3] = NAN;
        s->fields[f][4] = -INFINITY;
        s->field_list[f] = s->fields[f];
        s->names[f] = names[f];
    }
    for (size_t t = 0; t < TRIANGLES;
         t++) /* every vertex is used, and comes first in a triangle of its number */
        for (size_t k = 0; k < 3; k++)
            s->triangles[3 * t + k] =
                k == 0 ? (uint32_t)(t % POINTS) : mw__random_below(&random, POINTS);
    s->file = (mw_mesh_file){.points = s->points,
                             .triangles = s->triangles,
                             .point_count = POINTS,
                             .triangle_count = TRIANGLES,
                             .has_z = has_z,
                             .field_names = s->names,
                             .fields = s->field_list,
                             .field_count = FIELDS};
}

static bool same(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static void expect_same_mesh(const mw_mesh_file *a, const mw_mesh_file *b)
{
    assert_int_equal(a->point_count, b->point_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    for (size_t i = 0; i < 3 * a->point_count; i++)
        if (!same(a->points[i], b->points[i]))
            fail_msg("coordinate %zu: %a, %a", i, a->points[i], b->points[i]);
    assert_memory_equal(a->triangles, b->triangles, 3 * a->triangle_count * sizeof *a->triangles);
}

static void expect_same_fields(const mw_mesh_file *a, const mw_mesh_file *b,
                               const char *const *names)
{
    assert_int_equal(b->field_count, FIELDS);
    for (size_t f = 0; f < FIELDS; f++) {
        assert_string_equal(b->field_names[f], names[f]);
        for (size_t v = 0; v < POINTS; v++)
            if (!same(a->fields[f][v], b->fields[f][v])) fail_msg("field %zu of %zu", f, v);
    }
}

static const char *const words[FIELDS] = {"depth", "velocity_u", "x_3"};

static mw_mesh_file write_and_read(const char *path, const char *format, const mw_mesh_file *file)
{
    mw_error error;
    if (mw_write_mesh(path, file, format, NULL, &error) != MW_OK) fail_msg("%s", error.message);
    return mesh_file_read(path);
}

static void expect_same_corners(const mw_mesh_file *a, const mw_mesh_file *b, const char *name)
{
    if (a->point_count != b->point_count || a->triangle_count != b->triangle_count)
        fail_msg("%s: %zu vertices, %zu triangles", name, b->point_count, b->triangle_count);
    for (size_t i = 0; i < 2 * a->point_count; i++)
        if (!same(a->points[3 * (i / 2) + i % 2], b->points[3 * (i / 2) + i % 2]))
            fail_msg("%s: coordinate %zu", name, i);
    assert_memory_equal(a->triangles, b->triangles, 3 * a->triangle_count * sizeof *a->triangles);
}

static void test_every_format(void **state)
{
    (void)state;
    static const struct {
        const char *path, *format;
        bool fields, planar;
    } cases[] = {{"a.off", NULL, false, false},  {"a.obj", NULL, false, false},
                 {"a.ply", NULL, true, false},   {"b.ply", "ply-ascii", true, false},
                 {"a.dat", "off", false, false}, {"a.node", NULL, true, true},
                 {"b.ele", NULL, true, true},    {"a.nc", NULL, true, true}};
    size_t count = sizeof cases / sizeof *cases - (mw_netcdf_version(NULL, 0) == 0);
    uint64_t seed = (uint64_t)time(NULL);
    print_message("seed %llu\n", (unsigned long long)seed);
    sample *s = malloc(sizeof *s);
    assert_non_null(s);
    for (size_t i = 0; i < count; i++)
        for (int has_z = 0; has_z < 2; has_z++) {
            fill(s, seed + i, has_z);
            mw_mesh_file back = write_and_read(cases[i].path, cases[i].format, &s->file);
            expect_same_mesh(&s->file, &back);
            if (cases[i].fields)
                expect_same_fields(&s->file, &back, words);
            else
                assert_int_equal(back.field_count, 0);
            /* .node knows meshes without heights, the others have z always */
            assert_int_equal(back.has_z, cases[i].planar ? has_z : 1);
            mw_mesh_file_release(&back);
            files_clear();
        }
    free(s);
}

/* A triangle, a quadrilateral and a pentagon, with boundaries, a barrier among them. */
static const char grid_vtk_text[] =
    "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
    "0 0 0 .1 0 0 1 1 0 0 1 0 2 0 0 2 2 0 1 3 0 0 3 0\nCELLS 3 15\n4 0 1 2 3\n3 1 4 2\n"
    "5 3 2 5 6 7\nCELL_TYPES 3\n9 5 7\nPOINT_DATA 8\nSCALARS depth double\nLOOKUP_TABLE default\n"
    "-1 2 3 1e-3 5 6 0.1 7\nCELL_DATA 3\nSCALARS physical int\nLOOKUP_TABLE default\n7 8 9\n";

static void test_grids(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        size_t faces;
        bool depth, physical, marks;
    } cases[] = {{"a.vtu", 3, true, true, false},
                 {"a.14", 6, true, false, true},
                 {"a.gr3", 5, true, false, true},
                 {"a.2dm", 5, false, false, false},
                 {"a.msh", 5, true, true, true}};
    char *names[] = {"open 1", "land 1 type 20", "land 2 type 24"};
    mw_marked_edge edges[] = {{{0, 1}, 0}, {{1, 4}, 0}, {{4, 5}, 1}, {{6, 3}, 2}, {{3, 0}, 1}};
    mw_mesh_file mesh = mesh_file_read_text("a.vtk", grid_vtk_text);
    mesh.mark_names = names;
    mesh.mark_count = 3;
    mesh.edges = edges;
    mesh.edge_count = 5;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_mesh_file back = write_and_read(cases[i].path, NULL, &mesh);
        expect_same_corners(&mesh, &back, cases[i].path);
        assert_int_equal(back.face_count, cases[i].faces);
        assert_int_equal(back.field_count, cases[i].depth);
        for (size_t v = 0; v < 8 && cases[i].depth; v++)
            assert_true(back.fields[0][v] == mesh.fields[0][v]);
        assert_int_equal(back.has_z, i == 3);
        for (size_t v = 0; v < 8 && i == 3; v++)
            assert_true(back.points[3 * v + 2] == -mesh.fields[0][v]);
        if (cases[i].physical || i == 3)
            assert_memory_equal(back.triangle_fields[0], mesh.triangle_fields[0],
                                6 * sizeof(double));
        bool fort14 = i == 1 || i == 2;
        assert_int_equal(back.edge_count, fort14 ? 4 : cases[i].marks ? 5 : 0);
        if (fort14) { /* without the barrier; chains that do not hang together are two */
            assert_int_equal(back.mark_count, 3);
            assert_string_equal(back.mark_names[0], "open 1");
            assert_string_equal(back.mark_names[2], "land 2 type 20");
            assert_true(back.edges[1].vertex[1] == 4 && back.edges[3].vertex[0] == 3);
        }
        if (i == 4) assert_string_equal(back.mark_names[back.edges[3].mark], "land 2 type 24");
        mw_mesh_file_release(&back);
        files_clear();
    }
    mesh.mark_names = NULL;
    mesh.edges = NULL;
    mesh.mark_count = mesh.edge_count = 0;
    mw_mesh_file_release(&mesh);
}

/* STL has no vertices: they come back in the order of the corners, merged where they are equal. */
static void test_stl(void **state)
{
    (void)state;
    sample *s = malloc(sizeof *s);
    assert_non_null(s);
    fill(s, 5, 1);
    mw_mesh_file back = write_and_read("a.stl", NULL, &s->file);
    assert_int_equal(back.point_count, POINTS);
    assert_int_equal(back.triangle_count, TRIANGLES);
    assert_int_equal(back.welded, 3 * TRIANGLES - POINTS);
    for (size_t i = 0; i < 3 * TRIANGLES; i++)
        for (size_t k = 0; k < 3; k++)
            if (!same(back.points[3 * back.triangles[i] + k], s->points[3 * s->triangles[i] + k]))
                fail_msg("corner %zu", i);
    mw_mesh_file_release(&back);
    free(s);
    files_clear();
}

/* A normal is the outer one of a counter-clockwise triangle, of length 1; none of a flat one. */
static void test_stl_normals(void **state)
{
    (void)state;
    double points[] = {0, 0, 0, 2, 0, 0, 0, 3, 0, 4, 0, -3, 0, 4, 3};
    uint32_t triangles[] = {0, 1, 2, 0, 0, 1, 0, 3, 2, 0, 2, 3, 0, 1, 4};
    mw_mesh_file file = {
        .points = points, .triangles = triangles, .point_count = 5, .triangle_count = 5};
    assert_int_equal(mw_write_mesh("n.stl", &file, NULL, NULL, NULL), MW_OK);
    char *text = files_read("n.stl", NULL);
    assert_non_null(text);
    assert_non_null(strstr(text, "\nouter loop\nvertex 0 0 0\nvertex 2 0 0\n"));
    static const double wanted[5][3] = {
        {0, 0, 1}, {0, 0, 0}, {0.6, 0, 0.8}, {-0.6, 0, -0.8}, {0, -0.6, 0.8}};
    const char *at = text;
    for (int t = 0; t < 5; t++) {
        double n[3];
        at = strstr(at, "facet normal ");
        assert_non_null(at);
        assert_int_equal(sscanf(at, "facet normal %lf %lf %lf", &n[0], &n[1], &n[2]), 3);
        for (int k = 0; k < 3; k++) assert_true(n[k] == wanted[t][k]);
        at++;
    }
    free(text);
    files_clear();
}

/* CSV is read back as points: a row for each corner. */
static void test_csv(void **state)
{
    (void)state;
    sample *s = malloc(sizeof *s);
    assert_non_null(s);
    fill(s, 6, 1);
    assert_int_equal(mw_write_mesh("a.csv", &s->file, NULL, NULL, NULL), MW_OK);
    mw_point_reader_options options = {.columns =
                                           "triangle,corner,vertex,x,y,z,depth,velocity_u,x_3"};
    mw_point_reader *reader;
    assert_int_equal(mw_point_reader_open("a.csv", &options, &reader, NULL), MW_OK);
    assert_int_equal(mw_point_reader_width(reader), 9);
    for (size_t i = 0; i <= 3 * TRIANGLES; i++) {
        double row[9];
        size_t count;
        assert_int_equal(mw_point_reader_read(reader, row, 1, &count, NULL), MW_OK);
        assert_int_equal(count, i < 3 * TRIANGLES);
        if (count == 0) break;
        size_t v = s->triangles[i];
        assert_true(row[0] == (double)(i / 3) && row[1] == (double)(i % 3) && row[2] == (double)v);
        for (size_t k = 0; k < 3; k++) assert_true(same(row[3 + k], s->points[3 * v + k]));
        for (size_t f = 0; f < FIELDS; f++) assert_true(same(row[6 + f], s->fields[f][v]));
    }
    mw_point_reader_close(reader);
    free(s);
    files_clear();
}

/* The text is fixed, for other programs; what is read back is the same, values of triangles too. */
static void test_vtk(void **state)
{
    (void)state;
    double points[] = {0, 0, 0.1, 1, 0, -0.0, 1, 1, 1e-300, 0, 1, 4},
           depth[] = {1, 2.5, NAN, -1e22}, soil[] = {7, 0.25};
    uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    char name[] = "water depth", soil_name[] = "soil";
    char *names[] = {name}, *triangle_names[] = {soil_name};
    double *fields[] = {depth}, *triangle_fields[] = {soil};
    mw_mesh_file file = {.points = points,
                         .triangles = triangles,
                         .point_count = 4,
                         .triangle_count = 2,
                         .has_z = 1,
                         .field_names = names,
                         .fields = fields,
                         .field_count = 1,
                         .triangle_field_names = triangle_names,
                         .triangle_fields = triangle_fields,
                         .triangle_field_count = 1};
    assert_int_equal(mw_write_mesh("a.vtk", &file, NULL, NULL, NULL), MW_OK);
    char *text = files_read("a.vtk", NULL);
    assert_non_null(text);
    assert_string_equal(
        text,
        "# vtk DataFile Version 3.0\nmeshwalk\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        "POINTS 4 double\n0 0 0.1\n1 0 -0\n1 1 1e-300\n0 1 4\n"
        "CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\n"
        "POINT_DATA 4\nSCALARS water_depth double 1\nLOOKUP_TABLE default\n1\n2.5\nnan\n-1e+22\n"
        "CELL_DATA 2\nSCALARS soil double 1\nLOOKUP_TABLE default\n7\n0.25\n");
    free(text);
    mw_mesh_file back = write_and_read("b.vtk", NULL, &file);
    assert_int_equal(back.triangle_field_count, 1);
    assert_string_equal(back.triangle_field_names[0], "soil");
    assert_memory_equal(back.triangle_fields[0], soil, sizeof soil);
    mw_mesh_file_release(&back);
    files_clear();
}

/* No triangles, and nothing at all. */
static void test_empty(void **state)
{
    (void)state;
    static const char *const paths[] = {"a.off", "a.ply", "a.node", "a.obj"};
    double points[] = {0, 0, 0, 1, 2, 3};
    mw_mesh_file file = {.points = points, .point_count = 2, .has_z = 1};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        mw_mesh_file back = write_and_read(paths[i], NULL, &file);
        assert_int_equal(back.triangle_count, 0);
        assert_int_equal(back.point_count, 2);
        assert_true(back.points[4] == 2 && back.points[5] == 3);
        mw_mesh_file_release(&back);
    }
    static const char *const formats[] = {"off", "ply", "ply-ascii", "node",
                                          "stl", "csv", "vtk",       "obj"};
    mw_mesh_file nothing = {0};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        assert_int_equal(mw_write_mesh("nothing.node", &nothing, formats[i], NULL, NULL), MW_OK);
    files_clear();
}

/* Names that give the same word get numbers, and a name in UTF-8 stays. */
static void test_field_names(void **state)
{
    (void)state;
    double points[] = {1, 2, 3}, values[] = {7};
    char names[][16] = {"a b", "a-b", "z", "", "h\xc3\xb6he", "a,b"};
    static const char *const wanted[] = {"a_b", "a_b_2", "z_3", "_4", "h\xc3\xb6he", "a_b_6"};
    char *name_list[6];
    double *fields[6];
    for (int i = 0; i < 6; i++) {
        name_list[i] = names[i];
        fields[i] = values;
    }
    mw_mesh_file file = {.points = points,
                         .point_count = 1,
                         .has_z = 1,
                         .field_names = name_list,
                         .fields = fields,
                         .field_count = 6};
    static const char *const paths[] = {"a.ply", "a.node"};
    for (int p = 0; p < 2; p++) {
        mw_mesh_file back = write_and_read(paths[p], NULL, &file);
        assert_int_equal(back.field_count, 6);
        for (int i = 0; i < 6; i++) assert_string_equal(back.field_names[i], wanted[i]);
        assert_true(back.points[2] == 3 && back.fields[5][0] == 7);
        mw_mesh_file_release(&back);
    }
    files_clear();
}

static void expect_refused(const char *path, const char *format, const mw_mesh_file *file,
                           mw_status status, const char *says)
{
    mw_error error;
    assert_int_equal(mw_write_mesh(path, file, format, NULL, &error), status);
    files_expect_error(&error, status, -1, says);
    assert_int_equal(files_count(), 0);
}

static void test_refused(void **state)
{
    (void)state;
    double points[] = {0, 0, 0};
    uint32_t triangles[] = {0, 0, 1};
    mw_mesh_file file = {.points = points, .point_count = 1};
    expect_refused("a.xyz", NULL, &file, MW_ERROR_ARGUMENT,
                   "a.xyz: no mesh format has this ending");
    expect_refused("-", NULL, &file, MW_ERROR_ARGUMENT, "no mesh format");
    expect_refused("a.off", "dxf", &file, MW_ERROR_ARGUMENT,
                   "unknown mesh format 'dxf' (known: off, ply, ply-ascii, ");
    expect_refused("a.off.gz", NULL, &file, MW_ERROR_ARGUMENT, "gzip is read, but not written");
    expect_refused("-", "node", &file, MW_ERROR_ARGUMENT, "two files");
    expect_refused("nowhere/a.node", NULL, &file, MW_ERROR_SYSTEM, "nowhere/a.node: No such file");
    expect_refused("nowhere/a.off", NULL, &file, MW_ERROR_SYSTEM, "nowhere/a.off: No such file");
    if (access("/dev/full", W_OK) == 0)
        expect_refused("/dev/full", "ply", &file, MW_ERROR_SYSTEM,
                       "/dev/full: No space left on device");
    expect_refused(NULL, "off", &file, MW_ERROR_ARGUMENT, "NULL");
    file.triangles = triangles;
    file.triangle_count = 1;
    expect_refused("a.off", NULL, &file, MW_ERROR_INPUT, "triangle 0 names vertex 1");
}

/* Of a pair whose second file cannot be written, neither appears. */
static void test_pair_or_nothing(void **state)
{
    (void)state;
    double points[] = {0, 0, 0};
    mw_mesh_file file = {.points = points, .point_count = 1};
    assert_int_equal(mkdir("a.ele", 0700), 0);
    mw_error error;
    assert_int_equal(mw_write_mesh("a.node", &file, NULL, NULL, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "a.ele: Is a directory");
    assert_false(files_exists("a.node"));
    assert_int_equal(rmdir("a.ele"), 0);
    if (access("/dev/full", W_OK) == 0) {
        assert_int_equal(symlink("/dev/full", "a.ele"), 0);
        assert_int_equal(mw_write_mesh("a.node", &file, NULL, NULL, &error), MW_ERROR_SYSTEM);
        files_expect_error(&error, MW_ERROR_SYSTEM, -1, "a.ele: No space left on device");
        assert_false(files_exists("a.node"));
    }
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_format), cmocka_unit_test(test_grids),
        cmocka_unit_test(test_stl),          cmocka_unit_test(test_stl_normals),
        cmocka_unit_test(test_csv),          cmocka_unit_test(test_vtk),
        cmocka_unit_test(test_empty),        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_field_names),  cmocka_unit_test(test_pair_or_nothing),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
