/* test_prepared.c - prepared files: answers are those of the locator that was written, bit for bit,
 * and a file that was changed is refused. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/allocations.h"
#include "support/files.h"
#include "support/meshes.h"
#include "oracle/prepared/prepared_bytes.h"
#include "support/start_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* wrap: malloc calloc realloc aligned_alloc */

/* --- meshes ----------------------------------------------------------------------------------- */

/* A triangle with a vertex inside an edge, and a flat triangle beside it: it is cut. */
static arrays arrays_cut(void)
{
    arrays a = arrays_make(5, 4);
    arrays_point(&a, 0, 0);
    arrays_point(&a, 4, 0);
    arrays_point(&a, 2, 3);
    arrays_point(&a, 2, 0);
    arrays_point(&a, 2, -3);
    arrays_triangle(&a, 0, 1, 2);
    arrays_triangle(&a, 0, 3, 1);
    arrays_triangle(&a, 0, 4, 3);
    arrays_triangle(&a, 4, 1, 3);
    return a;
}

/* Most points crowd at one place. */
static arrays arrays_crowded(uint32_t n, uint64_t *random)
{
    double *points = malloc(2 * (size_t)n * sizeof *points);
    assert_non_null(points);
    for (uint32_t i = 0; i < n; i++) {
        double scale = i % 10 == 0 ? 1 : 1e-4;
        points[2 * i] = scale * random_unit(random);
        points[2 * i + 1] = scale * random_unit(random);
    }
    mw_mesh *mesh = mesh_delaunay(points, n);
    arrays a = arrays_of_mesh(mesh);
    mw_mesh_destroy(mesh);
    free(points);
    return a;
}

/* Columns ever nearer to each other: no grid leads near. */
static arrays arrays_strip(uint32_t steps)
{
    arrays a = arrays_make(2 * steps + 2, 2 * steps);
    for (uint32_t i = 0; i <= steps; i++)
        for (int y = 0; y < 2; y++) arrays_point(&a, exp2(1000 - 2000.0 * i / steps), y);
    for (uint32_t i = 0; i < 2 * steps; i += 2) {
        arrays_triangle(&a, i, i + 1, i + 2);
        arrays_triangle(&a, i + 2, i + 1, i + 3);
    }
    return a;
}

enum { PLAIN, LAID_OUT, HOLES, CUT, STRIP, CROWDED, SMALL, SHAPE_COUNT };

static arrays shape_of(int which, uint64_t *random)
{
    arrays a;
    switch (which) {
    case PLAIN: return arrays_grid(12, 0.5, random);
    case CUT: return arrays_cut();
    case STRIP: return arrays_strip(300);
    case CROWDED: return arrays_crowded(3000, random);
    case SMALL: return arrays_grid(2, 0, random);
    default: break;
    }
    a = arrays_grid(which == HOLES ? 14 : 40, which == HOLES ? 0 : 0.5, random);
    if (which == HOLES) arrays_punch(&a, 0.3, random);
    arrays_scramble(&a, 1, random);
    return a;
}

typedef struct prepared_case {
    arrays given;
    mw_mesh *mesh;
    mw_locator *locator;
} prepared_case;

static prepared_case case_make(int which, int border, uint64_t *random)
{
    prepared_case c = {.given = shape_of(which, random)};
    c.mesh = arrays_mesh(&c.given, (mw_mesh_options){.layout = which == LAID_OUT ? MW_LAYOUT_HILBERT
                                                                                 : MW_LAYOUT_AUTO});
    c.locator = mesh_locator(c.mesh, (mw_locator_options){.border = border});
    return c;
}

static void case_release(prepared_case *c)
{
    mw_locator_destroy(c->locator);
    mw_mesh_destroy(c->mesh);
    arrays_free(&c->given);
}

static void case_write(const prepared_case *c, const char *path)
{
    mw_error error;
    expect_ok(mw_write_prepared(c->locator, path, NULL, &error), path, &error);
}

static mw_prepared *map_file(const char *path, int trust)
{
    mw_error error;
    mw_prepared *p;
    mw_map_options options = {.trust = trust, .threads = trust ? 1 : 3};
    expect_ok(mw_mesh_map(path, &options, &p, &error), path, &error);
    return p;
}

/* --- answers ---------------------------------------------------------------------------------- */

