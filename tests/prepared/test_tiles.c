/* test_tiles.c - a mesh in tiles: what the files of a folder hold, what its index says, and that a
 * call that fails leaves no folder. That answers are those of the whole mesh is for the tests of
 * Python, where tiles are read. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "prepared/tiles/blake2b.h"
#include "prepared/tiles/tile_index.h"
#include "support/allocations.h"
#include "support/files.h"
#include "support/meshes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* wrap: malloc calloc realloc aligned_alloc */

enum { TILES = 5 };

/* --- folders ---------------------------------------------------------------------------------- */

static char *file_in(const char *folder, int tile)
{
    static char name[80];
    if (tile < 0)
        snprintf(name, sizeof name, "%s/overview.mwm", folder);
    else
        snprintf(name, sizeof name, "%s/tile-%05d.mwm", folder, tile);
    return name;
}

static void folder_remove(const char *folder, int tiles)
{
    char name[80];
    snprintf(name, sizeof name, "%s/tiles.json", folder);
    unlink(name);
    for (int tile = -1; tile < tiles; tile++) unlink(file_in(folder, tile));
    assert_int_equal(rmdir(folder), 0);
}

static void expect_same_file(const char *one, const char *other)
{
    size_t sizes[2];
    char *a = files_read(one, &sizes[0]), *b = files_read(other, &sizes[1]);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(a, b, sizes[0]);
    free(a);
    free(b);
}

/* --- a mesh with holes, and with flat triangles that hang on one another ---------------------- */

typedef struct tiled_mesh {
    arrays given;
    mw_mesh *mesh;
    mw_locator *locator;
} tiled_mesh;

/* A square of four triangles, whose lower side is two edges: three flat triangles lie between the
 * side as one edge and what is below. */
static arrays arrays_with_flat(void)
{
    arrays a = arrays_make(8, 8);
    arrays_point(&a, 0, 0);
    arrays_point(&a, 4, 0);
    arrays_point(&a, 4, 4);
    arrays_point(&a, 0, 4);
    arrays_point(&a, 1, 0);
    arrays_point(&a, 2, 0);
    arrays_point(&a, 0, -4);
    arrays_point(&a, 4, -4);
    arrays_triangle(&a, 0, 1, 2);
    arrays_triangle(&a, 0, 2, 3);
    arrays_triangle(&a, 0, 5, 1);
    arrays_triangle(&a, 0, 4, 5);
    arrays_triangle(&a, 0, 6, 4);
    arrays_triangle(&a, 4, 6, 5);
    arrays_triangle(&a, 5, 6, 7);
    arrays_triangle(&a, 5, 7, 1);
    return a;
}

static tiled_mesh tiled_mesh_make(bool flat)
{
    uint64_t random = 4;
    tiled_mesh m = {.given = flat ? arrays_with_flat() : arrays_grid(14, 0, &random)};
    if (!flat) arrays_punch(&m.given, 0.3, &random);
    m.mesh = arrays_mesh(&m.given, (mw_mesh_options){0});
    m.locator = mesh_locator(m.mesh, (mw_locator_options){.fill = MW_FILL_YES});
    return m;
}

static void tiled_mesh_release(tiled_mesh *m)
{
    mw_locator_destroy(m->locator);
    mw_mesh_destroy(m->mesh);
    arrays_free(&m->given);
}

static void tiled_mesh_write(const tiled_mesh *m, const char *folder, uint32_t tiles,
                             uint32_t threads)
{
    mw_error error;
    const mw_tile_options options = {.tiles = tiles, .threads = threads};
    expect_ok(mw_write_tiles(m->locator, folder, &options, &error), folder, &error);
}

static bool triangle_is_flat(const mw_mesh *mesh, uint32_t t)
{
    uint32_t v[3];
    double p[3][2];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
    return mw_orient2d(p[0], p[1], p[2]) == 0;
}

/* Check that a file has triangles of the mesh under their numbers, and count each. */
static void expect_part(const tiled_mesh *m, const char *path, uint32_t *times)
{
    mw_error error;
    mw_prepared *p;
    double at[2], want[2];
    expect_ok(mw_mesh_map(path, NULL, &p, &error), path, &error);
    const mw_mesh_file *values = mw_prepared_values(p);
    const mw_mesh *part = mw_prepared_mesh(p);
    assert_int_equal(values->field_count, 1);
    assert_string_equal(values->field_names[0], "meshwalk:vertex");
    assert_int_equal(values->triangle_field_count, 1);
    assert_string_equal(values->triangle_field_names[0], "meshwalk:triangle");
    for (uint32_t t = 0; t < mw_mesh_triangle_count(part); t++) {
        uint32_t v[3], whole[3];
        const double number = values->triangle_fields[0][t];
        assert_true(t == 0 || number > values->triangle_fields[0][t - 1]);
        times[(uint32_t)number]++;
        mw_mesh_triangle(part, t, v);
        mw_mesh_triangle(m->mesh, (uint32_t)number, whole);
        for (int k = 0; k < 3; k++) {
            assert_true(values->fields[0][v[k]] == whole[k]);
            mw_mesh_vertex(part, v[k], at);
            mw_mesh_vertex(m->mesh, whole[k], want);
            assert_memory_equal(at, want, sizeof at);
        }
    }
    mw_prepared_close(p);
}

