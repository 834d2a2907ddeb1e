/* test_io_memory.c - allocation number k fails, for every k: readers and writers report it and
 * lose nothing. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdbool.h>
#include <meshwalk/series.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* wrap: malloc calloc realloc aligned_alloc strdup strndup free */
#include "support/grid_bytes.h"
#include "support/write_mesh_file.h"

static long countdown = -1; /* allocations until one fails; negative: none does */
static long alive;          /* blocks that the library holds */
static bool counting;

static bool fails(void)
{
    return counting && countdown >= 0 && countdown-- == 0;
}

static void *counted(void *block)
{
    alive += counting && block;
    return block;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
char *__real_strndup(const char *text, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : counted(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails() ? NULL : counted(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size)
{
    if (fails()) return NULL;
    void *block = __real_realloc(old, size);
    return old ? block : counted(block);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return fails() ? NULL : counted(__real_aligned_alloc(alignment, size));
}

char *__wrap_strdup(const char *text)
{
    return fails() ? NULL : counted(__real_strdup(text));
}

char *__wrap_strndup(const char *text, size_t size)
{
    return fails() ? NULL : counted(__real_strndup(text, size));
}

void __wrap_free(void *block)
{
    alive -= counting && block;
    __real_free(block);
}

/* A piece of work that can fail; it releases all it got. */
typedef mw_status io_work(const char *argument, mw_error *error);

static void fail_each(io_work *job, const char *argument)
{
    for (long k = 0;; k++) {
        mw_error error = {0};
        countdown = k;
        alive = 0;
        counting = true;
        mw_status status = job(argument, &error);
        counting = false;
        if (alive != 0)
            fail_msg("%s: %ld blocks lost when allocation %ld fails", argument, alive, k);
        if (countdown >= 0) { /* there were fewer allocations than that */
            assert_int_equal(status, MW_OK);
            assert_true(k > 2);
            return;
        }
        if (status != MW_ERROR_MEMORY)
            fail_msg("%s: status %d when allocation %ld fails: %s", argument, status, k,
                     error.message);
        assert_string_equal(error.message, "out of memory");
    }
}

static mw_status read_mesh(const char *path, mw_error *error)
{
    mw_mesh_file file;
    mw_status status = mw_read_mesh(path, NULL, &file, error);
    if (status) assert_null(file.points);
    mw_mesh_file_release(&file);
    return status;
}

static mw_status read_points(const char *path, mw_error *error)
{
    mw_point_reader *reader;
    mw_point_reader_options options = {.columns = strstr(path, "named") ? "y,x" : NULL};
    mw_status status = mw_point_reader_open(path, &options, &reader, error);
    double values[64];
    size_t count = 1;
    while (!status && count > 0) status = mw_point_reader_read(reader, values, 8, &count, error);
    mw_point_reader_close(reader);
    return status;
}

/* The same as a table, whose columns are chosen after it was opened. */
static mw_status read_table(const char *path, mw_error *error)
{
    mw_point_reader *reader;
    mw_point_reader_options options = {.table = 1};
    const size_t columns[] = {1, 0};
    mw_status status = mw_point_reader_open(path, &options, &reader, error);
    double values[64];
    size_t count = 1;
    if (!status) status = mw_point_reader_select(reader, columns, 2, error);
    while (!status && count > 0) status = mw_point_reader_read(reader, values, 8, &count, error);
    mw_point_reader_close(reader);
    return status;
}

static mw_status read_edits(const char *path, mw_error *error)
{
    mw_edit_reader *reader;
    mw_edit_line line = {.kind = MW_EDIT_LINE_UNDO};
    mw_status status = mw_edit_reader_open(path, NULL, &reader, error);
    while (!status && line.kind != MW_EDIT_LINE_NONE)
        status = mw_edit_reader_read(reader, &line, error);
    mw_edit_reader_close(reader);
    return status;
}

static double points[300];
static uint32_t triangles[300];

static mw_status write_mesh(const char *path, mw_error *error)
{
    char name[] = "depth";
    char *names[] = {name};
    double *fields[] = {points};
    mw_mesh_file file = {.points = points,
                         .triangles = triangles,
                         .point_count = 100,
                         .triangle_count = 100,
                         .field_names = names,
                         .fields = fields,
                         .field_count = 1};
    return mw_write_mesh(path, &file, NULL, NULL, error);
}

/* Arrays for all that a file has are made at once. */
static void fail_binary_ply(void)
{
    static const char head[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char "
        "y\nproperty char q\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    static const unsigned char data[] = {0, 0, 1, 1, 0, 1, 0, 1, 1, 3, 0, 0, 0, 0, 1, 0, 0, 0,
                                         2, 0, 0, 0, 3, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0};
    char file[sizeof head - 1 + sizeof data];
    memcpy(file, head, sizeof head - 1);
    memcpy(file + sizeof head - 1, data, sizeof data);
    files_write("b.ply", (bytes){file, sizeof file});
    fail_each(read_mesh, "b.ply");
}

static void test_read_meshes(void **state)
{
    (void)state;
    char room[512];
    static const float corners[1][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}};
    files_write_text("a.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    files_write_text("a.obj", SQUARE_V "f 1 2\\\n3\\\n4\n");
    files_write_text("a.stl", "solid\n" STL_FACET("0 0 0", "1 0 0", "1 1 0") "endsolid\n");
    files_write("b.stl", mesh_file_stl(room, "", 1, corners, 1));
    files_write_text("a.ply", "ply\nformat ascii 1.0\ncomment crs EPSG:1\nelement vertex "
                              "3\nproperty float x\nproperty float "
                              "y\nproperty int q\n"
                              "element face 1\nproperty list int int vertex_indices\nend_header\n0 "
                              "0 1\n1 0 1\n0 1 1\n3 0 1 2\n");
    files_write_text("a.node",
                     "# attributes: depth, z\n3 2 2 0\n0 0 0 7 7\n1 1 0 7 7\n2 0 1 7 7\n");
    files_write_text("a.ele", "1 3 0\n0 0 1 2\n");
    files_write_text("a.prj", "EPSG:2056");
    static const char *const paths[] = {"a.off", "a.obj", "a.stl", "b.stl", "a.ply", "a.node", "a"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) fail_each(read_mesh, paths[i]);
    fail_binary_ply();
    files_clear();
    /* enough vertices that the table of the welding grows */
    FILE *out = fopen("large.stl", "w");
    assert_non_null(out);
    fprintf(out, "solid\n");
    for (int i = 0; i < 200; i++)
        fprintf(out, "facet\nvertex %d 0 0\nvertex 0 %d 0\nvertex 0 0 %d\nendfacet\n", i, i, i);
    fprintf(out, "endsolid\n");
    fclose(out);
    fail_each(read_mesh, "large.stl");
    files_clear();
}

static void fail_grid(const char *name, grid_bytes g)
{
    files_write(name, (bytes){g.bytes, g.size});
    grid_release(&g);
    fail_each(read_mesh, name);
}

static void test_read_grids(void **state)
{
    (void)state;
    const grid_form packed = {.packed = true};
    files_write_text("a.gr3", "\n2 4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n1 4 1 2 3 4\n"
                              "2 3 1 2 3\n1\n2\n2\n1\n2\n1\n2\n2 20\n2\n3\n");
    files_write_text("hgrid.ll", "\n1 3\n1 0 0 0\n2 1 0 0\n3 1 1 0\n1 3 1 2 3\n");
    files_write_text("a.2dm", "MESH2D\nE4Q 2 1 2 3 4 5\nE3T 1 1 2 3 5\nND 4 0 1 0\nND 3 1 1 0\n"
                              "ND 2 1 0 0\nND 1 0 0 0\n");
    files_write_text("a.su2", "NDIME= 2\nNELEM= 1\n9 0 1 2 3\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\n"
                              "MARKER_TAG= a\nMARKER_ELEMS= 1\n3 0 1\n");
    static const char *const paths[] = {"a.gr3", "hgrid.ll", "a.2dm", "a.su2"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) fail_each(read_mesh, paths[i]);
    fail_grid("a.msh", grid_msh(22, false));
    fail_grid("a.msh", grid_msh(41, false));
    fail_grid("a.slf", grid_selafin(packed));
    fail_grid("a.vtk", grid_vtk(false));
    fail_grid("a.vtu", grid_vtu(packed, false));
    fail_grid("a.vtu", grid_vtu(packed, true));
    fail_grid("a.npz", grid_npz(packed, false));
    files_clear();
}

static mw_status read_series(const char *path, mw_error *error)
{
    mw_series *series;
    double values[8];
    mw_status status = mw_series_open(path, NULL, &series, error);
    if (!status) status = mw_series_read(series, 0, 1, values, error);
    if (!status) status = mw_series_read(series, 0, 0, values, error);
    mw_series_close(series);
    return status;
}

static void test_read_series(void **state)
{
    (void)state;
    grid_bytes g = grid_selafin((grid_form){0});
    files_write("a.slf", (bytes){g.bytes, g.size});
    grid_release(&g);
    fail_each(read_series, "a.slf");
    files_write_text("fort.64", "a\n2 2 1 1 2\n1 1\n1 1 1\n2 2 2\n2 2\n1 1 1\n2 2 2\n");
    fail_each(read_series, "fort.64");
    files_clear();
}

static void test_read_points(void **state)
{
    (void)state;
    files_write_text("plain.xyz", "1 2 3\n4 5 6\n");
    files_write_text("named.csv", "x,y\n1,2\n3,4\n");
    files_write_text("a.node", "2 2 1 1\n1 0 0 5 1\n2 1 1 5 0\n");
    static const char *const paths[] = {"plain.xyz", "named.csv", "a.node"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        fail_each(read_points, paths[i]);
        fail_each(read_table, paths[i]);
    }
    unsigned char las[227 + 20] = "LASF";
    las[24] = 1;
    las[25] = 2;
    las[94] = las[96] = 227;
    las[105] = 20;
    las[107] = 1;
    files_write("a.las", (bytes){(const char *)las, sizeof las});
    fail_each(read_points, "a.las");
    fail_each(read_table, "a.las");
    files_clear();
}

static void test_read_edits(void **state)
{
    (void)state;
    files_write_text("edits.txt", "insert 1 2 3\nlocate 1 2\nundo\n");
    fail_each(read_edits, "edits.txt");
    files_clear();
}

static void test_write(void **state)
{
    (void)state;
    static const char *const paths[] = {"a.off", "a.ply", "a.node", "a.obj", "a.stl", "a.csv",
                                        "a.vtk", "a.vtu", "a.14",   "a.gr3", "a.2dm", "a.msh"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        fail_each(write_mesh, paths[i]);
        files_clear();
    }
    if (mw_netcdf_version(NULL, 0) == 0) return;
    fail_each(write_mesh, "a.nc");
    fail_each(read_mesh, "a.nc");
    size_t size;
    char *contents = files_read("a.nc", &size);
    files_write_gzip("b.nc.gz", (bytes){contents, size});
    free(contents);
    fail_each(read_mesh, "b.nc.gz");
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_read_meshes), cmocka_unit_test(test_read_grids),
        cmocka_unit_test(test_read_series), cmocka_unit_test(test_read_points),
        cmocka_unit_test(test_read_edits),  cmocka_unit_test(test_write)};
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
