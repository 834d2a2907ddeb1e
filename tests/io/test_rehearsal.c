/* test_rehearsal.c - work is tried in a child: it comes to its end, or does not, and this process
 * goes on in either case. */
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/netcdf/rehearsal.h"

static void ends(void *work)
{
    *(int *)work = 7;
    fprintf(stderr, "nobody sees this\n");
    fflush(stderr);
}

static void aborts(void *work)
{
    (void)work;
    abort();
}

static void falls(void *work)
{
    (void)work;
    raise(SIGSEGV);
}

static void leaves(void *work)
{
    (void)work;
    _exit(0);
}

static void waits(void *work)
{
    (void)work;
    for (;;) pause();
}

static void goes_on(void *work)
{
    for (;;) ++*(volatile unsigned *)work;
}

static void reports(int number)
{
    (void)number;
    _exit(0); /* a host's handler that would hide the fall */
}

static bool comes_to_an_end(void (*perform)(void *), int *value)
{
    mw_rehearsal rehearsal;
    assert_true(mw__rehearsal_begin(&rehearsal, perform, value));
    return mw__rehearsal_end(&rehearsal);
}

static void work_that_ends_is_told_from_other_work(void **state)
{
    int value = 1;
    (void)state;
    assert_true(comes_to_an_end(ends, &value));
    assert_int_equal(value, 1); /* the child's memory is its own */
    assert_false(comes_to_an_end(aborts, &value));
    assert_false(comes_to_an_end(falls, &value));
    assert_false(comes_to_an_end(leaves, &value));
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
}

/* A child that waits has met a lock that stays locked; one that never ends is the work's fault. */
static void waiting_is_told_from_working(void **state)
{
    int value = 1;
    (void)state;
    assert_true(comes_to_an_end(waits, &value));
    assert_false(comes_to_an_end(goes_on, &value));
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
}

static void handlers_of_the_host_are_not_asked(void **state)
{
    int value = 1;
    (void)state;
    signal(SIGABRT, reports);
    signal(SIGCHLD, SIG_IGN);
    assert_false(comes_to_an_end(aborts, &value));
    assert_true(comes_to_an_end(ends, &value));
    signal(SIGABRT, SIG_DFL);
    signal(SIGCHLD, SIG_DFL);
}

/* The pipe would get the number of a stream, which the child turns to /dev/null. */
static void closed_streams_do_no_harm(void **state)
{
    int value = 1, kept[3];
    (void)state;
    for (int k = 0; k < 3; k++) {
        kept[k] = fcntl(k, F_DUPFD, 10);
        close(k);
    }
    const bool ended = comes_to_an_end(ends, &value);
    for (int k = 0; k < 3; k++) {
        dup2(kept[k], k);
        close(kept[k]);
    }
    assert_true(ended);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_that_ends_is_told_from_other_work),
        cmocka_unit_test(waiting_is_told_from_working),
        cmocka_unit_test(handlers_of_the_host_are_not_asked),
        cmocka_unit_test(closed_streams_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
