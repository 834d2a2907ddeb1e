/* test_bytes.c - the memory that objects tell is the memory that they hold: every allocation is
 * counted, from before an object is made until it is destroyed. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/calls/call_inputs.h"
#include "support/start_list.h"

#include <malloc.h>
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>

/* wrap: malloc calloc realloc aligned_alloc free */

/* --- what is allocated ------------------------------------------------------------------------ */

static size_t live_bytes, live_count;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);

static void *live_add(void *memory)
{
    if (memory) {
        __atomic_add_fetch(&live_bytes, malloc_usable_size(memory), __ATOMIC_RELAXED);
        __atomic_add_fetch(&live_count, 1, __ATOMIC_RELAXED);
    }
    return memory;
}

static void live_drop(void *memory)
{
    if (!memory) return;
    __atomic_sub_fetch(&live_bytes, malloc_usable_size(memory), __ATOMIC_RELAXED);
    __atomic_sub_fetch(&live_count, 1, __ATOMIC_RELAXED);
}

void *__wrap_malloc(size_t size)
{
    return live_add(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return live_add(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size)
{
    live_drop(old);
    void *memory = __real_realloc(old, size);
    live_add(memory ? memory : old);
    return memory;
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return live_add(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *memory)
{
    live_drop(memory);
    __real_free(memory);
}

/* --- what is told ----------------------------------------------------------------------------- */

typedef struct bytes_mark {
    size_t bytes, count;
} bytes_mark;

static bytes_mark bytes_now(void)
{
    return (bytes_mark){live_bytes, live_count};
}

/* An array that begins at a line of the cache takes up to a line more, and the allocator may give
 * some bytes more than it is asked for. */
enum { MORE = 88 };

static void expect_bytes(const char *what, bytes_mark before, size_t told)
{
    const size_t held = live_bytes - before.bytes, count = live_count - before.count;
    if (told > held || held - told > MORE * count)
        fail_msg("%s: tells %zu bytes, and holds %zu in %zu allocations", what, told, held, count);
}

static void expect_none(const char *what, bytes_mark before)
{
    if (live_bytes != before.bytes || live_count != before.count)
        fail_msg("%s: %zd bytes are left in %zd allocations", what,
                 (ssize_t)(live_bytes - before.bytes), (ssize_t)(live_count - before.count));
}

static void expect_status(mw_status status, const mw_error *error)
{
    if (status) fail_msg("%s", error->message);
}

static call_inputs in;

static int make_inputs(void **state)
{
    (void)state;
    mallopt(M_MMAP_MAX, 0); /* mapped memory would be rounded up to pages */
    in = call_inputs_make(3000, 5);
    return 0;
}

static int release_inputs(void **state)
{
    (void)state;
    call_inputs_release(&in);
    return 0;
}

/* --- in the plane ----------------------------------------------------------------------------- */

static void check_mesh(const char *what, const arrays *a, mw_mesh_options options)
{
    mw_mesh *mesh;
    mw_error error;
    const bytes_mark before = bytes_now();
    const mw_arrays view = arrays_view(a);
    double *values = __real_calloc(a->point_count, sizeof *values);
    expect_status(mw_mesh_create(&view, &options, &mesh, &error), &error);
    expect_bytes(what, before, mw_mesh_bytes(mesh));
    expect_status(mw_mesh_set_field(mesh, "height", values, 0, &error), &error);
    expect_status(mw_mesh_set_field(mesh, "depth", values, 0, &error), &error);
    expect_bytes("with two fields", before, mw_mesh_bytes(mesh));
    mw_mesh_destroy(mesh);
    __real_free(values);
    expect_none(what, before);
}

static void test_meshes(void **state)
{
    (void)state;
    check_mesh("mesh laid out", &in.plain, (mw_mesh_options){.layout = MW_LAYOUT_HILBERT});
    check_mesh("mesh as given", &in.plain, (mw_mesh_options){.layout = MW_LAYOUT_AS_GIVEN});
    check_mesh("mesh as the library likes", &in.whole, (mw_mesh_options){0});
}

static void check_locator(const char *what, const mw_mesh *mesh, mw_locator_options options)
{
    mw_locator *locator;
    mw_locator_info info;
    mw_error error;
    const bytes_mark before = bytes_now();
    expect_status(mw_locator_create(mesh, &options, &locator, &error), &error);
    mw_locator_describe(locator, &info);
    expect_bytes(what, before, info.bytes);
    const size_t tiles = (size_t)mw_mesh_triangle_count(mesh) + info.ghost_triangles;
    assert_int_equal(info.area_bytes, options.areas ? tiles * sizeof(double) : 0);
    assert_int_equal(info.fill_bytes > 0, info.ghost_triangles > 0);
    assert_int_equal(info.border_bytes > 0, options.border);
    assert_true(info.border_bytes + info.area_bytes + info.fill_bytes + info.guide_bytes <
                info.bytes);
    assert_true(info.chain_bytes <= info.guide_bytes);
    mw_locator_destroy(locator);
    expect_none(what, before);
}

static void test_locators(void **state)
{
    (void)state;
    check_locator("locator", in.mesh, (mw_locator_options){0});
    check_locator("locator with border", in.mesh, (mw_locator_options){.border = 1});
    check_locator("locator with areas", in.mesh, (mw_locator_options){.areas = 1});
    check_locator("locator, crowded", in.crowded, (mw_locator_options){0});
    check_locator("locator, filled", in.holed, (mw_locator_options){.fill = MW_FILL_YES});
    check_locator("locator, open", in.holed, (mw_locator_options){.fill = MW_FILL_NO});
    check_locator("locator with all", in.holed, (mw_locator_options){.border = 1, .areas = 1});
}

static void test_indices(void **state)
{
    (void)state;
    for (int start = 0; start < MW_START_COUNT; start++) {
        if (!mw_start_has_index((mw_start_kind)start)) continue;
        for (uint32_t corners = 0; corners < 2; corners++) {
            mw_index *index;
            mw_index_info info;
            mw_error error;
            const bytes_mark before = bytes_now();
            const mw_index_options options = {.corners = corners && start == MW_START_GRID};
            expect_status(
                mw_index_create(in.locator, (mw_start_kind)start, &options, &index, &error),
                &error);
            mw_index_describe(index, &info);
            expect_bytes(mw_start_name((mw_start_kind)start), before, info.bytes);
            mw_index_destroy(index);
            expect_none(mw_start_name((mw_start_kind)start), before);
        }
    }
}

static void test_borrowed(void **state)
{
    (void)state;
    for (int unchecked = 0; unchecked < 2; unchecked++) {
        mw_borrowed *mesh;
        mw_borrowed_info info;
        mw_error error;
        const bytes_mark before = bytes_now();
        const mw_borrowed_arrays foreign = {.mesh = arrays_view(&in.whole),
                                            .neighbours = in.neighbours};
        const mw_borrow_options options = {.unchecked = unchecked, .convex = unchecked};
        expect_status(mw_mesh_borrow(&foreign, &options, &mesh, &error), &error);
        mw_borrowed_describe(mesh, &info);
        expect_bytes("borrowed mesh", before, info.bytes);
        mw_borrowed_release(mesh);
        expect_none("borrowed mesh", before);
    }
}

static void check_operator(const char *what, bytes_mark before, mw_operator *weights)
{
    mw_operator_info info;
    mw_operator_describe(weights, &info);
    expect_bytes(what, before, info.bytes);
}

static void test_operators(void **state)
{
    (void)state;
    mw_operator *weights, *turned;
    mw_error error;
    mw_location *at = __real_malloc(in.point_count * sizeof *at);
    expect_status(mw_locate_batch(in.locator, in.points, in.point_count, 2, NULL, at, NULL, &error),
                  &error);
    const bytes_mark before = bytes_now();
    expect_status(mw_operator_create(in.mesh, at, in.point_count, NULL, &weights, &error), &error);
    check_operator("operator of places", before, weights);
    const bytes_mark between = bytes_now();
    expect_status(mw_operator_transpose(weights, NULL, &turned, &error), &error);
    check_operator("operator transposed", between, turned);
    mw_operator_destroy(turned);
    expect_none("operator transposed", between);
    mw_operator_destroy(weights);
    expect_none("operator of places", before);
    uint32_t rows[5] = {0, 0, 1, 3, 3}, columns[5] = {7, 8, 1, 2, 9};
    const double ones[5] = {1, 1, 1, 1, 1};
    const mw_operator_entries entries = {
        .row = rows, .column = columns, .weight = ones, .count = 5, .rows = 5, .columns = 10};
    expect_status(mw_operator_create_from_entries(&entries, NULL, &weights, &error), &error);
    check_operator("operator of entries", before, weights);
    mw_operator_destroy(weights);
    expect_none("operator of entries", before);
    __real_free(at);
}

static void test_editors(void **state)
{
    (void)state;
    for (size_t undo = 0; undo <= 4; undo += 2) {
        mw_editor *editor;
        mw_editor_info info;
        mw_error error;
        const mw_index *index;
        const bytes_mark before = bytes_now();
        const mw_editor_options options = {.undo = undo, .log = undo > 0};
        expect_status(mw_editor_create(in.mesh, &options, &editor, &error), &error);
        mw_editor_describe(editor, &info);
        expect_bytes("editor", before, info.bytes);
        for (uint32_t i = 0; i < 500; i++) {
            const double *p = in.points + 2 * (size_t)i;
            const mw_edit edit = {.kind = MW_EDIT_INSERT,
                                  .x = 0.5 * (p[0] + p[2]),
                                  .y = 0.5 * (p[1] + p[3]),
                                  .value = NAN};
            expect_status(mw_edit_apply(editor, &edit, NULL, &error), &error);
        }
        mw_editor_describe(editor, &info);
        expect_bytes("edited", before, info.bytes);
        expect_status(
            mw_editor_index(editor, MW_START_LAYERS, &(mw_index_options){0}, &index, &error),
            &error);
        expect_status(
            mw_editor_index(editor, MW_START_GRID, &(mw_index_options){0}, &index, &error), &error);
        mw_editor_describe(editor, &info);
        expect_bytes("edited, with indices", before, info.bytes);
        mw_editor_destroy(editor);
        expect_none("editor", before);
    }
}

static void test_polygons(void **state)
{
    (void)state;
    uint32_t segments[] = {0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3}, polygon[] = {0, 0, 0, 1, 1, 1};
    const double points[] = {0, 0, 8, 0, 0, 8, 4, 1, 4, 9, -3, 3};
    const mw_constraints rings = {.points = points,
                                  .point_count = 6,
                                  .segments = segments,
                                  .segment_count = 6,
                                  .polygon = polygon};
    mw_polygons *polygons;
    mw_polygons_info info;
    mw_error error;
    const bytes_mark before = bytes_now();
    expect_status(mw_polygons_create(&rings, NULL, &polygons, &error), &error);
    mw_polygons_describe(polygons, &info);
    expect_bytes("polygons (with their mesh)", before,
                 info.bytes + mw_mesh_bytes(mw_polygons_mesh(polygons)));
    mw_polygons_destroy(polygons);
    expect_none("polygons", before);
}

/* --- in space --------------------------------------------------------------------------------- */

static void test_surfaces(void **state)
{
    (void)state;
    for (int weld = 0; weld < 2; weld++) {
        mw_surface *surface;
        mw_surface_editor *editor;
        mw_surface_editor_info info;
        mw_error error;
        const bytes_mark before = bytes_now();
        const mw_arrays view = star_shape_arrays(&in.ball);
        const mw_surface_options options = {.weld = weld};
        expect_status(mw_surface_create(&view, &options, &surface, &error), &error);
        expect_bytes("surface", before, mw_surface_bytes(surface));
        const bytes_mark between = bytes_now();
        if (!weld) {
            expect_status(mw_surface_editor_create(surface, NULL, &editor, &error), &error);
            mw_surface_editor_describe(editor, &info);
            expect_bytes("surface editor", between, info.bytes);
            mw_surface_editor_destroy(editor);
        }
        mw_surface_destroy(surface);
        expect_none("surface", before);
    }
}

static void test_stars(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        mw_star *star;
        mw_star_info info;
        mw_error error;
        const bytes_mark before = bytes_now();
        const mw_star_options options = {.angles = kind == 1, .borrow = kind == 2};
        expect_status(mw_star_create(in.surface, &options, &star, &error), &error);
        mw_star_describe(star, &info);
        expect_bytes("star", before, info.bytes);
        assert_int_equal(info.angle_bytes, kind == 1 ? 16 * in.ball.points : 0);
        mw_star_destroy(star);
        expect_none("star", before);
    }
    for (int start = 0; start < MW_STAR_START_COUNT; start++) {
        mw_star_index *index;
        mw_star_index_info info;
        mw_error error;
        if (!mw_star_start_has_index((mw_star_start_kind)start)) continue;
        const bytes_mark before = bytes_now();
        expect_status(
            mw_star_index_create(in.star, (mw_star_start_kind)start, NULL, &index, &error), &error);
        mw_star_index_describe(index, &info);
        expect_bytes(mw_star_start_name((mw_star_start_kind)start), before, info.bytes);
        mw_star_index_destroy(index);
        expect_none("index of a star", before);
    }
}

static void test_probers(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        mw_prober *prober;
        mw_prober_info info;
        mw_error error;
        const bytes_mark before = bytes_now();
        const mw_prober_options options = {.boxes = kind & 1, .guide = kind >> 1};
        expect_status(mw_prober_create(in.surface, &options, &prober, &error), &error);
        mw_prober_describe(prober, &info);
        expect_bytes("prober", before, info.bytes);
        assert_int_equal(info.box_bytes > 0, kind & 1);
        assert_int_equal(info.guide_bytes > 0, kind >> 1);
        mw_prober_destroy(prober);
        expect_none("prober", before);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes),    cmocka_unit_test(test_locators),
        cmocka_unit_test(test_indices),   cmocka_unit_test(test_borrowed),
        cmocka_unit_test(test_operators), cmocka_unit_test(test_editors),
        cmocka_unit_test(test_polygons),  cmocka_unit_test(test_surfaces),
        cmocka_unit_test(test_stars),     cmocka_unit_test(test_probers),
    };
    return cmocka_run_group_tests(tests, make_inputs, release_inputs);
}