/* Each triangle with an area is in one tile; the overview has what is at the border. */
static void test_parts(void **state)
{
    (void)state;
    tiled_mesh m = tiled_mesh_make(false);
    const uint32_t count = mw_mesh_triangle_count(m.mesh);
    uint32_t *times = calloc(count, sizeof *times), *border = calloc(count, sizeof *border);
    tiled_mesh_write(&m, "parts", TILES, 1);
    for (int tile = 0; tile < TILES; tile++) expect_part(&m, file_in("parts", tile), times);
    expect_part(&m, file_in("parts", -1), border);
    for (uint32_t t = 0; t < count; t++) {
        bool outer = false;
        assert_int_equal(times[t], 1);
        for (unsigned k = 0; k < 3; k++)
            outer = outer || mw_mesh_neighbour(m.mesh, t, k, NULL) == MW_NONE;
        if (outer) assert_int_equal(border[t], 1);
    }
    tiled_mesh_write(&m, "threads", TILES, 3);
    for (int tile = -1; tile < TILES; tile++) {
        char name[80];
        snprintf(name, sizeof name, "%s", file_in("parts", tile));
        expect_same_file(name, file_in("threads", tile));
    }
    expect_same_file("parts/tiles.json", "threads/tiles.json");
    folder_remove("threads", TILES);
    folder_remove("parts", TILES);
    free(times);
    free(border);
    tiled_mesh_release(&m);
}

/* Flat triangles are in every tile that touches their group. */
static void test_flat_triangles(void **state)
{
    (void)state;
    tiled_mesh m = tiled_mesh_make(true);
    uint32_t times[8] = {0}, border[8] = {0};
    tiled_mesh_write(&m, "flat", 3, 1);
    for (int tile = 0; tile < 3; tile++) expect_part(&m, file_in("flat", tile), times);
    expect_part(&m, file_in("flat", -1), border);
    for (uint32_t t = 0; t < 8; t++) {
        assert_int_equal(times[t], triangle_is_flat(m.mesh, t) ? 3 : 1);
        assert_int_equal(border[t], 1); /* each has a vertex of the border */
    }
    folder_remove("flat", 3);
    tiled_mesh_release(&m);
}

/* --- the index -------------------------------------------------------------------------------- */

/* The form that is documented, of a square of two triangles. */
static void test_index(void **state)
{
    static const char wanted[] =
        "{\"format\": \"meshwalk tiles\", \"version\": 1, \"vertices\": 4, \"triangles\": 2, "
        "\"holes\": [], \"checksums\": [";
    (void)state;
    mw_error error;
    arrays a = arrays_make(4, 2);
    arrays_point(&a, 0, 0);
    arrays_point(&a, 0.1, 0);
    arrays_point(&a, 1e22, 4);
    arrays_point(&a, -0.5, 4);
    arrays_triangle(&a, 0, 1, 2);
    arrays_triangle(&a, 0, 2, 3);
    tiled_mesh m = {.given = a, .mesh = arrays_mesh(&a, (mw_mesh_options){0})};
    m.locator = mesh_locator(m.mesh, (mw_locator_options){.fill = MW_FILL_YES});
    tiled_mesh_write(&m, "index///", 2, 1);
    char *text = files_read("index/tiles.json", NULL);
    assert_non_null(text);
    assert_memory_equal(text, wanted, sizeof wanted - 1);
    assert_non_null(strstr(text, ", \"cuts\": [[0, 1e+22, -0.5, -1, -2]], \"checksum\": \""));
    assert_int_equal(mw_write_tiles(m.locator, "index", NULL, &error), MW_ERROR_SYSTEM);
    assert_non_null(strstr(error.message, "index: exists already; remove it first"));
    free(text);
    folder_remove("index", 2);
    tiled_mesh_release(&m);
}