static void expect_same_mesh(const mw_mesh *a, const mw_mesh *b)
{
    assert_int_equal(mw_mesh_vertex_count(a), mw_mesh_vertex_count(b));
    assert_int_equal(mw_mesh_triangle_count(a), mw_mesh_triangle_count(b));
    for (uint32_t v = 0; v < mw_mesh_vertex_count(a); v++) {
        double p[2], q[2];
        mw_mesh_vertex(a, v, p);
        mw_mesh_vertex(b, v, q);
        assert_memory_equal(p, q, sizeof p);
    }
    for (uint32_t t = 0; t < mw_mesh_triangle_count(a); t++) {
        uint32_t u[3], v[3];
        mw_mesh_triangle(a, t, u);
        mw_mesh_triangle(b, t, v);
        assert_memory_equal(u, v, sizeof u);
        for (unsigned k = 0; k < 3; k++)
            assert_int_equal(mw_mesh_neighbour(a, t, k, NULL), mw_mesh_neighbour(b, t, k, NULL));
    }
}

/* One at a time and as a batch; the tests that walks make are the same, too. */
static void expect_same_answers(const mw_locator *a, const mw_locator *b,
                                const mw_query_options *options, const double *q, size_t n)
{
    mw_location *one = malloc(n * sizeof *one), *other = malloc(n * sizeof *other);
    mw_counters counts[2] = {{0}};
    mw_cursor cursor[2];
    assert_non_null(one);
    assert_non_null(other);
    assert_int_equal(mw_locate_batch(a, q, n, 0, options, one, &counts[0], NULL), MW_OK);
    assert_int_equal(mw_locate_batch(b, q, n, 0, options, other, &counts[1], NULL), MW_OK);
    assert_memory_equal(one, other, n * sizeof *one);
    assert_memory_equal(&counts[0], &counts[1], sizeof counts[0]);
    assert_int_equal(mw_cursor_init(a, options, &cursor[0], NULL), MW_OK);
    assert_int_equal(mw_cursor_init(b, options, &cursor[1], NULL), MW_OK);
    for (size_t i = 0; i < n; i++) {
        one[0] = mw_locate(a, &cursor[0], q[2 * i], q[2 * i + 1]);
        other[0] = mw_locate(b, &cursor[1], q[2 * i], q[2 * i + 1]);
        assert_memory_equal(one, other, sizeof *one);
    }
    free(one);
    free(other);
}

static void expect_same_border(const mw_locator *a, const mw_locator *b, const double *q, size_t n)
{
    const mw_query_options near = {.tolerance = 0.25};
    expect_same_answers(a, b, &near, q, n);
    for (size_t i = 0; i < n; i++) {
        mw_nearest_border_point one = {0}, other = {0};
        mw_status status = mw_nearest_border(a, q[2 * i], q[2 * i + 1], &one, NULL);
        assert_int_equal(mw_nearest_border(b, q[2 * i], q[2 * i + 1], &other, NULL), status);
        assert_memory_equal(&one, &other, sizeof one);
    }
}

static void expect_same_locator(const prepared_case *c, const mw_locator *mapped, int border,
                                uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(&c->given, 12, &n, random);
    mw_index *index[2][MW_START_COUNT];
    for (int walk = 0; walk < MW_WALK_COUNT; walk++)
        expect_same_answers(c->locator, mapped,
                            &(mw_query_options){.walk = (mw_walk_kind)walk, .counters = walk % 2},
                            q, n);
    starts_open(c->locator, index[0]);
    starts_open(mapped, index[1]);
    for (int start = 0; start < MW_START_COUNT; start++) {
        mw_query_options options = {.start = (mw_start_kind)start, .index = index[0][start]};
        expect_same_answers(c->locator, mapped, &options, q, n);
        options.index = index[1][start];
        options.counters = 1;
        expect_same_answers(c->locator, mapped, &options, q, n);
    }
    starts_close(index[0]);
    starts_close(index[1]);
    if (border) expect_same_border(c->locator, mapped, q, n);
    free(q);
}

