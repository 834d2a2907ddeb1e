/* Threads are made by a call, as many as it was allowed, and end with it; where the system refuses
 * them, fewer do the work; a child made by fork() calls like its parent. */
/* wrap: pthread_create */
#include "support/environment.h"
#include "support/files.h"
#include "support/calls/long_calls.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

enum { POINTS = 20000, THREADS = 3 };

static atomic_int made, allowed; /* threads */

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *argument);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                          void *argument)
{
    if (made >= allowed) return EAGAIN;
    made++;
    return __real_pthread_create(thread, attributes, run, argument);
}

static int threads_now(void)
{
    int count = 0;
    DIR *tasks = opendir("/proc/self/task");
    if (!tasks) return -1;
    for (struct dirent *entry; (entry = readdir(tasks));) count += entry->d_name[0] != '.';
    closedir(tasks);
    return count;
}

/* A thread that has been joined may still be listed for a moment. */
static bool threads_come_down_to(int count)
{
    enum { TRIES = 1000, PAUSE = 1000 /* microseconds */ };
    for (int i = 0; i < TRIES && threads_now() > count; i++) usleep(PAUSE);
    return threads_now() <= count;
}

static uint64_t call_sum(const long_call *call, const call_inputs *in, uint32_t threads)
{
    uint64_t sum = 0;
    mw_error error = {0};
    mw_status status = call->run(in, &(call_setting){.threads = threads}, &sum, &error);
    if (status) fail_msg("%s on %u threads: %s", call->name, threads, error.message);
    return sum;
}

/* Ends the child: 0 if its results are those of its parent. */
static _Noreturn void child_run(const long_call *call, const call_inputs *in, uint64_t sum)
{
    uint64_t again = 0;
    alarm(120);
    mw_status status = call->run(in, &(call_setting){.threads = THREADS}, &again, NULL);
    _exit(status || again != sum);
}

static void check_in_child(const long_call *call, const call_inputs *in, uint64_t sum)
{
    pid_t child = fork();
    if (child == 0) child_run(call, in, sum);
    int end = -1;
    assert_int_equal(waitpid(child, &end, 0), child);
    if (end != 0) fail_msg("%s: the child ended with %d", call->name, end);
}

static void test_threads_end_with_the_call_and_fork(void **state)
{
    call_inputs in = call_inputs_make(POINTS, environment_print_seed("threads end", 2));
    (void)state;
    allowed = INT32_MAX;
    /* a sanitizer makes a thread of its own at the first one */
    call_sum(&long_calls[0], &in, THREADS);
    usleep(100000);
    int before = threads_now();
    for (size_t i = 0; i < long_call_count; i++) {
        uint64_t sum = call_sum(&long_calls[i], &in, THREADS);
        if (!threads_come_down_to(before)) fail_msg("%s leaves threads behind", long_calls[i].name);
        check_in_child(&long_calls[i], &in, sum);
    }
    call_inputs_release(&in);
}

static void test_one_makes_none_and_refused_threads(void **state)
{
    call_inputs in = call_inputs_make(POINTS, environment_print_seed("refused threads", 3));
    (void)state;
    for (size_t i = 0; i < long_call_count; i++) {
        made = 0;
        allowed = INT32_MAX;
        uint64_t sum = call_sum(&long_calls[i], &in, 1);
        if (made != 0) fail_msg("%s makes threads, and was allowed one", long_calls[i].name);
        allowed = 0;
        if (call_sum(&long_calls[i], &in, THREADS) != sum)
            fail_msg("%s: other results without threads", long_calls[i].name);
        allowed = 1;
        if (call_sum(&long_calls[i], &in, THREADS) != sum)
            fail_msg("%s: other results with one", long_calls[i].name);
    }
    call_inputs_release(&in);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_threads_end_with_the_call_and_fork, files_enter,
                                        files_leave),
        cmocka_unit_test_setup_teardown(test_one_makes_none_and_refused_threads, files_enter,
                                        files_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
