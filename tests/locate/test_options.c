/* test_options.c - structures of options: every reserved byte is refused unless it is zero, cells
 * are bounded by the size of the mesh, and a cursor that is all zero answers by default. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/meshes.h"
#include "support/star_shapes.h"

#include <meshwalk/meshwalk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A plane mesh, and a star-shaped polyhedron, with everything that can be made of them. */
typedef struct things {
    arrays plane;
    star_shape shape;
    mw_mesh *mesh;
    mw_locator *locator;
    mw_surface *surface;
    mw_star *star;
    mw_prober *prober;
} things;

static things things_create(void)
{
    uint64_t random = 3;
    mw_error error;
    things all = {.plane = arrays_grid(4, 0, &random), .shape = star_shape_octahedron(1)};
    all.mesh = arrays_mesh(&all.plane, (mw_mesh_options){0});
    all.locator = mesh_locator(all.mesh, (mw_locator_options){0});
    mw_arrays view = star_shape_arrays(&all.shape);
    assert_int_equal(mw_surface_create(&view, NULL, &all.surface, &error), MW_OK);
    assert_int_equal(mw_star_create(all.surface, NULL, &all.star, &error), MW_OK);
    mw_prober_options boxes = {.boxes = 1};
    assert_int_equal(mw_prober_create(all.surface, &boxes, &all.prober, &error), MW_OK);
    return all;
}

static void things_release(things *all)
{
    mw_prober_destroy(all->prober);
    mw_star_destroy(all->star);
    mw_surface_destroy(all->surface);
    mw_locator_destroy(all->locator);
    mw_mesh_destroy(all->mesh);
    star_shape_free(&all->shape);
    arrays_free(&all->plane);
}

/* --- reserved members ------------------------------------------------------------------------- */

/* One function for each function that takes options: calls it, and releases what it made. */
#define TAKER(name, type, ...)                                                                     \
    static mw_status name(const things *all, const void *given, mw_error *error)                   \
    {                                                                                              \
        const type *options = given;                                                               \
        (void)all;                                                                                 \
        __VA_ARGS__                                                                                \
    }

TAKER(take_mesh, mw_mesh_options, {
    mw_mesh *out;
    mw_arrays view = arrays_view(&all->plane);
    mw_status status = mw_mesh_create(&view, options, &out, error);
    mw_mesh_destroy(out);
    return status;
})
TAKER(take_locator, mw_locator_options, {
    mw_locator *out;
    mw_status status = mw_locator_create(all->mesh, options, &out, error);
    mw_locator_destroy(out);
    return status;
})
TAKER(take_index, mw_index_options, {
    mw_index *out;
    mw_status status = mw_index_create(all->locator, MW_START_GRID, options, &out, error);
    mw_index_destroy(out);
    return status;
})
TAKER(take_query, mw_query_options, {
    mw_cursor out;
    return mw_cursor_init(all->locator, options, &out, error);
})
TAKER(take_batch, mw_query_options, {
    mw_location at;
    return mw_locate_batch(all->locator, (double[2]){1, 1}, 1, 0, options, &at, NULL, error);
})
TAKER(take_interpolation, mw_interpolate_options, {
    mw_location at = {.triangle = MW_NONE};
    double value = 0;
    mw_value_table table = {.values = all->plane.points, .count = 1};
    return mw_interpolate_table(all->mesh, &table, &at, 1, options, &value, error);
})
TAKER(take_editor, mw_editor_options, {
    mw_editor *out;
    mw_status status = mw_editor_create(all->mesh, options, &out, error);
    mw_editor_destroy(out);
    return status;
})
TAKER(take_surface, mw_surface_options, {
    mw_surface *out;
    mw_arrays view = star_shape_arrays(&all->shape);
    mw_status status = mw_surface_create(&view, options, &out, error);
    mw_surface_destroy(out);
    return status;
})
TAKER(take_star, mw_star_options, {
    mw_star *out;
    mw_status status = mw_star_create(all->surface, options, &out, error);
    mw_star_destroy(out);
    return status;
})
TAKER(take_star_update, mw_star_update_options, {
    mw_star *star;
    mw_star_create(all->surface, NULL, &star, NULL);
    mw_status status = mw_star_update(star, options, error);
    mw_star_destroy(star);
    return status;
})
TAKER(take_star_check, mw_star_options, {
    mw_check check;
    mw_arrays view = star_shape_arrays(&all->shape);
    mw_status status = mw_star_check_arrays(&view, 0, options, &check, error);
    if (!status) mw_check_release(&check);
    return status;
})
TAKER(take_star_index, mw_star_index_options, {
    mw_star_index *out;
    mw_status status = mw_star_index_create(all->star, MW_STAR_START_GRID, options, &out, error);
    mw_star_index_destroy(out);
    return status;
})
TAKER(take_star_query, mw_star_query_options, {
    mw_star_cursor out;
    return mw_star_cursor_init(all->star, options, &out, error);
})
TAKER(take_prober, mw_prober_options, {
    mw_prober *out;
    mw_status status = mw_prober_create(all->surface, options, &out, error);
    mw_prober_destroy(out);
    return status;
})
TAKER(take_probe, mw_probe_options, {
    mw_probe_cursor out;
    return mw_probe_cursor_init(all->prober, options, &out, error);
})
TAKER(take_delaunay, mw_delaunay_options, {
    mw_mesh *out;
    mw_status status = mw_delaunay(all->plane.points, 3, 2, options, NULL, NULL, &out, error);
    mw_mesh_destroy(out);
    return status;
})
TAKER(take_kind, mw_kind_options, {
    mw_mesh *out;
    mw_status status =
        mw_triangulate(MW_KIND_GREEDY, all->plane.points, 6, 2, options, NULL, NULL, &out, error);
    mw_mesh_destroy(out);
    return status;
})
TAKER(take_constrain, mw_constrain_options, {
    mw_mesh *out;
    mw_constraints none = {.points = all->plane.points, .point_count = 6};
    mw_status status = mw_constrained_delaunay(&none, options, NULL, NULL, NULL, &out, error);
    mw_mesh_destroy(out);
    return status;
})
TAKER(take_points, mw_point_reader_options, {
    mw_point_reader *out;
    mw_status status = mw_point_reader_open(MW_TEST_SOURCE "/data/trap.csv", options, &out, error);
    mw_point_reader_close(out);
    return status;
})
TAKER(take_edit_text, mw_edit_text_options, {
    mw_edit_line line;
    return mw_edit_parse("insert 1 2", options, &line, error);
})
TAKER(take_edit_reader, mw_edit_text_options, {
    mw_edit_reader *out;
    mw_status status = mw_edit_reader_open(MW_TEST_SOURCE "/data/trap.csv", options, &out, error);
    mw_edit_reader_close(out);
    return status;
})