static void test_answers(void **state)
{
    uint64_t random = 1;
    uint32_t guides = 0;
    (void)state;
    for (int which = 0; which < SHAPE_COUNT; which++)
        for (int how = 0; how < 4; how++) {
            const int trust = how & 1, border = how >> 1;
            prepared_case c = case_make(which, border, &random);
            case_write(&c, "case.mwm");
            mw_prepared *p = map_file("case.mwm", trust);
            mw_prepared_info info;
            mw_locator_info one, other;
            mw_prepared_describe(p, &info);
            assert_int_equal(info.version, 1);
            assert_int_equal(info.border, border);
            assert_int_equal(info.trusted, trust);
            mw_locator_describe(c.locator, &one);
            mw_locator_describe(mw_prepared_locator(p), &other);
            assert_int_equal(one.bytes, other.bytes);
            assert_int_equal(one.guide, other.guide);
            assert_int_equal(one.holes, other.holes);
            assert_int_equal(one.copied, other.copied);
            guides |= 1u << one.guide;
            expect_same_mesh(c.mesh, mw_prepared_mesh(p));
            expect_same_locator(&c, mw_prepared_locator(p), border, &random);
            mw_prepared_close(p);
            case_release(&c);
        }
    /* every guide was there */
    assert_int_equal(guides, 1u << MW_START_GRID | 1u << MW_START_CURVE | 1u << MW_START_CHAINS);
    files_clear();
}

/* A triangulation as it is made does not know its border. */
static void test_triangulation(void **state)
{
    enum { POINTS = 300 };
    uint64_t random = 7;
    double points[2 * POINTS];
    (void)state;
    for (int i = 0; i < 2 * POINTS; i++) points[i] = random_unit(&random);
    prepared_case c = {.mesh = mesh_delaunay(points, POINTS)};
    c.given = arrays_of_mesh(c.mesh);
    c.locator = mesh_locator(c.mesh, (mw_locator_options){0});
    case_write(&c, "case.mwm");
    mw_prepared *p = map_file("case.mwm", 0);
    expect_same_locator(&c, mw_prepared_locator(p), 0, &random);
    mw_prepared_close(p);
    case_release(&c);
    files_clear();
}

/* --- what is kept beside the mesh ------------------------------------------------------------- */

static void test_values(void **state)
{
    double points[] = {0, 0, 5, 4, 0, 6, 4, 4, 7, 0, 4, 8}, depth[] = {1, 2, NAN, 4},
           soil[] = {10, 20}, *fields[] = {depth}, *triangle_fields[] = {soil};
    uint32_t triangles[] = {0, 1, 2, 0, 2, 3}, faces[] = {0, 0};
    char depth_name[] = "depth", soil_name[] = "soil", mark[] = "open 1", crs[] = "EPSG:2056",
         *names[] = {depth_name}, *triangle_names[] = {soil_name}, *marks[] = {mark};
    mw_marked_edge edges[] = {{{0, 1}, 0}};
    const mw_mesh_file given = {.points = points,
                                .triangles = triangles,
                                .point_count = 4,
                                .triangle_count = 2,
                                .has_z = 1,
                                .field_names = names,
                                .fields = fields,
                                .field_count = 1,
                                .crs = crs,
                                .faces = faces,
                                .face_count = 1,
                                .first_number = 1,
                                .step_count = 3,
                                .triangle_field_names = triangle_names,
                                .triangle_fields = triangle_fields,
                                .triangle_field_count = 1,
                                .edges = edges,
                                .edge_count = 1,
                                .mark_names = marks,
                                .mark_count = 1};
    const mw_arrays view = mw_mesh_file_arrays(&given);
    mw_error error;
    mw_mesh *mesh;
    mw_mesh_file read;
    (void)state;
    expect_ok(mw_mesh_create(&view, NULL, &mesh, &error), "mesh", &error);
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
    expect_ok(
        mw_write_prepared(locator, "values.mwm", &(mw_prepare_options){.values = &given}, &error),
        "write", &error);
    size_t size;
    char *whole = files_read("values.mwm", &size);
    files_write_gzip("packed", (bytes){whole, size});
    free(whole);
    for (int packed = 0; packed < 2; packed++) {
        expect_ok(mw_read_mesh(packed ? "packed" : "values.mwm", NULL, &read, &error), "read",
                  &error);
        assert_memory_equal(read.points, points, sizeof points);
        assert_memory_equal(read.triangles, triangles, sizeof triangles);
        assert_int_equal(read.has_z, 1);
        assert_int_equal(read.field_count, 1);
        assert_string_equal(read.field_names[0], "depth");
        assert_memory_equal(read.fields[0], depth, sizeof depth);
        assert_int_equal(read.triangle_field_count, 1);
        assert_string_equal(read.triangle_field_names[0], "soil");
        assert_memory_equal(read.triangle_fields[0], soil, sizeof soil);
        assert_memory_equal(read.faces, faces, sizeof faces);
        assert_int_equal(read.face_count, 1);
        assert_int_equal(read.first_number, 1);
        assert_int_equal(read.step_count, 3);
        assert_string_equal(read.crs, "EPSG:2056");
        assert_memory_equal(read.edges, edges, sizeof edges);
        assert_string_equal(read.mark_names[0], "open 1");
        mw_mesh_file_release(&read);
    }

    /* fields of a map may be set, which changes neither the file nor another map */
    mw_prepared *p = map_file("values.mwm", 1), *other = map_file("values.mwm", 0);
    assert_memory_equal(mw_mesh_field(mw_prepared_mesh(p), "depth"), depth, sizeof depth);
    assert_true(mw_mesh_field(mw_prepared_mesh(p), "z")[3] == 8);
    expect_ok(mw_mesh_set_field(mw_prepared_mesh(p), "depth", points, 3, &error), "set", &error);
    expect_ok(mw_mesh_set_field(mw_prepared_mesh(p), "more", points, 3, &error), "set", &error);
    assert_true(mw_mesh_field(mw_prepared_mesh(p), "depth")[1] == 4);
    assert_memory_equal(mw_mesh_field(mw_prepared_mesh(other), "depth"), depth, sizeof depth);
    assert_null(mw_mesh_field(mw_prepared_mesh(other), "more"));
    assert_string_equal(mw_prepared_values(p)->crs, "EPSG:2056");
    mw_prepared_close(p);
    mw_prepared_close(other);

    /* without values: the fields of the mesh */
    expect_ok(mw_mesh_set_field(mesh, "soil", depth, 1, &error), "set", &error);
    expect_ok(mw_write_prepared(locator, "values.mwm", NULL, &error), "write", &error);
    p = map_file("values.mwm", 0);
    assert_memory_equal(mw_mesh_field(mw_prepared_mesh(p), "soil"), depth, sizeof depth);
    assert_null(mw_prepared_values(p)->crs);
    mw_prepared_close(p);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    files_clear();
}

