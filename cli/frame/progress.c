/* The library does not call back at regular times. So a thread shows the progress: it sleeps for a
 * second, then repaints the line a few times a second until it is told to stop. */
#include "cli/frame/progress.h"
#include "cli/frame/signals.h"
#include "src/base/posix.h"
#include "src/base/posix.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <threads.h>

#define REPAINT_NANOSECONDS 250000000L

static struct {
    bool running, stop, shown;
    thrd_t thread;
    mtx_t lock;
    cnd_t wake;
    const char *doing, *what, *unit;
    uint64_t done;
    double rate;    /* points or lines per second */
    char stage[64]; /* of a call of the library; "": none */
    /* the part of the phase that calls of the library make up: from, to */
    double part[2];
    /* how much of the phase or the call is done; -1: not known */
    double fraction;
    struct timespec begin, phase_begin, part_begin; /* part: the phase or call of `fraction` */
} watch;

static double seconds_since(const struct timespec *begin)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)(now.tv_sec - begin->tv_sec) + 1e-9 * (double)(now.tv_nsec - begin->tv_nsec);
}

/* Sleep for the given time, or until told to stop. The caller holds the lock. */
static bool progress_wait(time_t seconds, long nanoseconds)
{
    struct timespec until;
    timespec_get(&until, TIME_UTC);
    until.tv_sec += seconds;
    until.tv_nsec += nanoseconds;
    if (until.tv_nsec >= 1000000000L) {
        until.tv_nsec -= 1000000000L;
        until.tv_sec++;
    }
    while (!watch.stop)
        if (cnd_timedwait(&watch.wake, &watch.lock, &until) == thrd_timedout) break;
    return !watch.stop;
}

static void progress_paint(void)
{
    if (!watch.doing) return;
    fprintf(stderr, "\r\033[K%s", watch.doing);
    if (watch.what)
        fprintf(stderr, " %s", strcmp(watch.what, "-") == 0 ? "standard input" : watch.what);
    double part = seconds_since(&watch.part_begin);
    if (*watch.stage) fprintf(stderr, ": %s", watch.stage);
    if (watch.done) fprintf(stderr, ": %" PRIu64 " %s", watch.done, watch.unit);
    if (watch.done) fprintf(stderr, ", %.0f a second", watch.rate);
    if (watch.fraction >= 0) fprintf(stderr, ", %.0f %%", 100 * watch.fraction);
    fprintf(stderr, ", %.0f s", seconds_since(&watch.begin));
    if (watch.fraction > 0.02)
        fprintf(stderr, ", about %.0f s left", part / watch.fraction * (1 - watch.fraction));
    fflush(stderr);
    watch.shown = true;
}

static int progress_run(void *unused)
{
    (void)unused;
    mtx_lock(&watch.lock);
    for (bool more = progress_wait(1, 0); more; more = progress_wait(0, REPAINT_NANOSECONDS))
        progress_paint();
    mtx_unlock(&watch.lock);
    return 0;
}

void progress_begin(bool quiet)
{
    if (quiet || watch.running || !isatty(STDERR_FILENO)) return;
    timespec_get(&watch.begin, TIME_UTC);
    watch.stop = watch.shown = false;
    if (mtx_init(&watch.lock, mtx_plain) != thrd_success) return;
    if (cnd_init(&watch.wake) == thrd_success) {
        watch.running = thrd_create(&watch.thread, progress_run, NULL) == thrd_success;
        if (!watch.running) cnd_destroy(&watch.wake);
    }
    if (!watch.running) mtx_destroy(&watch.lock);
}

void progress_phase(const char *doing, const char *what)
{
    if (!watch.running) return;
    mtx_lock(&watch.lock);
    watch.doing = doing;
    watch.what = what;
    watch.done = 0;
    watch.fraction = -1;
    watch.part[0] = 0;
    watch.part[1] = 1;
    *watch.stage = 0;
    timespec_get(&watch.phase_begin, TIME_UTC);
    watch.part_begin = watch.phase_begin;
    mtx_unlock(&watch.lock);
}

static void progress_count(uint64_t done, double fraction, const char *unit)
{
    if (!watch.running) return;
    mtx_lock(&watch.lock);
    double seconds = seconds_since(&watch.phase_begin);
    watch.done = done;
    watch.rate = seconds > 0 ? (double)done / seconds : 0;
    watch.unit = unit;
    watch.fraction = fraction;
    *watch.stage = 0;
    mtx_unlock(&watch.lock);
}

void progress_points(uint64_t done, double fraction)
{
    progress_count(done, fraction, "points");
}

void progress_lines(uint64_t done, double fraction)
{
    progress_count(done, fraction, "lines");
}

void progress_part(double from, double to)
{
    if (!watch.running) return;
    mtx_lock(&watch.lock);
    watch.part[0] = from;
    watch.part[1] = to;
    mtx_unlock(&watch.lock);
}

/* Another call, if the phase has several, begins at 0 again. While points are counted, stages
 * would come and go too fast to be read. */
static int progress_report(void *unused, const char *stage, double fraction)
{
    (void)unused;
    if (watch.running) {
        mtx_lock(&watch.lock);
        double now =
            watch.part[0] < 0 ? -1 : watch.part[0] + (watch.part[1] - watch.part[0]) * fraction;
        if (now < watch.fraction) timespec_get(&watch.part_begin, TIME_UTC);
        watch.fraction = now;
        snprintf(watch.stage, sizeof watch.stage, "%s", watch.done ? "" : stage);
        mtx_unlock(&watch.lock);
    }
    return signals_have_come();
}

const mw_progress *progress_of_call(void)
{
    static const mw_progress of_call = {.report = progress_report};
    return &of_call;
}

void progress_end(void)
{
    if (!watch.running) return;
    mtx_lock(&watch.lock);
    watch.stop = true;
    cnd_signal(&watch.wake);
    mtx_unlock(&watch.lock);
    thrd_join(watch.thread, NULL);
    cnd_destroy(&watch.wake);
    mtx_destroy(&watch.lock);
    watch.running = false;
    if (watch.shown) {
        fputs("\r\033[K", stderr);
        fflush(stderr);
    }
}