/* Numbers are as Python writes them, and read back. */
static void test_numbers(void **state)
{
    static const struct {
        double value;
        const char *text;
    } known[] = {{0, "0.0"},
                 {-0.0, "-0.0"},
                 {1, "1.0"},
                 {-2.5, "-2.5"},
                 {0.1, "0.1"},
                 {0.1 + 0.2, "0.30000000000000004"},
                 {100, "100.0"},
                 {123456789012345680, "1.2345678901234568e+17"},
                 {1e15, "1000000000000000.0"},
                 {9999999999999998, "9999999999999998.0"},
                 {1e16, "1e+16"},
                 {1e22, "1e+22"},
                 {1e-4, "0.0001"},
                 {-1.25e-3, "-0.00125"},
                 {1e-5, "1e-05"},
                 {1.5e-10, "1.5e-10"},
                 {5e-324, "5e-324"},
                 {2.2250738585072014e-308, "2.2250738585072014e-308"},
                 {1.7976931348623157e308, "1.7976931348623157e+308"}};
    uint64_t random = 9;
    char text[32];
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        mw__tile_number_write(known[i].value, text);
        assert_string_equal(text, known[i].text);
    }
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = mw__random(&random);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        mw__tile_number_write(value, text);
        assert_true(strlen(text) < 25 && strtod(text, NULL) == value);
    }
}

/* What hashlib.blake2b(text, digest_size=8) gives, in pieces of any lengths. */
static void test_checksum(void **state)
{
    static const struct {
        size_t size;
        uint64_t digest;
    } known[] = {{0, UINT64_C(0xe4a6a0577479b2b4)},
                 {128, UINT64_C(0xe4dcce81741deec1)},
                 {129, UINT64_C(0x5a26b734d908e474)},
                 {1000, UINT64_C(0xdaca53d8ba37dd82)}};
    unsigned char text[1000];
    (void)state;
    for (size_t i = 0; i < sizeof text; i++) text[i] = (unsigned char)(i * i);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        for (size_t piece = 1; piece < 300; piece += 42) {
            mw_blake2b hash = mw__blake2b();
            for (size_t k = 0; k < known[i].size; k += piece)
                mw__blake2b_add(&hash, text + k,
                                known[i].size - k < piece ? known[i].size - k : piece);
            assert_true(mw__blake2b_end(&hash) == known[i].digest);
        }
}

/* --- failures --------------------------------------------------------------------------------- */

static void expect_refused(const mw_locator *locator, const mw_tile_options *options,
                           mw_status status, const char *says)
{
    mw_error error;
    assert_int_equal(mw_write_tiles(locator, "refused", options, &error), status);
    assert_int_equal(error.status, status);
    assert_non_null(strstr(error.message, says));
    assert_int_equal(files_count(), 0);
}

static void test_refused(void **state)
{
    (void)state;
    mw_error error;
    tiled_mesh m = tiled_mesh_make(true);
    char name[] = "meshwalk:triangle", *names[] = {name};
    double numbers[8] = {0}, *fields[] = {numbers};
    mw_mesh_file values = {.point_count = 8,
                           .triangle_count = 8,
                           .triangle_field_names = names,
                           .triangle_fields = fields,
                           .triangle_field_count = 1};
    mw_tile_options options = {.values = &values};
    expect_refused(NULL, NULL, MW_ERROR_ARGUMENT, "NULL");
    expect_refused(m.locator, &options, MW_ERROR_INPUT, "which tiles need");
    values.point_count = 7;
    expect_refused(m.locator, &options, MW_ERROR_ARGUMENT, "the values have 7 vertices");
    options = (mw_tile_options){.tiles = 7};
    expect_refused(m.locator, &options, MW_ERROR_INPUT,
                   "7 tiles are more than the 6 triangles with an area");
    options = (mw_tile_options){.reserved = {1}};
    expect_refused(m.locator, &options, MW_ERROR_ARGUMENT, "reserved");
    assert_int_equal(mw_write_tiles(m.locator, "no/where", NULL, &error), MW_ERROR_SYSTEM);
    assert_non_null(strstr(error.message, "no/where: No such file"));
    assert_int_equal(mw_write_tiles(m.locator, "", NULL, &error), MW_ERROR_ARGUMENT);
    tiled_mesh_release(&m);
    m = tiled_mesh_make(false);
    mw_locator *open = mesh_locator(m.mesh, (mw_locator_options){.fill = MW_FILL_NO});
    expect_refused(open, NULL, MW_ERROR_ARGUMENT, "pockets and holes are not filled");
    mw_locator_destroy(open);
    tiled_mesh_release(&m);
}

/* Whichever allocation fails, the folder is there when the call succeeds, and only then. */
static void test_memory(void **state)
{
    (void)state;
    mw_error error;
    mw_status status;
    long k = 0;
    tiled_mesh m = tiled_mesh_make(true);
    const mw_tile_options options = {.tiles = 2, .threads = 1};
    do {
        allocations_left = k++;
        status = mw_write_tiles(m.locator, "memory", &options, &error);
        assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
        assert_int_equal(files_count(), status == MW_OK);
    } while (status && k < 1000);
    allocations_left = -1;
    assert_true(k > 50 && k < 1000);
    folder_remove("memory", 2);
    tiled_mesh_release(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts),    cmocka_unit_test(test_flat_triangles),
        cmocka_unit_test(test_index),    cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_checksum), cmocka_unit_test(test_refused),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