/* --- refusals --------------------------------------------------------------------------------- */

static void expect_refused(const mw_locator *locator, const mw_prepare_options *options,
                           mw_status status, const char *says)
{
    mw_error error = {0};
    assert_int_equal(mw_write_prepared(locator, "no.mwm", options, &error), status);
    files_expect_error(&error, status, -1, says);
    assert_false(files_exists("no.mwm"));
}

static void test_refused_locators(void **state)
{
    uint64_t random = 2;
    mw_editor *editor;
    mw_error error;
    arrays trap = arrays_make(4, 2);
    (void)state;
    prepared_case c = case_make(HOLES, 0, &random);
    mw_locator *open = mesh_locator(c.mesh, (mw_locator_options){.fill = MW_FILL_NO});
    expect_refused(open, NULL, MW_ERROR_ARGUMENT, "its pockets and holes are not filled");
    mw_locator_destroy(open);
    const mw_mesh_file others = {.point_count = 3, .triangle_count = 1};
    expect_refused(c.locator, &(mw_prepare_options){.values = &others}, MW_ERROR_ARGUMENT,
                   "the values have 3 vertices and 1 triangles");
    expect_refused(c.locator, &(mw_prepare_options){.reserved = {1}}, MW_ERROR_ARGUMENT,
                   "reserved");
    expect_refused(NULL, NULL, MW_ERROR_ARGUMENT, "NULL");
    expect_ok(mw_editor_create(c.mesh, NULL, &editor, &error), "editor", &error);
    expect_refused(mw_editor_locator(editor), NULL, MW_ERROR_ARGUMENT, "its mesh is edited");
    mw_editor_destroy(editor);
    case_release(&c);

    /* two triangles that overlap */
    arrays_point(&trap, 0, 0);
    arrays_point(&trap, 4, 0);
    arrays_point(&trap, 2, 3);
    arrays_point(&trap, 2, 2);
    arrays_triangle(&trap, 0, 1, 2);
    arrays_triangle(&trap, 0, 1, 3);
    mw_mesh *mesh = arrays_mesh(&trap, (mw_mesh_options){0});
    mw_locator *locator = mesh_locator(mesh, (mw_locator_options){.any = 1});
    expect_refused(locator, NULL, MW_ERROR_ARGUMENT, "not an embedding");
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    arrays_free(&trap);
}

static void expect_unmappable(const char *path, mw_status status, const char *says)
{
    mw_error error = {0};
    for (int trust = 0; trust < 2; trust++) {
        mw_prepared *p = (mw_prepared *)&error;
        assert_int_equal(mw_mesh_map(path, &(mw_map_options){.trust = trust}, &p, &error), status);
        files_expect_error(&error, status, -1, says);
        assert_null(p);
    }
}

