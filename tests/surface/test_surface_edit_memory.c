/* test_surface_edit_memory.c - every allocation of an editor of a surface fails once: the call says
 * so, nothing has changed, and the same call succeeds afterwards. */
/* wrap: malloc calloc realloc aligned_alloc */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "oracle/edit_require.h"
#include "oracle/surface/surface_twin.h"
#include "support/allocations.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = 6, EDITS = 400 };

typedef struct surface_call {
    surface_twin *twin;
    const mw_surface_edit *edit;
    void *record; /* of the surface before the call */
    mw_surface *surface;
    mw_surface_editor_options options;
    mw_surface_editor *made;
    mw_star *star;
    mw_prober *prober;
} surface_call;

typedef mw_status surface_job(surface_call *call, mw_error *error);

static long failures_seen;
static uint32_t triangles[10000], vertices[10000]; /* new numbers */

/* Let allocation 0, 1, 2, ... of a job fail until it gets through. */
static mw_status exhaust(surface_job *run, surface_call *call)
{
    for (long k = 0;; k++) {
        mw_error error = {0};
        allocations_left = k;
        mw_status status = run(call, &error);
        bool failed = allocations_left < 0;
        allocations_left = -1;
        if (status != MW_ERROR_MEMORY) return status;
        REQUIRE(failed && strcmp(error.message, "out of memory") == 0);
        if (call->twin) surface_twin_require_record(call->twin, call->record);
        failures_seen++;
    }
}

static mw_status apply_job(surface_call *call, mw_error *error)
{
    return mw_surface_edit_apply(call->twin->editor, call->edit, NULL, error);
}

static mw_status undo_job(surface_call *call, mw_error *error)
{
    return mw_surface_edit_undo(call->twin->editor, NULL, error);
}

static mw_status compact_job(surface_call *call, mw_error *error)
{
    return mw_surface_editor_compact(call->twin->editor, triangles, vertices, error);
}

static mw_status create_job(surface_call *call, mw_error *error)
{
    return mw_surface_editor_create(call->surface, &call->options, &call->made, error);
}

/* Each edit is applied, with failures, and undone, with failures; then the twin does the same as
 * its editor. */
static void test_edits(void **state)
{
    (void)state;
    uint64_t random = 3;
    uint32_t path[2 * PATH];
    shape s = shape_join(shape_ball(1, 10, 0.3, &random), shape_patch(4, 2, &random), 30);
    surface_twin t = surface_twin_make(&s, SIZE_MAX);
    surface_call call = {.twin = &t};
    edit_case.name = "failing allocations";
    for (int i = 0; i < EDITS; i++) {
        mw_surface_edit edit = surface_twin_edit(&t, path, PATH, &random);
        edit_case.step = (uint64_t)i;
        call.edit = &edit;
        call.record = surface_twin_record(&t);
        mw_status status = exhaust(apply_job, &call);
        if (status == MW_OK) {
            void *before = call.record;
            call.record = surface_twin_record(&t);
            REQUIRE(exhaust(undo_job, &call) == MW_OK);
            surface_twin_require_record(&t, before);
            free(before);
        }
        free(call.record);
        REQUIRE(surface_twin_apply(&t, &edit) == (status == MW_OK));
        surface_twin_check(&t, 1, &random);
        if (i % 40 != 39) continue;
        call.record = surface_twin_record(&t);
        REQUIRE(exhaust(compact_job, &call) == MW_OK);
        free(call.record);
        surface_twin_compacted(&t, triangles, vertices);
        surface_twin_check(&t, 1, &random);
    }
    printf("%ld allocations failed\n", failures_seen);
    REQUIRE(failures_seen > EDITS / 8);
    surface_twin_free(&t);
    shape_free(&s);
}

static void test_creation(void **state)
{
    (void)state;
    uint64_t random = 4;
    shape s = shape_patch(4, 2, &random);
    surface_call call = {.surface = shape_surface(&s, (mw_surface_options){0})};
    mw_prober_options boxes = {.boxes = 1, .threads = 1};
    REQUIRE(mw_prober_create(call.surface, &boxes, &call.options.prober, NULL) == MW_OK);
    failures_seen = 0;
    REQUIRE(exhaust(create_job, &call) == MW_OK);
    printf("%ld allocations of a creation failed\n", failures_seen);
    REQUIRE(failures_seen >= 8); /* what one try got is there in the next */
    mw_surface_editor_destroy(call.made);
    mw_prober_destroy(call.options.prober);
    mw_surface_destroy(call.surface);
    shape_free(&s);
}

/* --- what follows --- */

static mw_status attach_star_job(surface_call *call, mw_error *error)
{
    return mw_surface_editor_attach_star(call->made, call->star, error);
}

static mw_status attach_prober_job(surface_call *call, mw_error *error)
{
    return mw_surface_editor_attach_prober(call->made, call->prober, error);
}

/* A prober and a star are attached, up to date and not: a star that was up to date stays so, and in
 * the end both follow. */
static void test_attaching(void **state)
{
    (void)state;
    uint64_t random = 6;
    shape s = shape_ball(2, 20, 0.3, &random);
    surface_call call = {.surface = shape_surface(&s, (mw_surface_options){0})};
    mw_prober_options boxes = {.boxes = 1, .threads = 1};
    mw_star_options angles = {.angles = 1, .threads = 1};
    mw_star_cursor cursor = {0};
    star_twin_counts counts = {0};
    REQUIRE(mw_surface_editor_create(call.surface, NULL, &call.made, NULL) == MW_OK);
    REQUIRE(mw_prober_create(call.surface, &boxes, &call.prober, NULL) == MW_OK);
    REQUIRE(mw_star_create(call.surface, &angles, &call.star, NULL) == MW_OK);
    for (int round = 0; round < 3; round++) {
        long before = failures_seen;
        REQUIRE(exhaust(attach_star_job, &call) == MW_OK);
        REQUIRE(failures_seen - before >= 3);
        before = failures_seen;
        REQUIRE(exhaust(attach_prober_job, &call) == MW_OK);
        REQUIRE(failures_seen - before >= (round == 1));
        REQUIRE(mw_surface_edit_split_triangle(call.made, 3, NULL, NULL, NULL) == MW_OK);
        star_twin_check(call.star, &cursor, 20, &counts, &random);
        REQUIRE(mw_star_ready(call.star));
        mw_surface_editor_detach_star(call.made, call.star);
        mw_surface_editor_detach_prober(call.made, call.prober);
        if (round == 0) /* out of date */
            REQUIRE(mw_surface_edit_split_triangle(call.made, 5, NULL, NULL, NULL) == MW_OK);
    }
    mw_surface_editor_destroy(call.made);
    mw_star_destroy(call.star);
    mw_prober_destroy(call.prober);
    mw_surface_destroy(call.surface);
    shape_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_edits),
                                       cmocka_unit_test(test_creation),
                                       cmocka_unit_test(test_attaching)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
