/* calls.c - long calls on inputs of any size and any number of threads: cancelled at any report,
 * from which nothing may be left behind; or repeated by a child of fork(), whose results must be
 * those of its parent. */
#include "hostile/hostile.h"
#include "support/calls/long_calls.h"

#include <sys/wait.h>
#include <unistd.h>

static uint32_t any_size(uint64_t *random)
{
    return 50 + mw__random_below(random, 1u << (6 + mw__random_below(random, 9)));
}

typedef struct stopper {
    uint32_t reports, stop_at;
    double stopped; /* at this fraction */
} stopper;

static int stopper_report(void *context, const char *stage, double fraction)
{
    stopper *s = context;
    (void)stage;
    bool stop = s->reports++ == s->stop_at;
    if (stop) s->stopped = fraction;
    return stop;
}

static mw_status call_stop(const long_call *call, const call_inputs *in, uint32_t threads,
                           stopper *s)
{
    uint64_t sum = 0;
    mw_progress progress = {stopper_report, s};
    return call->run(in, &(call_setting){threads, &progress}, &sum, NULL);
}

void hostile_cancels(uint64_t *random)
{
    enum { TRIES = 20 };
    call_inputs in = call_inputs_make(any_size(random), mw__random(random));
    for (int i = 0; i < TRIES; i++) {
        const long_call *call = &long_calls[mw__random_below(random, (uint32_t)long_call_count)];
        uint32_t threads = 1 + mw__random_below(random, 4);
        stopper never = {.stop_at = UINT32_MAX};
        mw_status status = call_stop(call, &in, threads, &never);
        if (status) hostile_failed("%s: %s", call->name, mw_status_text(status));
        stopper once = {.stop_at = mw__random_below(random, never.reports)};
        status = call_stop(call, &in, threads, &once);
        if (status && status != MW_CANCELLED)
            hostile_failed("%s, cancelled: %s", call->name, mw_status_text(status));
        /* at its last report a call has done all; there may be fewer reports than before */
        if (!status && once.reports > once.stop_at && once.stopped < 1)
            hostile_failed("%s, cancelled at %g: went on", call->name, once.stopped);
    }
    call_inputs_release(&in);
}

static uint64_t call_sum(const long_call *call, const call_inputs *in, uint32_t threads)
{
    uint64_t sum = 0;
    mw_status status = call->run(in, &(call_setting){.threads = threads}, &sum, NULL);
    if (status) hostile_failed("%s: %s", call->name, mw_status_text(status));
    return sum;
}

void hostile_forks(uint64_t *random)
{
    enum { TRIES = 8, LONGEST = 100 /* seconds */ };
    call_inputs in = call_inputs_make(any_size(random), mw__random(random));
    for (int i = 0; i < TRIES; i++) {
        const long_call *before = &long_calls[mw__random_below(random, (uint32_t)long_call_count)];
        const long_call *call = &long_calls[mw__random_below(random, (uint32_t)long_call_count)];
        uint32_t threads = 1 + mw__random_below(random, 4);
        uint64_t sum = call_sum(call, &in, 1);
        call_sum(before, &in, 4);
        pid_t child = fork();
        if (child == 0) {
            alarm(LONGEST);
            _exit(call_sum(call, &in, threads) != sum);
        }
        int end = -1;
        if (waitpid(child, &end, 0) != child || end != 0)
            hostile_failed("a child after %s: %s on %u threads ended with %d", before->name,
                           call->name, threads, end);
    }
    call_inputs_release(&in);
}