static void test_other_files(void **state)
{
    uint64_t random = 3;
    size_t size;
    mw_prepared *p;
    (void)state;
    prepared_case c = case_make(SMALL, 1, &random);
    case_write(&c, "small.mwm");
    char *whole = files_read("small.mwm", &size);
    assert_non_null(whole);
    files_write("other", (bytes){whole, size});
    assert_true(mw_prepared_known("other"));
    const uint32_t version = 2, order = UINT32_C(0x04030201);
    memcpy(whole + offsetof(mw_prepared_header, version), &version, 4);
    files_write("version.mwm", (bytes){whole, size});
    expect_unmappable("version.mwm", MW_ERROR_INPUT, "format version 2");
    memcpy(whole + offsetof(mw_prepared_header, order), &order, 4);
    files_write("order.mwm", (bytes){whole, size});
    expect_unmappable("order.mwm", MW_ERROR_INPUT, "byte order of another machine");
    files_write_text("text.mwm", "OFF\n3 1 0\n");
    expect_unmappable("text.mwm", MW_ERROR_INPUT, "not a prepared mesh");
    files_write_text("empty.mwm", "");
    expect_unmappable("empty.mwm", MW_ERROR_INPUT, "not a prepared mesh");
    expect_unmappable("none.mwm", MW_ERROR_SYSTEM, "none.mwm");
    expect_unmappable("/dev/null", MW_ERROR_INPUT, "only a file can be mapped");
    assert_false(mw_prepared_known("text.mwm") || mw_prepared_known("none.mwm") ||
                 mw_prepared_known("-") || mw_prepared_known(NULL));
    assert_int_equal(mw_mesh_map(NULL, NULL, &p, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_map("other", NULL, NULL, NULL), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_mesh_map("other", &(mw_map_options){.reserved = {0, 1}}, &p, NULL),
                     MW_ERROR_ARGUMENT);
    free(whole);
    case_release(&c);
    files_clear();
}

/* A prepared file in memory, at a multiple of MW_PREPARED_ALIGN. */
typedef struct file_image {
    unsigned char *bytes;
    size_t size;
} file_image;

static file_image image_make(int which, uint64_t *random)
{
    prepared_case c = case_make(which, 1, random);
    file_image image;
    case_write(&c, "image.mwm");
    char *whole = files_read("image.mwm", &image.size);
    image.bytes = mw__alloc_lines(image.size, 1);
    assert_non_null(image.bytes);
    memcpy(image.bytes, whole, image.size);
    free(whole);
    case_release(&c);
    files_clear();
    return image;
}

/* Refused with a message, or right. */
static bool image_is_refused(const unsigned char *image, size_t size)
{
    mw_error error = {0};
    mw_prepared p = {0};
    mw_status status = mw__prepared_open(&p, "i.mwm", image, size, false, MW_ALONE, &error);
    if (status) {
        assert_int_equal(status, MW_ERROR_INPUT);
        assert_memory_equal(error.message, "i.mwm: ", 7);
    } else {
        assert_true(prepared_bytes_query(&p));
    }
    mw__prepared_release(&p);
    return status != MW_OK;
}

/* Every byte of a file changed in every bit, and every length. */
static void test_damage(void **state)
{
    uint64_t random = 4;
    (void)state;
    file_image image = image_make(SMALL, &random);
    assert_false(image_is_refused(image.bytes, image.size));
    for (size_t i = 0; i < image.size; i++)
        for (int bit = 0; bit < 8; bit++) {
            image.bytes[i] ^= (unsigned char)(1 << bit);
            assert_true(image_is_refused(image.bytes, image.size));
            image.bytes[i] ^= (unsigned char)(1 << bit);
        }
    for (size_t size = 0; size < image.size; size++)
        assert_true(image_is_refused(image.bytes, size));
    free(image.bytes);
}

/* Numbers that someone chose to do harm. */
static uint32_t number_to_harm(uint32_t was, int which)
{
    static const uint32_t plain[] = {0, 1, 3, 7, 64, UINT32_MAX, UINT32_C(1) << 31, 1 << 30};
    enum { PLAIN_COUNT = sizeof plain / sizeof *plain };
    if (which < PLAIN_COUNT) return plain[which];
    const uint32_t near[] = {was + 1, was - 1, was + 4, was - 4, was ^ 2, was * 2, was << 16};
    return near[which - PLAIN_COUNT];
}

/* Every number of a file replaced, with right checksums: refused, or every query has its answer. */
static void test_malice(void **state)
{
    static const int shapes[] = {SMALL, CUT, HOLES, STRIP, CROWDED};
    enum { KINDS = 15, MOST = 120 };
    uint64_t random = 5;
    uint32_t taken = 0, refused = 0;
    (void)state;
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        file_image image = image_make(shapes[s], &random);
        unsigned char *header = malloc(sizeof(mw_prepared_header));
        const size_t words = image.size / 4, stride = words / MOST + 1;
        assert_non_null(header);
        memcpy(header, image.bytes, sizeof(mw_prepared_header));
        for (size_t i = mw__random_below(&random, (uint32_t)stride); i < words; i += stride) {
            uint32_t was, now;
            memcpy(&was, image.bytes + 4 * i, 4);
            now = number_to_harm(was, (int)mw__random_below(&random, KINDS));
            memcpy(image.bytes + 4 * i, &now, 4);
            prepared_bytes_repair(image.bytes, image.size);
            if (image_is_refused(image.bytes, image.size))
                refused++;
            else
                taken++;
            memcpy(image.bytes + 4 * i, &was, 4);
            memcpy(image.bytes, header, sizeof(mw_prepared_header));
        }
        free(header);
        free(image.bytes);
    }
    /* values and most of a guide may be anything */
    assert_true(refused > 100 && taken > 50);
}

