/* test_edit_threads.c - between edits threads query the editor's locator, each with cursors of its
 * own that outlast the edits: all get the answers that one gets, and (under ThreadSanitizer) there
 * is no data race. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "base/random.h"
#include "support/meshes.h"

#include <math.h>
#include <pthread.h>

enum { POINTS = 400, QUERIES = 300, THREADS = 3, ROUNDS = 30, EDITS = 20 };

typedef struct reader_thread {
    const mw_editor *editor;
    const double *query;
    mw_cursor cursor[MW_WALK_COUNT];
    uint64_t seed;
    mw_location answer[QUERIES];
} reader_thread;

static void *ask(void *argument)
{
    reader_thread *r = argument;
    for (size_t i = 0; i < QUERIES; i++) {
        mw_cursor *cursor = &r->cursor[(i + r->seed) % MW_WALK_COUNT];
        r->answer[i] =
            mw_locate(mw_editor_locator(r->editor), cursor, r->query[2 * i], r->query[2 * i + 1]);
    }
    return NULL;
}

/* The walks of a reader begin in different ways. */
static void open_reader(reader_thread *r, mw_editor *editor, const double *query, uint64_t seed)
{
    static const mw_start_kind starts[] = {MW_START_AUTO, MW_START_LAST, MW_START_GRID,
                                           MW_START_LAYERS};
    *r = (reader_thread){.editor = editor, .query = query, .seed = seed};
    for (int walk = 0; walk < MW_WALK_COUNT; walk++) {
        mw_query_options options = {
            .walk = (mw_walk_kind)walk, .start = starts[(seed + (uint64_t)walk) % 4], .seed = seed};
        if (mw_start_has_index(options.start))
            assert_int_equal(mw_editor_index(editor, options.start, NULL, &options.index, NULL),
                             MW_OK);
        assert_int_equal(
            mw_cursor_init(mw_editor_locator(editor), &options, &r->cursor[walk], NULL), MW_OK);
    }
}

static void edit_some(mw_editor *editor, uint64_t *random)
{
    for (int i = 0; i < EDITS; i++) {
        mw_editor_info info;
        mw_editor_describe(editor, &info);
        uint32_t v = mw__random_below(random, info.vertex_range);
        double x = random_unit(random), y = random_unit(random);
        if (i % 3 == 0)
            mw_edit_insert(editor, x, y, NULL, NULL);
        else if (i % 3 == 1)
            mw_edit_remove(editor, v, NULL, NULL);
        else
            mw_edit_move(editor, v, x, y, NULL, NULL);
    }
}

static void test_queries_between_edits(void **state)
{
    (void)state;
    static double points[2 * POINTS], query[2 * QUERIES];
    static reader_thread r[THREADS + 1];
    uint64_t random = 1;
    for (int i = 0; i < 2 * POINTS; i++) points[i] = random_unit(&random);
    for (int i = 0; i < 2 * QUERIES; i++) query[i] = 1.2 * random_unit(&random) - 0.1;
    mw_mesh *mesh = mesh_delaunay(points, POINTS);
    mw_editor *editor;
    assert_int_equal(mw_editor_create(mesh, NULL, &editor, NULL), MW_OK);
    mw_mesh_destroy(mesh);
    for (uint64_t i = 0; i <= THREADS; i++) open_reader(&r[i], editor, query, i);
    for (int round = 0; round < ROUNDS; round++) {
        pthread_t thread[THREADS];
        edit_some(editor, &random);
        for (int i = 0; i < THREADS; i++)
            assert_int_equal(pthread_create(&thread[i], NULL, ask, &r[i]), 0);
        ask(&r[THREADS]);
        for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
        for (int i = 0; i < THREADS; i++)
            for (int k = 0; k < QUERIES; k++) {
                assert_int_equal(r[i].answer[k].triangle, r[THREADS].answer[k].triangle);
                assert_int_equal(r[i].answer[k].where, r[THREADS].answer[k].where);
            }
    }
    mw_editor_destroy(editor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_queries_between_edits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
