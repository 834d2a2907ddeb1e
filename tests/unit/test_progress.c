/* Long calls are watched: reports come in order and are few; a call can be cancelled at each of
 * them, and leaves nothing behind. */
#define _GNU_SOURCE /* sched_setaffinity */
#include "base/job.h"
#include "support/environment.h"
#include "support/calls/long_calls.h"
#include "support/files.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>
#include <string.h>
#ifdef __linux__
#include <sched.h>
#endif

enum { MOST_REPORTS = 300 };

typedef struct watcher {
    int reports, stop_at; /* -1: never */
    double last;
    bool in_order, has_stages;
} watcher;

static int watcher_report(void *context, const char *stage, double fraction)
{
    watcher *w = context;
    w->in_order = w->in_order && fraction >= w->last && fraction >= 0 && fraction <= 1;
    w->has_stages = w->has_stages && stage && *stage;
    w->last = fraction;
    return w->reports++ == w->stop_at;
}

static watcher watch(const long_call *call, const call_inputs *in, uint32_t threads, int stop_at,
                     mw_status *status)
{
    watcher w = {.stop_at = stop_at, .in_order = true, .has_stages = true};
    mw_progress progress = {watcher_report, &w};
    uint64_t sum = 0;
    mw_error error = {0};
    *status = call->run(in, &(call_setting){threads, &progress}, &sum, &error);
    if (*status) assert_int_equal(error.status, *status);
    return w;
}

/* An editor's calls are several, each with reports from 0 to 1. */
static bool is_several(const long_call *call)
{
    return strstr(call->name, "calls") != NULL;
}

static void test_reports(void **state)
{
    call_inputs in = call_inputs_make(20000, environment_print_seed("reports", 1));
    (void)state;
    for (size_t i = 0; i < long_call_count; i++) {
        mw_status status;
        watcher w = watch(&long_calls[i], &in, 2, -1, &status);
        if (status) fail_msg("%s: %s", long_calls[i].name, mw_status_text(status));
        if (!w.has_stages || w.last != 1) fail_msg("%s ends at %g", long_calls[i].name, w.last);
        if (!is_several(&long_calls[i]) && !w.in_order)
            fail_msg("%s: fractions go back", long_calls[i].name);
        if (w.reports > MOST_REPORTS * (is_several(&long_calls[i]) ? 5 : 1))
            fail_msg("%s: %d reports", long_calls[i].name, w.reports);
    }
    call_inputs_release(&in);
}

/* Watching changes no result, nor does the number of threads. */
static void test_same_results(void **state)
{
    call_inputs in = call_inputs_make(20000, environment_print_seed("same results", 2));
    (void)state;
    for (size_t i = 0; i < long_call_count; i++) {
        uint64_t sum[3] = {0};
        watcher w = {.stop_at = -1};
        mw_progress progress = {watcher_report, &w}, silent = {0};
        const call_setting how[3] = {{1, NULL}, {3, &progress}, {2, &silent}};
        for (int k = 0; k < 3; k++)
            assert_int_equal(long_calls[i].run(&in, &how[k], &sum[k], NULL), MW_OK);
        if (sum[0] != sum[1] || sum[0] != sum[2]) fail_msg("%s: other results", long_calls[i].name);
    }
    call_inputs_release(&in);
}

static void test_cancel_at_each_report(void **state)
{
    call_inputs in = call_inputs_make(200, environment_print_seed("cancel", 3));
    (void)state;
    for (size_t i = 0; i < long_call_count; i++) {
        mw_status status;
        int reports = watch(&long_calls[i], &in, 1, -1, &status).reports;
        for (int stop = 0; stop < reports; stop++) {
            watcher w = watch(&long_calls[i], &in, 1, stop, &status);
            /* what is done is done */
            if (status == MW_OK && w.last == 1) continue;
            if (is_several(&long_calls[i]) && status == MW_OK) continue;
            if (status != MW_CANCELLED)
                fail_msg("%s at report %d: %s", long_calls[i].name, stop, mw_status_text(status));
            if (w.reports != stop + 1)
                fail_msg("%s: reports after it was cancelled", long_calls[i].name);
        }
    }
    call_inputs_release(&in);
}