/* The file of version 1 that is kept: every later version maps it, on machines of its order of
 * bytes; others refuse it. */
static void test_version_1(void **state)
{
    mw_error error;
    mw_prepared *p;
    mw_cursor cursor = {0};
    (void)state;
    mw_status status =
        mw_mesh_map(MW_TEST_SOURCE "/tests/prepared/version_1.mwm", NULL, &p, &error);
    if (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {
        assert_int_equal(status, MW_ERROR_INPUT);
        assert_non_null(strstr(error.message, "byte order of another machine"));
        return;
    }
    expect_ok(status, "version 1", &error);
    assert_int_equal(mw_mesh_triangle_count(mw_prepared_mesh(p)), 16);
    mw_location at = mw_locate(mw_prepared_locator(p), &cursor, 0.5, 0.25);
    assert_int_equal(at.triangle, 0);
    assert_int_equal(at.where, MW_INSIDE);
    at = mw_locate(mw_prepared_locator(p), &cursor, 2.5, 2.5);
    assert_int_equal(at.where, MW_IN_HOLE);
    double height;
    at = mw_locate(mw_prepared_locator(p), &cursor, 4, 5);
    mw_interpolate(mw_prepared_mesh(p), mw_mesh_field(mw_prepared_mesh(p), "z"), &at, 1, &height);
    assert_true(height == 4 + 10 * 5);
    assert_true(prepared_bytes_query(p));
    mw_prepared_close(p);
}

/* --- memory ----------------------------------------------------------------------------------- */

static void test_memory(void **state)
{
    uint64_t random = 6;
    (void)state;
    prepared_case c = case_make(HOLES, 1, &random);
    mw_error error;
    mw_prepared *p;
    mw_mesh_file file;
    double heights[15 * 15] = {0};
    expect_ok(mw_mesh_set_field(c.mesh, "z", heights, 1, &error), "set", &error);
    mw_status status;
    long k = 0;
    do {
        allocations_left = k++;
        status = mw_write_prepared(c.locator, "memory.mwm", NULL, &error);
        assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
        assert_int_equal(files_exists("memory.mwm"), status == MW_OK);
    } while (status && k < 100);
    allocations_left = -1;
    assert_true(k > 3 && k < 100);
    k = 0;
    do {
        allocations_left = k++;
        status = mw_mesh_map("memory.mwm", &(mw_map_options){.threads = 1}, &p, &error);
        assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
    } while (status && k < 100);
    allocations_left = -1;
    assert_true(k > 3 && k < 100);
    mw_prepared_close(p);
    k = 0;
    do {
        allocations_left = k++;
        status = mw_read_mesh("memory.mwm", NULL, &file, &error);
        assert_true(status == MW_OK || status == MW_ERROR_MEMORY);
    } while (status && k < 100);
    allocations_left = -1;
    assert_true(k > 10 && k < 100);
    mw_mesh_file_release(&file);
    case_release(&c);
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_answers),     cmocka_unit_test(test_triangulation),
        cmocka_unit_test(test_values),      cmocka_unit_test(test_refused_locators),
        cmocka_unit_test(test_other_files), cmocka_unit_test(test_damage),
        cmocka_unit_test(test_malice),      cmocka_unit_test(test_version_1),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