typedef struct taker {
    mw_status (*take)(const things *all, const void *options, mw_error *error);
    const char *type;
    size_t first, bytes; /* of the reserved member */
} taker;

#define ROW(take, type)                                                                            \
    {                                                                                              \
        take, #type, offsetof(type, reserved), sizeof((type *)0)->reserved                         \
    }

static const taker takers[] = {
    ROW(take_mesh, mw_mesh_options),
    ROW(take_locator, mw_locator_options),
    ROW(take_index, mw_index_options),
    ROW(take_query, mw_query_options),
    ROW(take_batch, mw_query_options),
    ROW(take_interpolation, mw_interpolate_options),
    ROW(take_editor, mw_editor_options),
    ROW(take_surface, mw_surface_options),
    ROW(take_star, mw_star_options),
    ROW(take_star_update, mw_star_update_options),
    ROW(take_star_check, mw_star_options),
    ROW(take_star_index, mw_star_index_options),
    ROW(take_star_query, mw_star_query_options),
    ROW(take_prober, mw_prober_options),
    ROW(take_probe, mw_probe_options),
    ROW(take_delaunay, mw_delaunay_options),
    ROW(take_kind, mw_kind_options),
    ROW(take_constrain, mw_constrain_options),
    ROW(take_points, mw_point_reader_options),
    ROW(take_edit_text, mw_edit_text_options),
    ROW(take_edit_reader, mw_edit_text_options),
};

/* With all zero a function must not complain of the options; with any reserved byte set it must,
 * and name the structure. */
static void test_reserved_is_refused(void **state)
{
    (void)state;
    things all = things_create();
    for (size_t i = 0; i < sizeof takers / sizeof *takers; i++) {
        const taker *t = &takers[i];
        _Alignas(16) unsigned char options[1024] = {0};
        mw_error error;
        assert_true(t->first + t->bytes <= sizeof options);
        assert_int_not_equal(t->take(&all, options, &error), MW_ERROR_ARGUMENT);
        for (size_t byte = 0; byte < t->bytes; byte++) {
            options[t->first + byte] = 1;
            assert_int_equal(t->take(&all, options, &error), MW_ERROR_ARGUMENT);
            assert_non_null(strstr(error.message, t->type));
            options[t->first + byte] = 0;
        }
    }
    things_release(&all);
}

/* --- cells ------------------------------------------------------------------------------------ */

static void test_cells_are_bounded(void **state)
{
    (void)state;
    things all = things_create();
    static const mw_start_kind starts[] = {MW_START_GRID, MW_START_TWO_LEVEL_GRID, MW_START_CURVE};
    mw_index_options options = {.cells = UINT32_C(1) << 30};
    mw_error error;
    for (size_t i = 0; i < 3; i++) {
        mw_index *index;
        mw_index_info info;
        assert_int_equal(mw_index_create(all.locator, starts[i], &options, &index, &error), MW_OK);
        mw_index_describe(index, &info);
        assert_true(info.cells > 0 && info.cells <= 2 * 65536);
        mw_index_destroy(index);
    }
    for (int start = 0; start < MW_STAR_START_COUNT; start++) {
        if (!mw_star_start_has_index((mw_star_start_kind)start)) continue;
        mw_star_index *index;
        mw_star_index_info info;
        mw_star_index_options most = {.cells = UINT32_C(1) << 30, .levels = MW_STAR_MAX_LEVELS + 1};
        assert_int_equal(
            mw_star_index_create(all.star, (mw_star_start_kind)start, &most, &index, &error),
            MW_OK);
        mw_star_index_describe(index, &info);
        assert_true(info.cells > 0 && info.cells <= 65536);
        mw_star_index_destroy(index);
    }
    things_release(&all);
}