/* With threads, and in calls large enough for all of them. */
static void test_cancel_large(void **state)
{
    call_inputs in = call_inputs_make(20000, environment_print_seed("cancel large", 4));
    (void)state;
    for (size_t i = 0; i < long_call_count; i++) {
        mw_status status;
        int reports = watch(&long_calls[i], &in, 2, -1, &status).reports;
        int step = environment_is_long() ? 1 : reports / 2 + 1;
        for (int stop = 0; stop + 1 < reports; stop += step) {
            watch(&long_calls[i], &in, 2, stop, &status);
            if (status != MW_CANCELLED && !is_several(&long_calls[i]) && status != MW_OK)
                fail_msg("%s at report %d: %s", long_calls[i].name, stop, mw_status_text(status));
        }
    }
    call_inputs_release(&in);
}

/* --- jobs ------------------------------------------------------------------------------------- */

static void test_parts(void **state)
{
    (void)state;
    watcher w = {.stop_at = -1, .in_order = true, .has_stages = true};
    mw_progress progress = {watcher_report, &w};
    mw_job job = mw__job(1, &progress);
    mw__job_stage(&job, "first", 0.5);
    assert_true(mw__job_step(&job, 1, 2));
    assert_true(w.last == 0.25);
    mw_job_span outer = mw__job_part(&job, 0.25);
    mw__job_stage(&job, "inner", 0.5);
    assert_true(w.last == 0.5);
    mw__job_stage(&job, "inner", 0.5);
    assert_true(w.last == 0.625);
    mw_job_span steps = mw__job_steps_of(&job, 1, 1, 2);
    assert_true(mw__job_step(&job, 1, 2));
    assert_true(w.last == 0.71875);
    mw__job_steps_end(&job, steps);
    mw__job_part_end(&job, outer);
    mw__job_stage(&job, "last", 0.25);
    assert_true(w.last == 0.75);
    int reports = w.reports;
    for (int i = 0; i < 100000; i++) assert_true(mw__job_step(&job, (uint64_t)i, 100000));
    assert_in_range(w.reports - reports, 30, 70);
    assert_int_equal(mw__job_end(&job, MW_OK, NULL), MW_OK);
    assert_true(w.last == 1 && w.in_order);
}

/* However many stages there are, the reports stay few. */
static void test_many_stages(void **state)
{
    (void)state;
    watcher w = {.stop_at = -1, .in_order = true, .has_stages = true};
    mw_progress progress = {watcher_report, &w};
    mw_job job = mw__job(1, &progress);
    for (int i = 0; i < 5000; i++) {
        mw__job_stage(&job, "one of many", 1.0 / 5000);
        assert_true(mw__job_step(&job, 1, 2));
    }
    assert_int_equal(mw__job_end(&job, MW_OK, NULL), MW_OK);
    assert_in_range(w.reports, 200, MOST_REPORTS);
    assert_true(w.in_order);
}

typedef struct chunk_marks {
    _Atomic int done[1000];
    uint32_t team;
    _Atomic bool wrong;
} chunk_marks;

static void chunk_mark(void *work, uint64_t chunk, uint32_t member)
{
    chunk_marks *m = work;
    m->done[chunk]++;
    if (member >= m->team) m->wrong = true;
}

/* Unless a number is asked for, one thread for each processor that this process may use. */
static void expect_allowed_processors(void)
{
#ifdef __linux__
    cpu_set_t allowed, one;
    size_t first = 0;
    assert_int_equal(sched_getaffinity(0, sizeof allowed, &allowed), 0);
    while (!CPU_ISSET(first, &allowed)) first++;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    assert_int_equal(mw__team(0, UINT64_MAX), 1);
    assert_int_equal(sched_setaffinity(0, sizeof allowed, &allowed), 0);
#else
    assert_true(mw__team(0, UINT64_MAX) >= 1);
#endif
}

static void test_chunks(void **state)
{
    (void)state;
    for (uint32_t threads = 1; threads <= 8; threads++) {
        chunk_marks marks = {.team = mw__team(threads, 1000)};
        mw_job job = mw__job(threads, NULL);
        assert_int_equal(marks.team, threads);
        assert_true(mw__job_chunks(&job, marks.team, 1000, chunk_mark, &marks));
        for (int i = 0; i < 1000; i++) assert_int_equal(marks.done[i], 1);
        assert_false(marks.wrong);
    }
    assert_int_equal(mw__team(5, 0), 1);
    assert_int_equal(mw__team(5, 3), 3);
    assert_int_equal(mw__team(100000, UINT64_MAX), MW_MOST_THREADS);
    expect_allowed_processors();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_many_stages),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test_setup_teardown(test_reports, files_enter, files_leave),
        cmocka_unit_test_setup_teardown(test_same_results, files_enter, files_leave),
        cmocka_unit_test_setup_teardown(test_cancel_at_each_report, files_enter, files_leave),
        cmocka_unit_test_setup_teardown(test_cancel_large, files_enter, files_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