/* --- cursors that are all zero ---------------------------------------------------------------- */

static void expect_same_location(const mw_location *a, const mw_location *b)
{
    assert_int_equal(a->triangle, b->triangle);
    assert_int_equal(a->where, b->where);
    assert_int_equal(a->local, b->local);
}

static void test_zeroed_cursor_in_the_plane(void **state)
{
    (void)state;
    things all = things_create();
    mw_editor *editor;
    mw_error error;
    assert_int_equal(mw_editor_create(all.mesh, NULL, &editor, &error), MW_OK);
    const mw_locator *locators[] = {all.locator, mw_editor_locator(editor)};
    for (size_t i = 0; i < 2; i++) {
        mw_cursor zero = {0}, path = {0}, made;
        assert_int_equal(mw_cursor_init(locators[i], NULL, &made, &error), MW_OK);
        for (int k = 0; k < 50; k++) {
            double x = k % 10 * 0.5 - 0.5, y = k / 10 * 0.77 - 0.3;
            mw_location want = mw_locate(locators[i], &made, x, y), walked;
            mw_location got = mw_locate(locators[i], &zero, x, y);
            expect_same_location(&want, &got);
            uint32_t triangles[64];
            mw_walk_path(locators[i], &path, x, y, triangles, 64, &walked);
            expect_same_location(&want, &walked);
            if (i && k % 7 == 3)
                assert_int_equal(mw_edit_insert(editor, 0.3 + 0.05 * k, 1.1, NULL, &error), MW_OK);
        }
    }
    mw_editor_destroy(editor);
    things_release(&all);
}

static void test_zeroed_cursor_in_space(void **state)
{
    (void)state;
    things all = things_create();
    mw_star_cursor star = {0}, star_made;
    mw_probe_cursor probe = {0}, probe_made;
    mw_error error;
    assert_int_equal(mw_star_cursor_init(all.star, NULL, &star_made, &error), MW_OK);
    assert_int_equal(mw_probe_cursor_init(all.prober, NULL, &probe_made, &error), MW_OK);
    for (int k = 0; k < 60; k++) {
        double ray[3] = {k % 4 - 1.4, k % 5 - 1.7, k % 7 - 2.9}, centre[3] = {0, 0, 0};
        mw_location want = mw_star_locate(all.star, &star_made, ray);
        mw_location got = mw_star_locate(all.star, &star, ray);
        expect_same_location(&want, &got);
        mw_touch first = mw_probe(all.prober, &probe_made, centre, ray);
        mw_touch second = mw_probe(all.prober, &probe, centre, ray);
        assert_int_equal(first.state, MW_TOUCH_HIT);
        assert_int_equal(second.state, MW_TOUCH_HIT);
    }
    things_release(&all);
}

/* --- sizes of samples ------------------------------------------------------------------------- */

/* The printed sizes of Appendix D, Table 1, and twice the fourth root; never more than triangles.
 */
static void test_sample_sizes(void **state)
{
    (void)state;
    static const uint32_t printed[][3] = {{4897, 17, 17},  {13829, 24, 22}, {15819, 25, 22},
                                          {19993, 27, 24}, {41851, 35, 29}, {3, 1, 1}};
    uint64_t random = 61;
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++) {
        double *points = malloc(2 * printed[i][0] * sizeof *points);
        mw_mesh *mesh;
        mw_error error;
        mw_cursor cursor;
        for (uint32_t k = 0; k < 2 * printed[i][0]; k++) points[k] = random_unit(&random);
        assert_int_equal(mw_delaunay(points, printed[i][0], 2, NULL, NULL, NULL, &mesh, &error),
                         MW_OK);
        mw_locator *locator = mesh_locator(mesh, (mw_locator_options){0});
        mw_query_options options = {.start = MW_START_SAMPLE,
                                    .samples = MW_SAMPLE_CUBE_ROOT_OF_VERTICES};
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, &error), MW_OK);
        assert_int_equal(cursor.sample, printed[i][1]);
        options.samples = MW_SAMPLE_FOURTH_ROOT_OF_VERTICES;
        assert_int_equal(mw_cursor_init(locator, &options, &cursor, &error), MW_OK);
        assert_int_equal(cursor.sample, printed[i][2]);
        mw_locator_destroy(locator);
        mw_mesh_destroy(mesh);
        free(points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reserved_is_refused),
        cmocka_unit_test(test_cells_are_bounded),
        cmocka_unit_test(test_zeroed_cursor_in_the_plane),
        cmocka_unit_test(test_zeroed_cursor_in_space),
        cmocka_unit_test(test_sample_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
